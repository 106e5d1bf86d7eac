//! The description of an FMU besides its interface list.

use crate::date::Date;
use ttb_contract::Model;

/// The log categories of the FMUs: name and meaning. The shell uses exactly these.
pub const LOG_CATEGORIES: [(&str, &str); 3] = [
    ("logStatusError", "Why a call was refused or failed; sent whether debug logging is on or off."),
    ("logStatusWarning", "What looks wrong but does not stop the simulation; sent whether debug logging is on or off."),
    ("logEvents", "Milestones of an instance: instantiated, initialized, reset, terminated."),
];

/// The meaning of our directional derivatives, for XML and documentation.
pub const DERIVATIVE_MEANING: &str = "Directional derivatives are \u{2202}(outputs at the end of a step of the size in \
    use)/\u{2202}(inputs' value set for that step).";

/// Name, purpose and experiment of an FMU.
#[derive(Clone, Debug, PartialEq)]
pub struct About<'a> {
    /// C identifier; the shared library is called `<model_identifier>.so`.
    pub model_identifier: &'a str,
    /// Name shown to the user.
    pub model_name: &'a str,
    /// What the FMU computes, in a sentence or two.
    pub description: &'a str,
    /// Preferred communication step in s.
    pub step: f64,
    /// Default stop time in s.
    pub stop: f64,
    /// Whether `fmi2GetDirectionalDerivative` answers.
    pub directional_derivatives: bool,
    /// Date for description and archive; without one they carry none.
    pub date: Option<Date>,
}

impl<'a> About<'a> {
    /// Takes step, stop time and capability from a model.
    pub fn of<M: Model>(model: &M, model_identifier: &'a str, model_name: &'a str, description: &'a str) -> Self {
        let (step, stop) = model.default_experiment();
        Self {
            model_identifier,
            model_name,
            description,
            step,
            stop,
            directional_derivatives: M::DIRECTIONAL_DERIVATIVES,
            date: None,
        }
    }

    /// The description with the meaning of the derivatives, where there are any.
    pub fn full_description(&self) -> String {
        let derivatives = if self.directional_derivatives { DERIVATIVE_MEANING } else { "" };
        let full = format!("{} {derivatives}", self.description);
        full.split_whitespace().collect::<Vec<_>>().join(" ")
    }
}
