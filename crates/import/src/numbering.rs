//! Rows by node and direction.

use std::collections::HashMap;

use crate::dof::Dof;

/// Nodes below are found in a table, others by hashing; the table then takes at most 16 MB.
const DENSE: u32 = 1 << 22;
/// No row.
const NONE: u32 = u32::MAX;

/// Finds the row of a node's motion.
#[derive(Clone, Debug, Default)]
pub(crate) struct Numbering {
    /// Place in `rows` by node number.
    dense: Vec<u32>,
    sparse: HashMap<u32, u32>,
    /// A node and the rows of its six motions.
    rows: Vec<(u32, [u32; 6])>,
    len: u32,
}

impl Numbering {
    /// Rows in the order given.
    pub fn new(labels: &[Dof]) -> Self {
        let mut all = Self::default();
        for (dof, row) in labels.iter().zip(0..) {
            all.set(*dof, row);
        }
        all
    }

    /// Number of motions known.
    pub fn len(&self) -> u32 {
        self.len
    }

    #[inline]
    fn place(&self, node: u32) -> Option<usize> {
        let place = if node < DENSE { *self.dense.get(node as usize)? } else { *self.sparse.get(&node)? };
        (place != NONE).then_some(place as usize)
    }

    /// The row of a motion.
    #[inline]
    pub fn get(&self, dof: Dof) -> Option<u32> {
        let row = *self.rows[self.place(dof.node)?].1.get(usize::from(dof.freedom))?;
        (row != NONE).then_some(row)
    }

    /// Gives a motion a row.
    pub fn set(&mut self, dof: Dof, row: u32) {
        let place = self.place(dof.node).unwrap_or_else(|| {
            let place = self.rows.len();
            self.rows.push((dof.node, [NONE; 6]));
            if dof.node < DENSE {
                let least = dof.node as usize + 1;
                if self.dense.len() < least {
                    self.dense.resize(least, NONE);
                }
                self.dense[dof.node as usize] = place as u32;
            } else {
                self.sparse.insert(dof.node, place as u32);
            }
            place
        });
        if let Some(known) = self.rows[place].1.get_mut(usize::from(dof.freedom)) {
            self.len += u32::from(*known == NONE);
            *known = row;
        }
    }

    /// All motions, by node and direction.
    pub fn sorted(mut self) -> Vec<Dof> {
        self.rows.sort_unstable_by_key(|(node, _)| *node);
        let of_node = |(node, rows): (u32, [u32; 6])| {
            (0..6).filter(move |&f| rows[usize::from(f)] != NONE).map(move |freedom| Dof { node, freedom })
        };
        self.rows.into_iter().flat_map(of_node).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn motions_are_found_and_sorted() {
        let labels = [(7, 2), (u32::MAX, 5), (1, 0), (7, 0)].map(|(node, freedom)| Dof { node, freedom });
        let all = Numbering::new(&labels);
        assert_eq!(labels.map(|dof| all.get(dof)), [Some(0), Some(1), Some(2), Some(3)]);
        for (node, freedom) in [(7, 1), (2, 0), (8, 0), (DENSE, 0), (0, 0)] {
            assert_eq!(all.get(Dof { node, freedom }), None);
        }
        assert_eq!(all.len(), 4);
        assert_eq!(all.sorted(), [labels[2], labels[3], labels[0], labels[1]]);
    }
}
