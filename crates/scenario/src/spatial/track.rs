//! Rails, fasteners and sleepers: what is left out follows from the plane track.

use crate::bundled;
use crate::problem::Report;
use crate::spec::{SpaceSleeper, SpaceTrack};
use crate::types::{RailSectionChoice, Sleeper, Support, TrackInSpace, TrackType};

/// The track and the key with every default written in.
pub(super) fn resolve(
    space: &TrackInSpace,
    plane: &TrackType,
    report: &mut Report,
) -> Option<(SpaceTrack, TrackInSpace)> {
    let section = match &space.rail {
        RailSectionChoice::Named(name) => bundled::rail_section(name),
        RailSectionChoice::Data(section) => Some(section.clone()),
    };
    let mass = match &plane.support {
        Support::SingleLayer { .. } => None,
        Support::TwoLayer { sleeper_mass, .. } | Support::ThreeLayer { sleeper_mass, .. } => Some(*sleeper_mass),
    };
    if mass.is_none() && space.sleeper.is_some() {
        let rule = "the track's type must have sleepers: a slab track has none";
        report.problem("$.space.track.sleeper", rule, "single-layer");
    }
    let known = bundled::fasteners()?;
    let fastener = if mass.is_some() { known.sleepers } else { known.single_layer };
    let (lateral, rolling) = (space.lateral.unwrap_or(fastener.lateral), space.rolling.unwrap_or(fastener.rolling));
    let sleeper = mass.map(|mass| (mass, space.sleeper.clone().unwrap_or_default()));
    let section = section?;
    let filled = TrackInSpace {
        lateral: Some(lateral),
        rolling: Some(rolling),
        sleeper: sleeper.as_ref().map(|(_, sleeper)| sleeper.clone()),
        ..space.clone()
    };
    let body = |(mass, sleeper): (f64, Sleeper)| SpaceSleeper {
        roll_inertia: mass * sleeper.length * sleeper.length / 12.0,
        half_distance: sleeper.half_distance,
        lateral: sleeper.lateral,
    };
    let track = SpaceTrack {
        lateral_bending_stiffness: section.lateral_bending_stiffness,
        torsional_stiffness: section.torsional_stiffness,
        polar_inertia: section.polar_inertia,
        head_height: section.head_height,
        foot_height: section.foot_height,
        half_distance: space.half_distance,
        gauge: space.gauge,
        inclination: space.inclination,
        lateral,
        rolling,
        sleeper: sleeper.map(body),
    };
    Some((track, filled))
}
