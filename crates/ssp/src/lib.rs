//! System structures as files: SSP 1.0 and 2.0, *System Structure and Parameterization*.
//!
//! [`pack`] writes an archive of a [`Structure`] and its files. [`read`] gives back the structure of a SystemStructure.ssd,
//! [`load`] also all documents that it names, [`flatten`] makes components with their values and wires of systems in systems;
//! or they tell everything that is wrong, each problem with its place in the document. What a component's file is and what
//! its variables mean is not looked at here.

mod archive;
mod bindings;
mod flat;
mod flatten;
mod graph;
mod load;
mod parameters;
mod problem;
mod read;
mod shared;
mod source;
mod system;
mod transform;
mod tree;
mod types;
mod unit;
mod uri;
mod values;
mod write;

pub use archive::{Content, PackError, Stamp, pack};
pub use bindings::{read_mapping, read_set};
pub use flat::{Bound, Flat, Offer, Wire};
pub use flatten::flatten;
pub use graph::Hop;
pub use load::{Files, Loaded, load};
pub use parameters::{Binding, Entry, Enumeration, Mapping, NamedUnit, Parameter, ParameterSet, Value, Values};
pub use problem::{Problem, Report};
pub use read::read;
pub use transform::Transformation;
pub use types::{
    Annotation, BaseUnit, Component, Connection, Connector, Experiment, FileKind, Kind, STRUCTURE, SignalReference,
    Source, Structure, System, Type, Unit,
};
pub use uri::Base;
pub use write::write;

/// Folder of the components' files.
pub const RESOURCES: &str = "resources";
/// Folder of what is not the standard's, below a reversed domain name.
pub const EXTRA: &str = "extra";
