//! Extremes of every column, with their time; loss of contact of every wheel.

use std::collections::HashMap;
use std::ops::ControlFlow;

use schemars::JsonSchema;
use serde::{Serialize, Serializer};

use crate::axis::shortest;
use crate::column::{Column, Kind, Of};
use crate::error::RunError;
use crate::observe::{Begin, GO_ON, Moment, Observer};
use crate::quantity::Quantity;

/// A value and when, and for wheels where, it occurred.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Extreme {
    /// Value in the column's unit.
    pub value: f64,
    /// s; written as the shortest form of a multiple of the step.
    #[serde(serialize_with = "written")]
    pub time: f64,
    /// Abscissa of the wheel, m.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub x: Option<f64>,
}

fn written<S: Serializer>(time: &f64, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_f64(shortest(*time))
}

/// Both extremes of a column.
#[derive(Clone, Debug, PartialEq)]
pub struct Peak {
    /// Whose.
    pub column: Column,
    /// Least value.
    pub min: Extreme,
    /// Greatest value.
    pub max: Extreme,
    /// When the column was NaN or infinite for the first time, s; the extremes are those of its finite values.
    pub not_finite_from: Option<f64>,
}

impl Peak {
    /// The greatest amount.
    pub fn amount(&self) -> f64 {
        self.min.value.abs().max(self.max.value.abs())
    }
}

/// Contact of one wheelset.
#[derive(Clone, Debug, Default, PartialEq, Serialize, JsonSchema)]
pub struct ContactLoss {
    /// Wheel, from 1 at the front.
    pub wheel: usize,
    /// Number of intervals without contact.
    pub intervals: usize,
    /// Their whole duration, s.
    pub seconds: f64,
    /// The longest, s.
    pub longest: f64,
}

/// Collects extremes over a run, or between two times of it; losses of contact and values that are not finite over the whole
/// run.
#[derive(Default)]
pub struct Peaks {
    /// Between which times extremes count, s; `None`: always.
    between: Option<[f64; 2]>,
    peaks: Vec<Peak>,
    /// Column of the position that belongs to a column, for wheels.
    positions: Vec<Option<usize>>,
    wheels: Vec<Contact>,
}

/// A wheelset's contact force, and how long it has been without contact; `None`: it has contact.
struct Contact {
    column: usize,
    loss: ContactLoss,
    lost_for: Option<f64>,
}

/// Times within this of an end of the interval, relative to its size, are in it.
const ROUNDING: f64 = 1e-9;

impl Peaks {
    /// Of what happens between two times, s, both included.
    pub fn between(times: Option<[f64; 2]>) -> Self {
        Self { between: times, ..Self::default() }
    }

    fn counts(&self, time: f64) -> bool {
        let within = |[from, to]: [f64; 2]| {
            let slack = ROUNDING * to.abs().max(1.0);
            (from - slack..=to + slack).contains(&time)
        };
        self.between.is_none_or(within)
    }

    /// All extremes in column order.
    pub fn all(&self) -> &[Peak] {
        &self.peaks
    }

    /// Wheels that lost contact.
    pub fn contact_losses(&self) -> Vec<ContactLoss> {
        self.wheels.iter().map(|wheel| wheel.loss.clone()).filter(|loss| loss.intervals > 0).collect()
    }
}

impl Contact {
    /// Over a step of `h` seconds that ended with this force.
    fn update(&mut self, force: f64, h: f64) {
        if force > 0.0 {
            self.lost_for = None;
            return;
        }
        if self.lost_for.is_none() {
            self.loss.intervals += 1;
        }
        let lost_for = self.lost_for.unwrap_or(0.0) + h;
        self.lost_for = Some(lost_for);
        self.loss.seconds += h;
        self.loss.longest = self.loss.longest.max(lost_for);
    }
}

impl Observer for Peaks {
    fn start(&mut self, begin: &Begin) -> Result<(), RunError> {
        let none = Extreme { value: f64::NAN, time: 0.0, x: None };
        let places: HashMap<(&Of, Option<&str>), usize> = begin
            .columns
            .iter()
            .enumerate()
            .filter(|(_, column)| column.is(Kind::Wheel, &Quantity::Position))
            .map(|(i, column)| ((&column.of, column.instance.as_deref()), i))
            .collect();
        for (i, column) in begin.columns.iter().enumerate() {
            self.positions.push(places.get(&(&column.of, column.instance.as_deref())).copied());
            if let (Of::Wheel(wheel), Quantity::ContactForce) = (&column.of, &column.quantity) {
                let loss = ContactLoss { wheel: *wheel, ..ContactLoss::default() };
                self.wheels.push(Contact { column: i, loss, lost_for: None });
            }
            self.peaks.push(Peak { column: column.clone(), min: none, max: none, not_finite_from: None });
        }
        Ok(())
    }

