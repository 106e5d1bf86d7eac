//! Where everything is: what the scenario says, and what was chosen where it says nothing.

use serde_json::Value;

use crate::types::{Point, Scenario, Space};

/// A key of the scenario that was left out, and what was chosen for it.
#[derive(Clone, Debug, PartialEq, serde::Serialize, schemars::JsonSchema)]
pub struct Chosen {
    /// Its path, such as `train.front_wheel`.
    pub key: String,
    /// What was chosen.
    pub value: Value,
    /// Unit of a number; empty if it has none.
    pub unit: &'static str,
    /// Why.
    pub why: String,
}

/// Where everything is; `None` where the scenario does not tell enough, which has been reported.
#[derive(Default)]
pub(crate) struct Placement {
    pub front_wheel: Option<f64>,
    pub pre_roll: Option<f64>,
    pub from: Option<f64>,
    pub bays: Option<usize>,
    pub end: Option<f64>,
    pub free_vibration: Option<f64>,
    pub points: Option<Vec<Point>>,
    pub space: Option<Space>,
    pub chosen: Vec<Chosen>,
}

impl Placement {
    pub fn chose(&mut self, key: &str, value: impl Into<Value>, unit: &'static str, why: impl Into<String>) {
        self.chosen.push(Chosen { key: key.into(), value: value.into(), unit, why: why.into() });
    }
}

/// Writes what was chosen into the scenario, as if it had stood there.
pub(crate) fn fill(scenario: &mut Scenario, placed: Placement) {
    scenario.train.front_wheel = placed.front_wheel;
    scenario.train.pre_roll = placed.pre_roll;
    (scenario.track.from, scenario.track.bays) = (placed.from, placed.bays);
    (scenario.time.end, scenario.time.free_vibration) = (placed.end, placed.free_vibration);
    scenario.space = placed.space;
    scenario.bridge.points = scenario.bridge.points.take().or(placed.points);
}
