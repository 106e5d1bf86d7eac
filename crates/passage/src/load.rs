//! A train over a modal bridge without a speed: modal forces and static answers over the place s of its first axle.
//!
//! ```text
//! p_j(s) = Σ_i P_i φ_j(s − x_i)       y_k^stat(s) = Σ_i P_i I_k(s − x_i)       s = n Δs, from the deck's begin
//! rest_k(s) = y_k^stat(s) − Σ_j Y_kj p_j(s)/ω_j²
//! ```
//!
//! Neither depends on the speed: a passage at v in steps of h reads every (v h/Δs)-th row, which is a whole number.

use ttb_trains::ForceTrain;

use crate::extreme::{Extreme, WIDE};
use crate::modal::ModalBridge;

/// Rows that are made together.
const BLOCK: usize = 2048;

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
        let modes = bridge.modes();
        let groups = (width - pad) / WIDE;
        let mut load = Self {
            grid,
            forces: Vec::with_capacity(rows * pad),
            rest: Vec::with_capacity(rows * groups),
            rows,
            statics: vec![Extreme::default(); bridge.positions()],
        };
        let mut block = Vec::new();
        let mut follow = vec![0.0; modes.len()];
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
            for (n, row) in (from..).zip(block.chunks_exact(width)) {
                let (forces, statics) = row.split_at(pad);
                load.forces.extend_from_slice(forces);
                for (found, value) in load.statics.iter_mut().zip(statics) {
                    if *value > found.max {
                        (found.max, found.max_time) = (*value, n as f64 * grid);
                    }
                    if *value < found.min {
                        (found.min, found.min_time) = (*value, n as f64 * grid);
                    }
                }
                let flexible = forces.iter().zip(modes).map(|(p, mode)| p / (mode.omega * mode.omega));
                follow.iter_mut().zip(flexible).for_each(|(q, flexible)| *q = flexible);
                let wide = statics.chunks_exact(WIDE).zip(bridge.position_rows().chunks_exact(modes.len().max(1)));
                load.rest.extend(wide.map(|(value, rows)| {
                    let mut rest: [f64; WIDE] = std::array::from_fn(|i| value[i]);
                    for (row, q) in rows.iter().zip(&follow) {
                        rest.iter_mut().zip(row).for_each(|(rest, y)| *rest -= y * q);
                    }
                    rest.map(|rest| rest as f32)
                }));
            }
        }
        load
    }
}
