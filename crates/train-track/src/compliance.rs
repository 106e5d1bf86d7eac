//! Dynamic compliance of the track, from bands of the inverse made once: between two points of the rail, Y = N K̂⁻¹ Nᵀ, and
//! between the rail and the supports on the bridge, N K̂⁻¹ e_s.
//!
//! K̂⁻¹ decays exponentially along the rail; entries below 1e-16 of the largest are left out, so that the tables are exact to
//! rounding. One pair of columns a node is enough: K̂⁻¹ is symmetric.

use std::ops::Range;

use ttb_dynamics::band::BandFactor;

use crate::track::{RailPoint, Track};

/// Blocks [ww, wθ, θw, θθ] of K̂⁻¹ between rail nodes p and p + o, o < width.
#[derive(Clone, Debug)]
pub struct RailCompliance {
    width: usize,
    blocks: Vec<[f64; 4]>,
    /// Rail node over every support on the bridge.
    support_nodes: Vec<usize>,
    /// [w, θ] of K̂⁻¹ e_s at the rail nodes within `width` of the support's, 2 width − 1 of them.
    columns: Vec<[f64; 2]>,
}

/// What is left out, relative to the largest entry of a column.
const NEGLIGIBLE: f64 = 1e-16;

impl RailCompliance {
    /// Tabulates the inverse of `factor`, the track's Newmark matrix.
    pub fn new(track: &Track, factor: &BandFactor) -> Self {
        let (nodes, n) = (track.nodes(), track.order());
        let width = reach(track, factor);
        let mut blocks = vec![[0.0; 4]; nodes * width];
        let mut column = vec![0.0; n];
        for p in 0..nodes {
            let begin = track.node_dof(p);
            // The solution has to decay beyond the last block before the window may end.
            let last = (p + width).min(nodes) - 1;
            let end = if p + 2 * width < nodes { track.node_dof(p + 2 * width) } else { n };
            for a in 0..2 {
                column[begin..end].fill(0.0);
                column[begin + a] = 1.0;
                factor.solve_range(&mut column, begin, end);
                for q in p..=last {
                    let (block, dof) = (&mut blocks[p * width + q - p], track.node_dof(q));
                    (block[2 * a], block[2 * a + 1]) = (column[dof], column[dof + 1]);
                }
            }
        }
        let (support_nodes, columns) = supports(track, factor, width);
        Self { width, blocks, support_nodes, columns }
    }

    /// Supports on the bridge that a wheel at `point` can be felt at, and N K̂⁻¹ e_s of each, written to `row` (one entry a
    /// support on the bridge, the others are left alone).
    pub fn to_supports(&self, point: &RailPoint, row: &mut [f64]) -> Range<usize> {
        let behind = |n: &usize| n + self.width <= point.element + 1;
        let ahead = |n: &usize| *n >= point.element + self.width;
        // Against the run where the train comes from the bridge's end.
        let rising = self.support_nodes.first() <= self.support_nodes.last();
        let begin = self.support_nodes.partition_point(|n| if rising { behind(n) } else { ahead(n) });
        let end = self.support_nodes.partition_point(|n| if rising { !ahead(n) } else { !behind(n) });
        let end = end.max(begin);
        for (s, entry) in row.iter_mut().enumerate().take(end).skip(begin) {
            let table = s * (2 * self.width - 1);
            let at = |node: usize| self.columns[table + node + self.width - 1 - self.support_nodes[s]];
            let ([w1, t1], [w2, t2]) = (at(point.element), at(point.element + 1));
            let [a, b, c, d] = point.row;
            *entry = a * w1 + b * t1 + c * w2 + d * t2;
        }
        begin..end
    }

    /// Whether two points feel each other at all.
    pub fn reaches(&self, i: &RailPoint, j: &RailPoint) -> bool {
        i.element.abs_diff(j.element) <= self.width
    }

    /// N_i K̂⁻¹ N_jᵀ, m/N, local compliance not included.
    pub fn between(&self, i: &RailPoint, j: &RailPoint) -> f64 {
        let mut sum = 0.0;
        for a in 0..2 {
            for b in 0..2 {
                let (p, q) = (i.element + a, j.element + b);
                let (low, high) = (p.min(q), p.max(q));
                if high - low >= self.width {
                    continue;
                }
                let [ww, wt, tw, tt] = self.blocks[low * self.width + high - low];
                let (wt, tw) = if p <= q { (wt, tw) } else { (tw, wt) };
                let (w, t) = (i.row[2 * a], i.row[2 * a + 1]);
                let (v, s) = (j.row[2 * b], j.row[2 * b + 1]);
                sum += w * (ww * v + wt * s) + t * (tw * v + tt * s);
            }
        }
        sum
    }
}

/// Rail nodes over the supports on the bridge, and the columns K̂⁻¹ e_s around them.
fn supports(track: &Track, factor: &BandFactor, width: usize) -> (Vec<usize>, Vec<[f64; 2]>) {
    let (nodes, n) = (track.nodes(), track.order());
    let dof = |node: usize| if node < nodes { track.node_dof(node) } else { n };
    let (mut support_nodes, mut columns, mut column) = (Vec::new(), Vec::new(), vec![0.0; n]);
    for (node, base) in track.bridge_bases() {
        let (begin, end) = (dof(node.saturating_sub(width)), dof(node + 2 * width));
        column[begin..end].fill(0.0);
        column[base] = 1.0;
        factor.solve_range(&mut column, begin, end);
        columns.extend((0..2 * width - 1).map(|i| match (node + i).checked_sub(width - 1) {
            Some(q) if q < nodes => [column[dof(q)], column[dof(q) + 1]],
            _ => [0.0; 2],
        }));
        support_nodes.push(node);
    }
    (support_nodes, columns)
}

/// Number of nodes over which the inverse decays to nothing, measured in the middle of the track.
fn reach(track: &Track, factor: &BandFactor) -> usize {
    let (nodes, middle) = (track.nodes(), track.nodes() / 2);
    let mut reach = 1;
    for a in 0..2 {
        let mut column = vec![0.0; track.order()];
        column[track.node_dof(middle) + a] = 1.0;
        factor.solve(&mut column);
        for b in 0..2 {
            let entry = |q: usize| column[track.node_dof(q) + b].abs();
            let largest = (0..nodes).map(entry).fold(0.0, f64::max);
            let far = (middle..nodes).rev().find(|q| entry(*q) > NEGLIGIBLE * largest);
            reach = reach.max(far.map_or(1, |q| q - middle + 1));
        }
    }
    // Near the ends the rail is softer than in the middle: a quarter more.
    (reach + reach / 4 + 1).min(nodes)
}
