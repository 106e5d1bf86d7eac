//! One instance of an FMU: its life and what it costs ([`life`]), its variables ([`access`]), its saved states ([`state`]).

mod access;
mod life;
mod state;

pub use life::{FmuInstance, Tally};
pub use state::StateSlot;
