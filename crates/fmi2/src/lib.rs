//! FMI 2.0 for co-simulation, both ways.
//!
//! [`export`] puts any [`ttb_contract::Model`] behind the 44 C functions of the standard: [`export_fmu!`] is all a shared
//! library needs. [`import`] loads anyone's FMU; what is the same in all versions of FMI (archives, instances, processes of
//! their own) is [`ttb_fmi`]'s. [`probe`] calls without protection, for `ttb check`. [`types`] are the C types all share.
//! `unsafe` is allowed in this crate and in [`ttb_fmi`] alone; it never shows in their interfaces.

pub mod export;
#[cfg(feature = "import")]
pub mod import;
#[cfg(feature = "import")]
mod logger;
#[cfg(feature = "import")]
pub mod probe;
pub mod types;
