//! Linear structural dynamics: elements, damping, Newmark, reduced models, banded solvers.
//!
//! Knows no train, no FMI and no file. SI units; vertical motion positive down, rotation θ = dw/dx.

pub mod band;
pub mod beam;
pub mod damping;
pub mod dense;
pub mod frame;
pub mod near;
pub mod newmark;
pub mod pool;
pub mod reduction;
pub mod twisted;
