//! From FMU files to two coupled subsystems: which variable belongs to which, in what units, in which process.

pub mod assign;
pub mod connected;
mod equal;
pub mod isolate;
pub mod map;
pub mod parameters;
mod ports;
pub mod preload;
pub mod probe;
pub mod series;
pub mod trusting;
mod watched;
