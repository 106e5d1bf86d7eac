//! A limit as a table over span and speed.
//!
//! ```text
//! between spans and between speeds straight lines; outside of the table nothing is known
//! EN 1990 A2.4.4.3.2   values · 0.7 (one span, two simple spans, two continuous spans), · 0.9 (three continuous spans or more),
//!                      / b_v of the level of comfort asked for (1.0, 1.3, 2.0)
//! ```

use serde::{Deserialize, Serialize};

use crate::facts::Facts;

/// A table.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Chart {
    /// Rising spans, m.
    pub spans_m: Vec<f64>,
    /// Rising speeds, km/h.
    pub speeds_km_h: Vec<f64>,
    /// A row a speed, a value a span.
    pub values: Vec<Vec<f64>>,
}

impl Chart {
    /// The value.
    ///
    /// # Errors
    /// Span or speed is outside of the table.
    pub fn at(&self, span: f64, speed: f64) -> Result<f64, String> {
        let (i, r) = within(&self.spans_m, span).ok_or_else(|| self.outside(span, speed))?;
        let (k, s) = within(&self.speeds_km_h, speed).ok_or_else(|| self.outside(span, speed))?;
        let row = |k: usize| {
            self.values[k][i] + r * (self.values[k][(i + 1).min(self.spans_m.len() - 1)] - self.values[k][i])
        };
        Ok(row(k) + s * (row((k + 1).min(self.speeds_km_h.len() - 1)) - row(k)))
    }

    fn outside(&self, span: f64, speed: f64) -> String {
        let ends = |list: &[f64]| format!("{} to {}", list[0], list[list.len() - 1]);
        let (spans, speeds) = (ends(&self.spans_m), ends(&self.speeds_km_h));
        format!("{span} m at {speed} km/h is outside of the table of {spans} m and {speeds} km/h")
    }

    /// Whether rows and columns fit.
    ///
    /// # Errors
    /// The rule that is not kept.
    pub fn check(&self) -> Result<(), String> {
        let rises = |list: &[f64]| !list.is_empty() && list.windows(2).all(|pair| pair[0] < pair[1]);
        if !rises(&self.spans_m) || !rises(&self.speeds_km_h) {
            return Err("must have rising `spans_m` and `speeds_km_h`".into());
        }
        let (rows, columns) = (self.speeds_km_h.len(), self.spans_m.len());
        if self.values.len() != rows || self.values.iter().any(|row| row.len() != columns) {
            return Err(format!("must have {rows} rows (speeds) of {columns} values (spans)"));
        }
        if self.values.iter().flatten().any(|value| *value <= 0.0) {
            return Err("must have positive values".into());
        }
        Ok(())
    }
}

/// The interval of a rising list in which a value lies, and where.
fn within(list: &[f64], value: f64) -> Option<(usize, f64)> {
    let (first, last) = (list.first()?, list.last()?);
    if value < *first || value > *last {
        return None;
    }
    let i = list.partition_point(|x| *x <= value).saturating_sub(1);
    let next = list.get(i + 1).copied();
    Some((i, next.map_or(0.0, |next| (value - list[i]) / (next - list[i]))))
}

/// The factor on values of figure A2.3.
pub(super) fn of_comfort(facts: &Facts) -> f64 {
    let spans = facts.spans_m.as_ref().map_or(1, Vec::len);
    let of_spans = match (facts.continuous.unwrap_or(false), spans) {
        (_, ..=2) => 0.7,
        (true, _) => 0.9,
        (false, _) => 1.0,
    };
    let level = match facts.comfort_level.as_deref() {
        Some("good") => 1.3,
        Some("acceptable") => 2.0,
        _ => 1.0,
    };
    of_spans / level
}
