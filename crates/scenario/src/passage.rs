//! When wheels are on the bridge, and between which times peaks count.

use crate::deck::Deck;
use crate::problem::Report;
use crate::spec::{BridgeSpec, TrainTrackSpec};
use crate::travel::{distance, time_of};
use crate::types::{PeaksFrom, PeaksWord, Scenario};

/// When the first wheel comes onto the bridge and the last one leaves it, s; a time that is not reached is infinite.
#[must_use]
pub fn on_bridge(train: &TrainTrackSpec, at: f64, length: f64) -> [f64; 2] {
    let last = train.offsets().last().copied().unwrap_or(0.0);
    [at, at + length + last].map(|x| time_of(&train.speed, x - train.front_wheel).unwrap_or(f64::INFINITY))
}

/// Between which times peaks count, s. Where no wheel comes onto the bridge it is the whole run, and a warning says so.
pub(crate) fn peaks(scenario: &Scenario, train: &TrainTrackSpec, bridge: &BridgeSpec, report: &mut Report) -> [f64; 2] {
    let length = Deck::new(&bridge.structure).map_or(0.0, |deck| deck.length);
    let free = scenario.time.free_vibration.unwrap_or(f64::INFINITY);
    match scenario.output.peaks_from {
        PeaksFrom::Word(PeaksWord::Start) => [0.0, train.end],
        PeaksFrom::Seconds(from) => [from.min(train.end), train.end],
        PeaksFrom::Word(PeaksWord::Bridge) => {
            let [first, last] = on_bridge(train, scenario.bridge.at, length);
            let before = train.front_wheel - train.offsets().last().copied().unwrap_or(0.0);
            let passed = before > scenario.bridge.at + length;
            if first <= train.end && !passed {
                return [first, (last + free).min(train.end)];
            }
            let run = distance(&train.speed, train.end);
            report.warn(format!(
                "no wheel is on the bridge during the run, which takes the leading one from {} to {:.3} m: peaks count from \
                 the start",
                train.front_wheel,
                train.front_wheel + run
            ));
            [0.0, train.end]
        }
    }
}
