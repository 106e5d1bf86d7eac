//! What the checks and the physics both need to know of a finite-element model: which node a number stands for, which
//! motions are eliminated, which parts hang together.

mod index;
mod parts;
mod ties;

pub use index::Index;
pub use parts::{Part, parts};
pub use ties::{Motion, Origin, Tie, Ties, motion};
