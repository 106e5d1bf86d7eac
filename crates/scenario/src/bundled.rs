//! Trains, tracks, spectra and bridges that come with the program: data files, each with its source.

use serde::Deserialize;
use serde::de::DeserializeOwned;

use crate::data::{CARS, FRAMES, Files, SPECTRA, TRACKS, TRAINS};
pub use crate::data::{frame_names, spectrum_names, track_names, train_names};
use crate::spec::Density;
use crate::types::{Car, Frame, TrackType};

/// The scenario that runs when none is named.
#[must_use]
pub fn default_scenario_text() -> &'static str {
    include_str!("../../../examples/default.json")
}

/// Kinds of data files.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Vehicles.
    Cars,
    /// Trains of vehicles.
    Trains,
    /// Kinds of track.
    Tracks,
    /// Spectra of irregularity.
    Spectra,
    /// Frames.
    Bridges,
}

/// Names and texts (JSON, each with a field `source`) of the data files of a kind.
#[must_use]
pub fn files(kind: Kind) -> &'static [(&'static str, &'static str)] {
    match kind {
        Kind::Cars => CARS,
        Kind::Trains => TRAINS,
        Kind::Tracks => TRACKS,
        Kind::Spectra => SPECTRA,
        Kind::Bridges => FRAMES,
    }
}

/// A bundled train: names of its cars from the front.
#[derive(Deserialize)]
struct Consist {
    cars: Vec<String>,
}

/// A bundled spectrum.
#[derive(Deserialize)]
struct Spectrum {
    density: Density,
}

/// The car of this name, or all cars of the train of this name.
#[must_use]
pub fn cars(name: &str) -> Option<Vec<Car>> {
    let car = |name: &str| find::<Car>(CARS, name);
    match find::<Consist>(TRAINS, name) {
        Some(consist) => consist.cars.iter().map(|name| car(name)).collect(),
        None => car(name).map(|car| vec![car]),
    }
}

/// The track type of this name.
#[must_use]
pub fn track(name: &str) -> Option<TrackType> {
    find(TRACKS, name)
}

/// The spectrum of this name.
#[must_use]
pub fn spectrum(name: &str) -> Option<Density> {
    find::<Spectrum>(SPECTRA, name).map(|spectrum| spectrum.density)
}

/// The frame of this name.
#[must_use]
pub fn frame(name: &str) -> Option<Frame> {
    find(FRAMES, name)
}

fn find<T: DeserializeOwned>(files: Files, name: &str) -> Option<T> {
    let (_, text) = files.iter().find(|(known, _)| *known == name)?;
    Some(serde_json::from_str(text).expect("the tests below read every bundled file"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::PLAUSIBLE;

    #[test]
    fn every_bundled_file_is_readable_and_names_its_source() {
        for name in train_names() {
            assert!(cars(name).is_some_and(|cars| !cars.is_empty()), "{name}");
        }
        assert!(track_names().all(|name| track(name).is_some()));
        assert!(spectrum_names().all(|name| spectrum(name).is_some()));
        assert!(frame_names().all(|name| frame(name).is_some()));
        for (name, text) in [CARS, TRAINS, TRACKS, SPECTRA, FRAMES, PLAUSIBLE].concat() {
            let value: serde_json::Value = serde_json::from_str(text).expect(name);
            assert!(value["source"].as_str().is_some_and(|source| source.len() > 20), "{name}");
        }
    }
}
