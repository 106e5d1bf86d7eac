//! Numbers of the free motions, and what becomes of the others.

use std::collections::HashMap;

use ttb_contract::ModelError;
use ttb_scenario::space::{Index, Motion, Part, Ties, motion, parts};
use ttb_scenario::types::{Freedom, Model};

use super::elements;
use super::tied::{Sums, Tied};
use crate::assembled::Names;
use crate::deck::Row;

/// Weights on motions of nodes.
pub(super) type Weights = Vec<(Motion, f64)>;

/// A weight below this carries nothing.
const NOTHING: f64 = 1e-9;

/// What becomes of a motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Fate {
    /// A degree of freedom.
    Free(u32),
    /// Held by a bearing.
    Held,
    /// Nothing resists it.
    Out,
    /// A combination of others, a position in [`Freedoms::ties`].
    Tied(u32),
}

/// All motions of a model.
pub(super) struct Freedoms {
    pub index: Index,
    /// Number of nodes.
    pub nodes: usize,
    /// The motion of every degree of freedom.
    pub motions: Vec<Motion>,
    pub fates: Vec<Fate>,
    /// Tied motions in terms of motions that are not.
    ties: Vec<Weights>,
    pub parts: Vec<Part>,
    numbers: Vec<u32>,
}

impl Freedoms {
    pub fn new(model: &Model) -> Result<Self, ModelError> {
        let index = Index::new(model);
        if let Some(&position) = index.repeated.first() {
            return Err(ModelError(format!("bridge: two nodes have the number {}", model.nodes[position].0)));
        }
        let ties = Ties::new(model, &index);
        let numbers = model.nodes.iter().map(|node| node.0).collect();
        let parts = parts(model, &index, &ties);
        let mut all = Self {
            nodes: model.nodes.len(),
            motions: Vec::new(),
            fates: vec![Fate::Out; 6 * model.nodes.len()],
            ties: Vec::new(),
            index,
            parts,
            numbers,
        };
        all.tie(&ties)?;
        all.hold(model)?;
        let mut resisted = vec![false; all.fates.len()];
        for element in elements::all(model, &all.index) {
            let element = element?;
            let motions = element.motions();
            let own = motions.iter().zip(element.kind.resists()).filter(|(_, resists)| *resists);
            own.for_each(|(motion, _)| all.masters(*motion).for_each(|(master, _)| resisted[master as usize] = true));
        }
        for (motion, fate) in all.fates.iter_mut().enumerate().filter(|(motion, _)| resisted[*motion]) {
            if *fate == Fate::Out {
                *fate = Fate::Free(all.motions.len() as u32);
                all.motions.push(motion as Motion);
            }
        }
        if all.motions.is_empty() {
            return Err(ModelError("bridge: nothing can move: every motion is held, or no element resists any".into()));
        }
        Ok(all)
    }

    /// Replaces what ties follow until no tied motion is left in them.
    fn tie(&mut self, ties: &Ties) -> Result<(), ModelError> {
        if let Some((_, again)) = ties.twice.first().map(|(before, again)| (&ties.list[*before], &ties.list[*again])) {
            let (place, name) = (again.origin, self.describe(again.follower));
            return Err(ModelError(format!("bridge: {place} eliminates the {name}, which is eliminated already")));
        }
        if let Some(tie) = ties.cyclic.first().map(|i| &ties.list[*i]) {
            let name = self.describe(tie.follower);
            return Err(ModelError(format!("bridge: {} makes the {name} follow itself", tie.origin)));
        }
        for tie in ties.order.iter().map(|i| &ties.list[*i]) {
            let mut sums = Sums::default();
            for (term, weight) in &tie.terms {
                self.masters(*term).for_each(|(master, share)| sums.add(master, weight * share));
            }
            self.fates[tie.follower as usize] = Fate::Tied(self.ties.len() as u32);
            self.ties.push(sums.list);
        }
        Ok(())
    }

