//! Checks that need no reference: mass, equilibrium under the own weight, what is loose.
//!
//! ```text
//! K u = f,  f = M r_z g          reactions   R = f − K u over the held motions, ties undone by Tᵀ
//! m = r_zᵀ M r_z,   m x_c = −r_ryᵀ M r_z,   m y_c = r_rxᵀ M r_z,   m z_c = r_ryᵀ M r_x
//! ```
//!
//! r_i is the rigid motion of the whole model along or about an axis.

use ttb_contract::ModelError;
use ttb_elements::Matrices;
use ttb_scenario::GRAVITY;
use ttb_scenario::space::{Motion, motion};
use ttb_scenario::types::{Freedom, Model};
use ttb_sparse::vector::dot;

use super::diagonal::Diagonal;
use super::elements::{self, Placed, coordinates};
use super::freedoms::{Fate, Freedoms, position};
use super::kind::Kind;
use super::report::{Reaction, Reactions, SelfCheck};

/// What solving with K, numbered as [`super::assemble`] numbers, gave.
pub enum Statics<'a> {
    /// Replaces a load by its displacement: x ← K⁻¹ x.
    Solved(&'a mut dyn FnMut(&mut [f64])),
    /// K cannot be factorised: this degree of freedom has no stiffness left.
    Mechanism(usize),
    /// Nothing was tried.
    Unknown,
}

/// Lets a model tell its mass, its reactions, and what in it is loose.
///
/// # Errors
/// The model cannot be numbered, or an element cannot be made.
pub fn self_check(model: &Model, statics: Statics<'_>) -> Result<SelfCheck, ModelError> {
    let freedoms = Freedoms::new(model)?;
    let mut audit = Audit::new(model, &freedoms);
    let mut stiffness = Diagonal::new(&freedoms);
    for element in elements::all(model, &freedoms.index) {
        let element = element?;
        let matrices = element.kind.matrices();
        stiffness.add(&freedoms, &element.motions(), &matrices);
        audit.weigh(&element, &matrices);
    }
    let loose: Vec<String> = stiffness.loose(&freedoms).into_iter().map(|dof| freedoms.name(dof)).collect();
    let (mass, moments) = (audit.mass, audit.moments);
    let centre = moments.map(|moment| if mass > 0.0 { moment / mass } else { 0.0 });
    let (mut mechanism, mut reactions) = (None, None);
    match statics {
        Statics::Solved(solve) if loose.is_empty() => {
            let mut u = audit.load.clone();
            solve(&mut u);
            reactions = Some(audit.reactions(&u)?);
        }
        Statics::Mechanism(dof) if dof < freedoms.motions.len() => mechanism = Some(freedoms.name(dof)),
        _ => {}
    }
    Ok(SelfCheck {
        nodes: model.nodes.len(),
        elements: audit.elements,
        freedoms: freedoms.motions.len(),
        mass,
        centre,
        size: size(model),
        loose_parts: freedoms.parts.iter().filter(|part| !part.held).cloned().collect(),
        loose,
        mechanism,
        reactions,
    })
}

fn size(model: &Model) -> f64 {
    let extent = |axis: usize| {
        let values = || (0..model.nodes.len()).map(|node| coordinates(model, node)[axis]);
        values().fold(f64::NEG_INFINITY, f64::max) - values().fold(f64::INFINITY, f64::min)
    };
    (0..3).map(extent).fold(0.0, f64::max)
}

pub(super) struct Audit<'a> {
    model: &'a Model,
    freedoms: &'a Freedoms,
    elements: usize,
    mass: f64,
    /// m x_c, m y_c, m z_c.
    moments: [f64; 3],
    /// f over the degrees of freedom.
    pub load: Vec<f64>,
}

impl<'a> Audit<'a> {
    pub fn new(model: &'a Model, freedoms: &'a Freedoms) -> Self {
        let load = vec![0.0; freedoms.motions.len()];
        Self { model, freedoms, elements: 0, mass: 0.0, moments: [0.0; 3], load }
    }

    /// Adds an element's mass and weight.
    pub fn weigh(&mut self, element: &Placed, matrices: &Matrices) {
        self.elements += 1;
        let rigid = |freedom: Freedom| rigid(self.model, element, freedom);
        let (down, turned) = (product(matrices, &matrices.m, &rigid(Freedom::Z)), rigid(Freedom::Ry));
        let along = product(matrices, &matrices.m, &rigid(Freedom::X));
        let own = [-dot(&down, &turned), dot(&down, &rigid(Freedom::Rx)), dot(&along, &turned)];
        let mass = dot(&down, &rigid(Freedom::Z));
        self.mass += mass;
        self.moments.iter_mut().zip(own).for_each(|(sum, own)| *sum += own);
        for (motion, force) in element.motions().into_iter().zip(down) {
            for (master, weight) in self.freedoms.masters(motion) {
                if let Fate::Free(dof) = self.freedoms.fates[master as usize] {
                    self.load[dof as usize] += weight * force * GRAVITY;
                }
            }
        }
    }

