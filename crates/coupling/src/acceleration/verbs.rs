//! What every acceleration does.

/// An acceleration of the fixed-point iteration λ = G(λ).
pub trait Acceleration {
    /// A new step begins.
    fn begin_step(&mut self);
    /// λ^{k−1} → λ^k, given r = G(λ^{k−1}) − λ^{k−1}.
    fn update(&mut self, lambda: &mut [f64], residual: &[f64]);
    /// The step is over: its last trial and what was left of the residual.
    fn end_step(&mut self, lambda: &[f64], residual: &[f64]);
}
