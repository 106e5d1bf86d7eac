//! How a step went: the row of the iteration log, or why the run cannot go on.

use crate::settings::Method;
use crate::work::Work;

/// Largest ρ at the start for which a bridge that cannot roll back is stepped. Without a train the steps are stable up to .25
/// at least; a train on the bridge raises ρ.
pub const STABLE: f64 = 0.1;

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

/// A side that came back nearly to a state it had saved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Returned {
    /// Begin of the step that was taken again, s.
    pub t: f64,
    /// Which.
    pub side: Side,
    /// By how much the step from the restored state differs, relative to what a tenth of an axle load, or 0.01 mm of the
    /// deck's motion, changes of it.
    pub difference: f64,
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
    /// The same as accelerations of the deck, m/s²: the largest force that was missing at a port, as far as it can
    /// accelerate the deck there. None if nobody could be asked how far that is.
    pub explicit_acceleration: Option<f64>,
    /// The step from a restored state that was furthest from the step from the state that had been saved, if that can be
    /// seen.
    pub returned: Option<Returned>,
    /// Largest amount of an accepted force, in the unit of the first port, and of a position of the deck, m.
    pub largest: [f64; 2],
    /// Work at the interface, all steps together.
    pub work: Work,
}

impl std::fmt::Display for Side {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::TrainTrack => "the train–track subsystem",
            Self::Bridge => "the bridge",
        })
    }
}
