//! Reads M, C and K written by other finite-element programs, and where the track's supports rest on them.
//!
//! ```text
//! M q̈ + C q̇ + K q = Σ_s w_sᵀ F_s,     u_s = w_s q
//! ```
//!
//! K, M and C come as sparse symmetric matrices, the weights w_s of every support from a table. The formats are those
//! that the programs write themselves ([`Format`]); a file is read twice, in chunks, so that hardly more memory is used
//! than the result takes. Whatever is wrong with a file is refused with file, line, rule and value ([`Problem`]).

mod collect;
mod dof;
mod dofs;
mod files;
mod formats;
mod input;
mod inspect;
mod lines;
mod matrix;
mod number;
mod numbering;
mod problem;
mod profile;
mod read;
mod rows;
mod series;
mod table;
mod text;
mod weights;

pub use dof::{DIRECTIONS, Dof, INTERNAL};
pub use dofs::Dofs;
pub use files::{FileFacts, Files, Imported};
pub use formats::Format;
pub use input::Input;
pub use inspect::{Inspection, Motion};
pub use matrix::SymmetricMatrix;
pub use problem::{Problem, Problems};
pub use profile::{Profile, profile};
pub use read::{Facts, Matrix, read_matrix};
pub use rows::Row;
pub use series::{Columns, series};
pub use text::{text, text_of_file};
