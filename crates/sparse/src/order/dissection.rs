//! Nested dissection: an elimination order of the nodes from their coordinates.
//!
//! ```text
//! order(part) = order(left), order(right), separator        no edge joins left and right
//! ```
//!
//! (George, SIAM J. Numer. Anal. 10, 1973, 345–363.) A part is cut across one of its coordinates near the middle, where
//! the separator is smallest.

use crate::order::graph::Graph;

/// Where cuts are tried, as shares of a part.
const CUTS: [f64; 9] = [0.5, 0.475, 0.525, 0.45, 0.55, 0.425, 0.575, 0.4, 0.6];

/// An elimination order of the nodes from their coordinates.
pub fn nested_dissection(graph: &Graph, place: &[[f64; 3]]) -> Vec<u32> {
    let nodes = graph.nodes();
    let mut dissection = Dissection { graph, place, side: vec![OUTSIDE; nodes], order: Vec::with_capacity(nodes) };
    // Last comes first: separators are written from the end.
    let mut parts = vec![(0..nodes as u32).collect::<Vec<_>>()];
    while let Some(part) = parts.pop() {
        if part.len() <= 1 {
            dissection.order.extend(part.into_iter().rev());
        } else {
            parts.extend(dissection.cut(part));
        }
    }
    dissection.order.reverse();
    dissection.order
}

const OUTSIDE: u8 = 0;
const LEFT: u8 = 1;
const RIGHT: u8 = 2;

struct Dissection<'a> {
    graph: &'a Graph,
    place: &'a [[f64; 3]],
    /// Of every node, while its part is being cut.
    side: Vec<u8>,
    order: Vec<u32>,
}

impl Dissection<'_> {
    /// Orders the best separator and returns what it leaves.
    fn cut(&mut self, part: Vec<u32>) -> [Vec<u32>; 2] {
        let mut best: Option<(f64, Vec<u32>, [Vec<u32>; 2])> = None;
        for axis in 0..3 {
            let mut along: Vec<(f64, u32)> = part.iter().map(|&a| (self.place[a as usize][axis], a)).collect();
            along.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
            let extent = along[along.len() - 1].0 - along[0].0;
            // Nodes in one line across are not parted, unless all are in one line.
            let near = 1e-6 * extent;
            let cuts = CUTS.map(|share| {
                let at = (share * along.len() as f64) as usize;
                let edge = along[at].0 - near;
                if extent > 0.0 { along.partition_point(|(x, _)| *x < edge) } else { at }
            });
            for (i, &at) in cuts.iter().enumerate() {
                if at == 0 || cuts[..i].contains(&at) {
                    continue;
                }
                let (separator, rest) = self.separate(&along, at);
                let [left, right] = [rest[0].len() as f64, rest[1].len() as f64];
                let lopsided = (left - right).abs() / part.len() as f64;
                let cost = separator.len() as f64 * (1.0 + lopsided * lopsided * 4.0);
                if best.as_ref().is_none_or(|(least, ..)| cost < *least) {
                    best = Some((cost, separator, rest));
                }
            }
        }
        let Some((_, separator, rest)) = best else {
            // All nodes at one place.
            self.order.extend(part);
            return [Vec::new(), Vec::new()];
        };
        self.order.extend(separator.into_iter().rev());
        rest
    }

    /// Parts a sorted list before position `at`; the separator is the smaller of the two shores.
    fn separate(&mut self, along: &[(f64, u32)], at: usize) -> (Vec<u32>, [Vec<u32>; 2]) {
        for (i, (_, a)) in along.iter().enumerate() {
            self.side[*a as usize] = if i < at { LEFT } else { RIGHT };
        }
        let shore = |range: &[(f64, u32)], other: u8| -> Vec<u32> {
            let borders = |a: &u32| self.graph.of(*a).iter().any(|&b| self.side[b as usize] == other);
            range.iter().map(|(_, a)| *a).filter(borders).collect()
        };
        let (left, right) = (shore(&along[..at], RIGHT), shore(&along[at..], LEFT));
        let separator = if left.len() < right.len() { left } else { right };
        separator.iter().for_each(|&a| self.side[a as usize] = OUTSIDE);
        let rest = [LEFT, RIGHT].map(|side| {
            let of_side = along.iter().map(|(_, a)| *a).filter(|&a| self.side[a as usize] == side);
            of_side.collect::<Vec<u32>>()
        });
        along.iter().for_each(|(_, a)| self.side[*a as usize] = OUTSIDE);
        (separator, rest)
    }
}
