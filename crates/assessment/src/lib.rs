//! What a response means to a code: filters, comfort indices, statistics, limits. Values in, values out: no files, no FMUs, and
//! nothing is printed.
//!
//! ```text
//! history ── filter ──► reduced to one value: a [`Peak`] ── criteria ──► verdicts
//! ```

pub mod amplification;
pub mod criterion;
pub mod error;
pub mod facts;
pub mod filter;
pub mod index;
pub mod judge;
mod load_case;
pub mod peak;
pub mod percentile;
pub mod reduce;
pub mod run;
pub mod sample;
pub mod statics;
pub mod verdict;

pub use criterion::{Criteria, Criterion};
pub use error::SignalError;
pub use facts::Facts;
pub use filter::{Butterworth, Filter, Phase, Weighting};
pub use judge::judge;
pub use peak::{Peak, PlaceKind, Statistic};
pub use percentile::percentile;
pub use reduce::{Histories, LossAt, Reduced, reduce};
pub use run::{Basis, Loads, Missing, Rail, Results, Run};
pub use sample::{Sample, Seeded};
pub use statics::{LoadCase, Statics};
pub use verdict::{Status, Verdict, Verdicts};
