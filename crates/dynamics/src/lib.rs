//! Linear structural dynamics: elements, assembly, damping, modes, Newmark, sparse and banded solvers.
//!
//! Knows no train, no FMI and no file. SI units; vertical motion positive down, rotation θ = dw/dx.

pub mod band;
pub mod beam;
pub mod blocks;
pub mod damping;
pub mod dense;
pub mod factor;
pub mod frame;
pub mod krylov;
pub mod modes;
pub mod newmark;
pub mod order;
pub mod pool;
mod random;
pub mod reduction;
pub mod simplicial;
pub mod sparse;
pub mod supernodal;
pub mod sweeps;
pub mod twisted;
pub mod vector;
