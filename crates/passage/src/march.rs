//! A passage step by step: modes by the exact recursion, outputs combined and reduced at once.
//!
//! The loops run over modes and over groups of eight outputs; the instruction set is chosen at run time, the order of
//! additions and their rounding are the same with all of them.

use pulp::{Simd, WithSimd};

use crate::extreme::{Extreme, WIDE, Watch};
use crate::load::TrainLoad;
use crate::modal::ModalBridge;
use crate::recursion::Coefficients;

/// Four modes.
const QUAD: usize = 4;

/// A passage at one speed.
pub struct March<'a> {
    bridge: &'a ModalBridge,
    load: &'a TrainLoad,
    /// Rows of the tables a step.
    stride: usize,
    /// Step, s.
    pub h: f64,
    /// Number of steps.
    pub steps: usize,
}

/// Four modes in step: motion and coefficients.
#[derive(Clone, Default)]
struct Quad {
    q: [f64; QUAD],
    v: [f64; QUAD],
    a: [f64; QUAD],
    position: [[f64; QUAD]; 4],
    velocity: [[f64; QUAD]; 4],
    rate: [f64; QUAD],
    omega2: [f64; QUAD],
}

impl Quad {
    /// From p₀ to p₁.
    #[inline(always)]
    fn step(&mut self, p0: &[f64; QUAD], p1: &[f64; QUAD]) {
        let (q, v) = (self.q, self.v);
        let ends = |c: &[[f64; QUAD]; 4]| -> [f64; QUAD] {
            std::array::from_fn(|i| (c[2][i] * p0[i] + c[3][i] * p1[i]) + (c[0][i] * q[i] + c[1][i] * v[i]))
        };
        (self.q, self.v) = (ends(&self.position), ends(&self.velocity));
        self.a = std::array::from_fn(|i| p1[i] - self.rate[i] * self.v[i] - self.omega2[i] * self.q[i]);
    }
}

/// What a march is asked for beside extremes.
pub trait Keep {
    /// Modal motion after a step: q and q̈ in fours.
    fn keep(&mut self, q: &[f64; QUAD], a: &[f64; QUAD]);
}

/// Nothing is kept.
pub struct Nothing;

impl Keep for Nothing {
    #[inline(always)]
    fn keep(&mut self, _q: &[f64; QUAD], _a: &[f64; QUAD]) {}
}

impl<'a> March<'a> {
    /// At `speed` m/s, with free vibration for `free` s behind the train; the step is the longest that is a whole number of
    /// rows and no longer than the bridge allows.
    #[must_use]
    pub fn new(bridge: &'a ModalBridge, load: &'a TrainLoad, length: f64, speed: f64, free: f64) -> Self {
        let stride = ((speed * bridge.longest_step() / load.grid).floor() as usize).max(1);
        let h = stride as f64 * load.grid / speed;
        let steps = (((bridge.length() + length) / speed + free) / h).ceil() as usize;
        Self { bridge, load, stride, h, steps }
    }

    /// Rows of the tables a step.
    #[must_use]
    pub fn stride(&self) -> usize {
        self.stride
    }

    fn quads(&self) -> Vec<Quad> {
        let modes = self.bridge.modes();
        let quads = modes.chunks(QUAD).map(|chunk| {
            let mut quad = Quad::default();
            for (i, mode) in chunk.iter().enumerate() {
                let Coefficients { position, velocity } = mode.step(self.h);
                quad.position.iter_mut().zip(position).for_each(|(row, c)| row[i] = c);
                quad.velocity.iter_mut().zip(velocity).for_each(|(row, c)| row[i] = c);
                (quad.rate[i], quad.omega2[i]) = (mode.rate, mode.omega * mode.omega);
            }
            quad
        });
        quads.collect()
    }

    /// Extremes of all outputs, in the bridge's order.
    #[must_use]
    pub fn extremes(&self) -> Vec<Extreme> {
        let (mut quads, positions) = (self.quads(), self.bridge.positions());
        let accelerations = self.bridge.outputs().len() - positions;
        let [wide, fast] = [positions, accelerations].map(|n| n.div_ceil(WIDE));
        let mut watches = vec![Watch::default(); wide + fast];
        let job = Job { march: self, quads: &mut quads, watches: &mut watches, wide };
        pulp::Arch::new().dispatch(job);
        let found = watches.iter().flat_map(|watch| watch.finish(self.steps + 1, self.h));
        let found: Vec<Extreme> = found.collect();
        let (slow, quick) = found.split_at(wide * WIDE);
        slow[..positions].iter().chain(&quick[..accelerations]).copied().collect()
    }

