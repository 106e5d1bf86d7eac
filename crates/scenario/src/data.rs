//! The data files that come with the program, as texts, and their names.

/// Name and text of the files in one folder of `data/`.
macro_rules! files {
    ($folder:literal: $($name:literal),*) => {
        &[$(($name, include_str!(concat!("../data/", $folder, "/", $name, ".json")))),*]
    };
}

/// Names and texts of the files in a folder.
pub(crate) type Files = &'static [(&'static str, &'static str)];
pub(crate) const CARS: Files =
    files!("cars": "ice3-motor", "ice3-trailer", "velaro-e", "manchester", "shinkansen-s300", "emu-a", "emu-b");
pub(crate) const TRAINS: Files = files!("trains": "ice3");
pub(crate) const TRACKS: Files = files!("tracks": "slab", "ballast-zhai", "ballast-two-layer");
pub(crate) const SPECTRA: Files = files!("spectra": "german-low", "german-high", "sncf-good", "sncf-poor", "china-ballastless", "fra-4", "fra-5", "fra-6");
pub(crate) const FRAMES: Files = files!("bridges": "cable-stayed-224");

pub(crate) const RAIL_SECTIONS: Files = files!("rails": "60e1", "chn60");
pub(crate) const FASTENERS: Files = files!("rails": "fasteners");
pub(crate) const WHEEL_PROFILES: Files = files!("profiles/wheels": "s1002", "cone-20", "cone-40");
pub(crate) const RAIL_PROFILES: Files = files!("profiles/rails": "60e1");

pub(crate) const PLAUSIBLE: Files = files!("plausible": "ranges", "frequencies", "results");

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

/// Names of spectra that have components beside the level.
pub fn space_spectrum_names() -> impl Iterator<Item = &'static str> {
    SPECTRA.iter().filter(|(_, text)| text.contains("\"lateral\"")).map(|(name, _)| *name)
}

/// Names of rail sections.
pub fn rail_section_names() -> impl Iterator<Item = &'static str> {
    RAIL_SECTIONS.iter().map(|(name, _)| *name)
}

/// Names of wheel profiles.
pub fn wheel_profile_names() -> impl Iterator<Item = &'static str> {
    WHEEL_PROFILES.iter().map(|(name, _)| *name)
}

/// Names of profiles of rail heads.
pub fn rail_profile_names() -> impl Iterator<Item = &'static str> {
    RAIL_PROFILES.iter().map(|(name, _)| *name)
}

/// Names of frames.
pub fn frame_names() -> impl Iterator<Item = &'static str> {
    FRAMES.iter().map(|(name, _)| *name)
}
