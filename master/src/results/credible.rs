//! Results that nobody can believe. A run that has taken all its steps, but blew up on the way, is not `ok`.
//!
//! ```text
//! F > 100 P₀        a contact force or a force on the deck; P₀: the largest static axle load
//! |d| > 10 m        a displacement of rail or deck
//! |W| > 10 m Σ P₀   work that the deck received
//! ```
//!
//! With less than that a run is believed, but a bridge that has given more work than ever can have been stored in it at the
//! start is told: W < −Σ P₀ |d|. All this is about trains; of a general system of two FMUs it is a warning.

use ttb_contract::finite::larger;
use ttb_coupling::Report;
use ttb_session::observe::{Peak, Peaks};
use ttb_session::{Of, Quantity};

use super::job::{Job, Origin};
use crate::error::Error;

/// Static axle loads that no force reaches.
const LOADS: f64 = 100.0;
/// A displacement that no deck and no rail reaches, m.
const DISPLACEMENT: f64 = 10.0;

/// What was found of a run.
#[derive(Debug, Default, PartialEq)]
pub struct Doubts {
    /// Why the results cannot be believed.
    pub blown: Option<String>,
    /// What makes one doubt.
    pub warnings: Vec<String>,
}

impl Doubts {
    /// Of a run over a train and a deck, or of a general system.
    pub fn of(job: &Job, peaks: &Peaks, report: &Report) -> Self {
        let mut doubts = Self::of_train(job.case.axle_load, peaks.all(), report);
        if matches!(job.origin, Origin::System(_)) {
            doubts.warnings.extend(doubts.blown.take());
        }
        doubts
    }

    fn of_train(load: f64, peaks: &[Peak], report: &Report) -> Self {
        let mut found = Vec::new();
        let wheels = peaks.iter().filter(|peak| matches!(peak.column.quantity, Quantity::ContactForce)).count();
        for peak in peaks {
            let (amount, name) = (peak.amount(), &peak.column);
            let at = if amount == peak.max.value { peak.max.time } else { peak.min.time };
            if is_force(peak) && amount > LOADS * load {
                found.push(format!("{name} is {amount:.1e} N at t = {at} s, {:.0} static axle loads", amount / load));
            } else if is_displacement(peak) && amount > DISPLACEMENT {
                found.push(format!("{name} is {amount:.1e} m at t = {at} s"));
            }
        }
        let [force, displacement] = report.largest;
        if found.is_empty() && force > LOADS * load {
            found.push(format!("a force on the deck reaches {force:.1e} N, {:.0} static axle loads", force / load));
        }
        if found.is_empty() && displacement > DISPLACEMENT {
            found.push(format!("the deck goes {displacement:.1e} m under the track"));
        }
        let (work, weight) = (report.work.received, load * wheels.max(1) as f64);
        if work.abs() > DISPLACEMENT * weight {
            found.push(format!("the deck received {work:.1e} J, which the train does not have"));
        }
        let stored = weight * larger(displacement, 1e-3);
        let gives = wheels > 0 && found.is_empty() && work < -stored;
        let warnings = gives.then(|| {
            format!(
                "the deck has given {:.1e} J to train and track, more than the train's weight can have stored in it: its \
                 damping may be negative",
                -work
            )
        });
        Self { blown: told(&found), warnings: warnings.into_iter().collect() }
    }

    /// Whether the run may count as done.
    pub fn verdict(&self) -> Result<(), Error> {
        self.blown.clone().map_or(Ok(()), |text| Err(Error::BlownUp(text)))
    }
}

fn is_force(peak: &Peak) -> bool {
    matches!(
        (&peak.column.of, &peak.column.quantity),
        (Of::Wheel(_), Quantity::ContactForce) | (Of::Support(_), Quantity::Force | Quantity::MeanForce)
    )
}

fn is_displacement(peak: &Peak) -> bool {
    let placed = !matches!(peak.column.of, Of::Whole);
    placed && matches!(peak.column.quantity, Quantity::Displacement | Quantity::RailDisplacement)
}

/// The first of what was found, and how much more there is.
fn told(found: &[String]) -> Option<String> {
    let (first, more) = (found.first()?, found.len() - 1);
    let more = if more > 0 { format!(" (and {more} more like it)") } else { String::new() };
    Some(format!(
        "the results cannot be believed: {first}{more}. The step may be too long, a stiffness, mass or unit wrong, or a \
         foreign bridge unstable"
    ))
}

#[cfg(test)]
mod tests {
    use ttb_coupling::Work;
    use ttb_session::Column;
    use ttb_session::observe::Extreme;

    use super::*;

    fn peak(name: &str, most: f64) -> Peak {
        let at = |value| Extreme { value, time: 0.5, x: None };
        Peak { column: Column::parse(name, ""), min: at(0.0), max: at(most), not_finite_from: None }
    }

    fn doubts(peaks: &[Peak], largest: [f64; 2], received: f64) -> Doubts {
        let report = Report { largest, work: Work { received, ..Work::default() }, ..Report::default() };
        Doubts::of_train(1e5, peaks, &report)
    }

    #[test]
    fn what_no_train_does_is_blown_up_and_what_a_rough_track_does_is_not() {
        let fine = [
            peak("wheel[1].contact_force", 99e5),
            peak("point[mid].displacement", 9.9),
            peak("car[1].position", 1e4),
            peak("Deck.u", 1e9),
        ];
        assert_eq!(doubts(&fine, [99e5, 9.9], 9e5), Doubts::default());
        for (name, most) in [
            ("wheel[1].contact_force", 101e5),
            ("support[3].force", 101e5),
            ("point[mid].displacement", 10.1),
            ("wheel[2].rail_displacement", 10.1),
        ] {
            let text = doubts(&[peak(name, most)], [0.0; 2], 0.0).blown.expect(name);
            assert!(text.contains(name) && text.contains("t = 0.5 s"), "{text}");
        }
        assert!(doubts(&[], [101e5, 0.0], 0.0).blown.is_some());
        assert!(doubts(&[], [0.0, 10.1], 0.0).blown.is_some());
        assert!(doubts(&fine, [0.0; 2], 1.1e6).blown.is_some());
        assert!(doubts(&fine, [0.0; 2], -1.1e6).verdict().is_err_and(|error| error.code() == 3));
    }

    #[test]
    fn a_deck_that_gives_more_than_it_can_have_is_told() {
        let wheels = [peak("wheel[1].contact_force", 1e5), peak("wheel[2].contact_force", 1e5)];
        // 2 P₀ · 10 mm = 2 kJ
        assert_eq!(doubts(&wheels, [1e5, 1e-2], -1.9e3).warnings.len(), 0);
        let found = doubts(&wheels, [1e5, 1e-2], -2.1e3);
        assert!(found.blown.is_none() && found.warnings[0].contains("2.1e3 J"), "{found:?}");
    }
}
