//! Linear structural dynamics: elements, assembly, damping, modes, Newmark, sparse and banded solvers.
//!
//! Knows no train, no FMI and no file. SI units; vertical motion positive down, rotation θ = dw/dx.

pub mod band;
pub mod beam;
pub mod damping;
pub mod factor;
pub mod frame;
pub mod modes;
pub mod newmark;
pub mod pool;
pub mod sparse;
pub mod twisted;
pub mod vector;
