//! The trains that come with the program.

use std::sync::LazyLock;

use ttb_scenario::bundled;

use crate::files;
use crate::train::ForceTrain;

/// Files of force trains.
const FILES: [&str; 4] = [
    include_str!("../data/hslm-a.json"),
    include_str!("../data/high-speed.json"),
    include_str!("../data/en15528.json"),
    include_str!("../data/annex-d.json"),
];

/// All of them by name, in the order of a list; vehicle trains last.
pub static TRAINS: LazyLock<Vec<ForceTrain>> = LazyLock::new(|| {
    let forces = FILES.iter().flat_map(|text| files::bundled(text));
    let vehicles = bundled::train_names().filter_map(|name| {
        let cars = bundled::cars(name)?;
        let title =
            if cars.len() == 1 { cars[0].name.clone() } else { format!("{} vehicles, static axle loads", cars.len()) };
        Some(ForceTrain::of_cars(name, &title, &cars))
    });
    forces.chain(vehicles).collect()
});

/// Names that stand for several trains: a name and what those begin with.
pub const FAMILIES: [(&str, &str); 3] = [("hslm-a", "hslm-a"), ("annex-d", "annex-d-"), ("en15528", "en15528-")];
