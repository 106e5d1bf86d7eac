//! The numbers of an instance: one value a variable, and the rates of the inputs.

use crate::interface::Interface;

/// Current values of all variables, and the first time derivatives of the inputs for the coming step.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Values {
    /// By value reference.
    pub all: Vec<f64>,
    /// First time derivative by input value reference; meaningful where [`Values::has_rates`].
    pub rates: Vec<f64>,
    /// Whether derivatives were set for the coming step; if not, inputs are held over it.
    pub has_rates: bool,
    /// Whether derivatives were set for the last step.
    pub had_rates: bool,
}

impl Values {
    /// Start values of an interface.
    pub fn start(interface: &Interface) -> Self {
        let all: Vec<f64> = interface.variables().iter().map(|v| v.start).collect();
        Self { rates: vec![0.0; interface.inputs().len()], all, has_rates: false, had_rates: false }
    }
}
