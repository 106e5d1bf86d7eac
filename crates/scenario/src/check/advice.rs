//! Warnings: settings that are allowed, but known to spoil results (limits measured for this program).

use super::passage;
use super::places::{Passage, Rail};
use crate::pieces::Pieces;
use crate::problem::{Report, Warning};
use crate::resolve::Resolved;
use crate::spec::Profile;
use crate::travel::DEFAULT_RAMP;

/// Closer to its end than this, m, a rail bends like a free end.
const MARGIN: f64 = 12.0;
/// Longer steps, s, are off by several percent in deck acceleration.
const LONG_STEP: f64 = 2e-3;
/// A wave needs this many rail elements.
const ELEMENTS_PER_WAVE: f64 = 4.0;

/// Where everything is, as far as it is known.
pub(super) struct Places<'a> {
    pub rail: Option<&'a Rail>,
    pub passage: Option<&'a Passage>,
    /// Begin and end of the bridge, m.
    pub bridge: Option<[f64; 2]>,
}

pub(super) fn give(pieces: &Pieces, resolved: &Resolved, places: &Places, report: &mut Report) {
    let Places { rail, passage, bridge } = *places;
    if let Some(step) = pieces.time.and_then(|time| time.step.given()).filter(|step| *step > LONG_STEP) {
        let slip = if LONG_STEP >= 1e-3 * step && step >= 0.01 { ": given in ms?" } else { "" };
        let text = format!("step {step} s: more than {LONG_STEP} s costs accuracy in accelerations{slip}");
        report.note(Warning::at("$.time.step", text));
    }
    if let (Some(rail), Some(passage)) = (rail, passage) {
        margin(passage.rear - rail.from, "begins", "behind the last wheel at the start", report);
        margin(rail.to - passage.end, "ends", "ahead of the leading wheel at the end of the run", report);
    }
    if let (Some(passage), Some(bridge)) = (passage, bridge) {
        let constant = resolved.speed.as_ref().and_then(|speed| speed.first().filter(|_| speed.len() == 1));
        passage::give(passage, bridge, constant.map(|[_, v]| *v), report);
    }
    if let (Some(rail), Some(profile)) = (rail, &resolved.profile) {
        waves(rail, profile, report);
    }
    if let (Some(passage), Some(bridge), Some(profile)) = (passage, bridge, &resolved.profile) {
        fade_in(profile, passage, bridge, report);
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

/// An irregularity that is still growing under the wheels on the bridge is neither smooth nor its full size.
fn fade_in(profile: &Profile, passage: &Passage, [begin, end]: [f64; 2], report: &mut Report) {
    let (ramp, default) = match profile {
        Profile::None => return,
        Profile::Waves { ramp, .. } | Profile::Samples { ramp, .. } => (ramp, None),
        Profile::Spectrum { ramp, .. } => (ramp, Some([passage.fade_in(), DEFAULT_RAMP])),
    };
    let Some([start, length]) = ramp.as_ref().map(|ramp| [ramp.start, ramp.length]).or(default) else { return };
    if start < end && start + length > begin {
        report.warn(format!(
            "the irregularity grows to its size from {start:.1} to {:.1} m, on the bridge from {begin} to {end} m: begin it at \
             {:.1} m or before",
            start + length,
            begin - length
        ));
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
