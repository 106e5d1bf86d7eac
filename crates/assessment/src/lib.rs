//! What a response means to a code: filters, comfort indices, statistics, limits. Values in, values out: no files, no FMUs, and
//! nothing is printed.
//!
//! ```text
//! history ── filter ──► reduced to one value: a [`Peak`] ── criteria ──► verdicts
//! ```

pub mod amplification;
pub mod error;
pub mod filter;
pub mod index;
pub mod peak;
pub mod percentile;
pub mod sample;

pub use error::SignalError;
pub use filter::{Butterworth, Filter, Phase, Weighting};
pub use peak::{Peak, PlaceKind, Statistic};
pub use percentile::percentile;
pub use sample::{Sample, Seeded};
