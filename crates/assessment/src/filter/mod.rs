//! Filters, by name and parameters: what a criterion asks for and a row of results was made with.
//!
//! A filter acts on all internal steps of one uniform record. Dynamic parts are filtered, Q − Q₀ and ẅ, never Q itself: a filter
//! that begins at rest takes a load that is there from the beginning for a loss of it.

mod butterworth;
mod section;
mod sliding_mean;
mod weighting;

use serde::{Deserialize, Serialize};

pub use butterworth::Butterworth;
pub use section::{Cascade, Section};
pub use sliding_mean::sliding_mean;
pub use weighting::Weighting;

use crate::error::SignalError;

/// The label of a record that was not filtered.
pub const RAW: &str = "raw";

/// In which direction a filter runs over the record.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Phase {
    /// Forwards, from rest.
    Causal,
    /// Forwards and backwards: no delay, gain squared (−6 dB at the cut-off, twice the order in effect).
    Zero,
    /// As `zero`, with the cut-off raised so that the gain there is −3 dB in all.
    Compensated,
}

/// A filter with all its parameters.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "type", rename_all = "kebab-case", deny_unknown_fields)]
pub enum Filter {
    /// None.
    Raw,
    /// Butterworth low-pass.
    Butterworth {
        /// Order of one pass.
        order: usize,
        /// Hz.
        cut_off_hz: f64,
        /// Direction.
        phase: Phase,
    },
    /// Mean over a length of way, centred.
    SlidingMean {
        /// m.
        length_m: f64,
    },
    /// Weighting of human response.
    Weighting {
        /// Which.
        curve: Weighting,
    },
}

impl Filter {
    /// The label in tables: `raw`, `butterworth-4-30Hz-zero`, `mean-2m`.
    pub fn label(&self) -> String {
        match self {
            Self::Raw => RAW.into(),
            Self::Butterworth { order, cut_off_hz, phase } => {
                let phase = match phase {
                    Phase::Causal => "causal",
                    Phase::Zero => "zero",
                    Phase::Compensated => "compensated",
                };
                format!("butterworth-{order}-{cut_off_hz}Hz-{phase}")
            }
            Self::SlidingMean { length_m } => format!("mean-{length_m}m"),
            Self::Weighting { curve } => curve.label().into(),
        }
    }

    /// The filtered record. `rate` is the number of values in a second, `way` the distance between two values, m, for filters
    /// over way.
    ///
    /// # Errors
    /// The record is too short or too coarse, a parameter is outside its range, or a value is not finite.
    pub fn apply(&self, signal: &[f64], rate: f64, way: f64) -> Result<Vec<f64>, SignalError> {
        match *self {
            Self::Raw => Ok(signal.to_vec()),
            Self::Butterworth { order, cut_off_hz, phase } => {
                let mut filtered = signal.to_vec();
                Butterworth::new(order, cut_off_hz, rate, phase)?.apply(&mut filtered)?;
                Ok(filtered)
            }
            Self::SlidingMean { length_m } => sliding_mean(signal, way, length_m),
            Self::Weighting { curve } => curve.apply(signal, rate),
        }
    }

    /// Each of several records, as [`apply`](Self::apply) filters it to the last bit; together they take less time.
    ///
    /// # Errors
    /// As [`apply`](Self::apply).
    pub fn apply_each(&self, records: &mut [Vec<f64>], rate: f64, way: f64) -> Result<(), SignalError> {
        if let Self::Butterworth { order, cut_off_hz, phase } = *self {
            return Butterworth::new(order, cut_off_hz, rate, phase)?.apply_each(records);
        }
        for record in records {
            *record = self.apply(record, rate, way)?;
        }
        Ok(())
    }
}
