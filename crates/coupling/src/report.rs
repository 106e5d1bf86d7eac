//! How a step went: the row of the iteration log, or why the run cannot go on.

use crate::settings::Method;
use crate::work::Work;
use ttb_contract::Failure;

/// How a step ended.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Outcome {
    /// Within the tolerance.
    Converged,
    /// k_max trials were not enough, or the residual ran away.
    #[default]
    IterationLimit,
    /// The step was not iterated: the bridge cannot roll back. The residual is an error estimate.
    Explicit,
}

/// One of the two subsystems.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// Train and track.
    TrainTrack,
    /// The bridge.
    Bridge,
}

/// Where a model of the interface came from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Source {
    /// Directional derivatives of the bridge, trials of the train–track subsystem.
    Derivatives,
    /// Trials of both.
    Trials,
}

/// One row of the iteration log.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct StepInfo {
    /// How it ended.
    pub outcome: Outcome,
    /// Trials, those of rescues and halved steps included.
    pub iterations: usize,
    /// Steps of the train–track subsystem: more than trials where it was iterated against a model of the bridge.
    pub train_track_trials: usize,
    /// |r| / max(|G|, one axle load) of the last trial.
    pub residual: f64,
    /// Observed contraction: geometric mean of the quotients of successive |r|; 0 with a single trial.
    pub contraction: f64,
    /// How often both states were restored to try again.
    pub roll_backs: usize,
    /// Halvings that were needed.
    pub halvings: usize,
    /// Times the step was begun again by quasi-Newton with an empty memory.
    pub rescues: usize,
    /// The method in force at its end.
    pub method: Method,
    /// Work at the interface.
    pub work: Work,
}

/// What was found out about the coupling besides its steps.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Report {
    /// ρ at the start, the contraction of the plain fixed point.
    pub contraction: Option<f64>,
    /// Trials and derivatives spent on ρ and on the model, in no step's count.
    pub identification_trials: usize,
    /// Where the model came from, if there is one.
    pub model: Option<Source>,
    /// Methods that took over in the course of the run, and when, s.
    pub switches: Vec<(f64, Method)>,
    /// Steps that were not iterated: largest |G − λ| / max(|G|, one axle load), the force that was missing.
    pub explicit: Option<f64>,
    /// Work at the interface, all steps together.
    pub work: Work,
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

impl std::fmt::Display for Side {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::TrainTrack => "the train–track subsystem",
            Self::Bridge => "the bridge",
        })
    }
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
                        let (most, enough) = (crate::explicit::STABLE, h * (crate::explicit::STABLE / rho).sqrt());
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
