//! How an FMU is driven: its coupled variables, their excitation, its time.

use std::cell::RefCell;
use std::collections::HashSet;

use ttb_contract::Component;
use ttb_fmi::description::{ModelDescription, ScalarVariable, VariableType};
use ttb_fmi2::probe::Instantiation;

/// Steps when nothing is said of them, s.
const STEP: f64 = 1e-3;

/// How an FMU is driven: its coupled variables, its time.
pub struct Plan {
    inputs: Vec<u32>,
    /// Start value and amplitude of each input.
    swing: Vec<(f64, f64)>,
    pub outputs: Vec<u32>,
    names: Vec<String>,
    /// Outputs that differ from run to run: no comparison says anything about them.
    pub random: RefCell<Vec<bool>>,
    /// Whether there may be several instances in a process, also one after the other.
    pub several: bool,
    /// Whether steps may go on after the call.
    pub asynchronous: bool,
    /// Begin, end and step in s.
    pub start: f64,
    pub stop: Option<f64>,
    pub h: f64,
    guid: String,
    resources: String,
}

impl Plan {
    /// Of what a description says; `resources` is the URI of the FMU's resources.
    pub fn new(d: &ModelDescription, resources: String) -> Self {
        let reals = |causality| d.with_causality(causality).filter(|v| v.kind == VariableType::Real);
        // Of inputs that share a reference, which is an error of its own, the first: a value can be set once.
        let mut seen = HashSet::new();
        let inputs: Vec<&ScalarVariable> = reals("input").filter(|v| seen.insert(v.value_reference)).collect();
        let start = d.start_time.filter(|t| t.is_finite()).unwrap_or(0.0);
        let stop = d.stop_time.filter(|t| *t > start);
        let h = d.step_size.filter(|h| *h > 0.0 && h.is_finite());
        let h = h.or(stop.map(|stop| (stop - start) / 500.0)).unwrap_or(STEP);
        Self {
            inputs: inputs.iter().map(|v| v.value_reference).collect(),
            swing: inputs.iter().map(|v| swing(v, d)).collect(),
            random: RefCell::new(vec![false; reals("output").count()]),
            several: !d.co_simulation.can_be_instantiated_only_once_per_process,
            asynchronous: d.co_simulation.can_run_asynchronously,
            outputs: reals("output").map(|v| v.value_reference).collect(),
            names: reals("output").map(|v| v.name.clone()).collect(),
            start,
            stop,
            h,
            guid: d.guid.clone(),
            resources,
        }
    }

    /// Time after k steps.
    pub fn time(&self, k: usize) -> f64 {
        self.start + k as f64 * self.h
    }

    /// How many of the `wanted` steps there are until the stop time.
    pub fn steps(&self, wanted: usize) -> usize {
        let whole = |stop: f64| ((stop - self.start) / self.h * (1.0 + 1e-9)) as usize;
        self.stop.map_or(wanted, |stop| whole(stop).min(wanted))
    }

    /// How a right instance is made.
    pub fn instantiation(&self) -> Instantiation<'_> {
        Instantiation { name: "Check", guid: &self.guid, resources: &self.resources, logging: false }
    }

    /// Inputs by number: references, start values, amplitudes.
    pub fn input(&self, i: usize) -> Option<(u32, f64)> {
        Some((*self.inputs.get(i)?, self.swing[i].1))
    }
    /// How many inputs there are.
    pub fn input_count(&self) -> usize {
        self.inputs.len()
    }
    /// References of all inputs.
    pub fn inputs(&self) -> &[u32] {
        &self.inputs
    }
    /// Name of an output.
    pub fn name(&self, i: usize) -> &str {
        &self.names[i]
    }

    /// Whether an output is left out of all comparisons.
    pub fn is_random(&self, i: usize) -> bool {
        self.random.borrow()[i]
    }

    /// Inputs at a time; another `tune` is another excitation.
    pub fn values(&self, t: f64, tune: f64) -> Vec<f64> {
        let tau = (t - self.start) / self.h;
        let value = |(i, (start, amplitude)): (usize, &(f64, f64))| {
            start + amplitude * (0.05 * (1.0 + tune) * tau + 0.7 * i as f64 + tune).sin()
        };
        self.swing.iter().enumerate().map(value).collect()
    }
}

/// Start value and amplitude, by unit: 10 kN, 10 kN m, 0.1 mm, 1 mm/s, 0.1 mrad, 1 mrad/s, or one.
fn swing(v: &ScalarVariable, d: &ModelDescription) -> (f64, f64) {
    let start = v.start.as_ref().and_then(|text| text.trim().parse().ok()).unwrap_or(0.0);
    let unit = v.unit.as_ref().and_then(|unit| d.units.get(unit));
    let amplitude = match unit.map(|unit| (unit.powers, unit.factor)) {
        Some(([1, 1, -2, ..], factor)) => 1e4 / factor,
        Some(([1, 2, -2, ..], factor)) if v.name.ends_with(Component::Roll.force()) => 1e4 / factor,
        Some(([0, 0, 0, 0, 0, 0, 0, 1], factor)) => 1e-4 / factor,
        Some(([0, 0, -1, 0, 0, 0, 0, 1], factor)) => 1e-3 / factor,
        Some(([0, 1, 0, ..], factor)) => 1e-4 / factor,
        Some(([0, 1, -1, ..], factor)) => 1e-3 / factor,
        _ => 1.0,
    };
    (start, amplitude)
}
