//! Which nodes hang together over elements and ties, and whether the ground holds them.

use super::index::Index;
use super::ties::Ties;
use crate::types::Model;

/// Nodes that hang together.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Part {
    /// Number of the first of its nodes in the model's order.
    pub node: u32,
    /// How many nodes it has.
    pub nodes: usize,
    /// A bearing or a spring to the ground holds it, in some direction at least.
    pub held: bool,
}

/// The parts of a model in the order of their first nodes; nodes that belong to nothing are no parts.
#[must_use]
pub fn parts(model: &Model, index: &Index, ties: &Ties) -> Vec<Part> {
    let mut forest = Forest::new(model.nodes.len());
    let mut held = vec![false; model.nodes.len()];
    let position = |number: &u32| index.position(*number);
    let beams = model.beams.iter().flat_map(|list| &list.elements).map(|pair| &pair[..]);
    let trusses = model.trusses.iter().flat_map(|list| &list.elements).map(|pair| &pair[..]);
    let shells = model.shells.iter().flat_map(|list| &list.elements).map(Vec::as_slice);
    let springs = model.springs.iter().flat_map(|list| &list.elements).map(Vec::as_slice);
    for element in beams.chain(trusses).chain(shells).chain(springs) {
        forest.join(element.iter().filter_map(position));
    }
    model.masses.iter().flat_map(|list| &list.nodes).for_each(|node| forest.join(position(node).into_iter()));
    for tie in &ties.list {
        let motions = std::iter::once(tie.follower).chain(tie.terms.iter().map(|(motion, _)| *motion));
        forest.join(motions.map(|motion| motion as usize / 6));
    }
    let bearings = model.bearings.iter().filter(|list| !list.fixed.is_empty()).flat_map(|list| &list.nodes);
    let springs = model.springs.iter().filter(|list| list.stiffness.iter().any(|k| *k > 0.0));
    let grounded = springs.flat_map(|list| &list.elements).filter(|element| element.len() == 1).flatten();
    bearings.chain(grounded).filter_map(position).for_each(|node| held[node] = true);
    collect(model, &mut forest, &held)
}

fn collect(model: &Model, forest: &mut Forest, held: &[bool]) -> Vec<Part> {
    let mut parts: Vec<Part> = Vec::new();
    let mut part_of = vec![None; model.nodes.len()];
    for (position, node) in model.nodes.iter().enumerate() {
        if !forest.used[position] {
            continue;
        }
        let root = forest.root(position);
        let number = *part_of[root].get_or_insert_with(|| {
            parts.push(Part { node: node.0, nodes: 0, held: false });
            parts.len() - 1
        });
        parts[number].nodes += 1;
        parts[number].held |= held[position];
    }
    parts
}

/// Disjoint sets with path halving.
struct Forest {
    parent: Vec<u32>,
    used: Vec<bool>,
}

impl Forest {
    fn new(n: usize) -> Self {
        Self { parent: (0..n as u32).collect(), used: vec![false; n] }
    }

    fn root(&mut self, mut i: usize) -> usize {
        while self.parent[i] as usize != i {
            self.parent[i] = self.parent[self.parent[i] as usize];
            i = self.parent[i] as usize;
        }
        i
    }

    fn join(&mut self, nodes: impl Iterator<Item = usize>) {
        let mut first = None;
        for node in nodes {
            self.used[node] = true;
            let (a, b) = (self.root(*first.get_or_insert(node)), self.root(node));
            // the smaller position becomes the root, so that the order of elements does not matter
            self.parent[a.max(b)] = a.min(b) as u32;
        }
    }
}