    fn displacement(&self, motion: Motion, u: &[f64]) -> f64 {
        let own = |(master, weight): (Motion, f64)| match self.freedoms.fates[master as usize] {
            Fate::Free(dof) => weight * u[dof as usize],
            _ => 0.0,
        };
        self.freedoms.masters(motion).map(own).sum()
    }

    /// Forces on the ground for displacements under the own weight.
    fn reactions(&self, u: &[f64]) -> Result<Reactions, ModelError> {
        let mut held = vec![0.0; self.freedoms.fates.len()];
        let mut springs = vec![0.0; held.len()];
        let mut sprung = std::collections::BTreeSet::new();
        for element in elements::all(self.model, &self.freedoms.index) {
            let element = element?;
            let (matrices, motions) = (element.kind.matrices(), element.motions());
            let own: Vec<f64> = motions.iter().map(|motion| self.displacement(*motion, u)).collect();
            let (elastic, weight) = (
                product(&matrices, &matrices.k, &own),
                product(&matrices, &matrices.m, &rigid(self.model, &element, Freedom::Z)),
            );
            for ((motion, elastic), weight) in motions.iter().zip(&elastic).zip(weight) {
                for (master, share) in self.freedoms.masters(*motion) {
                    held[master as usize] += share * (GRAVITY * weight - elastic);
                }
            }
            if let Kind::Spring { grounded: true, .. } = element.kind {
                motions.iter().zip(&elastic).for_each(|(motion, force)| springs[*motion as usize] += force);
                sprung.extend(element.nodes);
            }
        }
        let mut groups = Vec::new();
        let mut moment = [GRAVITY * -self.moments[1], GRAVITY * self.moments[0], 0.0];
        for (number, list) in self.model.bearings.iter().enumerate() {
            let nodes = list.nodes.iter().map(|node| position(&self.freedoms.index, *node, "bearings"));
            let nodes: Vec<usize> = nodes.collect::<Result<_, _>>()?;
            // what two groups hold counts for the first
            let force = |node: usize, freedom: &Freedom| {
                list.fixed.contains(freedom).then(|| std::mem::take(&mut held[motion(node, *freedom) as usize]))
            };
            groups.push(self.group(format!("bearings[{number}]"), &nodes, force, &mut moment));
        }
        if !sprung.is_empty() {
            let nodes: Vec<usize> = sprung.into_iter().collect();
            let force = |node: usize, freedom: &Freedom| Some(springs[motion(node, *freedom) as usize]);
            groups.push(self.group("springs to the ground".to_owned(), &nodes, force, &mut moment));
        }
        let sum = |axis: usize| groups.iter().map(|group: &Reaction| group.force[axis]).sum();
        let sag = (0..self.model.nodes.len()).map(|node| (self.displacement(motion(node, Freedom::Z), u), node));
        let (sag, node) = sag.fold((0.0, 0), |most, node| if node.0 > most.0 { node } else { most });
        Ok(Reactions {
            force: [sum(0), sum(1), sum(2)],
            moment,
            weight: self.mass * GRAVITY,
            sag: (sag, self.model.nodes[node].0),
            groups,
        })
    }

    /// Sums a group's forces; their moments about the origin are added to `about`.
    fn group(
        &self,
        name: String,
        nodes: &[usize],
        mut force: impl FnMut(usize, &Freedom) -> Option<f64>,
        about: &mut [f64; 3],
    ) -> Reaction {
        let mut reaction = Reaction { name, nodes: nodes.len(), force: [0.0; 3], moment: [0.0; 3] };
        for &node in nodes {
            let [x, y, z] = coordinates(self.model, node);
            let [fx, fy, fz, mx, my, mz] = Freedom::ALL.map(|freedom| force(node, &freedom).unwrap_or(0.0));
            let moments = [mx + y * fz - z * fy, my + z * fx - x * fz, mz + x * fy - y * fx];
            for (axis, (force, moment)) in [(fx, mx), (fy, my), (fz, mz)].into_iter().enumerate() {
                reaction.force[axis] += force;
                reaction.moment[axis] += moment;
                about[axis] += moments[axis];
            }
        }
        reaction
    }
}

/// A rigid motion about the origin, of an element's nodes.
fn rigid(model: &Model, element: &Placed, freedom: Freedom) -> Vec<f64> {
    let motion = |node: &usize| {
        let [x, y, z] = coordinates(model, *node);
        match freedom {
            Freedom::X => [1.0, 0.0, 0.0, 0.0, 0.0, 0.0],
            Freedom::Y => [0.0, 1.0, 0.0, 0.0, 0.0, 0.0],
            Freedom::Z => [0.0, 0.0, 1.0, 0.0, 0.0, 0.0],
            Freedom::Rx => [0.0, -z, y, 1.0, 0.0, 0.0],
            Freedom::Ry => [z, 0.0, -x, 0.0, 1.0, 0.0],
            Freedom::Rz => [-y, x, 0.0, 0.0, 0.0, 1.0],
        }
    };
    element.nodes.iter().flat_map(motion).collect()
}

/// A x of an element's matrix, row by row.
fn product(matrices: &Matrices, a: &[f64], x: &[f64]) -> Vec<f64> {
    a.chunks_exact(matrices.n).map(|row| dot(row, x)).collect()
}
