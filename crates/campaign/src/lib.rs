//! Many runs of one scenario: which, where their results are kept, and what is made of them.
//!
//! ```text
//! request ── expand ──► plan ──► runs in a fixed order, each with an id that follows from what decides its result
//!                                  │  shard: run i belongs to shard i mod n
//!                                  ▼
//!                     pool of workers ── Compute ──► journal: one small file a run, written whole, then renamed
//!                                                      │
//!                                                      ▼  read in the order of the plan
//!                                   runs.csv, peaks.csv, envelope.csv, results.h5; timings.csv beside them
//! ```
//!
//! The journal alone is the truth: a run is done if its file is there. Tables are made from it in the order of the plan, so that
//! they have the same bytes with one worker or many, in any order, after any number of ends by force.

pub mod compute;
pub mod error;
pub mod hdf5;
pub mod history;
pub mod identity;
pub mod journal;
pub mod list;
pub mod plan;
pub mod pool;
pub mod record;
pub mod shard;
pub mod slurm;
pub mod status;
pub mod tables;

pub use compute::{Compute, Computed};
pub use error::Error;
pub use journal::Journal;
pub use plan::{Plan, Run, Way};
pub use record::{Envelope, Record};
pub use shard::Shard;