    /// Runs with every modal motion handed to `keep`.
    pub fn kept(&self, keep: &mut impl Keep) {
        let mut quads = self.quads();
        self.run(pulp::Scalar::new(), &mut quads, &mut [], 0, keep);
    }

    #[inline(always)]
    fn run<S: Simd>(&self, simd: S, quads: &mut [Quad], watches: &mut [Watch], wide: usize, keep: &mut impl Keep) {
        let modes = self.bridge.modes().len();
        let (rows, fast_rows) = (self.bridge.position_rows(), self.bridge.acceleration_rows());
        let (slow, fast) = watches.split_at_mut(wide);
        let (groups, across) = (slow.len(), quads.len());
        let mut loads = Loads::default();
        let mut q = vec![0.0; across * QUAD];
        let mut a = vec![0.0; across * QUAD];
        for begin in (0..self.steps).step_by(BLOCK) {
            let end = (begin + BLOCK).min(self.steps);
            loads.fetch(self, [begin, end], groups, across);
            for n in begin + 1..=end {
                let k = n - begin;
                let (before, now) = loads.forces[(k - 1) * across..(k + 1) * across].split_at(across);
                for (j, ((quad, p0), p1)) in quads.iter_mut().zip(before).zip(now).enumerate() {
                    quad.step(p0, p1);
                    keep.keep(&quad.q, &quad.a);
                    q[j * QUAD..(j + 1) * QUAD].copy_from_slice(&quad.q);
                    a[j * QUAD..(j + 1) * QUAD].copy_from_slice(&quad.a);
                }
                let rest = &loads.rest[(k - 1) * groups..k * groups];
                for (group, (watch, rest)) in slow.iter_mut().zip(rest).enumerate() {
                    let mut y = rest.map(f64::from);
                    add(simd, &rows[group * modes..(group + 1) * modes], &q, &mut y);
                    watch.look_with(simd, &y, n, self.h);
                }
                for (group, watch) in fast.iter_mut().enumerate() {
                    let mut y = [0.0; WIDE];
                    add(simd, &fast_rows[group * modes..(group + 1) * modes], &a, &mut y);
                    watch.look_with(simd, &y, n, self.h);
                }
            }
        }
    }
}

/// Rows of the tables for some steps to come. A step skips rows, and the tables are larger than the caches: row by row, each would
/// be waited for; fetched together, they come one behind the other.
#[derive(Default)]
struct Loads {
    /// At the begin of the first step and at the end of every step.
    forces: Vec<[f64; QUAD]>,
    /// At the end of every step.
    rest: Vec<[f32; WIDE]>,
}

/// Steps whose rows are fetched together.
const BLOCK: usize = 64;

impl Loads {
    /// Fetches what the steps from `begin` to `end` need; zero behind the train.
    fn fetch(&mut self, march: &March, [begin, end]: [usize; 2], groups: usize, across: usize) {
        let (forces, _) = march.load.forces.as_chunks::<QUAD>();
        self.forces.clear();
        for n in begin..=end {
            let row = n * march.stride;
            self.forces.extend_from_slice(forces.get(row * across..(row + 1) * across).unwrap_or(&[]));
            self.forces.resize((n - begin + 1) * across, [0.0; QUAD]);
        }
        self.rest.clear();
        for n in begin + 1..=end {
            let row = n * march.stride;
            self.rest.extend_from_slice(march.load.rest.get(row * groups..(row + 1) * groups).unwrap_or(&[]));
            self.rest.resize((n - begin) * groups, [0.0; WIDE]);
        }
    }
}

/// A march under an instruction set.
struct Job<'a, 'b> {
    march: &'a March<'b>,
    quads: &'a mut [Quad],
    watches: &'a mut [Watch],
    wide: usize,
}

impl WithSimd for Job<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        self.march.run(simd, self.quads, self.watches, self.wide, &mut Nothing);
    }
}

/// y ← y + Σ_j row_j x_j, added in the order of j.
#[inline(always)]
pub fn add<S: Simd>(simd: S, rows: &[[f64; WIDE]], x: &[f64], y: &mut [f64; WIDE]) {
    for (row, x) in rows.iter().zip(x) {
        let x = simd.splat_f64s(*x);
        let lanes = S::as_mut_simd_f64s(y).0.iter_mut().zip(S::as_simd_f64s(row).0);
        lanes.for_each(|(y, row)| *y = simd.add_f64s(*y, simd.mul_f64s(*row, x)));
    }
}
