//! Finite elements in space: beams, trusses, shells, springs, masses; their matrices and interpolation.
//!
//! Everything an element gives is in global axes over its nodes' motions [x, y, z, rx, ry, rz], node after node. SI
//! units; axes are right-handed, which of them points down does not matter here.
//!
//! | element | membrane, axial | bending | shear deformation |
//! |---|---|---|---|
//! | [`Beam3`] | linear | exact static shapes | where a shear area is given |
//! | [`Truss3`] | linear | none | none |
//! | [`Shell4`] | assumed stress with drilling rotations | discrete Kirchhoff–Mindlin | yes |
//! | [`Shell3`] | optimal triangle with drilling rotations | discrete Kirchhoff–Mindlin | yes |

mod beam3;
mod error;
mod matrices;
mod point;
mod shell;
mod truss3;

pub use beam3::{Beam3, BeamSection};
pub use error::ElementError;
pub use matrices::{Matrices, Weights};
pub use point::{Mass, Spring};
pub use shell::{Plate, Shell3, Shell4};
pub use truss3::Truss3;
