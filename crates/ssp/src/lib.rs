//! System structures as files: SSP 1.0, *System Structure and Parameterization*.
//!
//! [`pack`] writes an archive of a [`Structure`] and its files, [`read`] gives back the structure of a SystemStructure.ssd,
//! or everything that is wrong with it, each with its place in the document. What a component's file is and what its
//! variables mean is not looked at here.

mod archive;
mod components;
mod problem;
mod read;
mod tree;
mod types;
mod write;

pub use archive::{Content, PackError, Stamp, pack};
pub use problem::{Problem, Report};
pub use read::read;
pub use types::{
    Annotation, BaseUnit, Component, Connection, Connector, Experiment, Kind, STRUCTURE, Structure, System, Type, Unit,
};
pub use write::write;

/// Folder of the components' files.
pub const RESOURCES: &str = "resources";
/// Folder of what is not the standard's, below a reversed domain name.
pub const EXTRA: &str = "extra";
