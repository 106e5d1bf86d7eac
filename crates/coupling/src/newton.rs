//! Newton's method with an interface Jacobian that was identified once, and a quasi-Newton correction for what has
//! changed since.
//!
//! ```text
//! J = I − ∂G/∂λ,    s = J⁻¹ r,    λ ← λ + s
//! ```
//!
//! J is constant, but a train that comes onto the bridge changes ∂G/∂λ. So s, which is zero where r is, takes the place
//! of r in [`QuasiNewton`]: what successive trials say about s corrects the step.

use crate::acceleration::Acceleration;
use crate::dense::Lu;
use crate::quasi_newton::QuasiNewton;

/// Newton's method with the factors of a constant Jacobian.
#[derive(Debug)]
pub struct Newton {
    factors: Lu,
    /// The step the Jacobian belongs to, s.
    h: f64,
    step: Vec<f64>,
    correction: QuasiNewton,
}

/// Steps within this of each other, relatively, are one.
const SAME_STEP: f64 = 1e-9;

impl Newton {
    /// From J = I − ∂G/∂λ (n × n, row by row) for steps of `h` seconds; `None` if it is singular.
    pub fn new(n: usize, jacobian: Vec<f64>, h: f64, reuse: usize) -> Option<Self> {
        let factors = Lu::new(n, jacobian)?;
        Some(Self { factors, h, step: vec![0.0; n], correction: QuasiNewton::new(n, reuse) })
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
