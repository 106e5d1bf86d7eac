//! Verification of the finite elements against published benchmarks and closed forms.

mod beams;
mod macneal;
mod patch;
mod plates;
mod shells;
mod structure;
mod table;
