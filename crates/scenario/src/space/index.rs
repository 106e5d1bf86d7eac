//! From a node's number to its position in the list of nodes.

use std::collections::HashMap;

use crate::types::Model;

/// Positions of the nodes by number.
#[derive(Clone, Debug)]
pub struct Index {
    /// Numbers that hardly leave gaps: position by number, `NONE` for a gap.
    dense: Vec<u32>,
    /// Any others.
    sparse: HashMap<u32, u32>,
    /// Positions of nodes whose number another has before them.
    pub repeated: Vec<usize>,
}

const NONE: u32 = u32::MAX;
/// Numbers up to this many times the number of nodes are looked up in a table.
const GAPS: usize = 8;

impl Index {
    /// The nodes of a model; of two with one number the first counts.
    #[must_use]
    pub fn new(model: &Model) -> Self {
        let greatest = model.nodes.iter().map(|node| node.0 as usize).max().unwrap_or(0);
        let is_dense = greatest < GAPS * model.nodes.len();
        let mut index = Self {
            dense: if is_dense { vec![NONE; greatest + 1] } else { Vec::new() },
            sparse: HashMap::with_capacity(if is_dense { 0 } else { model.nodes.len() }),
            repeated: Vec::new(),
        };
        for (position, node) in model.nodes.iter().enumerate() {
            let place = match index.dense.get_mut(node.0 as usize) {
                Some(place) => place,
                None => index.sparse.entry(node.0).or_insert(NONE),
            };
            if *place == NONE {
                *place = position as u32;
            } else {
                index.repeated.push(position);
            }
        }
        index
    }

    /// Position of the node with this number.
    #[must_use]
    pub fn position(&self, number: u32) -> Option<usize> {
        let found = self.dense.get(number as usize).or_else(|| self.sparse.get(&number));
        found.filter(|position| **position != NONE).map(|position| *position as usize)
    }
}
