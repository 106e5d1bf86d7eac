//! A model behind FMI 2.0: one shell for every FMU of the project.
//!
//! * [`export_fmu!`](crate::export_fmu) writes out the 44 C functions; each calls its namesake in this module;
//! * [`guard`] stands around every one of them: no null instance, no call in the wrong state, no panic gets past it;
//! * [`component`] is an instance: the model in its life cycle ([`ttb_contract::Instance`]), log, saved states.
//!
//! The shell has no static state and reads no file but the model's resources, in `fmi2Instantiate`.

#[cfg(panic = "abort")]
compile_error!("an FMU must be built with panic = \"unwind\": a panic is caught at the C boundary, never passed on");

pub mod component;
pub mod guard;
pub mod instantiate;
pub mod life_cycle;
pub mod log;
pub mod saved;
pub mod stage;
pub mod states;
pub mod stepping;
mod symbols;
pub mod values;

pub use component::Component;
