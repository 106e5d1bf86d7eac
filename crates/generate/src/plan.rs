//! The cable-stayed bridge's fixed dimensions. Abscissae are counted from the begin of its main girder.

use ttb_scenario::GRAVITY;

use crate::section::{Profile, hollow, solid};
use crate::trough::Trough;

/// Spans, m: main, side, end. The paper prints 30 for the last, which does not give its 224.
pub(crate) const SPANS: [f64; 3] = [112.0, 80.0, 32.0];
/// Length of the main girder, m.
pub(crate) const LENGTH: f64 = SPANS[0] + SPANS[1] + SPANS[2];
/// Abscissa of the pier between side and end span, m.
pub(crate) const INNER_PIER: f64 = SPANS[0] + SPANS[1];
/// Abscissa of the tower, m.
pub(crate) const TOWER: f64 = SPANS[0];
/// Distance of cross-beams, m.
pub(crate) const BAY: f64 = 4.0;
/// Distance of the two cross-beams on the tower from its axis, m.
pub(crate) const SEAT: f64 = 2.0;

/// Dead load that the track brings: 67.9 kN/m, as kg/m.
pub(crate) const TRACK_LOAD: f64 = 67.9e3 / GRAVITY;

/// E of concrete C50, N/m².
pub(crate) const MODULUS: f64 = 3.45e10;
/// Poisson's ratio of concrete.
pub(crate) const POISSON: f64 = 0.2;
/// Its density: 26 kN/m³, as kg/m³.
pub(crate) const DENSITY: f64 = 26e3 / GRAVITY;

/// Overall height of the main girder in the main and side spans, m.
pub(crate) const HEIGHT: f64 = 3.7;
/// Overall height in the end span and of the girders before and after, m.
pub(crate) const LOW: f64 = 3.5;

/// Main girder, 10.8 m wide over its flanges.
pub(crate) const MAIN: Trough = Trough {
    half_width: 4.9,
    floor: 0.6,
    web: 0.65,
    flange: 1.0,
    flange_thickness: 0.4,
    cross_beam: 0.8,
    cross_beam_thickness: 0.4,
};

/// Girders before and after.
pub(crate) const APPROACH: Trough = Trough { floor: 0.5, web: 0.5, ..MAIN };

/// Of every foundation, below the floor, m.
pub(crate) const FOOT: f64 = 20.0;
/// Middle of the tower's lower crossbeam, below the floor, m.
pub(crate) const CROSSBEAM: f64 = 2.0;
/// Where the legs turn upright, above the floor, m.
pub(crate) const KINK: f64 = 22.0;
/// Top of the tower, above the floor, m.
pub(crate) const TOP: f64 = 50.0;
/// y of the legs at the lower crossbeam and below, m; at the kink and above they stand over the webs.
pub(crate) const LEG: f64 = 7.2;
/// Half the width of a pier, m.
pub(crate) const PIER: f64 = 3.0;
/// Greatest length of beams of tower and piers, m.
pub(crate) const BEAM: f64 = 4.0;

/// Cables go to multiples of 8 m from the tower, the first and last of these.
pub(crate) const CABLES: std::ops::RangeInclusive<usize> = 2..=13;
/// Distance of cables on the girder, m.
pub(crate) const CABLE_DISTANCE: f64 = 8.0;

/// Height of the `i`-th cable's anchor on the tower above the floor, m.
pub(crate) fn anchor(i: usize) -> f64 {
    KINK + 2.0 * i as f64
}

/// A leg of the tower above the lower crossbeam.
pub(crate) fn upper_leg() -> Profile {
    hollow(4.0, 2.6, 0.5)
}

/// A leg below it.
pub(crate) fn lower_leg() -> Profile {
    hollow(5.0, 2.8, 0.6)
}

/// The lower crossbeam.
pub(crate) fn lower_crossbeam() -> Profile {
    hollow(4.0, 2.4, 0.4)
}

/// The crossbeams at kink and top.
pub(crate) fn upper_crossbeam() -> Profile {
    hollow(2.4, 2.0, 0.3)
}

/// A pier's column.
pub(crate) fn column() -> Profile {
    hollow(2.0, 2.0 * PIER, 0.25)
}

/// The cap on a pier.
pub(crate) fn cap() -> Profile {
    solid(1.6, 1.0)
}
