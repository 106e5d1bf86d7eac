//! A train over a modal bridge without a speed: modal forces and static answers over the place s of its first axle.
//!
//! ```text
//! p_j(s) = Σ_i P_i φ_j(s − x_i)       y_k^stat(s) = Σ_i P_i I_k(s − x_i)       s = n Δs, from the deck's begin
//! rest_k(s) = y_k^stat(s) − Σ_j Y_kj p_j(s)/ω_j²
//! ```
//!
//! Neither depends on the speed: a passage at v in steps of h reads every (v h/Δs)-th row, which is a whole number. Both are
//! cubics over stretches of rows, as in `sum.rs`; p_j is written out row by row, rest_k is made where an output is looked at.

use pulp::NullaryFnOnce;
use ttb_trains::ForceTrain;

use crate::extreme::{Extreme, WIDE};
use crate::lanes::{QUAD, ROUNDING, larger, smaller};
use crate::lines::{Cubics, value};
use crate::modal::ModalBridge;
use crate::sum::{Stretch, Sums};

/// Tables of a train.
#[derive(Clone, Debug)]
pub struct TrainLoad {
    /// Δs, m.
    pub grid: f64,
    /// p_j of every row, [`ModalBridge::mode_pad`] numbers each.
    pub forces: Vec<f64>,
    /// rest_k as cubics by stretch and group of outputs, in single precision: it is small beside what it is added to.
    rests: Vec<[[f32; WIDE]; 4]>,
    /// First row of every stretch.
    firsts: Vec<u32>,
    /// Stretch of every row; behind them the train has left.
    stretches: Vec<u32>,
    /// Bounds of rest_k over [`CHUNK`] rows each, by group.
    ranges: Vec<[[f64; WIDE]; 2]>,
    /// Static extremes of the outputs that follow displacements; instead of times the places s, m.
    pub statics: Vec<Extreme>,
}

/// Rows whose range is kept.
const CHUNK: usize = 64;

/// What a group of outputs has beside its modes, in steps of so many rows.
#[derive(Clone, Copy)]
pub struct Rest<'a> {
    /// Tables of the train.
    pub load: &'a TrainLoad,
    /// Number of the group.
    pub group: usize,
    /// Rows of a step.
    pub stride: usize,
}

impl Rest<'_> {
    /// At a step after the first: a history begins at rest, whatever the first axle does to the place where it enters.
    #[inline(always)]
    #[must_use]
    pub fn at(&self, n: usize) -> [f64; WIDE] {
        let row = n * self.stride;
        let Some(stretch) = self.load.stretches.get(row) else { return [0.0; WIDE] };
        let stretch = *stretch as usize;
        let [c0, c1, c2, c3] = &self.load.rests[stretch * self.load.groups() + self.group];
        let u = (row - self.load.firsts[stretch] as usize) as f64;
        let mut y = [0.0; WIDE];
        for k in 0..WIDE {
            y[k] = f64::from(c0[k]) + u * (f64::from(c1[k]) + u * (f64::from(c2[k]) + u * f64::from(c3[k])));
        }
        y
    }

    /// Bounds of all values at some steps and at so many before them.
    #[inline(always)]
    #[must_use]
    pub fn range(&self, steps: std::ops::Range<usize>, before: usize) -> [[f64; WIDE]; 2] {
        let (first, last) = (steps.start.saturating_sub(before) * self.stride, steps.end * self.stride);
        let chunks = first / CHUNK..(last / CHUNK + 1).min(self.load.stretches.len().div_ceil(CHUNK));
        // Before and behind the train there is nothing.
        let (mut low, mut high) = ([0.0; WIDE], [0.0; WIDE]);
        for chunk in chunks {
            let [least, most] = self.load.ranges[chunk * self.load.groups() + self.group];
            for k in 0..WIDE {
                (low[k], high[k]) = (smaller(low[k], least[k]), larger(high[k], most[k]));
            }
        }
        [low, high]
    }
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
        let ([begin, end], pad) = (lines.extent(), bridge.mode_pad());
        let rows = ((end - begin + train.length()) / grid).ceil() as usize + 1;
        let groups = (lines.count() - pad) / WIDE;
        let mut load = Self {
            grid,
            forces: vec![0.0; rows * pad],
            rests: Vec::with_capacity(rows.min(train.axles.len() * lines.breaks().len()) * groups),
            firsts: Vec::new(),
            stretches: Vec::with_capacity(rows),
            ranges: vec![[[0.0; WIDE]; 2]; rows.div_ceil(CHUNK) * groups],
            statics: vec![Extreme::default(); bridge.positions()],
        };
        let sums = Sums::new(&lines, &train.axles, grid, rows);
        pulp::Arch::new().dispatch(Fill { load: &mut load, bridge, sums });
        load.statics.iter_mut().for_each(without_rounding);
        load
    }

    /// Groups of outputs that follow displacements.
    fn groups(&self) -> usize {
        self.statics.len().div_ceil(WIDE)
    }
}

