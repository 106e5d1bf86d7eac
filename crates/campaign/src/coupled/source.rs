//! A scenario with other values for some of its keys.

use std::path::PathBuf;

use serde_json::{Value, json};
use ttb_scenario::{Checked, Problems, Setting, from_str_using};

use crate::plan::{Load, Plan, Rail, Run, Variant};

/// A scenario file as it was read.
#[derive(Clone, Debug)]
pub struct Source {
    /// Its text.
    pub text: String,
    /// The folder from which it names files.
    pub folder: PathBuf,
    /// What messages call it.
    pub name: String,
    /// Other values that the command line gives for all runs.
    pub settings: Vec<Setting>,
}

impl Source {
    /// The scenario as it is.
    ///
    /// # Errors
    /// All its problems.
    pub fn checked(&self) -> Result<Checked, Problems> {
        self.with(Vec::new())
    }

    /// The scenario with the keys of a variant.
    ///
    /// # Errors
    /// All its problems.
    pub fn varied(&self, variant: &Variant) -> Result<Checked, Problems> {
        self.with(of_variant(variant))
    }

    /// The scenario of a run. Over the scenario's own bridge axle loads take neither its vehicles nor its track: only their speed
    /// is set. Over an FMU they run on the track, as the scenario's train.
    ///
    /// # Errors
    /// All its problems.
    pub fn of_run(&self, plan: &Plan, run: &Run) -> Result<Checked, Problems> {
        let mut settings = of_variant(&plan.variants[run.variant]);
        let mut set = |key: &str, value: Value| settings.push(Setting { key: key.into(), value });
        match &plan.trains[run.train].load {
            Load::Cars(cars) => {
                set("train.forces", Value::Null);
                set("train.cars", json!(cars));
            }
            Load::Axles(axles) if !plan.bridges.is_empty() => {
                set("train.cars", Value::Null);
                set("train.forces", json!(axles));
            }
            Load::Axles(_) | Load::Scenario => {}
        }
        if let Some(speed) = run.speed() {
            set("train.speed", json!({ "m_s": speed }));
        }
        if !plan.trains[run.train].heading.is_forward() {
            set("train.heading", json!("backward"));
        }
        match run.rail {
            Rail::Scenario => {}
            Rail::Smooth => set("irregularity", json!({ "type": "none" })),
            Rail::Seed(seed) => set("irregularity.seed", json!(seed)),
        }
        self.with(settings)
    }

    fn with(&self, settings: Vec<Setting>) -> Result<Checked, Problems> {
        let settings: Vec<Setting> = self.settings.iter().cloned().chain(settings).collect();
        from_str_using(&self.text, &self.folder, &self.name, &settings, &ttb_trains::axles_of)
    }
}

fn of_variant(variant: &Variant) -> Vec<Setting> {
    variant.set.iter().map(|(key, value)| Setting { key: key.clone(), value: value.clone() }).collect()
}
