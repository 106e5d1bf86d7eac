//! The parts of a scenario that can be read on their own, so that a fault in one does not hide faults in the others.

use serde::de::DeserializeOwned;
use serde_json::Value;

use crate::types::{
    Bridge, CarChoice, Contact, CouplingSettings, Csv, Damping, Forces, Irregularity, Newmark, Point, Rail, RailPoint,
    Space, Speed, Structure, Time, Track, TrackChoice, Train,
};

/// Whatever can be read; `None` is what the schema's walker has complained about.
pub(crate) struct Pieces {
    pub train: Option<Train>,
    pub cars: Vec<Option<CarChoice>>,
    pub forces: Option<Forces>,
    pub speed: Option<Speed>,
    pub contact: Option<Contact>,
    pub track: Option<Track>,
    pub track_type: Option<TrackChoice>,
    pub rail: Option<Rail>,
    pub irregularity: Option<Irregularity>,
    pub bridge: Option<Bridge>,
    /// Where it begins, m.
    pub at: Option<f64>,
    pub structure: Option<Structure>,
    pub damping: Option<Damping>,
    pub points: Vec<Option<Point>>,
    pub rail_points: Vec<Option<RailPoint>>,
    pub time: Option<Time>,
    pub newmark: Option<Newmark>,
    pub coupling: Option<CouplingSettings>,
    /// Keys that are there, whatever they say.
    pub has_track_type: bool,
    pub has_step: bool,
    pub has_train: bool,
    pub has_cars: bool,
    pub has_forces: bool,
    pub has_points: bool,
    pub csv: Option<Csv>,
    /// The run in space, if the key is there and can be read.
    pub space: Option<Space>,
    pub has_space: bool,
}

impl Pieces {
    pub fn read(scenario: &Value) -> Self {
        Self {
            train: piece(&scenario["train"]),
            cars: list(&scenario["train"]["cars"]),
            forces: piece(&scenario["train"]["forces"]),
            has_train: scenario["train"].is_object(),
            has_cars: !scenario["train"]["cars"].is_null(),
            has_forces: !scenario["train"]["forces"].is_null(),
            speed: piece(&scenario["train"]["speed"]),
            contact: or_default(&scenario["contact"]),
            track: or_default(&scenario["track"]),
            track_type: or_default(&scenario["track"]["type"]),
            rail: piece(&scenario["track"]["type"]["rail"]),
            irregularity: or_default(&scenario["irregularity"]),
            bridge: piece(&scenario["bridge"]),
            at: or_default(&scenario["bridge"]["at"]),
            structure: piece(&scenario["bridge"]["structure"]),
            damping: piece(&scenario["bridge"]["damping"]),
            points: list(&scenario["bridge"]["points"]),
            rail_points: list(&scenario["track"]["points"]),
            time: or_default(&scenario["time"]),
            newmark: piece(&scenario["time"]["newmark"]),
            coupling: piece(&scenario["coupling"]),
            has_track_type: !scenario["track"]["type"].is_null(),
            has_step: !scenario["time"]["step"].is_null(),
            has_points: !scenario["bridge"]["points"].is_null(),
            csv: piece(&scenario["output"]["csv"]),
            space: piece(&scenario["space"]),
            has_space: scenario.get("space").is_some(),
        }
    }
}

fn piece<T: DeserializeOwned>(value: &Value) -> Option<T> {
    T::deserialize(value).ok()
}

/// A key that may be left out. One that stands there as null has been complained about.
fn or_default<T: DeserializeOwned + Default>(value: &Value) -> Option<T> {
    if value.is_null() { Some(T::default()) } else { piece(value) }
}

fn list<T: DeserializeOwned>(value: &Value) -> Vec<Option<T>> {
    value.as_array().into_iter().flatten().map(piece).collect()
}
