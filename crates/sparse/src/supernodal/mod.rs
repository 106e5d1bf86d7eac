//! Supernodal Cholesky factorisation P A Pᵀ = L Lᵀ for large models: symbolic once, numeric often.
//!
//! faer computes the numbers; the order is [`crate::order`]'s and the sweeps are [`crate::sweeps`]'.

mod numbers;
mod pattern;

pub use numbers::Numbers;
pub use pattern::Pattern;
