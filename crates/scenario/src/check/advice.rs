//! Warnings: settings that are allowed, but known to spoil results (limits measured for this program).

use super::places::{Passage, Rail};
use crate::pieces::Pieces;
use crate::problem::Report;
use crate::resolve::Resolved;
use crate::spec::Profile;

/// Closer to its end than this, m, a rail bends like a free end.
const MARGIN: f64 = 12.0;
/// Longer steps, s, are off by several percent in deck acceleration.
const LONG_STEP: f64 = 2e-3;
/// A wave needs this many rail elements.
const ELEMENTS_PER_WAVE: f64 = 4.0;

pub(super) fn give(
    pieces: &Pieces,
    resolved: &Resolved,
    rail: Option<&Rail>,
    passage: Option<&Passage>,
    report: &mut Report,
) {
    if let Some(step) = pieces.time.and_then(|time| time.step.given()).filter(|step| *step > LONG_STEP) {
        report.warn(format!("step {step} s: more than {LONG_STEP} s costs accuracy in accelerations"));
    }
    if let (Some(rail), Some(passage)) = (rail, passage) {
        margin(passage.rear - rail.from, "begins", "behind the last wheel at the start", report);
        margin(rail.to - passage.end, "ends", "ahead of the leading wheel at the end of the run", report);
    }
    if let (Some(rail), Some(profile)) = (rail, &resolved.profile) {
        waves(rail, profile, report);
    }
    if let (Some(passage), Some(Profile::Samples { x, .. })) = (passage, &resolved.profile) {
        let (from, to) = (passage.rear - passage.pre_roll, passage.end);
        if let (Some(first), Some(last)) = (x.first(), x.last())
            && (from < *first || to > *last)
        {
            report.warn(format!(
                "the measured profile covers {first} to {last} m, the wheels {from:.1} to {to:.1} m: constant outside"
            ));
        }
    }
}

fn margin(margin: f64, verb: &str, place: &str, report: &mut Report) {
    if (0.0..MARGIN).contains(&margin) {
        report.warn(format!("the rail {verb} {margin:.1} m {place}: its free end is felt within {MARGIN} m"));
    }
}

fn waves(rail: &Rail, profile: &Profile, report: &mut Report) {
    let shortest = match profile {
        Profile::None | Profile::Samples { .. } => return,
        Profile::Waves { waves, .. } => waves.iter().map(|wave| wave.wavelength).fold(f64::INFINITY, f64::min),
        Profile::Spectrum { wavelengths, .. } => wavelengths[0],
    };
    if shortest < ELEMENTS_PER_WAVE * rail.element {
        let element = rail.element;
        report.warn(format!(
            "irregularity of wavelength {shortest} m: shorter than {ELEMENTS_PER_WAVE} rail elements of {element} m"
        ));
    }
}
