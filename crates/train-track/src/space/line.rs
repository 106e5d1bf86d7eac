//! A part of the track that moves on its own: sums or differences of both rails' motions on their fasteners and sleepers.
//!
//! ```text
//! fields of a node: w_a, θ_a (vertical, difference) and/or v, ψ (lateral bending), φ (torsion)
//! bending Hermite cubics, consistent mass;  torsion GJ/l [1 −1; −1 1], ρI_p l/6 [2 1; 1 2]      both rails: twice of one
//! springs  e = Σ c_i u_i − (d_y, d_φ) of the deck,  force k e + c ė on every row
//! ```
//!
//! All matrices are constant and banded; the Newmark matrix is factored once a step size.

use ttb_dynamics::band::Band;
use ttb_dynamics::beam::Beam;
use ttb_dynamics::newmark::{Motion, Newmark};
use ttb_scenario::types::Spring;

/// What a node of the rail has.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Field {
    /// Deflection and its slope.
    Bending(Beam),
    /// Torsion: GJ and ρI_p of both rails.
    Torsion {
        /// N m².
        stiffness: f64,
        /// kg m.
        inertia: f64,
    },
}

impl Field {
    fn dofs(&self) -> usize {
        match self {
            Self::Bending(_) => 2,
            Self::Torsion { .. } => 1,
        }
    }
}

/// A spring over up to three degrees of freedom and the deck.
#[derive(Clone, Copy, Debug)]
pub struct Row {
    /// Degrees of freedom with their coefficients; unused ones have 0.
    pub of: [(usize, f64); 3],
    /// The spring.
    pub spring: Spring,
}

impl Row {
    /// Force on the row by the motion (d_y, d_φ) of a deck and its rates, of which it takes the parts `by`.
    fn pressed(&self, by: [f64; 2], deck: [[f64; 2]; 2]) -> f64 {
        let [d, v] = deck.map(|motion| by[0] * motion[0] + by[1] * motion[1]);
        self.spring.stiffness * d + self.spring.damping * v
    }

    /// Adds a force on the row to `p`.
    fn add(&self, force: f64, p: &mut [f64]) {
        self.of.iter().for_each(|(i, c)| p[*i] += c * force);
    }
}

/// Spring at a support as it is described: places count among the node's fields, then the support's own masses.
#[derive(Clone, Copy, Debug)]
pub struct SupportSpring {
    /// (place, coefficient).
    pub of: [(usize, f64); 3],
    /// The spring.
    pub spring: Spring,
    /// What e takes off of the deck's d_y and d_φ; none: an inner spring.
    pub deck: Option<[f64; 2]>,
}

/// All a line is made of.
#[derive(Clone, Debug)]
pub struct Description {
    /// Fields of a rail node.
    pub fields: Vec<Field>,
    /// Masses or inertias below each support.
    pub masses: Vec<f64>,
    /// Springs of each support.
    pub springs: Vec<SupportSpring>,
    /// Spring between the same mass of neighbouring supports.
    pub shear: Option<(usize, Spring)>,
    /// Bays, elements a bay, length of an element in m.
    pub bays: usize,
    /// See `bays`.
    pub per_bay: usize,
    /// See `bays`.
    pub length: f64,
}

/// Numbering and matrices.
#[derive(Clone, Debug)]
pub struct Line {
    /// What it was made of.
    pub made_of: Description,
    /// Degrees of freedom of a node.
    pub width: usize,
    order: usize,
    half_bandwidth: usize,
    rows: Vec<Row>,
    /// Rows to the deck, by support on the bridge.
    pub(super) on_bridge: Vec<OnBridge>,
    /// Rows to the ground beside the bridge, and what each takes off of its motion.
    beside: Vec<(Row, [f64; 2])>,
    lumped: Vec<(usize, f64)>,
    /// Mass of an element field by field: the field's first place in a node.
    element_mass: Vec<(usize, FieldMass)>,
}

/// A row to the deck.
#[derive(Clone, Copy, Debug)]
pub(super) struct OnBridge {
    /// Support, counted on the bridge.
    pub support: usize,
    /// Node of the rail above it.
    pub node: usize,
    /// The row over rail and sleeper.
    pub row: Row,
    /// What it takes off of the deck's d_y and d_φ.
    pub by: [f64; 2],
}

/// Mass of a field between both ends of an element.
#[derive(Clone, Copy, Debug)]
enum FieldMass {
    Bending([[f64; 4]; 4]),
    Torsion([f64; 2]),
}

