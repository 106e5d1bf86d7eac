//! Points of a line, and its compliance between them.
//!
//! ```text
//! Y = N_i K̂⁻¹ N_jᵀ          N rows of the ports at a point: Hermite for bending, linear for torsion
//! N K̂⁻¹ e_s                 e_s rows of the springs on the bridge
//! c_loc = (ξ(1−ξ)l)³/(3EI),  ξ(1−ξ)l/(GJ)
//! ```
//!
//! K̂⁻¹ is tabulated in bands of blocks between nodes, as far as it decays to 1e-16. Farther than that from both ends of the
//! track it is the same in every bay, and is solved for in one.

use ttb_dynamics::band::{Band, BandFactor, NotPositiveDefinite};
use ttb_dynamics::newmark::Motion;
use ttb_dynamics::twisted::TwistedFactor;

use super::car::dot;
use super::line::{Field, Line};

/// Ports of a line at a point at most.
pub const MOST_PORTS: usize = 3;
/// Degrees of freedom of an element at most.
const MOST_DOFS: usize = 10;
/// What is left out of the inverse, relative to the largest entry of a column.
const NEGLIGIBLE: f64 = 1e-16;

/// Where an axle stands on a line.
#[derive(Clone, Copy, Debug, Default)]
pub struct LinePoint {
    element: usize,
    /// Row of every port over the element's degrees of freedom.
    rows: [[f64; MOST_DOFS]; MOST_PORTS],
    /// c_loc of every port.
    pub local: [f64; MOST_PORTS],
}

impl Line {
    /// Number of ports at a point: one a field.
    pub fn ports(&self) -> usize {
        self.made_of.fields.len()
    }

    /// The point at the part `xi` of an element.
    pub fn point(&self, element: usize, xi: f64, local: bool) -> LinePoint {
        let (w, l) = (self.width, self.made_of.length);
        let mut point = LinePoint { element, ..LinePoint::default() };
        let mut place = 0;
        for (port, field) in self.made_of.fields.iter().enumerate() {
            let row = &mut point.rows[port];
            match field {
                Field::Bending(beam) => {
                    let n = beam.shape(xi, l);
                    (row[place], row[place + 1], row[w + place], row[w + place + 1]) = (n[0], n[1], n[2], n[3]);
                    point.local[port] = if local { beam.local_compliance(xi, l) } else { 0.0 };
                    place += 2;
                }
                Field::Torsion { stiffness, .. } => {
                    (row[place], row[w + place]) = (1.0 - xi, xi);
                    point.local[port] = if local { xi * (1.0 - xi) * l / stiffness } else { 0.0 };
                    place += 1;
                }
            }
        }
        point
    }

    fn each(&self, point: &LinePoint, port: usize, mut visit: impl FnMut(usize, f64)) {
        let (a, b, w) = (self.node(point.element), self.node(point.element + 1), self.width);
        let row = &point.rows[port];
        (0..w).for_each(|k| visit(a + k, row[k]));
        (0..w).for_each(|k| visit(b + k, row[w + k]));
    }

    /// N x of a port.
    pub fn at(&self, point: &LinePoint, port: usize, x: &[f64]) -> f64 {
        self.of(point, port, |i| x[i])
    }

    /// N x of a port, x given by its entries.
    pub fn of(&self, point: &LinePoint, port: usize, x: impl Fn(usize) -> f64) -> f64 {
        let mut sum = 0.0;
        self.each(point, port, |i, n| sum += n * x(i));
        sum
    }

    /// p += Nᵀ f of a port.
    pub fn add_force(&self, point: &LinePoint, port: usize, force: f64, p: &mut [f64]) {
        self.each(point, port, |i, n| p[i] += n * force);
    }
}

/// A line for one step size, or at rest.
#[derive(Clone, Debug)]
pub struct LineFactors {
    /// K̂.
    pub factor: TwistedFactor,
    table: Table,
    /// K̂⁻¹ e_s of the rows to the deck at the rail nodes less than `reach` away, 2 reach − 1 of them.
    columns: Vec<f64>,
}

#[derive(Clone, Debug)]
struct Table {
    /// Nodes that a node is felt at, itself included.
    reach: usize,
    width: usize,
    /// K̂⁻¹ between the fields of nodes p (rows) and p + o (columns), o < reach.
    blocks: Vec<f64>,
}

impl LineFactors {
    /// Factorises K + a_M M + a_C C.
    ///
    /// # Errors
    /// A matrix that is not positive definite.
    pub fn new(line: &Line, mass_factor: f64, damping_factor: f64) -> Result<Self, NotPositiveDefinite> {
        let effective: Band = line.effective(mass_factor, damping_factor);
        let factor = effective.clone().factorise()?;
        let table = Table::new(line, &factor);
        let columns = columns(line, &factor, table.reach);
        Ok(Self { factor: TwistedFactor::new(effective)?, table, columns })
    }

    /// Motions of a point's ports by `forces` on the rows to the deck.
    pub fn by_deck(&self, line: &Line, point: &LinePoint, forces: &[f64]) -> [f64; MOST_PORTS] {
        let (reach, w) = (self.table.reach, self.table.width);
        let begin = line.on_bridge.partition_point(|on| on.node + reach <= point.element + 1);
        let mut sum = [0.0; MOST_DOFS];
        for (s, on) in line.on_bridge.iter().enumerate().skip(begin) {
            if on.node >= point.element + reach {
                break;
            }
            // Of the element's nodes, next to each other in the table.
            let at = (s * (2 * reach - 1) + point.element + reach - 1 - on.node) * w;
            let column = &self.columns[at..at + 2 * w];
            sum.iter_mut().zip(column).for_each(|(sum, y)| *sum += y * forces[s]);
        }
        std::array::from_fn(|port| dot(&point.rows[port][..2 * w], &sum[..2 * w]))
    }

