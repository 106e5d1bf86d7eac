//! Verification of the finite elements against published benchmarks and closed forms.

mod macneal;
mod patch;
mod shells;
mod structure;
mod table;
