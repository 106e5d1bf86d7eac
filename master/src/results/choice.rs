//! The steps that were chosen for a scenario that leaves them to the program.

use serde::Serialize;

/// What was chosen, and why.
#[derive(Clone, Debug, Serialize)]
pub struct Choice {
    /// Hz: speed over the shortest wavelength; over the spacing of supports; wheelset against rail.
    pub irregularity_hz: f64,
    /// Hz.
    pub supports_hz: f64,
    /// Hz.
    pub wheel_rail_hz: f64,
    /// Greatest error allowed.
    pub allowed_error: f64,
    /// The steps tried, the last one taken.
    pub tried: Vec<Tried>,
    /// Estimated error of each kind of quantity at the steps taken, relative to its largest extreme.
    pub errors: Vec<KindError>,
}

/// A step that was tried.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Tried {
    /// Macro step, s.
    pub step_s: f64,
    /// Sub-steps in it.
    pub substeps: usize,
    /// Greatest estimated error of a kind; absent: the iteration did not converge.
    pub error: Option<f64>,
}

/// Estimated error of all quantities of a kind.
#[derive(Clone, Debug, Serialize)]
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
        eprintln!(
            "ttb: step auto: irregularity up to {irregularity:.0} Hz, supports {supports:.0} Hz, wheel on rail \
             {wheel_rail:.0} Hz"
        );
        for tried in &self.tried {
            let (step, substeps) = (tried.step_s, tried.substeps);
            let error =
                tried.error.map_or("did not converge".into(), |e| format!("error of peaks about {:.1} %", 1e2 * e));
            eprintln!("ttb: step auto: {step} s in {substeps} sub-steps: {error}");
        }
        let worst = self.errors.iter().max_by(|a, b| a.error.total_cmp(&b.error));
        if let Some(KindError { kind, error }) = worst.filter(|worst| worst.error > self.allowed_error) {
            let allowed = 1e2 * self.allowed_error;
            eprintln!("ttb: warning: step auto: {kind} is still off by about {:.1} %, not {allowed} %", 1e2 * error);
        }
    }
}