impl Line {
    /// Numbers a line; the ground under all supports but those `on_bridge` is at rest.
    pub fn new(made_of: Description, on_bridge: &[usize]) -> Self {
        let width: usize = made_of.fields.iter().map(Field::dofs).sum();
        let mut line = Self {
            width,
            order: 0,
            half_bandwidth: 0,
            rows: Vec::new(),
            on_bridge: Vec::new(),
            beside: Vec::new(),
            lumped: Vec::new(),
            element_mass: Vec::new(),
            made_of,
        };
        let Description { bays, per_bay, .. } = line.made_of;
        line.order = line.node(bays * per_bay) + width + line.made_of.masses.len();
        for support in 0..=bays {
            let node = line.node(support * per_bay);
            line.lumped.extend(line.made_of.masses.iter().enumerate().map(|(k, mass)| (node + width + k, *mass)));
            for spring in &line.made_of.springs {
                let of = spring.of.map(|(place, factor)| (node + place, factor));
                let row = Row { of, spring: spring.spring };
                line.rows.push(row);
                match (spring.deck, on_bridge.binary_search(&support)) {
                    (Some(by), Ok(i)) => {
                        line.on_bridge.push(OnBridge { support: i, node: support * per_bay, row, by });
                    }
                    (Some(deck), Err(_)) => line.beside.push((row, deck)),
                    (None, _) => {}
                }
            }
            if let (Some((mass, spring)), true) = (line.made_of.shear, support > 0) {
                let before = line.node((support - 1) * per_bay) + width + mass;
                let of = [(before, -1.0), (node + width + mass, 1.0), (node, 0.0)];
                line.rows.push(Row { of, spring });
            }
        }
        let spread = |dofs: &mut dyn Iterator<Item = usize>| {
            let (least, most) = dofs.fold((usize::MAX, 0), |(a, b), dof| (a.min(dof), b.max(dof)));
            most - least
        };
        let elements = (0..bays * per_bay).map(|e| line.node(e + 1) + width - 1 - line.node(e));
        let rows = line.rows.iter().map(|row| spread(&mut row.of.iter().filter(|of| of.1 != 0.0).map(|of| of.0)));
        line.half_bandwidth = elements.chain(rows).max().unwrap_or(0);
        let (l, mut place) = (line.made_of.length, 0);
        for field in &line.made_of.fields {
            let mass = match field {
                Field::Bending(beam) => FieldMass::Bending(beam.mass_matrix(l)),
                Field::Torsion { inertia, .. } => FieldMass::Torsion([inertia * l / 3.0, inertia * l / 6.0]),
            };
            line.element_mass.push((place, mass));
            place += field.dofs();
        }
        line
    }

    /// Degrees of freedom.
    pub fn order(&self) -> usize {
        self.order
    }

    /// Rail nodes.
    pub fn nodes(&self) -> usize {
        self.made_of.bays * self.made_of.per_bay + 1
    }

    /// First degree of freedom of a rail node.
    pub fn node(&self, node: usize) -> usize {
        let (per_bay, masses) = (self.made_of.per_bay, self.made_of.masses.len());
        let supports_before = node.div_ceil(per_bay);
        node * self.width + supports_before * masses
    }

    /// Degrees of freedom of an element, first node's fields first.
    fn element_dofs(&self, element: usize) -> impl Iterator<Item = usize> {
        let (a, b, w) = (self.node(element), self.node(element + 1), self.width);
        (a..a + w).chain(b..b + w)
    }

    /// `stiffness` K + `mass` M of an element by rows.
    fn element(&self, stiffness: f64, mass: f64) -> Vec<f64> {
        let (w, l) = (self.width, self.made_of.length);
        let mut matrix = vec![0.0; 4 * w * w];
        let mut place = 0;
        for field in &self.made_of.fields {
            match field {
                Field::Bending(beam) => {
                    let (k, m) = (beam.stiffness(l), beam.mass_matrix(l));
                    let at = [place, place + 1, w + place, w + place + 1];
                    for i in 0..4 {
                        for j in 0..4 {
                            matrix[at[i] * 2 * w + at[j]] += stiffness * k[i][j] + mass * m[i][j];
                        }
                    }
                }
                Field::Torsion { stiffness: gj, inertia } => {
                    for (i, j, k, m) in [(0, 0, 1.0, 2.0), (0, 1, -1.0, 1.0), (1, 0, -1.0, 1.0), (1, 1, 1.0, 2.0)] {
                        let at = (w * i + place) * 2 * w + w * j + place;
                        matrix[at] += stiffness * gj / l * k + mass * inertia * l / 6.0 * m;
                    }
                }
            }
            place += field.dofs();
        }
        matrix
    }

