//! A plan, and records that cost nothing.

use ttb_assessment::peak::{Peak, PlaceKind, Statistic, quantity};
use ttb_campaign::plan::{FORMAT, Load, Rail, Train, Variant};
use ttb_campaign::{Envelope, Plan, Record, Way};
use ttb_scenario::types::Heading;

/// A plan of `trains` trains at `speeds` speeds.
pub fn plan(trains: usize, speeds: usize) -> Plan {
    let train = |i| Train {
        name: format!("train, {i}"),
        max_speed_km_h: None,
        load: Load::Axles(vec![[0.0, 1e5 + i as f64], [3.0, 1e5]]),
        heading: Heading::Forward,
    };
    Plan {
        format: FORMAT,
        version: "0".into(),
        scenario: "my.json".into(),
        scenario_sha256: "00".into(),
        set: Vec::new(),
        bridges: Vec::new(),
        way: Way::Modal,
        refine: false,
        forces: false,
        trains: (0..trains).map(train).collect(),
        variants: vec![Variant::default()],
        rails: vec![Rail::Scenario],
        speeds_km_h: (0..speeds).map(|i| 100.0 + i as f64).collect(),
        limits: Vec::new(),
        values: String::new(),
    }
}

/// A record of about the size of a real one.
pub fn record(id: &str, value: f64) -> Record {
    let x: Vec<f64> = (0..=20).map(|i| 1.25 * f64::from(i)).collect();
    let max: Vec<f64> = x.iter().map(|x| value * x / 7.0).collect();
    let envelope = |quantity: &'static str| Envelope {
        quantity: quantity.into(),
        filter: "raw".into(),
        unit: "m/s2".into(),
        min: max.iter().map(|x| -x).collect(),
        x: x.clone(),
        max: max.clone(),
    };
    let peak = Peak {
        unit: "m/s2".into(),
        x: Some(12.5),
        time: Some(value / 300.0),
        ..Peak::raw(quantity::DECK_ACCELERATION, PlaceKind::Deck, Statistic::AbsMax, value / 3.0)
    };
    Record {
        format: ttb_campaign::record::FORMAT,
        run_id: id.into(),
        error: None,
        step: Some(1e-3),
        modes: Some(3),
        seconds: value,
        peaks: vec![peak],
        envelopes: vec![envelope(quantity::DECK_ACCELERATION), envelope(quantity::DECK_DISPLACEMENT)],
        missing: Vec::new(),
        remarks: Vec::new(),
    }
}
