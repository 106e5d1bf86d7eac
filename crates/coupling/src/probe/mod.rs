//! What trial steps tell before a step is taken.
//!
//! `contraction` and `identify` look at the coupling, [`rehearsal`] at each side alone, [`response`] says what is wrong
//! with a deck's signs and units.

mod contraction;
mod identify;
pub mod rehearsal;
pub mod response;

pub(crate) use contraction::{Strength, apart, contraction, shape};
pub(crate) use identify::identify;
pub(crate) use rehearsal::{FORCE, MOTION, alike, difference, rehearse};
pub use rehearsal::{Probe, returns};
