//! The test model as an FMU's shared library.

#[path = "../tests/models/oscillator.rs"]
#[allow(missing_docs, dead_code)] // shared with the tests, which use more of it
mod oscillator;

ttb_fmi2::export_fmu!(oscillator::Oscillator, "Oscillator");
