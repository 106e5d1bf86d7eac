//! Tracks of two and three layers at rest against tracks of one, whose deflection is Winkler's (file `track.rs`).

mod common;

use common::{spec, started, value};
use ttb_scenario::types::{Spring, Support};

const PAD: f64 = 1.3e8;
const BALLAST: f64 = 2.755e8;
const SUB_BALLAST: f64 = 1.55e8;

fn spring(stiffness: f64) -> Spring {
    Spring { stiffness, damping: 1e5 }
}

/// Deflection of the rail under the leading wheel of a standing car, m.
fn deflection(support: Support) -> f64 {
    let mut spec = spec();
    spec.track.support = support;
    value(&mut started(spec), "wheel[1].rail_displacement")
}

fn three(shear: Option<Spring>) -> Support {
    let [pad, ballast, sub_ballast] = [PAD, BALLAST, SUB_BALLAST].map(spring);
    Support::ThreeLayer { pad, sleeper_mass: 251.0, ballast, ballast_mass: 1062.8, shear, sub_ballast }
}

fn one(stiffness: f64) -> f64 {
    deflection(Support::SingleLayer { fastener: spring(stiffness) })
}

#[test]
fn layers_without_shear_are_springs_in_series() {
    let series = |springs: &[f64]| 1.0 / springs.iter().map(|k| 1.0 / k).sum::<f64>();
    let near = |found: f64, expected: f64| {
        assert!((found / expected - 1.0).abs() < 1e-9, "{found} m, in series {expected} m");
    };
    let two = Support::TwoLayer { pad: spring(PAD), sleeper_mass: 251.0, ballast: spring(BALLAST) };
    near(deflection(two), one(series(&[PAD, BALLAST])));
    near(deflection(three(None)), one(series(&[PAD, BALLAST, SUB_BALLAST])));
}

/// Shear springs that do not yield make one rigid layer of the ballast: all 91 sub-ballasts carry the car alike, and the rail
/// lies on pads and ballast above.
#[test]
fn rigid_shear_springs_spread_the_load_over_the_whole_track() {
    let weight = 4.0 * ttb_train_track::car::Car::new(&common::trailer()).axle_load;
    let above = one(1.0 / (1.0 / PAD + 1.0 / BALLAST));
    let expected = above + weight / (91.0 * SUB_BALLAST);
    let found = deflection(three(Some(spring(1e15))));
    assert!((found / expected - 1.0).abs() < 1e-4, "{found} m, spread {expected} m");
    assert!(found < 0.9 * deflection(three(None)));
}
