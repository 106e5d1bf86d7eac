//! A passage step by step: modes by the exact recursion, then outputs combined and reduced.
//!
//! The instruction set is chosen at run time; the order of additions and their rounding are the same with all of them.

use pulp::NullaryFnOnce;

use crate::block::{Motion, Outputs};
use crate::extreme::Extreme;
use crate::lanes::QUAD;
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

    /// q and q̈ at rest and after every step.
    #[must_use]
    pub fn motions(&self) -> Motions {
        let at_rest = || Motion::at_rest(self.bridge.modes().len(), self.steps + 1);
        let mut motions = Motions { q: at_rest(), a: at_rest() };
        pulp::Arch::new().dispatch(Run { march: self, motions: &mut motions });
        motions
    }

    /// Extremes of all outputs, in the bridge's order, of its motions.
    #[must_use]
    pub fn extremes(&self, motions: &Motions) -> Vec<Extreme> {
        let Self { bridge, load, stride, h, .. } = *self;
        let (rows, rest) = (bridge.position_rows(), Some((load, stride)));
        let positions = Outputs { motion: &motions.q, rows, rest, count: bridge.positions(), h }.extremes();
        [positions, accelerations(bridge, &motions.a, h)].concat()
    }
}

/// Modal motions of a passage.
#[derive(Clone, Debug)]
pub struct Motions {
    /// q.
    pub q: Motion,
    /// q̈.
    pub a: Motion,
}

/// Extremes of all accelerations of a motion q̈, in the order of the bridge's outputs behind [`ModalBridge::positions`].
#[must_use]
pub fn accelerations(bridge: &ModalBridge, motion: &Motion, h: f64) -> Vec<Extreme> {
    let count = bridge.outputs().len() - bridge.positions();
    Outputs { motion, rows: bridge.acceleration_rows(), rest: None, count, h }.extremes()
}

/// A march under an instruction set.
struct Run<'a, 'b> {
    march: &'a March<'b>,
    motions: &'a mut Motions,
}

impl NullaryFnOnce for Run<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let Self { march, motions: Motions { q, a } } = self;
        let mut quads = march.quads();
        let (forces, _) = march.load.forces.as_chunks::<QUAD>();
        let across = quads.len();
        for block in 0..q.blocks() {
            let steps = q.steps(block).start.max(1)..q.steps(block).end;
            for (j, quad) in quads.iter_mut().enumerate() {
                // Zero behind the train.
                let force = |n: usize| forces.get(n * march.stride * across + j).unwrap_or(&[0.0; QUAD]);
                let mut before = force(steps.start - 1);
                for (n, (q, a)) in steps.clone().zip(q.quad(j, steps.clone()).iter_mut().zip(a.quad(j, steps.clone())))
                {
                    let now = force(n);
                    quad.step(before, now);
                    (*q, *a) = (quad.q, quad.a);
                    before = now;
                }
            }
            q.bound(block);
            a.bound(block);
        }
    }
}
