//! Verification of the finite elements against published benchmarks and closed forms.

mod beams;
mod macneal;
mod patch;
mod plates;
mod shells;
mod structure;

/// What runs these tests.
const COMMAND: &str = "-p ttb-tests --test verification";