/// Fills the tables stretch by stretch under an instruction set; all of them give the same bits.
struct Fill<'a> {
    load: &'a mut TrainLoad,
    bridge: &'a ModalBridge,
    sums: Sums<'a>,
}

impl NullaryFnOnce for Fill<'_> {
    type Output = ();

    #[inline(always)]
    fn call(mut self) {
        let (modes, pad) = (self.bridge.modes(), self.bridge.mode_pad());
        let squares: Vec<f64> = modes.iter().map(|mode| mode.omega * mode.omega).collect();
        let (quads, groups) = (pad / QUAD, self.load.groups());
        while let Some(stretch) = self.sums.advance() {
            let number = self.load.firsts.len() as u32;
            self.load.firsts.push(stretch.first as u32);
            self.load.stretches.extend(std::iter::repeat_n(number, stretch.count));
            if !stretch.loaded {
                self.load.rests.extend(std::iter::repeat_n([[0.0; WIDE]; 4], groups));
                continue;
            }
            let (forces, statics) = self.sums.sums().split_at(quads);
            for (quad, forces) in forces.iter().enumerate() {
                let (rows, _) = self.load.forces[stretch.first * pad..].as_chunks_mut::<QUAD>();
                for (row, u) in rows[quad..].iter_mut().step_by(quads).take(stretch.count).zip(0..) {
                    *row = value(forces, f64::from(u));
                }
            }
            let (statics, _) = statics.as_chunks::<2>();
            for (group, statics) in statics.iter().enumerate() {
                let rows = &self.bridge.position_rows()[group * modes.len()..(group + 1) * modes.len()];
                let mut rest = together(statics);
                self.load.look(&rest, group, stretch);
                // What modes follow at once is taken off.
                for (j, (row, square)) in rows.iter().zip(&squares).enumerate() {
                    for (rest, force) in rest.iter_mut().zip(&forces[j / QUAD]) {
                        let q = force[j % QUAD] / square;
                        for k in 0..WIDE {
                            rest[k] -= row[k] * q;
                        }
                    }
                }
                self.load.bound(&rest, group, stretch);
                self.load.rests.push(rest.map(|c| c.map(|c| c as f32)));
            }
        }
    }
}

impl TrainLoad {
    /// Takes the bounds of a group's rest over a stretch into those of its rows.
    #[inline(always)]
    fn bound(&mut self, rest: &[[f64; WIDE]; 4], group: usize, stretch: Stretch) {
        let [low, high] = bounds(rest, stretch.count, f64::from(f32::EPSILON));
        let groups = self.groups();
        for chunk in stretch.first / CHUNK..=(stretch.first + stretch.count - 1) / CHUNK {
            let [least, most] = &mut self.ranges[chunk * groups + group];
            for k in 0..WIDE {
                (least[k], most[k]) = (smaller(least[k], low[k]), larger(most[k], high[k]));
            }
        }
    }

    /// Takes the static extremes of a group of outputs over a stretch, unless its bound shows that there are none.
    #[inline(always)]
    fn look(&mut self, cubic: &[[f64; WIDE]; 4], group: usize, stretch: Stretch) {
        let found = &mut self.statics[group * WIDE..];
        let [low, high] = bounds(cubic, stretch.count, ROUNDING);
        if found.iter().zip(low.iter().zip(&high)).all(|(found, (low, high))| *low >= found.min && *high <= found.max) {
            return;
        }
        for u in 0..stretch.count {
            let place = (stretch.first + u) as f64 * self.grid;
            for (found, y) in found.iter_mut().zip(value(cubic, u as f64)) {
                if y > found.max {
                    (found.max, found.max_time) = (y, place);
                }
                if y < found.min {
                    (found.min, found.min_time) = (y, place);
                }
            }
        }
    }
}

/// A static answer to one side alone has nothing but rounding on the other.
fn without_rounding(of: &mut Extreme) {
    if of.max < -ROUNDING * of.min {
        (of.max, of.max_time) = (0.0, 0.0);
    }
    if -of.min < ROUNDING * of.max {
        (of.min, of.min_time) = (0.0, 0.0);
    }
}

/// Bounds of cubics over so many rows, wider by a share of their size.
#[inline(always)]
fn bounds([c0, c1, c2, c3]: &[[f64; WIDE]; 4], count: usize, share: f64) -> [[f64; WIDE]; 2] {
    let most = (count - 1) as f64;
    let reach: [f64; WIDE] = std::array::from_fn(|k| {
        let reach = most * (c1[k].abs() + most * (c2[k].abs() + most * c3[k].abs()));
        reach + share * (reach + c0[k].abs())
    });
    [std::array::from_fn(|k| c0[k] - reach[k]), std::array::from_fn(|k| c0[k] + reach[k])]
}

/// Twice four lines as a group.
#[inline(always)]
fn together([a, b]: &[Cubics; 2]) -> [[f64; WIDE]; 4] {
    std::array::from_fn(|power| std::array::from_fn(|k| if k < QUAD { a[power][k] } else { b[power][k - QUAD] }))
}
