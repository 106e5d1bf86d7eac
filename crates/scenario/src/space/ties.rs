//! Motions that follow others: rigid links and multi-point constraints as one list, in an order in which they can be
//! replaced.
//!
//! ```text
//! rigid link      u_f = u_l + θ_l × (r_f − r_l),   θ_f = θ_l      for the freedoms named
//! constraint      Σ c_i u_i = 0                    u_1 = −Σ_{i>1} c_i/c_1 u_i
//! ```

use std::collections::HashMap;
use std::fmt;

use super::index::Index;
use crate::types::{Freedom, Model};

/// A node's motion: six times the node's position plus the freedom's.
pub type Motion = u32;

/// The motion of a node, given by its position, in a freedom.
#[must_use]
pub fn motion(node: usize, freedom: Freedom) -> Motion {
    (6 * node + freedom.index()) as Motion
}

/// A motion that follows: it is Σ weight · motion.
#[derive(Clone, Debug, PartialEq)]
pub struct Tie {
    /// The motion that is eliminated.
    pub follower: Motion,
    /// What it follows, and how.
    pub terms: Vec<(Motion, f64)>,
    /// Where the model says so.
    pub origin: Origin,
}

/// Where a model ties a motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Origin {
    /// Rigid link and position among its followers.
    Link(usize, usize),
    /// Constraint.
    Constraint(usize),
}

impl fmt::Display for Origin {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Link(link, follower) => write!(f, "rigid_links[{link}].followers[{follower}]"),
            Self::Constraint(constraint) => write!(f, "constraints[{constraint}]"),
        }
    }
}

/// All ties of a model.
#[derive(Clone, Debug, Default)]
pub struct Ties {
    /// The ties; what names an unknown node, or divides by zero, is left out.
    pub list: Vec<Tie>,
    /// Positions in the list such that every tie comes after those that it needs.
    pub order: Vec<usize>,
    /// Pairs of positions in the list: the second eliminates what the first has eliminated already.
    pub twice: Vec<(usize, usize)>,
    /// Positions of ties that lead back to themselves; not in the order.
    pub cyclic: Vec<usize>,
}

impl Ties {
    /// Collects and orders.
    #[must_use]
    pub fn new(model: &Model, index: &Index) -> Self {
        let mut ties = Self { list: links(model, index), ..Self::default() };
        ties.list.extend(constraints(model, index));
        let mut first = HashMap::with_capacity(ties.list.len());
        for (i, tie) in ties.list.iter().enumerate() {
            if let Some(before) = first.get(&tie.follower) {
                ties.twice.push((*before, i));
            } else {
                first.insert(tie.follower, i);
            }
        }
        ties.sort(&first);
        ties
    }

    /// Every tie after those whose motions it needs (Kahn, Communications of the ACM 5, 1962, 558–562).
    fn sort(&mut self, by_follower: &HashMap<Motion, usize>) {
        let mut open = vec![0; self.list.len()];
        let mut needed_by = vec![Vec::new(); self.list.len()];
        for (i, tie) in self.list.iter().enumerate() {
            for other in tie.terms.iter().filter_map(|(motion, _)| by_follower.get(motion)) {
                open[i] += 1;
                needed_by[*other].push(i);
            }
        }
        self.order = (0..self.list.len()).filter(|i| open[*i] == 0).collect();
        let mut done = 0;
        while let Some(&ready) = self.order.get(done) {
            done += 1;
            for &i in &needed_by[ready] {
                open[i] -= 1;
                if open[i] == 0 {
                    self.order.push(i);
                }
            }
        }
        self.cyclic = (0..self.list.len()).filter(|i| open[*i] > 0).collect();
    }
}

fn links(model: &Model, index: &Index) -> Vec<Tie> {
    let mut ties = Vec::new();
    for (number, link) in model.rigid_links.iter().enumerate() {
        let Some(leader) = index.position(link.leader) else { continue };
        let freedoms = link.freedoms.as_deref().unwrap_or(&Freedom::ALL);
        for (place, follower) in link.followers.iter().enumerate() {
            let Some(follower) = index.position(*follower).filter(|follower| *follower != leader) else { continue };
            let [(_, a, b, c), (_, d, e, f)] = [model.nodes[leader], model.nodes[follower]];
            let arm = [d - a, e - b, f - c];
            ties.extend(freedoms.iter().map(|&freedom| Tie {
                follower: motion(follower, freedom),
                terms: rigid(leader, freedom, arm),
                origin: Origin::Link(number, place),
            }));
        }
    }
    ties
}

/// Motion of a rigid body in one freedom at `arm` from the leader.
fn rigid(leader: usize, freedom: Freedom, [x, y, z]: [f64; 3]) -> Vec<(Motion, f64)> {
    use Freedom::{Rx, Ry, Rz, X, Y, Z};
    let turned = match freedom {
        X => vec![(Ry, z), (Rz, -y)],
        Y => vec![(Rz, x), (Rx, -z)],
        Z => vec![(Rx, y), (Ry, -x)],
        Rx | Ry | Rz => Vec::new(),
    };
    let all = std::iter::once((freedom, 1.0)).chain(turned);
    all.filter(|(_, weight)| *weight != 0.0).map(|(freedom, weight)| (motion(leader, freedom), weight)).collect()
}

fn constraints<'a>(model: &'a Model, index: &'a Index) -> impl Iterator<Item = Tie> + 'a {
    model.constraints.iter().enumerate().filter_map(|(number, constraint)| {
        let terms = constraint.terms.iter().map(|(node, freedom, factor)| {
            let node = index.position(*node)?;
            Some((motion(node, *freedom), *factor))
        });
        let terms: Vec<_> = terms.collect::<Option<_>>()?;
        let ((follower, own), others) = terms.split_first().filter(|((_, own), _)| *own != 0.0)?;
        let terms = others.iter().filter(|(_, factor)| *factor != 0.0);
        let terms = terms.map(|(motion, factor)| (*motion, -factor / own)).collect();
        Some(Tie { follower: *follower, terms, origin: Origin::Constraint(number) })
    })
}
