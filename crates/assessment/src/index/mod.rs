//! Indices: one number from a record.

mod comfort;
mod contact;
mod peak_to_peak;
mod rainflow;
mod rms;
mod sperling;

pub use comfort::{BLOCK, NMV_LEAST, block_rms, n_mv};
pub use contact::{Loss, losses};
pub use peak_to_peak::peak_to_peak;
pub use rainflow::{Cycle, rainflow};
pub use rms::{rms, running_rms};
pub use sperling::{Line, lines, sperling, sperling_continuous, sperling_lateral};

/// The number of values in `seconds`, at least one.
fn count(seconds: f64, rate: f64) -> usize {
    ((seconds * rate).round() as usize).max(1)
}
