//! Bridges that give less than the iteration wants ([`Adapted`], [`Stations`]), and several bridges as one ([`Joined`]).

mod adapted;
mod joined;
mod stations;
mod velocities;
mod watch;

pub use adapted::{Adapted, Lacks};
pub use joined::Joined;
pub use stations::{Shape, StationError, Stations};
pub use watch::{Place, Watch};
