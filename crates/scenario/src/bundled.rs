//! Trains, tracks, spectra and bridges that come with the program: data files, each with its source.

use serde::Deserialize;
use serde::de::DeserializeOwned;

use crate::spec::Density;
use crate::types::{Car, Frame, TrackType};

/// Name and text of the files in one folder of `data/`.
macro_rules! files {
    ($folder:literal: $($name:literal),*) => {
        &[$(($name, include_str!(concat!("../data/", $folder, "/", $name, ".json")))),*]
    };
}

type Files = &'static [(&'static str, &'static str)];
const CARS: Files = files!("cars": "ice3-motor", "ice3-trailer", "velaro-e", "manchester", "shinkansen-s300");
const TRAINS: Files = files!("trains": "ice3");
const TRACKS: Files = files!("tracks": "slab", "ballast-zhai", "ballast-two-layer");
const SPECTRA: Files = files!("spectra": "german-low", "german-high", "sncf-good", "sncf-poor", "china-ballastless");
const FRAMES: Files = files!("bridges": "cable-stayed-224");

/// The scenario that runs when none is named.
#[must_use]
pub fn default_scenario_text() -> &'static str {
    include_str!("../../../examples/default.json")
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

/// Names that may stand in a train's list of cars: cars and whole trains.
pub fn train_names() -> impl Iterator<Item = &'static str> {
    CARS.iter().chain(TRAINS).map(|(name, _)| *name)
}

/// Names of track types.
pub fn track_names() -> impl Iterator<Item = &'static str> {
    TRACKS.iter().map(|(name, _)| *name)
}

/// Names of spectra.
pub fn spectrum_names() -> impl Iterator<Item = &'static str> {
    SPECTRA.iter().map(|(name, _)| *name)
}

/// Names of frames.
pub fn frame_names() -> impl Iterator<Item = &'static str> {
    FRAMES.iter().map(|(name, _)| *name)
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

    #[test]
    fn every_bundled_file_is_readable_and_names_its_source() {
        for name in train_names() {
            assert!(cars(name).is_some_and(|cars| !cars.is_empty()), "{name}");
        }
        assert!(track_names().all(|name| track(name).is_some()));
        assert!(spectrum_names().all(|name| spectrum(name).is_some()));
        assert!(frame_names().all(|name| frame(name).is_some()));
        for (name, text) in [CARS, TRAINS, TRACKS, SPECTRA, FRAMES].concat() {
            let value: serde_json::Value = serde_json::from_str(text).expect(name);
            assert!(value["source"].as_str().is_some_and(|source| source.len() > 20), "{name}");
        }
    }
}
