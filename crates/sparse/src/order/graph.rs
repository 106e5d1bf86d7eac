//! Graphs of nodes, from the pattern of a matrix.

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

    /// Neighbours of a node, ascending from where they were met.
    pub fn of(&self, node: u32) -> &[u32] {
        &self.neighbours[self.starts[node as usize]..self.starts[node as usize + 1]]
    }
}
