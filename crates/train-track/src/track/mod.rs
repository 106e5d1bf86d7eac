//! The track: rail elements on one-, two- or three-layer supports, numbered along the track so that all matrices are banded.
//!
//! ```text
//! rail – fastener – deck                                              one layer
//! rail – pad – sleeper – ballast – deck                               two layers
//! rail – pad – sleeper – ballast – ballast mass – sub-ballast – deck  three layers, ballast masses linked by shear springs
//! ```
//!
//! The lowest spring ("base") belongs to the track: it receives the deck's motion d, ḋ and returns the support force
//! k(u − d) + c(u̇ − ḋ), positive down on the deck. On the ground d = 0.

mod forces;

use ttb_dynamics::band::Band;
use ttb_dynamics::beam::{Beam, Matrix4};
use ttb_scenario::spec::TrainTrackSpec;
use ttb_scenario::types::{Spring, Support};

/// Factors on the top layer (fastener or pad), FMU parameters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FastenerFactors {
    /// On its stiffness.
    pub stiffness: f64,
    /// On its damping.
    pub damping: f64,
}

impl Default for FastenerFactors {
    fn default() -> Self {
        Self { stiffness: 1.0, damping: 1.0 }
    }
}

/// A spring–dashpot between two degrees of freedom.
#[derive(Clone, Copy, Debug)]
struct Link {
    dofs: [usize; 2],
    spring: Spring,
}

/// Numbering and matrices.
#[derive(Clone, Debug)]
pub struct Track {
    from: f64,
    element_length: f64,
    elements: usize,
    elements_per_bay: usize,
    /// Degrees of freedom between rail and base beside the rail's: 0, 1 (sleeper) or 2 (sleeper, ballast).
    layers: usize,
    beam: Beam,
    local_compliance: bool,
    /// Deflection of every rail node.
    nodes: Vec<usize>,
    /// Consistent mass of a rail element, and the masses below the rail by degree of freedom.
    element_mass: Matrix4,
    lumped: Vec<(usize, f64)>,
    order: usize,
    half_bandwidth: usize,
    links: Vec<Link>,
    base: Spring,
    on_bridge: Vec<usize>,
}

/// Where a wheel stands on the rail: element, shape row, local compliance.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RailPoint {
    /// Element.
    pub element: usize,
    /// N(ξ), deflection from [w₁, θ₁, w₂, θ₂].
    pub row: [f64; 4],
    /// c_loc, m/N.
    pub local_compliance: f64,
}

impl Track {
    /// Assembles the track.
    pub fn new(spec: &TrainTrackSpec, factors: FastenerFactors) -> Self {
        let (rail, bays, per_bay) = (&spec.track.rail, spec.bays, spec.elements_per_bay);
        let beam = Beam {
            bending_stiffness: rail.bending_stiffness,
            mass: rail.mass,
            shear_stiffness: rail.shear_stiffness,
            rotary_inertia: rail.rotary_inertia,
        };
        let scaled =
            |s: &Spring| Spring { stiffness: s.stiffness * factors.stiffness, damping: s.damping * factors.damping };
        // Springs from the top, masses between them.
        let (springs, masses, shear) = match &spec.track.support {
            Support::SingleLayer { fastener } => (vec![scaled(fastener)], vec![], None),
            Support::TwoLayer { pad, sleeper_mass, ballast } => {
                (vec![scaled(pad), *ballast], vec![*sleeper_mass], None)
            }
            Support::ThreeLayer { pad, sleeper_mass, ballast, ballast_mass, shear, sub_ballast } => {
                (vec![scaled(pad), *ballast, *sub_ballast], vec![*sleeper_mass, *ballast_mass], *shear)
            }
        };
        let layers = masses.len();
        let (n, half_bandwidth) = (
            bays * (2 * per_bay + layers) + 2 + layers,
            (3 + layers).max(2 + if layers == 2 { 2 * per_bay } else { 0 }),
        );
        let mut track = Self {
            from: spec.from,
            element_length: spec.track.spacing / per_bay as f64,
            elements: bays * per_bay,
            elements_per_bay: per_bay,
            layers,
            beam,
            local_compliance: spec.local_compliance,
            nodes: Vec::new(),
            element_mass: beam.mass_matrix(spec.track.spacing / per_bay as f64),
            lumped: Vec::new(),
            order: n,
            half_bandwidth,
            links: Vec::new(),
            base: springs[layers],
            on_bridge: spec.on_bridge.clone(),
        };
        track.nodes = (0..=track.elements).map(|node| track.number_of(node)).collect();
        for support in 0..=bays {
            let rail = track.node_dof(support * per_bay);
            for (layer, mass) in masses.iter().enumerate() {
                let dof = rail + 2 + layer;
                track.lumped.push((dof, *mass));
                let above = if layer == 0 { rail } else { dof - 1 };
                track.links.push(Link { dofs: [above, dof], spring: springs[layer] });
            }
            if let (Some(spring), true) = (shear, support > 0) {
                let dofs = [track.base_dof(support - 1), track.base_dof(support)];
                track.links.push(Link { dofs, spring });
            }
        }
        track
    }

