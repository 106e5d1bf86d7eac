//! Scenario files: types, JSON Schema, checks, bundled data; no solver.

pub mod spec;
pub mod types;
