//! FMI 2.0 for co-simulation, both ways.
//!
//! [`export`] puts any [`ttb_contract::Model`] behind the 44 C functions of the standard: [`export_fmu!`] is all a shared
//! library needs. [`import`] loads anyone's FMU and makes it a [`ttb_contract::Subsystem`].
//! [`probe`] calls without protection, to find out what an FMU is worth.
//! [`types`] are the C types both share. This is the only library crate with `unsafe`; it never leaks into its interface.

pub mod export;
#[cfg(feature = "import")]
pub mod import;
#[cfg(feature = "import")]
pub mod isolate;
pub mod probe;
pub mod types;