    /// Number of degrees of freedom.
    pub fn order(&self) -> usize {
        self.order
    }
    /// Number of rail nodes.
    pub fn nodes(&self) -> usize {
        self.elements + 1
    }
    /// Supports on the bridge.
    pub fn bridge_supports(&self) -> usize {
        self.on_bridge.len()
    }
    /// First and last abscissa of the rail, m.
    pub fn extent(&self) -> (f64, f64) {
        (self.from, self.from + self.elements as f64 * self.element_length)
    }
    /// Deflection of a rail node; the rotation is the next one.
    pub fn node_dof(&self, node: usize) -> usize {
        self.nodes[node]
    }
    /// The numbering: bay by bay its first node, what stands below it, its inner nodes.
    fn number_of(&self, node: usize) -> usize {
        let (bay, inner) = (node / self.elements_per_bay, node % self.elements_per_bay);
        let stride = 2 * self.elements_per_bay + self.layers;
        bay * stride + if inner == 0 { 0 } else { 2 * inner + self.layers }
    }
    /// The degree of freedom above the base spring of a support.
    fn base_dof(&self, support: usize) -> usize {
        let rail = self.node_dof(support * self.elements_per_bay);
        if self.layers == 0 { rail } else { rail + 1 + self.layers }
    }
    /// [w₁, θ₁, w₂, θ₂] of an element.
    pub fn element_dofs(&self, element: usize) -> [usize; 4] {
        let (a, b) = (self.node_dof(element), self.node_dof(element + 1));
        [a, a + 1, b, b + 1]
    }

    /// The point of the rail at abscissa `x`; `None` beyond its ends.
    pub fn locate(&self, x: f64) -> Option<RailPoint> {
        let s = (x - self.from) / self.element_length;
        if !(0.0..=self.elements as f64).contains(&s) {
            return None;
        }
        let element = (s as usize).min(self.elements - 1);
        let (xi, l) = (s - element as f64, self.element_length);
        let local_compliance = if self.local_compliance { self.beam.local_compliance(xi, l) } else { 0.0 };
        Some(RailPoint { element, row: self.beam.shape(xi, l), local_compliance })
    }

    /// Where an abscissa lies within an element, 0 to 1.
    pub fn part_of_element(&self, x: f64, element: usize) -> f64 {
        (x - self.from) / self.element_length - element as f64
    }

    /// Rail deflection N u at a point, without the local part.
    pub fn deflection(&self, point: &RailPoint, u: &[f64]) -> f64 {
        let dofs = self.element_dofs(point.element);
        dofs.iter().zip(point.row).map(|(d, n)| n * u[*d]).sum()
    }

    /// f += Nᵀ F.
    pub fn add_force(&self, point: &RailPoint, force: f64, f: &mut [f64]) {
        let dofs = self.element_dofs(point.element);
        dofs.iter().zip(point.row).for_each(|(d, n)| f[*d] += n * force);
    }

    /// K + a_M M + a_C C: the static matrix for a_M = a_C = 0, Newmark's for a₀, a₁.
    pub fn effective(&self, mass_factor: f64, damping_factor: f64) -> Band {
        let mut matrix = Band::zeros(self.order, self.half_bandwidth);
        let (k, m) = (self.beam.stiffness(self.element_length), self.element_mass);
        let element = std::array::from_fn(|i| std::array::from_fn(|j| k[i][j] + mass_factor * m[i][j]));
        for e in 0..self.elements {
            matrix.add_element(&self.element_dofs(e), &element);
        }
        for (dof, mass) in &self.lumped {
            matrix.add(*dof, *dof, mass_factor * mass);
        }
        let effective = |s: &Spring| s.stiffness + damping_factor * s.damping;
        for link in &self.links {
            let ([i, j], k) = (link.dofs, effective(&link.spring));
            matrix.add(i, i, k);
            matrix.add(j, j, k);
            matrix.add(i, j, -k);
        }
        for support in 0..=self.elements / self.elements_per_bay {
            let dof = self.base_dof(support);
            matrix.add(dof, dof, effective(&self.base));
        }
        matrix
    }
}
