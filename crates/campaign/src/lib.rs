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

pub mod clock;
pub mod compute;
pub mod coupled;
pub mod error;
pub mod expand;
pub mod facts;
pub mod folder;
pub mod foreign;
pub mod governing;
pub mod hdf5;
pub mod history;
pub mod identity;
pub mod journal;
pub mod kept;
pub mod limits;
pub mod list;
pub mod modal;
pub mod one_axle;
mod paths;
pub mod plan;
pub mod points;
pub mod pool;
pub mod record;
pub mod refine;
pub mod refused;
pub mod request;
pub mod runner;
pub mod shard;
pub mod slurm;
pub mod speeds;
pub mod status;
pub mod tables;

pub use compute::{Compute, Computed};
pub use error::Error;
pub use folder::Folder;
pub use foreign::Foreign;
pub use journal::Journal;
pub use limits::Limits;
pub use plan::{Plan, Run, Way};
pub use record::{Envelope, Record, Records};
pub use runner::Runner;
pub use shard::Shard;
