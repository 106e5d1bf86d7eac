//! Elimination orders for large models: nested dissection of the nodes, then a postorder of the elimination tree.
//!
//! ```text
//! order(part) = order(left), order(right), separator        no edge joins left and right
//! ```
//!
//! (George, SIAM J. Numer. Anal. 10, 1973, 345–363.) A part is cut across one of its coordinates near the middle, where
//! the separator is smallest. Without coordinates the approximate minimum degree of the nodes' graph serves. The degrees of freedom of
//! a node stay together. Postordering puts columns of equal pattern side by side, which makes the factor's dense panels
//! wider.

/// A graph of nodes, each with its sorted neighbours.
#[derive(Clone, Debug)]
pub struct Graph {
    starts: Vec<usize>,
    neighbours: Vec<u32>,
}

impl Graph {
    /// The nodes' graph of a symmetric pattern (lower triangle by columns) whose row i belongs to node `node_of[i]`.
    pub fn new(starts: &[u32], rows: &[u32], node_of: &[u32]) -> Self {
        let nodes = node_of.iter().max().map_or(0, |max| *max as usize + 1);
        let mut columns: Vec<u32> = (0..node_of.len() as u32).collect();
        columns.sort_by_key(|&j| node_of[j as usize]);
        // Every edge once, from the node whose column holds it; `seen` marks the last node an edge came from.
        let (mut edges, mut seen) = (Vec::new(), vec![u32::MAX; nodes]);
        for &j in &columns {
            let a = node_of[j as usize];
            for &i in &rows[starts[j as usize] as usize..starts[j as usize + 1] as usize] {
                let b = node_of[i as usize];
                if b != a && seen[b as usize] != a {
                    seen[b as usize] = a;
                    edges.push([a, b]);
                }
            }
        }
        let mut degrees = vec![0; nodes + 1];
        edges.iter().flatten().for_each(|&a| degrees[a as usize + 1] += 1);
        (0..nodes).for_each(|a| degrees[a + 1] += degrees[a]);
        let (mut neighbours, mut next) = (vec![0; 2 * edges.len()], degrees.clone());
        for [a, b] in edges {
            for (from, to) in [(a as usize, b), (b as usize, a)] {
                neighbours[next[from]] = to;
                next[from] += 1;
            }
        }
        Self { starts: degrees, neighbours }
    }

    /// Number of nodes.
    pub fn nodes(&self) -> usize {
        self.starts.len() - 1
    }

    /// Lower triangle of the pattern by columns, the diagonal first.
    pub fn lower(&self) -> (Vec<u32>, Vec<u32>) {
        let (mut starts, mut rows) = (vec![0], Vec::with_capacity(self.neighbours.len() / 2 + self.nodes()));
        for node in 0..self.nodes() as u32 {
            let first = rows.len();
            rows.push(node);
            rows.extend(self.of(node).iter().filter(|&&other| other > node));
            rows[first..].sort_unstable();
            starts.push(rows.len() as u32);
        }
        (starts, rows)
    }

    fn of(&self, node: u32) -> &[u32] {
        &self.neighbours[self.starts[node as usize]..self.starts[node as usize + 1]]
    }
}

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

/// A postorder of the elimination tree of a symmetric pattern (lower triangle by columns) eliminated in `order`: an
/// equivalent order (Liu, SIAM J. Matrix Anal. Appl. 11, 1990, 134–172).
pub fn postordered(starts: &[u32], rows: &[u32], order: &[u32]) -> Vec<u32> {
    let parent = elimination_tree(starts, rows, order);
    let n = order.len();
    // Children in ascending order: the lists are filled from behind.
    let (mut first, mut sibling) = (vec![NONE; n + 1], vec![NONE; n]);
    for j in (0..n).rev() {
        let of = if parent[j] == NONE { n } else { parent[j] as usize };
        sibling[j] = first[of];
        first[of] = j as u32;
    }
    let (mut post, mut stack) = (Vec::with_capacity(n), vec![n as u32]);
    while let Some(&top) = stack.last() {
        let child = first[top as usize];
        if child != NONE {
            first[top as usize] = sibling[child as usize];
            stack.push(child);
        } else {
            stack.pop();
            if (top as usize) < n {
                post.push(order[top as usize]);
            }
        }
    }
    post
}

const NONE: u32 = u32::MAX;

/// Parent of every position of `order` (Liu's algorithm with path compression).
fn elimination_tree(starts: &[u32], rows: &[u32], order: &[u32]) -> Vec<u32> {
    let n = order.len();
    let mut position = vec![0_u32; n];
    order.iter().enumerate().for_each(|(at, &dof)| position[dof as usize] = at as u32);
    // Entries of the permuted upper triangle by columns.
    let mut counts = vec![0_u32; n + 1];
    let pairs = || {
        (0..n).flat_map(|j| {
            let column = &rows[starts[j] as usize..starts[j + 1] as usize];
            column.iter().map(move |&i| (i, j as u32))
        })
    };
    let sorted = |(i, j): (u32, u32)| {
        let (a, b) = (position[i as usize], position[j as usize]);
        if a < b { (a, b) } else { (b, a) }
    };
    pairs().map(sorted).filter(|(a, b)| a < b).for_each(|(_, b)| counts[b as usize + 1] += 1);
    (0..n).for_each(|j| counts[j + 1] += counts[j]);
    let (mut upper, mut next) = (vec![0_u32; counts[n] as usize], counts.clone());
    for (a, b) in pairs().map(sorted).filter(|(a, b)| a < b) {
        upper[next[b as usize] as usize] = a;
        next[b as usize] += 1;
    }
    let (mut parent, mut ancestor) = (vec![NONE; n], vec![NONE; n]);
    for j in 0..n {
        for &i in &upper[counts[j] as usize..counts[j + 1] as usize] {
            let mut node = i;
            while node != NONE && (node as usize) < j {
                let above = ancestor[node as usize];
                ancestor[node as usize] = j as u32;
                if above == NONE {
                    parent[node as usize] = j as u32;
                }
                node = above;
            }
        }
    }
    parent
}
