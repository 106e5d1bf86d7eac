//! Sparse symmetric matrices of large structures: assembly on one pattern, orders of elimination, factors, triangular
//! sweeps, natural modes.
//!
//! Knows no beam, no bridge, no time and no file. A model is assembled ([`assembly::Assembly`]) into a
//! [`pencil::Pencil`] (K, M and C on one pattern); every combination of the three that is asked for becomes a
//! [`factor::Factor`].

pub mod assembly;
pub mod blocks;
pub mod condition;
mod entries;
pub mod error;
pub mod excited;
pub mod factor;
mod lanczos;
pub mod modes;
pub mod order;
mod orthogonal;
pub mod pencil;
mod random;
pub mod raw;
pub mod simplicial;
pub mod supernodal;
pub mod sweeps;
pub mod symbolic;
mod symmetric;
pub mod vector;

pub use assembly::Assembly;
pub use condition::Condition;
pub use error::FactorError;
pub use factor::Factor;
pub use order::layout::Layout;
pub use pencil::Pencil;
pub use symbolic::Symbolic;
pub use symmetric::Product;
