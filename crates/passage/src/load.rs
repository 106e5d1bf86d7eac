//! A train over a modal bridge without a speed: modal forces and static answers over the place s of its first axle.
//!
//! ```text
//! p_j(s) = Σ_i P_i φ_j(s − x_i)       y_k^stat(s) = Σ_i P_i I_k(s − x_i)       s = n Δs, from the deck's begin
//! rest_k(s) = y_k^stat(s) − Σ_j Y_kj p_j(s)/ω_j²
//! ```
//!
//! Neither depends on the speed: a passage at v in steps of h reads every (v h/Δs)-th row, which is a whole number.

use pulp::{Simd, WithSimd};
use ttb_trains::ForceTrain;

use crate::block::{add, larger, smaller};
use crate::extreme::{Extreme, WIDE};
use crate::modal::ModalBridge;

/// Rows that are made together: axle after axle adds to them, so that they ought to stay in a cache.
const BLOCK: usize = 256;

/// Tables of a train.
#[derive(Clone, Debug)]
pub struct TrainLoad {
    /// Δs, m.
    pub grid: f64,
    /// p_j of every row, [`ModalBridge::mode_pad`] numbers each.
    pub forces: Vec<f64>,
    /// rest_k of every row, in single precision: it is small beside what it is added to.
    pub rest: Vec<[f32; WIDE]>,
    /// Number of rows; behind them the train has left.
    pub rows: usize,
    /// Static extremes of the outputs that follow displacements; instead of times the places s, m.
    pub statics: Vec<Extreme>,
}

/// Direction of a train.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Heading {
    /// Towards +x: the first axle enters at the deck's begin.
    #[default]
    Forward,
    /// Towards −x: the first axle enters at the deck's end.
    Backward,
}

impl TrainLoad {
    /// Tables of a train on the grid Δs, m.
    #[must_use]
    pub fn new(bridge: &ModalBridge, train: &ForceTrain, heading: Heading, grid: f64) -> Self {
        let lines = match heading {
            Heading::Forward => bridge.lines().clone(),
            Heading::Backward => bridge.lines().mirrored(),
        };
        let ([begin, end], width, pad) = (lines.extent(), lines.count(), bridge.mode_pad());
        let rows = ((end - begin + train.length()) / grid).ceil() as usize + 1;
        let groups = (width - pad) / WIDE;
        let mut load = Self {
            grid,
            forces: Vec::with_capacity(rows * pad),
            rest: Vec::with_capacity(rows * groups),
            rows,
            statics: vec![Extreme::default(); bridge.positions()],
        };
        let mut block = Vec::new();
        let mut places = Vec::new();
        for from in (0..rows).step_by(BLOCK) {
            let count = BLOCK.min(rows - from);
            block.clear();
            block.resize(count * width, 0.0);
            for axle in &train.axles {
                // Rows at which this axle is on the deck.
                let first = ((axle.x / grid).ceil() as usize).max(from);
                let last = ((axle.x + end - begin) / grid).floor() as usize;
                let last = last.min(from + count - 1);
                if first <= last {
                    places.clear();
                    places.extend((first..=last).map(|n| begin + (n as f64 * grid - axle.x)));
                    lines.add(&places, axle.load, &mut block[(first - from) * width..]);
                }
            }
            pulp::Arch::new().dispatch(Take { load: &mut load, bridge, block: &block, width });
            load.look(&block, width, pad, from);
        }
        load
    }

    /// Takes the static extremes of a block of rows from number `from` on.
    fn look(&mut self, block: &[f64], width: usize, pad: usize, from: usize) {
        let column = |k: usize| block.iter().skip(pad + k).step_by(width);
        let place = |k: usize, value: f64| column(k).position(|y| *y == value).unwrap_or(0) + from;
        for (group, found) in self.statics.chunks_mut(WIDE).enumerate() {
            let (mut low, mut high) = ([0.0; WIDE], [0.0; WIDE]);
            for row in block.chunks_exact(width) {
                let (values, _) = row[pad..].as_chunks::<WIDE>();
                for k in 0..WIDE {
                    (low[k], high[k]) = (smaller(low[k], values[group][k]), larger(high[k], values[group][k]));
                }
            }
            for (k, found) in found.iter_mut().enumerate() {
                if high[k] > found.max {
                    (found.max, found.max_time) = (high[k], place(WIDE * group + k, high[k]) as f64 * self.grid);
                }
                if low[k] < found.min {
                    (found.min, found.min_time) = (low[k], place(WIDE * group + k, low[k]) as f64 * self.grid);
                }
            }
        }
    }
}

/// A block of rows that is taken into the tables.
struct Take<'a> {
    load: &'a mut TrainLoad,
    bridge: &'a ModalBridge,
    block: &'a [f64],
    width: usize,
}

impl WithSimd for Take<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let modes = self.bridge.modes();
        // −q_j: what modes follow at once is taken off.
        let mut follow = vec![0.0; modes.len()];
        for row in self.block.chunks_exact(self.width) {
            let (forces, statics) = row.split_at(self.bridge.mode_pad());
            self.load.forces.extend_from_slice(forces);
            for ((q, p), mode) in follow.iter_mut().zip(forces).zip(modes) {
                *q = -(p / (mode.omega * mode.omega));
            }
            let (statics, _) = statics.as_chunks::<WIDE>();
            let rows = self.bridge.position_rows().chunks_exact(modes.len().max(1));
            for (rest, rows) in statics.iter().zip(rows) {
                let mut rest = *rest;
                add(simd, rows, &follow, &mut rest);
                self.load.rest.push(rest.map(|rest| rest as f32));
            }
        }
    }
}
