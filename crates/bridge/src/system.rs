//! The equations of motion M ü + C u̇ + K u = f, cut for Newmark's method so that the solver can be exchanged.
//!
//! ```text
//! K = k K₀,  M = m M₀              k, m: factors on stiffness and mass
//! C = αM + βK                      Rayleigh, or MΦ diag(2ζω) ΦᵀM over the lowest modes
//! u₁ = K̂⁻¹ (p + f₁) + g            p, g: History, what a step owes to the state it starts from
//! ```
//!
//! A history serves every repetition of a step from the same state: one solve each. A [`System`] holds what no parameter
//! touches (K₀, M₀, the factor of K₀, modes); a [`Step`] what belongs to one step size. There are two: all degrees of
//! freedom ([`crate::full`]) and modal coordinates ([`crate::reduced`]).

use std::sync::Arc;

use ttb_dynamics::factor::FactorError;
use ttb_dynamics::newmark::{Motion, Newmark};

/// Stiffness, mass and damping under the parameters in force.
#[derive(Clone, Debug, PartialEq)]
pub struct Law {
    /// k.
    pub stiffness: f64,
    /// m.
    pub mass: f64,
    /// α, 1/s.
    pub alpha: f64,
    /// β, s.
    pub beta: f64,
    /// 2ζω of the lowest modes, 1/s; empty without modal damping.
    pub rates: Vec<f64>,
}

/// What a step owes to the state it starts from.
#[derive(Clone, Debug)]
pub struct History {
    /// p: stands beside the forces.
    pub load: Vec<f64>,
    /// g: is added to the solution.
    pub known: Vec<f64>,
}

impl History {
    /// For `n` unknowns.
    pub fn new(n: usize) -> Self {
        Self { load: vec![0.0; n], known: vec![0.0; n] }
    }
}

/// A structure's equations.
pub trait System: Send + Sync {
    /// Number of unknowns.
    fn unknowns(&self) -> usize;

    /// Static solution: `x` holds the load and receives u.
    fn statics(&self, law: &Law, x: &mut [f64]);

    /// Factorises for one step size.
    ///
    /// # Errors
    /// K̂ is not positive definite.
    fn prepare(self: Arc<Self>, law: &Law, newmark: Newmark) -> Result<Box<dyn Step>, FactorError>;
}

/// A factorised step; allocates nothing.
pub trait Step: Send {
    /// Newmark's constants.
    fn newmark(&self) -> &Newmark;

    /// The history of a step from `motion`.
    fn history(&mut self, motion: &Motion, history: &mut History);

    /// `x` holds p + f₁ and receives u₁.
    fn solve(&mut self, history: &History, x: &mut [f64]);
}
