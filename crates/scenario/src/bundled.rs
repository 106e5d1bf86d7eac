//! Trains, tracks, spectra and bridges that come with the program: data files, each with its source.

use serde::Deserialize;
use serde::de::DeserializeOwned;

use crate::data::{
    CARS, FASTENERS, FRAMES, Files, RAIL_PROFILES, RAIL_SECTIONS, SPECTRA, TRACKS, TRAINS, WHEEL_PROFILES,
};
pub use crate::data::{
    frame_names, rail_profile_names, rail_section_names, space_spectrum_names, spectrum_names, track_names,
    train_names, wheel_profile_names,
};
use crate::spec::Density;
use crate::types::{Car, Frame, ProfilePiece, ProfileShape, RailSection, Spring, TrackType};

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
    /// Sections of rails.
    Rails,
    /// Profiles of wheels.
    WheelProfiles,
    /// Profiles of rail heads.
    RailProfiles,
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
        Kind::Rails => RAIL_SECTIONS,
        Kind::WheelProfiles => WHEEL_PROFILES,
        Kind::RailProfiles => RAIL_PROFILES,
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
    lateral: Option<Lateral>,
}

/// What a spectrum has beside the level, m²/(rad/m).
#[derive(Clone, Debug, Deserialize)]
pub struct Lateral {
    /// (a_L + a_R)/2.
    pub alignment: Density,
    /// r_R − r_L.
    pub cross_level: Density,
    /// a_R − a_L.
    pub gauge: Density,
}

/// A bundled profile.
#[derive(Deserialize)]
struct Pieces {
    pieces_mm: Vec<ProfilePiece>,
}

/// Lateral and rolling fastener of a rail, by whether it stands on sleepers.
#[derive(Clone, Debug, Deserialize)]
pub(crate) struct Fasteners {
    pub single_layer: Fastener,
    pub sleepers: Fastener,
}

/// Spring and dashpot laterally and about the rail's axis.
#[derive(Clone, Copy, Debug, Deserialize)]
pub(crate) struct Fastener {
    pub lateral: Spring,
    pub rolling: Spring,
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

/// What the spectrum of this name has beside the level, if it has.
#[must_use]
pub fn lateral(name: &str) -> Option<Lateral> {
    find::<Spectrum>(SPECTRA, name)?.lateral
}

/// The rail section of this name.
#[must_use]
pub fn rail_section(name: &str) -> Option<RailSection> {
    find(RAIL_SECTIONS, name)
}

/// Fasteners where a scenario does not say.
pub(crate) fn fasteners() -> Option<Fasteners> {
    find(FASTENERS, "fasteners")
}

/// The wheel profile of this name.
#[must_use]
pub fn wheel_profile(name: &str) -> Option<ProfileShape> {
    find::<Pieces>(WHEEL_PROFILES, name).map(|file| ProfileShape::PiecesMm(file.pieces_mm))
}

/// The profile of a rail's head of this name.
#[must_use]
pub fn rail_profile(name: &str) -> Option<ProfileShape> {
    find::<Pieces>(RAIL_PROFILES, name).map(|file| ProfileShape::PiecesMm(file.pieces_mm))
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
        assert!(rail_section_names().all(|name| rail_section(name).is_some()));
        assert!(wheel_profile_names().all(|name| wheel_profile(name).is_some()));
        assert!(rail_profile_names().all(|name| rail_profile(name).is_some()));
        assert!(fasteners().is_some());
        let space = [RAIL_SECTIONS, FASTENERS, WHEEL_PROFILES, RAIL_PROFILES].concat();
        for (name, text) in [[CARS, TRAINS, TRACKS, SPECTRA, FRAMES, PLAUSIBLE].concat(), space].concat() {
            let value: serde_json::Value = serde_json::from_str(text).expect(name);
            assert!(value["source"].as_str().is_some_and(|source| source.len() > 20), "{name}");
        }
    }
}
