//! S: what the outside sees of unit forces on the supports at the end of a step.

use ttb_dynamics::dense::Dense;
use ttb_dynamics::near::Near;

/// S by rows, in m/N, rad/N, m/(N m) or rad/(N m).
pub enum Compliance {
    /// All numbers.
    Dense(Dense),
    /// Those that matter: a single step's answer fades away a few metres from the force.
    Near(Near),
}

impl Compliance {
    /// Number of rows: supports and monitored points.
    pub fn rows(&self) -> usize {
        match self {
            Self::Dense(s) => s.rows(),
            Self::Near(s) => s.rows(),
        }
    }

    /// Number of forces.
    pub fn columns(&self) -> usize {
        match self {
            Self::Dense(s) => s.columns(),
            Self::Near(s) => s.columns(),
        }
    }

    /// r ← S f.
    pub fn multiply(&self, f: &[f64], r: &mut [f64]) {
        match self {
            Self::Dense(s) => s.multiply(f, r),
            Self::Near(s) => s.multiply(f, r),
        }
    }
}
