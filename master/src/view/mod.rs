//! Files for viewers of finite-element models: a grid as VTU, a series of grids as PVD, the bridge in the course of a run.
//!
//! VTU is VTK's XML for unstructured grids. Numbers stand as text: every reader takes it, and it compresses well.

pub mod crossing;
pub mod grid;
pub mod series;