    fn hold(&mut self, model: &Model) -> Result<(), ModelError> {
        for list in &model.bearings {
            for &number in &list.nodes {
                let node = position(&self.index, number, "bearings")?;
                for &freedom in &list.fixed {
                    let motion = motion(node, freedom);
                    if let Fate::Tied(_) = self.fates[motion as usize] {
                        let name = self.describe(motion);
                        return Err(ModelError(format!("bridge: a bearing holds the {name}, which follows others")));
                    }
                    self.fates[motion as usize] = Fate::Held;
                }
            }
        }
        Ok(())
    }

    /// The motions, none of them tied, that a motion is a combination of.
    pub fn masters(&self, motion: Motion) -> impl Iterator<Item = (Motion, f64)> {
        let tied = match self.fates[motion as usize] {
            Fate::Tied(tie) => Some(self.ties[tie as usize].as_slice()),
            _ => None,
        };
        let own = tied.is_none().then_some((motion, 1.0));
        tied.into_iter().flatten().copied().chain(own)
    }

    fn dof(&self, motion: Motion) -> Option<u32> {
        match self.fates[motion as usize] {
            Fate::Free(dof) => Some(dof),
            _ => None,
        }
    }

    /// Degrees of freedom of motions none of which is tied.
    pub fn plain(&self, motions: &[Motion]) -> Option<Vec<Option<u32>>> {
        let tied = motions.iter().any(|motion| matches!(self.fates[*motion as usize], Fate::Tied(_)));
        (!tied).then(|| motions.iter().map(|motion| self.dof(*motion)).collect())
    }

    /// T of motions some of which are tied.
    pub fn tied(&self, motions: &[Motion]) -> Tied {
        let mut tied = Tied { dofs: Vec::new(), t: Vec::with_capacity(motions.len()) };
        let mut columns = HashMap::new();
        for motion in motions {
            let mut row = Vec::new();
            for (master, weight) in self.masters(*motion) {
                if let Some(dof) = self.dof(master) {
                    let column = *columns.entry(dof).or_insert_with(|| {
                        tied.dofs.push(dof);
                        tied.dofs.len() - 1
                    });
                    row.push((column, weight));
                }
            }
            tied.t.push(row);
        }
        tied
    }

    /// Weights on motions as weights on degrees of freedom; `what` is for the message when nothing is there to carry.
    pub fn row(&self, weights: &[(Motion, f64)], what: &str) -> Result<Row, ModelError> {
        let mut sums = Sums::default();
        for (motion, weight) in weights.iter().filter(|(_, weight)| weight.abs() > NOTHING) {
            for (master, share) in self.masters(*motion) {
                match self.fates[master as usize] {
                    Fate::Free(dof) => sums.add(dof, weight * share),
                    Fate::Held | Fate::Tied(_) => {}
                    Fate::Out => {
                        let name = self.describe(master);
                        return Err(ModelError(format!("bridge: {what}: no element resists the {name}")));
                    }
                }
            }
        }
        sums.list.retain(|(_, weight)| *weight != 0.0);
        Ok(sums.list)
    }

    /// A motion in words.
    pub fn describe(&self, motion: Motion) -> String {
        words(motion, &self.numbers)
    }

    /// A degree of freedom in words.
    pub fn name(&self, dof: usize) -> String {
        self.describe(self.motions[dof])
    }

    /// All degrees of freedom in words.
    pub fn names(&self) -> Names {
        let (motions, numbers) = (self.motions.clone(), self.numbers.clone());
        Box::new(move |dof| {
            motions.get(dof).map_or_else(|| format!("degree of freedom {dof}"), |motion| words(*motion, &numbers))
        })
    }
}

fn words(motion: Motion, numbers: &[u32]) -> String {
    let (node, freedom) = (motion as usize / 6, Freedom::ALL[motion as usize % 6]);
    format!("{} of node {}", freedom.describe(), numbers[node])
}

/// Position of a node that some list names.
pub(super) fn position(index: &Index, number: u32, list: &str) -> Result<usize, ModelError> {
    index.position(number).ok_or_else(|| ModelError(format!("bridge: {list}: there is no node numbered {number}")))
}
