//! Whether the train crosses the bridge while the run lasts: warnings where it does not.

use super::places::Passage;
use crate::problem::{Report, Warning};
use crate::ranges::shown;

/// The deck on the track, m: begin and end.
pub(super) type Extent = [f64; 2];

/// `speed`: where the time of passing is told, the constant one, m/s.
pub(super) fn give(passage: &Passage, [begin, end]: Extent, speed: Option<f64>, report: &mut Report) {
    let run = passage.end - passage.front;
    let rear = passage.rear + run;
    if passage.rear > end {
        let text = format!(
            "$.train.front_wheel: the train is already past at the start: its last wheel is at {} m, the bridge ends at {} m",
            shown(passage.rear),
            shown(end)
        );
        return report.note(Warning::at("$.train.front_wheel", text));
    }
    if passage.end < begin {
        let text = format!(
            "$.time.end: the train never reaches the bridge: its leading wheel comes to {} m, the bridge begins at {} m",
            shown(passage.end),
            shown(begin)
        );
        return report.note(Warning::at("$.time.end", text));
    }
    // One that stands on the bridge is meant to.
    if run > 0.0 && rear < end {
        let until = speed.filter(|speed| *speed > 0.0).map_or_else(String::new, |speed| {
            format!("; it leaves the bridge at t = {} s", shown((end - passage.rear) / speed))
        });
        let text = format!(
            "$.time.end: the run ends before the train has passed: its last wheel comes to {} m, the bridge ends at {} m{until}",
            shown(rear),
            shown(end)
        );
        report.note(Warning::at("$.time.end", text));
    }
}
