//! Extremes as the summary tells them.

use std::collections::HashMap;

use schemars::JsonSchema;
use serde::Serialize;
use ttb_contract::finite::larger;
use ttb_session::observe::{Extreme, Peaks};

use super::choice::Choice;

/// Both extremes of a variable.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Peak {
    /// FMI name; in summary.json it is the key.
    #[serde(skip)]
    pub name: String,
    /// Unit.
    pub unit: String,
    /// Least value.
    pub min: Extreme,
    /// Greatest value.
    pub max: Extreme,
    /// How far both may be off for the steps' sake, in the variable's unit; an estimate and no
    /// bound, known where the steps were chosen.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub estimated_error: Option<f64>,
    /// When the variable was NaN or infinite for the first time, s; the extremes are then those of its finite values.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub not_finite_from: Option<f64>,
}

/// All extremes in column order, without those of a run that ended before its peaks began to count; every peak's error follows
/// from that of its kind, relative to the largest of the kind.
pub fn told(peaks: &Peaks, choice: Option<&Choice>) -> Vec<Peak> {
    let mut of_kind: HashMap<String, f64> = HashMap::new();
    for peak in peaks.all() {
        let most = of_kind.entry(peak.column.series()).or_default();
        *most = larger(*most, peak.amount());
    }
    let error = |series: &str| Some(choice?.error(series)? * of_kind[series]);
    let tell = |peak: &ttb_session::observe::Peak| Peak {
        name: peak.column.to_string(),
        unit: peak.column.unit.clone(),
        min: peak.min,
        max: peak.max,
        estimated_error: error(&peak.column.series()),
        not_finite_from: peak.not_finite_from,
    };
    let seen = |peak: &&ttb_session::observe::Peak| !peak.min.value.is_nan() || peak.not_finite_from.is_some();
    peaks.all().iter().filter(seen).map(tell).collect()
}

/// A sentence on columns that were not finite at all times, if there are any.
pub fn not_finite(peaks: &Peaks) -> Option<String> {
    let mut bad = peaks.all().iter().filter_map(|peak| Some((&peak.column, peak.not_finite_from?)));
    let (column, from) = bad.next()?;
    let more = match bad.count() {
        0 => String::new(),
        count => format!(" (and {count} more)"),
    };
    Some(format!(
        "{column}{more} was NaN or infinite, first at t = {from} s: its extremes are those of its finite values"
    ))
}

#[cfg(test)]
mod tests {
    use ttb_session::observe::{Begin, Moment, Observer, Timing};
    use ttb_session::{Column, TimeAxis};

    use super::*;

    #[test]
    fn a_column_that_is_not_finite_is_told_with_its_first_time() {
        let columns = ["a", "b", "c"].map(|name| Column::parse(name, "m"));
        let (mut peaks, axis) = (Peaks::default(), TimeAxis::new(0.5, 1.0));
        peaks.start(&Begin { columns: &columns, axis: &axis }).expect("columns");
        assert_eq!(not_finite(&peaks), None);
        for (n, row) in [[1.0, 2.0, 3.0], [1.0, f64::NAN, 3.0], [1.0, 2.0, f64::INFINITY]].iter().enumerate() {
            let moment =
                Moment { n: n as u64, t: axis.time(n as u64), h: 0.5, row, info: None, timing: Timing::default() };
            assert!(peaks.step(&moment).expect("a row").is_continue());
        }
        let told = not_finite(&peaks).expect("a warning");
        assert!(told.starts_with("b (and 1 more) was NaN or infinite, first at t = 0.5 s"), "{told}");
    }
}
