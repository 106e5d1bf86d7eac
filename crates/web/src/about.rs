//! What comes with the program, for the choices of a form.

use serde::Serialize;
use serde_json::Value;
use ttb_assessment::criterion::{DEFAULT, names, text};
use ttb_scenario::bundled::{Kind, files};
use ttb_trains::names::TRAINS;

use crate::session::VERSION;

/// Names, titles and ranges.
#[derive(Serialize)]
pub struct About {
    version: &'static str,
    /// Trains of axle loads.
    trains: Vec<Train>,
    /// Vehicles, trains of vehicles, tracks, spectra, bridges: name and source.
    cars: Vec<Named>,
    consists: Vec<Named>,
    tracks: Vec<Named>,
    spectra: Vec<Named>,
    bridges: Vec<Named>,
    /// Limits files: name and title, and those that judge unless others are named.
    limits: Vec<Named>,
    default_limits: &'static [&'static str],
    /// Usual and possible ranges.
    ranges: Value,
    /// Usual first frequencies over the length of a span.
    frequencies: Value,
    /// The scenario that runs when none is named.
    default_scenario: &'static str,
}

#[derive(Serialize)]
struct Train {
    name: String,
    title: String,
    max_speed_km_h: Option<f64>,
    axles: usize,
}

#[derive(Serialize)]
struct Named {
    name: &'static str,
    title: String,
}

impl About {
    /// All of it.
    pub fn new() -> Self {
        let trains = TRAINS.iter().map(|train| Train {
            name: train.name.clone(),
            title: train.title.clone(),
            max_speed_km_h: train.max_speed.map(|v| (36.0 * v).round() / 10.0),
            axles: train.axles.len(),
        });
        Self {
            version: VERSION,
            trains: trains.collect(),
            cars: named(files(Kind::Cars)),
            consists: named(files(Kind::Trains)),
            tracks: named(files(Kind::Tracks)),
            spectra: named(files(Kind::Spectra)),
            bridges: named(files(Kind::Bridges)),
            limits: names().map(|name| Named { name, title: title(text(name).unwrap_or("{}")) }).collect(),
            default_limits: DEFAULT,
            ranges: serde_json::from_str(ttb_scenario::usual()).unwrap_or_default(),
            frequencies: serde_json::from_str(ttb_scenario::usual_frequencies()).unwrap_or_default(),
            default_scenario: ttb_scenario::default_scenario_text(),
        }
    }
}

impl Default for About {
    fn default() -> Self {
        Self::new()
    }
}

fn named(files: &'static [(&'static str, &'static str)]) -> Vec<Named> {
    files.iter().map(|(name, text)| Named { name, title: title(text) }).collect()
}

/// Title or source of a data file.
fn title(text: &str) -> String {
    let value: Value = serde_json::from_str(text).unwrap_or_default();
    let of = |key: &str| value[key].as_str().map(str::to_string);
    of("title").or_else(|| of("source")).unwrap_or_default()
}
