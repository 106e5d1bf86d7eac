//! How the next trial follows from the residual r = G(λ) − λ: an object with three verbs and no physics.
//!
//! [`relaxation`] holds the simple ones, [`quasi_newton`] and [`newton`] those with a memory; `strategy` says which is in force.

pub mod newton;
pub mod quasi_newton;
pub mod relaxation;
mod strategy;
mod verbs;

pub(crate) use strategy::Strategy;
pub use verbs::Acceleration;
