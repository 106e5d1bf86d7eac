//! One trial of a step: what it starts from, what it sends and gets, in which units.

mod exchange;
mod history;
mod scaled;
mod trials;

pub(crate) use exchange::Sides;
pub(crate) use scaled::{Factors, Scaled};
pub(crate) use trials::Trials;
