//! Why a run cannot go on, in words that say what to do.

use ttb_contract::Failure;

use crate::report::{STABLE, Side, StepInfo};
use crate::settings::Method;

/// A run that cannot go on.
#[derive(Clone, Debug, PartialEq)]
pub enum IterationError {
    /// A subsystem failed.
    Subsystem(Failure),
    /// The step from `t` did not converge; the policy says stop.
    NotConverged {
        /// Begin of the step, s.
        t: f64,
        /// Its size, s; 0 in static equilibrium.
        h: f64,
        /// The last trial.
        info: Box<StepInfo>,
        /// ρ of the fixed point there, where it could be measured.
        rho: Option<f64>,
    },
    /// The bridge cannot roll back, and without that the coupling is not stable.
    Unstable {
        /// Begin of the step, s.
        t: f64,
        /// Its size, s.
        h: f64,
        /// ρ, where the bridge's derivatives told.
        rho: Option<f64>,
        /// |r| / max(|G|, one axle load) of the step; 0 if it was not taken.
        residual: f64,
    },
    /// A subsystem that says it rolls back does not come back to the same state.
    NoReturn {
        /// Begin of the step that was repeated, s.
        t: f64,
        /// Which.
        side: Side,
        /// By how much the repeated step differs, relative to what it changes.
        difference: f64,
    },
    /// A subsystem answered NaN or infinity.
    NotFinite {
        /// When, s: the end of the step.
        t: f64,
        /// Which side.
        side: Side,
        /// Name of the subsystem.
        subsystem: String,
        /// Name of its output.
        output: String,
        /// What it answered.
        value: f64,
    },
}

impl std::fmt::Display for IterationError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Subsystem(failure) => failure.fmt(f),
            Self::NotConverged { t, h, info, rho } => {
                let (k, method) = (info.iterations, info.method.name());
                write!(
                    f,
                    "the support forces did not converge in the step from t = {t} s (h = {h} s): residual {:.2e} after \
                     {k} trials, at the end by {method}",
                    info.residual
                )?;
                advise(f, *h, info, *rho)
            }
            Self::Unstable { t, h, rho, residual } => {
                write!(f, "the bridge cannot save and restore its state, and without that the coupling ")?;
                match rho {
                    Some(rho) if *residual == 0.0 => {
                        let (most, enough) = (STABLE, h * (STABLE / rho).sqrt());
                        write!(
                            f,
                            "is not stable: ρ = {rho:.2}; {most} is possible, about that with h = {enough:.1e} s"
                        )?;
                    }
                    _ => write!(
                        f,
                        "is not stable, or too coarse: forces disagree by {residual:.1e} in the step from t = {t} s (h = {h} s)"
                    )?,
                }
                write!(f, ". Use a smaller step, or a bridge FMU with canGetAndSetFMUstate")
            }
            Self::NoReturn { t, side, difference } => write!(
                f,
                "{side} does not come back to the state it saved: the step from t = {t} s, repeated, differs by {difference:.1e} \
                 of its change, so that no iteration can be trusted"
            ),
            Self::NotFinite { t, subsystem, output, value, .. } => {
                write!(f, "{subsystem}: output {output} is {value} at t = {t} s")
            }
        }
    }
}

/// What to do, by the reason that ρ shows.
fn advise(f: &mut std::fmt::Formatter<'_>, h: f64, info: &StepInfo, rho: Option<f64>) -> std::fmt::Result {
    let Some(rho) = rho else {
        return write!(f, ", contraction {:.2}; allow more trials (max_iterations)", info.contraction);
    };
    write!(f, "; the plain iteration has ρ = {rho:.2} there")?;
    if info.method == Method::FixedPoint && rho >= 0.5 {
        write!(f, ": use method auto, newton or iqn-ils")
    } else if rho < 1.0 {
        write!(f, ": allow more trials (max_iterations), or a tolerance above the accuracy of the subsystems")
    } else {
        // ρ grows with h² as long as the bridge answers within a step by its mass (docs/theory.md, T47).
        let enough = h * (0.5 / rho).sqrt();
        write!(f, ": a step of about {enough:.1e} s brings it to 0.5; or use on_failure halve")
    }
}

impl std::error::Error for IterationError {}
impl From<Failure> for IterationError {
    fn from(failure: Failure) -> Self {
        Self::Subsystem(failure)
    }
}
