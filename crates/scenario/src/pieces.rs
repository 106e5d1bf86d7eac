//! The parts of a scenario that can be read on their own, so that a fault in one does not hide faults in the others.

use serde::de::DeserializeOwned;
use serde_json::Value;

use crate::types::{
    Bridge, CarChoice, CouplingSettings, Damping, Irregularity, Newmark, Point, Rail, RailPoint, Speed, Structure,
    Time, Track, TrackChoice, Train,
};

/// Whatever can be read; `None` is what the schema's walker has complained about.
pub(crate) struct Pieces {
    pub train: Option<Train>,
    pub cars: Vec<Option<CarChoice>>,
    pub speed: Option<Speed>,
    pub track: Option<Track>,
    pub track_type: Option<TrackChoice>,
    pub rail: Option<Rail>,
    pub irregularity: Option<Irregularity>,
    pub bridge: Option<Bridge>,
    pub structure: Option<Structure>,
    pub damping: Option<Damping>,
    pub points: Vec<Option<Point>>,
    pub rail_points: Vec<Option<RailPoint>>,
    pub time: Option<Time>,
    pub newmark: Option<Newmark>,
    pub coupling: Option<CouplingSettings>,
}

impl Pieces {
    pub fn read(scenario: &Value) -> Self {
        Self {
            train: piece(&scenario["train"]),
            cars: list(&scenario["train"]["cars"]),
            speed: piece(&scenario["train"]["speed"]),
            track: piece(&scenario["track"]),
            track_type: piece(&scenario["track"]["type"]),
            rail: piece(&scenario["track"]["type"]["rail"]),
            irregularity: match scenario.get("irregularity") {
                None => Some(Irregularity::None),
                Some(value) => piece(value),
            },
            bridge: piece(&scenario["bridge"]),
            structure: piece(&scenario["bridge"]["structure"]),
            damping: piece(&scenario["bridge"]["damping"]),
            points: list(&scenario["bridge"]["points"]),
            rail_points: list(&scenario["track"]["points"]),
            time: piece(&scenario["time"]),
            newmark: piece(&scenario["time"]["newmark"]),
            coupling: piece(&scenario["coupling"]),
        }
    }
}

fn piece<T: DeserializeOwned>(value: &Value) -> Option<T> {
    T::deserialize(value).ok()
}

fn list<T: DeserializeOwned>(value: &Value) -> Vec<Option<T>> {
    value.as_array().into_iter().flatten().map(piece).collect()
}
