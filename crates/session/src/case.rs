//! What is coupled, how, and how long: all that a run needs to know beside its two subsystems.

use ttb_coupling::{Method, OnFailure, Predictor, Settings};
use ttb_scenario::{Checked, types};

use crate::axis::TimeAxis;
use crate::column::{Column, Of};

/// A run to be done, whether it comes from a scenario or from a system structure.
#[derive(Clone, Debug)]
pub struct Case {
    /// One line for people.
    pub title: String,
    /// The iteration.
    pub settings: Settings,
    /// A force that counts: the greatest static axle load, N.
    pub axle_load: f64,
    /// Macro step, s.
    pub step: f64,
    /// Steps of train and track in each of them.
    pub substeps: usize,
    /// End, s.
    pub end: f64,
    /// Every how many steps a row is kept.
    pub every: u64,
    /// Whether forces and motions of the supports are kept, too.
    pub supports: bool,
    /// Between which times peaks count, s; `None`: always.
    pub peaks: Option<[f64; 2]>,
    /// Patterns of the columns that results.csv holds; none: all that are kept.
    pub columns: Vec<String>,
    /// How results.csv and iterations.csv are written.
    pub csv: types::Csv,
}

impl Case {
    /// Of a scenario whose steps are known.
    pub fn of(checked: &Checked) -> Self {
        let steps = checked.steps();
        Self {
            title: checked.scenario.title.clone(),
            settings: settings(&checked.scenario.coupling, steps.substeps),
            axle_load: checked.axle_load,
            step: steps.step,
            substeps: steps.substeps,
            end: checked.train_track.end,
            every: checked.scenario.output.every as u64,
            supports: checked.scenario.output.supports,
            peaks: Some(checked.peaks),
            columns: checked.scenario.output.columns.clone(),
            csv: checked.scenario.output.csv,
        }
    }

    /// Its steps.
    pub fn axis(&self) -> TimeAxis {
        TimeAxis::new(self.step, self.end)
    }

    /// Whether a column is kept.
    pub fn keeps(&self, column: &Column) -> bool {
        self.supports || !matches!(column.of, Of::Support(_))
    }
}

/// The iteration's settings; of several `substeps` the forces are means over the step.
pub fn settings(of: &types::CouplingSettings, substeps: usize) -> Settings {
    Settings {
        method: match of.method {
            types::Method::FixedPoint => Method::FixedPoint,
            types::Method::Aitken => Method::Aitken,
            types::Method::IqnIls => Method::IqnIls,
            types::Method::Newton => Method::Newton,
            types::Method::Auto => Method::Auto,
        },
        reuse: of.reuse,
        predictor: match of.predictor {
            types::Predictor::Constant => Predictor::Constant,
            types::Predictor::Linear => Predictor::Linear,
            types::Predictor::Quadratic => Predictor::Quadratic,
            types::Predictor::Cubic => Predictor::Cubic,
        },
        tolerance: of.tolerance,
        max_iterations: of.max_iterations,
        hold_forces: of.send == types::Sending::Mean,
        mean_forces: substeps > 1,
        on_failure: match of.on_failure {
            types::OnFailure::Stop => OnFailure::Stop,
            types::OnFailure::Halve => OnFailure::Halve,
            types::OnFailure::Accept => OnFailure::Accept,
        },
    }
}
