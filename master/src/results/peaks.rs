//! Extremes of every recorded variable, with their time; loss of contact of every wheel.

use std::collections::HashMap;

use serde::Serialize;

use super::choice::Choice;
use super::names::kind;
use super::record::{Column, Recorder};

/// A value and when, and for wheels where, it occurred.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Extreme {
    /// Value in the variable's unit.
    pub value: f64,
    /// s.
    pub time: f64,
    /// Abscissa of the wheel, m.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub x: Option<f64>,
}

/// Both extremes of a variable.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Peak {
    /// FMI name.
    pub name: String,
    /// Unit.
    pub unit: String,
    /// Least value.
    pub min: Extreme,
    /// Greatest value.
    pub max: Extreme,
    /// How far both may be off for the steps' sake, in the variable's unit; known where the steps were chosen.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub estimated_error: Option<f64>,
}

/// Contact of one wheelset.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
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

/// Collects extremes over a run.
pub struct Peaks {
    peaks: Vec<Peak>,
    /// Column of the position that belongs to a column, for wheels.
    positions: Vec<Option<usize>>,
    wheels: Vec<(usize, ContactLoss, f64)>,
}

impl Peaks {
    /// For the columns of a recorder.
    pub fn new(recorder: &Recorder) -> Self {
        let none = Extreme { value: f64::NAN, time: 0.0, x: None };
        let peak = |c: &Column| Peak {
            name: c.name.clone(),
            unit: c.unit.clone(),
            min: none,
            max: none,
            estimated_error: None,
        };
        let position = |c: &Column| {
            let wheel = c.name.split_once("].").filter(|(head, _)| head.starts_with("wheel["))?.0;
            recorder.find(&format!("{wheel}].position"))
        };
        let contact = |(i, c): (usize, &Column)| {
            let wheel = c.name.strip_prefix("wheel[")?.strip_suffix("].contact_force")?.parse().ok()?;
            Some((i, ContactLoss { wheel, ..ContactLoss::default() }, 0.0))
        };
        Self {
            peaks: recorder.columns.iter().map(peak).collect(),
            positions: recorder.columns.iter().map(position).collect(),
            wheels: recorder.columns.iter().enumerate().filter_map(contact).collect(),
        }
    }

    /// Takes in the row of a step of `h` seconds that ended at `time`.
    pub fn update(&mut self, row: &[f64], time: f64, h: f64) {
        for ((peak, position), value) in self.peaks.iter_mut().zip(&self.positions).zip(row) {
            let here = || Extreme { value: *value, time, x: position.map(|p| row[p]) };
            if peak.min.value.is_nan() || *value < peak.min.value {
                peak.min = here();
            }
            if peak.max.value.is_nan() || *value > peak.max.value {
                peak.max = here();
            }
        }
        for (column, loss, running) in &mut self.wheels {
            if row[*column] > 0.0 {
                *running = 0.0;
                continue;
            }
            loss.intervals += usize::from(*running == 0.0);
            *running += h;
            loss.seconds += h;
            loss.longest = loss.longest.max(*running);
        }
    }

    /// Tells every peak's error by that of its kind, relative to the largest of the kind.
    pub fn estimate(&mut self, choice: &Choice) {
        let largest = |peak: &Peak| peak.min.value.abs().max(peak.max.value.abs());
        let mut of_kind: HashMap<String, f64> = HashMap::new();
        for peak in &self.peaks {
            let most = of_kind.entry(kind(&peak.name)).or_default();
            *most = most.max(largest(peak));
        }
        for peak in &mut self.peaks {
            peak.estimated_error = choice.error(&peak.name).map(|error| error * of_kind[&kind(&peak.name)]);
        }
    }

    /// All extremes in column order.
    pub fn all(&self) -> &[Peak] {
        &self.peaks
    }

    /// Wheels that lost contact.
    pub fn contact_losses(&self) -> Vec<ContactLoss> {
        self.wheels.iter().map(|(_, loss, _)| loss.clone()).filter(|loss| loss.intervals > 0).collect()
    }
}
