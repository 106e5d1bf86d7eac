//! Trains of axle loads, as data: HSLM, EN 15528, annex D of EN 1991-2, real trains, files of a user, and every bundled
//! train of vehicles with its static axle loads; static load models; the signature of a train.
//!
//! ```text
//! name or path ─ find ─▶ ForceTrain { axles (x, P) } ─ spread ─▶ the same over sleepers
//!                              └──────────────── signature ─▶ G(λ), resonance lengths
//! ```
//!
//! SI units: x in m from the first axle backwards, P in N, speeds in m/s. Data files have kN and km/h, and say so.

pub mod files;
pub mod find;
pub mod hslm;
pub mod load_model;
pub mod names;
pub mod rule;
pub mod signature;
pub mod spread;
pub mod train;

pub use find::{axles_of, find, find_all, names, split};
pub use load_model::{LoadModel, load_model, load_model_names};
pub use signature::Signature;
pub use spread::Spread;
pub use train::{Axle, ForceTrain};
