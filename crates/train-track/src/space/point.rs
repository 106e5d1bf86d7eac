//! Points of a line, and its compliance between them.
//!
//! ```text
//! Y = N_i K̂⁻¹ N_jᵀ          N rows of the ports at a point: Hermite for bending, linear for torsion
//! c_loc = (ξ(1−ξ)l)³/(3EI),  ξ(1−ξ)l/(GJ)
//! ```
//!
//! K̂⁻¹ is tabulated in bands of blocks between nodes, as far as it decays to 1e-16.

use ttb_dynamics::band::{Band, BandFactor, NotPositiveDefinite};
use ttb_dynamics::newmark::Motion;
use ttb_dynamics::twisted::TwistedFactor;

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
        let table = Table::new(line, &effective.clone().factorise()?);
        Ok(Self { factor: TwistedFactor::new(effective)?, table })
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
