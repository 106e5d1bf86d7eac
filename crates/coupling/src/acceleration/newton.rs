//! Newton's method with a model of the interface that was identified once, and a quasi-Newton correction for what has
//! changed since.
//!
//! ```text
//! bridge over a step    d(λ) = d^{k−1} + H (λ − λ^{k−1})
//! interface             J = I − ∂G/∂λ,    s = J⁻¹ r,    λ ← λ + s
//! ```
//!
//! A linear bridge has a constant H: with it, only the train–track subsystem is iterated, and the bridge steps again
//! when λ is found. J is that of the moment it was identified; a train that comes onto the bridge changes it. So s, which
//! is zero where r is, takes the place of r in [`QuasiNewton`]: what successive trials say about s corrects the step.

use ttb_contract::Ports;
use ttb_contract::finite::largest;

use crate::acceleration::quasi_newton::QuasiNewton;
use crate::acceleration::verbs::Acceleration;
use crate::algebra::{Lu, dot};

/// What is identified: how the coupling answers, over one step, to a change of λ.
#[derive(Debug)]
pub struct Model {
    /// H = ∂(d, ḋ)/∂λ, row by row.
    pub compliance: Vec<f64>,
    /// J = I − ∂G/∂λ, row by row.
    pub jacobian: Vec<f64>,
    /// The ports that forces and motions belong to.
    pub ports: Ports,
}

/// Newton's method with a constant model.
#[derive(Debug)]
pub struct Newton {
    factors: Lu,
    compliance: Vec<f64>,
    /// The step the model belongs to, s.
    h: f64,
    step: Vec<f64>,
    correction: QuasiNewton,
    /// λ^{k−1} and the motion it caused.
    base: Vec<f64>,
    base_motion: Vec<f64>,
    change: Vec<f64>,
    /// Motion of the model at its last λ.
    model_motion: Vec<f64>,
    ports: Ports,
    /// Largest entries of H: of positions, of rates, of others.
    largest: [f64; 3],
}

/// Steps within this of each other, relatively, are one.
const SAME_STEP: f64 = 1e-9;

impl Newton {
    /// For steps of `h` seconds; `None` if the Jacobian is singular.
    pub fn new(model: Model, h: f64, reuse: usize) -> Option<Self> {
        let (n, motions) = (model.ports.forces(), model.ports.motions());
        let rows = model.compliance.chunks_exact(n.max(1));
        let of_rows: Vec<f64> = rows.map(|row| largest(row.iter().map(|x| x.abs()))).collect();
        let largest = model.ports.parts(&of_rows).each().map(|rows| largest(rows.iter().copied()));
        Some(Self {
            factors: Lu::new(n, model.jacobian)?,
            compliance: model.compliance,
            h,
            step: vec![0.0; n],
            correction: QuasiNewton::new(n, reuse),
            base: vec![0.0; n],
            base_motion: vec![0.0; motions],
            change: vec![0.0; n],
            model_motion: vec![0.0; motions],
            ports: model.ports,
            largest,
        })
    }

    /// A trial of both subsystems: where the model of the bridge starts from.
    pub fn base(&mut self, lambda: &[f64], motion: &[f64]) {
        self.base.copy_from_slice(lambda);
        self.base_motion.copy_from_slice(motion);
    }

    /// Motion of the model under λ.
    pub fn motion(&mut self, lambda: &[f64], motion: &mut [f64]) {
        self.change.iter_mut().zip(lambda).zip(&self.base).for_each(|((c, l), b)| *c = l - b);
        let rows = self.compliance.chunks_exact(self.change.len());
        for ((motion, base), row) in motion.iter_mut().zip(&self.base_motion).zip(rows) {
            *motion = base + dot(row, &self.change);
        }
        self.model_motion.copy_from_slice(motion);
    }

    /// Whether the bridge's motion is the model's as exactly as if the forces were off by `force` at most.
    pub fn foresaw(&self, motion: &[f64], force: f64) -> bool {
        let (seen, model) = (self.ports.parts(motion).each(), self.ports.parts(&self.model_motion).each());
        seen.iter().zip(model).zip(self.largest).all(|((seen, model), largest)| {
            let squares = seen.iter().zip(model).map(|(a, b)| (a - b) * (a - b));
            squares.sum::<f64>().sqrt() <= force * largest
        })
    }

    /// Motion of the model at its last λ.
    pub fn foreseen(&self, motion: &mut [f64]) {
        motion.copy_from_slice(&self.model_motion);
    }

    /// Whether the Jacobian belongs to steps of `h` seconds.
    pub fn fits(&self, h: f64) -> bool {
        (h - self.h).abs() <= SAME_STEP * self.h
    }

    fn solve(&mut self, residual: &[f64]) {
        self.step.copy_from_slice(residual);
        self.factors.solve(&mut self.step);
    }
}

impl Acceleration for Newton {
    fn begin_step(&mut self) {
        self.correction.begin_step();
    }
    fn update(&mut self, lambda: &mut [f64], residual: &[f64]) {
        self.solve(residual);
        self.correction.update(lambda, &self.step);
    }
    fn end_step(&mut self, lambda: &[f64], residual: &[f64]) {
        self.solve(residual);
        self.correction.end_step(lambda, &self.step);
    }
}