    /// K + a_M M + a_C C.
    pub fn effective(&self, mass_factor: f64, damping_factor: f64) -> Band {
        let mut band = Band::zeros(self.order, self.half_bandwidth);
        let (element, size) = (self.element(1.0, mass_factor), 2 * self.width);
        for e in 0..self.nodes() - 1 {
            for (i, p) in self.element_dofs(e).enumerate() {
                for (j, q) in self.element_dofs(e).enumerate().filter(|(_, q)| *q <= p) {
                    if element[i * size + j] != 0.0 {
                        band.add(p, q, element[i * size + j]);
                    }
                }
            }
        }
        self.lumped.iter().for_each(|(dof, mass)| band.add(*dof, *dof, mass_factor * mass));
        for row in &self.rows {
            let k = row.spring.stiffness + damping_factor * row.spring.damping;
            for (i, (p, a)) in row.of.iter().enumerate() {
                for (q, b) in row.of.iter().take(i + 1).filter(|(_, b)| a * b != 0.0) {
                    band.add(*p, *q, k * a * b);
                }
            }
        }
        band
    }

    /// p = M (a₀u + a₂u̇ + a₃ü) + C (a₁u + a₄u̇ + a₅ü).
    pub fn history(&self, newmark: &Newmark, old: &Motion, p: &mut [f64]) {
        p.fill(0.0);
        let inertia = |i: usize| newmark.inertia(old.u[i], old.v[i], old.a[i]);
        for (place, mass) in &self.element_mass {
            let mut a = self.node(0) + place;
            match mass {
                FieldMass::Bending(m) => {
                    let mut x = [0.0, 0.0, inertia(a), inertia(a + 1)];
                    for node in 1..self.nodes() {
                        let b = self.node(node) + place;
                        x = [x[2], x[3], inertia(b), inertia(b + 1)];
                        let y = m.map(|m| (m[0] * x[0] + m[1] * x[1]) + (m[2] * x[2] + m[3] * x[3]));
                        (p[a], p[a + 1], p[b], p[b + 1]) = (p[a] + y[0], p[a + 1] + y[1], y[2], y[3]);
                        a = b;
                    }
                }
                FieldMass::Torsion([own, other]) => {
                    let mut x = [0.0, inertia(a)];
                    for node in 1..self.nodes() {
                        let b = self.node(node) + place;
                        x = [x[1], inertia(b)];
                        p[a] += own * x[0] + other * x[1];
                        p[b] = other * x[0] + own * x[1];
                        a = b;
                    }
                }
            }
        }
        self.lumped.iter().for_each(|(dof, mass)| p[*dof] += mass * inertia(*dof));
        for row in &self.rows {
            let rate: f64 = row.of.iter().map(|(i, c)| c * newmark.damping(old.u[*i], old.v[*i], old.a[*i])).sum();
            row.of.iter().for_each(|(i, c)| p[*i] += c * row.spring.damping * rate);
        }
    }

    /// Adds the forces of the deck's motion to `p`; `deck` gives (d_y, d_φ) and their rates by support on the bridge.
    pub fn add_deck(&self, deck: impl Fn(usize) -> [[f64; 2]; 2], p: &mut [f64]) {
        for OnBridge { support, row, by, .. } in &self.on_bridge {
            row.add(row.pressed(*by, deck(*support)), p);
        }
    }

    /// Adds [`Line::deck_forces`] to `p`.
    pub fn add_deck_forces(&self, forces: &[f64], p: &mut [f64]) {
        for (on, force) in self.on_bridge.iter().zip(forces) {
            on.row.add(*force, p);
        }
    }

    /// The forces of the deck's motion on all rows to it.
    pub fn deck_forces(&self, deck: impl Fn(usize) -> [[f64; 2]; 2], forces: &mut [f64]) {
        for (force, on) in forces.iter_mut().zip(&self.on_bridge) {
            *force = on.row.pressed(on.by, deck(on.support));
        }
    }

    /// Adds the forces of the ground beside the bridge, which moves by `d` m and `v` m/s to the right, to `p`.
    pub fn add_ground(&self, d: f64, v: f64, p: &mut [f64]) {
        for (row, by) in self.beside.iter().filter(|(_, by)| by[0] != 0.0) {
            row.add(by[0] * (row.spring.stiffness * d + row.spring.damping * v), p);
        }
    }

    /// Gives `add` the forces (F_y, M_x) of the rows on the deck, by support on the bridge.
    pub fn support_forces(
        &self,
        motion: &Motion,
        deck: impl Fn(usize) -> [[f64; 2]; 2],
        mut add: impl FnMut(usize, [f64; 2]),
    ) {
        for OnBridge { support, row, by, .. } in &self.on_bridge {
            let [d, v] = deck(*support).map(|motion| by[0] * motion[0] + by[1] * motion[1]);
            let of = |x: &[f64]| row.of.iter().map(|(i, c)| c * x[*i]).sum::<f64>();
            let force = row.spring.stiffness * (of(&motion.u) - d) + row.spring.damping * (of(&motion.v) - v);
            add(*support, by.map(|by| by * force));
        }
    }
}