    fn step(&mut self, moment: &Moment) -> Result<ControlFlow<()>, RunError> {
        let (row, time, counts) = (moment.row, moment.t, self.counts(moment.t));
        for ((peak, position), value) in self.peaks.iter_mut().zip(&self.positions).zip(row) {
            if !value.is_finite() {
                peak.not_finite_from.get_or_insert(time);
                continue;
            }
            if !counts {
                continue;
            }
            let here = || Extreme { value: *value, time, x: position.map(|p| row[p]) };
            if peak.min.value.is_nan() || *value < peak.min.value {
                peak.min = here();
            }
            if peak.max.value.is_nan() || *value > peak.max.value {
                peak.max = here();
            }
        }
        self.wheels.iter_mut().for_each(|wheel| wheel.update(row[wheel.column], moment.h));
        GO_ON
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::axis::TimeAxis;
    use crate::observe::Timing;

    fn observe(names: &[&str], rows: &[&[f64]]) -> Peaks {
        observe_between(None, names, rows)
    }

    fn observe_between(times: Option<[f64; 2]>, names: &[&str], rows: &[&[f64]]) -> Peaks {
        let columns: Vec<Column> = names.iter().map(|name| Column::parse(name, "N")).collect();
        let (mut peaks, axis) = (Peaks::between(times), TimeAxis::new(0.5, 0.5 * (rows.len() - 1) as f64));
        peaks.start(&Begin { columns: &columns, axis: &axis }).expect("columns");
        for (n, row) in rows.iter().enumerate() {
            let (t, h) = (0.5 * n as f64, if n == 0 { 0.0 } else { 0.5 });
            let moment = Moment { n: n as u64, t, h, row, info: None, timing: Timing::default() };
            assert!(peaks.step(&moment).expect("a row").is_continue());
        }
        peaks
    }

    #[test]
    fn a_wheel_without_contact_at_the_start_has_lost_it_once() {
        let force = ["wheel[2].contact_force"];
        let loss = |rows: &[&[f64]]| observe(&force, rows).contact_losses();
        let once = |seconds, longest| vec![ContactLoss { wheel: 2, intervals: 1, seconds, longest }];
        assert_eq!(loss(&[&[0.0], &[0.0], &[1.0], &[2.0]]), once(0.5, 0.5));
        assert_eq!(loss(&[&[1.0], &[0.0], &[0.0], &[2.0]]), once(1.0, 1.0));
        let twice = loss(&[&[0.0], &[1.0], &[0.0], &[0.0]]);
        assert_eq!((twice[0].intervals, twice[0].seconds, twice[0].longest), (2, 1.0, 1.0));
        assert!(loss(&[&[1.0], &[1.0]]).is_empty());
    }

    #[test]
    fn extremes_count_between_two_times_and_contact_always() {
        let names = ["wheel[1].contact_force", "point[mid].acceleration"];
        let rows: [&[f64]; 5] = [&[0.0, 9.0], &[3.0, 1.0], &[5.0, 2.0], &[4.0, -1.0], &[8.0, f64::NAN]];
        let peaks = observe_between(Some([0.5, 1.5]), &names, &rows);
        let [force, point] = peaks.all() else { panic!("two columns") };
        assert_eq!([force.min.value, force.max.value, point.min.value, point.max.value], [3.0, 5.0, -1.0, 2.0]);
        assert_eq!([force.min.time, force.max.time, point.min.time, point.max.time], [0.5, 1.0, 1.5, 1.0]);
        assert_eq!((peaks.contact_losses().len(), point.not_finite_from), (1, Some(2.0)));
    }

    #[test]
    fn extremes_have_time_and_place_and_a_nan_is_told() {
        let names = ["wheel[1].contact_force", "wheel[1].position", "point[mid].acceleration"];
        let peaks = observe(&names, &[&[5.0, 30.0, 0.1], &[9.0, 31.0, f64::NAN], &[7.0, 32.0, -0.3]]);
        let [force, _, point] = peaks.all() else { panic!("three columns") };
        assert_eq!((force.max, force.min.time), (Extreme { value: 9.0, time: 0.5, x: Some(31.0) }, 0.0));
        assert_eq!((point.min.value, point.max.value, point.not_finite_from), (-0.3, 0.1, Some(0.5)));
    }
}
