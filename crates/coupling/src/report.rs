//! How a step went: the row of the iteration log, or why the run cannot go on.

use crate::subsystem::Failure;

/// How a step ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// Within the tolerance.
    Converged,
    /// k_max trials were not enough.
    IterationLimit,
}

/// One row of the iteration log.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StepInfo {
    /// How it ended.
    pub outcome: Outcome,
    /// Trials, those of halved steps included.
    pub iterations: usize,
    /// |r| / max(|G|, one axle load) of the last trial.
    pub residual: f64,
    /// Last quotient of successive |r|: the observed contraction; 0 with a single trial.
    pub contraction: f64,
    /// How often both states were restored to try again.
    pub roll_backs: usize,
    /// Halvings that were needed.
    pub halvings: usize,
}

/// A run that cannot go on.
#[derive(Clone, Debug, PartialEq)]
pub enum IterationError {
    /// A subsystem failed.
    Subsystem(Failure),
    /// The step from `t` did not converge; the policy says stop.
    NotConverged {
        /// Begin of the step, s.
        t: f64,
        /// Its size, s.
        h: f64,
        /// The last trial.
        info: StepInfo,
    },
    /// The residual is not a number.
    NotFinite {
        /// Begin of the step, s.
        t: f64,
    },
}

impl std::fmt::Display for IterationError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Subsystem(failure) => failure.fmt(f),
            Self::NotConverged { t, h, info } => write!(
                f,
                "the support forces did not converge in the step from t = {t} s (h = {h} s): residual {:.2e} after {} \
                 trials, contraction {:.2}; try method aitken, a smaller step or on_failure halve",
                info.residual, info.iterations, info.contraction
            ),
            Self::NotFinite { t } => write!(f, "the support forces are not finite in the step from t = {t} s"),
        }
    }
}
impl std::error::Error for IterationError {}
impl From<Failure> for IterationError {
    fn from(failure: Failure) -> Self {
        Self::Subsystem(failure)
    }
}