    /// Whether two points feel each other.
    pub fn reaches(&self, i: &LinePoint, j: &LinePoint) -> bool {
        i.element.abs_diff(j.element) <= self.table.reach
    }

    /// N_i K̂⁻¹ N_jᵀ between the ports of two points.
    pub fn between(&self, ports: usize, i: &LinePoint, j: &LinePoint) -> [[f64; MOST_PORTS]; MOST_PORTS] {
        let Table { reach, width: w, blocks } = &self.table;
        let mut y = [[0.0; MOST_PORTS]; MOST_PORTS];
        for a in 0..2 {
            for b in 0..2 {
                let (p, q) = (i.element + a, j.element + b);
                let (low, high) = (p.min(q), p.max(q));
                if high - low >= *reach {
                    continue;
                }
                let block = &blocks[(low * reach + high - low) * w * w..][..w * w];
                for (row, y) in i.rows.iter().zip(&mut y).take(ports) {
                    // row of the first point times the block
                    let mut product = [0.0; MOST_DOFS];
                    for k in 0..*w {
                        let n = row[a * w + k];
                        if n == 0.0 {
                            continue;
                        }
                        for (m, product) in product.iter_mut().enumerate().take(*w) {
                            *product += n * if p <= q { block[k * w + m] } else { block[m * w + k] };
                        }
                    }
                    for (column, y) in j.rows.iter().zip(y).take(ports) {
                        *y += (0..*w).map(|m| product[m] * column[b * w + m]).sum::<f64>();
                    }
                }
            }
        }
        y
    }
}

impl Table {
    fn new(line: &Line, factor: &BandFactor) -> Self {
        let (nodes, w, n) = (line.nodes(), line.width, line.order());
        let reach = reach(line, factor);
        let mut blocks = vec![0.0; nodes * reach * w * w];
        let mut column = vec![0.0; n];
        for p in 0..nodes {
            let size = reach * w * w;
            if let Some(twin) = twin(line, p, reach) {
                blocks.copy_within(twin * size..(twin + 1) * size, p * size);
                continue;
            }
            let begin = line.node(p);
            let end = if p + 2 * reach < nodes { line.node(p + 2 * reach) } else { n };
            for a in 0..w {
                column[begin..end].fill(0.0);
                column[begin + a] = 1.0;
                factor.solve_range(&mut column, begin, end);
                for q in p..(p + reach).min(nodes) {
                    let block = &mut blocks[(p * reach + q - p) * w * w..][..w * w];
                    let dof = line.node(q);
                    block[a * w..(a + 1) * w].copy_from_slice(&column[dof..dof + w]);
                }
            }
        }
        Self { reach, width: w, blocks }
    }
}

/// The node a bay behind, if the ends of the track are felt at neither.
fn twin(line: &Line, node: usize, reach: usize) -> Option<usize> {
    let per_bay = line.made_of.per_bay;
    (node >= 2 * reach + per_bay && node + 2 * reach < line.nodes()).then(|| node - per_bay)
}

/// K̂⁻¹ e_s of all rows to the deck.
fn columns(line: &Line, factor: &BandFactor, reach: usize) -> Vec<f64> {
    let (nodes, w, n) = (line.nodes(), line.width, line.order());
    let dof = |node: usize| if node < nodes { line.node(node) } else { n };
    let (mut columns, mut column) = (Vec::new(), vec![0.0; n]);
    // Rows of one support stand together, in the same order at all of them.
    let per_support = line.on_bridge.iter().take_while(|on| on.support == line.on_bridge[0].support).count();
    for (s, on) in line.on_bridge.iter().enumerate() {
        let before = s.checked_sub(per_support).map(|before| line.on_bridge[before].node);
        if before.is_some() && before == twin(line, on.node, reach) {
            let size = (2 * reach - 1) * w;
            columns.extend_from_within((s - per_support) * size..(s - per_support + 1) * size);
            continue;
        }
        let (begin, end) = (dof(on.node.saturating_sub(reach)), dof(on.node + 2 * reach));
        column[begin..end].fill(0.0);
        on.row.of.iter().for_each(|(i, c)| column[*i] += c);
        factor.solve_range(&mut column, begin, end);
        for i in 0..2 * reach - 1 {
            match (on.node + i).checked_sub(reach - 1) {
                Some(q) if q < nodes => columns.extend_from_slice(&column[dof(q)..dof(q) + w]),
                _ => columns.extend((0..w).map(|_| 0.0)),
            }
        }
    }
    columns
}

/// Number of nodes over which the inverse decays to nothing, measured in the middle of the track.
fn reach(line: &Line, factor: &BandFactor) -> usize {
    let (nodes, middle) = (line.nodes(), line.nodes() / 2);
    let mut reach = 1;
    for a in 0..line.width {
        let mut column = vec![0.0; line.order()];
        column[line.node(middle) + a] = 1.0;
        factor.solve(&mut column);
        for b in 0..line.width {
            let entry = |q: usize| column[line.node(q) + b].abs();
            let largest = (0..nodes).map(entry).fold(0.0, f64::max);
            let far = (middle..nodes).rev().find(|q| entry(*q) > NEGLIGIBLE * largest);
            reach = reach.max(far.map_or(1, |q| q - middle + 1));
        }
    }
    // Near the ends the rail is softer than in the middle: a quarter more.
    (reach + reach / 4 + 1).min(nodes)
}

/// Static deflection of a line under forces at points, without the deck.
pub fn static_deflection(factors: &LineFactors, motion: &mut Motion, p: &[f64]) {
    motion.u.copy_from_slice(p);
    factors.factor.solve(&mut motion.u);
}
