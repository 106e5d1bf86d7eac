//! A passage step by step: modes by the exact recursion, outputs combined and reduced block by block.
//!
//! The instruction set is chosen at run time; the order of additions and their rounding are the same with all of them.

use pulp::{Simd, WithSimd};

use crate::block::{Block, Group, QUAD, Rest, STEPS};
use crate::extreme::{Extreme, WIDE, Watch};
use crate::load::TrainLoad;
use crate::modal::ModalBridge;
use crate::recursion::Coefficients;

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
        let positions = self.bridge.positions();
        let accelerations = self.bridge.outputs().len() - positions;
        let [slow, fast] = [positions, accelerations].map(|n| vec![Watch::default(); n.div_ceil(WIDE)]);
        let mut extremes = Extremes { march: self, slow, fast, rest: Rest::default() };
        pulp::Arch::new().dispatch(Job { march: self, visit: &mut extremes });
        let found = |watches: &[Watch], count: usize| -> Vec<Extreme> {
            watches.iter().flat_map(|watch| watch.finish(self.steps + 1, self.h)).take(count).collect()
        };
        [found(&extremes.slow, positions), found(&extremes.fast, accelerations)].concat()
    }

    /// Runs with the modal motions of every block handed to `visit`.
    pub fn visited(&self, visit: &mut impl Visit) {
        pulp::Arch::new().dispatch(Job { march: self, visit });
    }

    #[inline(always)]
    fn run<S: Simd>(&self, simd: S, visit: &mut impl Visit) {
        let (mut quads, modes) = (self.quads(), self.bridge.modes().len());
        let (forces, _) = self.load.forces.as_chunks::<QUAD>();
        let (mut q, mut a) = (Block::new(modes), Block::new(modes));
        let across = quads.len();
        for begin in (0..self.steps).step_by(STEPS) {
            let steps = STEPS.min(self.steps - begin);
            q.advance(steps);
            a.advance(steps);
            for (j, quad) in quads.iter_mut().enumerate() {
                // Zero behind the train.
                let force = |n: usize| forces.get(n * self.stride * across + j).unwrap_or(&[0.0; QUAD]);
                let mut before = force(begin);
                for (n, (q, a)) in (begin + 1..).zip(q.quad(j).iter_mut().zip(a.quad(j))) {
                    let now = force(n);
                    quad.step(before, now);
                    (*q, *a) = (quad.q, quad.a);
                    before = now;
                }
            }
            visit.block(simd, begin + 1, &mut q, &mut a);
        }
    }
}

/// What is done with modal motions.
pub trait Visit {
    /// q and q̈ of the steps from `first` on.
    fn block<S: Simd>(&mut self, simd: S, first: usize, q: &mut Block, a: &mut Block);
}

/// Reduces all outputs.
struct Extremes<'a, 'b> {
    march: &'a March<'b>,
    slow: Vec<Watch>,
    fast: Vec<Watch>,
    rest: Rest,
}

impl Visit for Extremes<'_, '_> {
    #[inline(always)]
    fn block<S: Simd>(&mut self, simd: S, first: usize, q: &mut Block, a: &mut Block) {
        let March { bridge, load, stride, h, steps } = *self.march;
        let (groups, last) = (self.slow.len(), first + STEPS > steps);
        q.bound();
        a.bound();
        let modes = bridge.modes().len().max(1);
        for (group, (watch, rows)) in self.slow.iter_mut().zip(bridge.position_rows().chunks(modes)).enumerate() {
            // A history begins at rest, whatever the first axle does to the place where it enters.
            let at = |n: usize| if n == 0 { None } else { load.rest.get(n * stride * groups + group) };
            self.rest.fill(first, |n| at(n).copied().unwrap_or_default());
            Group { rows, rest: Some(&self.rest), first, last, h }.watch(simd, q, watch);
        }
        for (watch, rows) in self.fast.iter_mut().zip(bridge.acceleration_rows().chunks(modes)) {
            Group { rows, rest: None, first, last, h }.watch(simd, a, watch);
        }
    }
}

/// A march under an instruction set.
struct Job<'a, 'b, V> {
    march: &'a March<'b>,
    visit: &'a mut V,
}

impl<V: Visit> WithSimd for Job<'_, '_, V> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        self.march.run(simd, self.visit);
    }
}
