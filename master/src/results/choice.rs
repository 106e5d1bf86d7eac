//! The steps that were chosen for a scenario that leaves them to the program.

use schemars::JsonSchema;
use serde::Serialize;

/// What was chosen, and why.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Choice {
    /// Hz: speed over the shortest wavelength; over the spacing of supports; wheelset against rail.
    pub irregularity_hz: f64,
    /// Hz.
    pub supports_hz: f64,
    /// Hz.
    pub wheel_rail_hz: f64,
    /// Greatest error allowed.
    pub allowed_error: f64,
    /// The steps tried.
    pub tried: Vec<Tried>,
    /// Estimated error of each kind of quantity at the steps taken, relative to its largest extreme.
    pub errors: Vec<KindError>,
    /// Kinds whose error is larger than allowed and does not fall with the step: they did not count.
    pub not_falling: Vec<String>,
    /// What was noticed; it stands among the run's warnings.
    #[serde(skip)]
    pub warnings: Vec<String>,
}

/// A step that was tried.
#[derive(Clone, Copy, Debug, Serialize, JsonSchema)]
pub struct Tried {
    /// Macro step, s.
    pub step_s: f64,
    /// Sub-steps in it.
    pub substeps: usize,
    /// Greatest estimated error of a kind; null: the iteration did not converge.
    pub error: Option<f64>,
    /// Whether it was taken.
    pub taken: bool,
}

/// Estimated error of all quantities of a kind.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct KindError {
    /// `wheel[].contact_force` and the like.
    pub kind: String,
    /// Relative to the largest extreme of the kind.
    pub error: f64,
}

impl Choice {
    /// Estimated error of a series of columns, relative to its greatest peak.
    pub fn error(&self, series: &str) -> Option<f64> {
        self.errors.iter().find(|known| known.kind == series).map(|known| known.error)
    }

    /// Progress for people, on standard error.
    pub fn print(&self) {
        let (irregularity, supports, wheel_rail) = (self.irregularity_hz, self.supports_hz, self.wheel_rail_hz);
        note!(
            "ttb: step auto: irregularity up to {irregularity:.0} Hz, supports {supports:.0} Hz, wheel on rail \
             {wheel_rail:.0} Hz"
        );
        for tried in &self.tried {
            let (step, substeps) = (tried.step_s, tried.substeps);
            let error =
                tried.error.map_or("did not converge".into(), |e| format!("estimated error of peaks {:.1} %", 1e2 * e));
            note!("ttb: step auto: {step} s in {substeps} sub-steps: {error}");
        }
        self.warnings.iter().for_each(|warning| note!("ttb: warning: {warning}"));
    }

    /// Notes what the choice could not reach.
    pub fn warn(&mut self) {
        let allowed = 1e2 * self.allowed_error;
        for KindError { kind, error } in self.errors.iter().filter(|error| error.error > self.allowed_error) {
            let error = 1e2 * error;
            self.warnings.push(if self.not_falling.contains(kind) {
                format!("step auto: the error of {kind}, about {error:.1} %, does not fall with the step: it was left out of the choice")
            } else {
                format!("step auto: {kind} is off by an estimated {error:.1} %, more than {allowed} %, at the shortest step tried")
            });
        }
        if self.errors.is_empty() {
            self.warnings
                .push("step auto: the iteration converged at no step that was tried: errors are not known".into());
        }
    }
}
