//! The bridge subsystem: spans of beams or a plane frame, linear, behind the coupling contract.
//!
//! Start with [`model::Bridge`]. A specification becomes a mesh ([`beams`] or [`frame`] → [`mesh`]), a mesh becomes
//! equations ([`structure`], [`system`]), and the deck's path ([`deck`]) ties the track's supports to them.

pub mod abreast;
mod across;
pub mod assembled;
pub mod beams;
pub mod compliance;
pub mod deck;
pub mod drawing;
pub mod frame;
pub mod full;
mod ground;
pub mod imported;
pub mod inspect;
pub mod interface;
pub mod lanes;
pub mod law;
pub mod lazy;
pub mod local;
pub mod march;
pub mod mesh;
pub mod model;
pub mod outline;
pub mod plane;
pub mod prepared;
mod read_out;
pub mod reduced;
pub mod reduction;
pub mod rounding;
pub mod rows;
mod solver;
pub mod space;
pub mod state;
pub mod steps;
pub mod stored;
pub mod structure;
pub mod system;

pub use abreast::Abreast;
pub use model::Bridge;
pub use prepared::Prepared;
