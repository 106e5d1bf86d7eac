//! Train and track in space: cars of 35 degrees of freedom on two rails, with creep and flanges.
//!
//! ```text
//! x ahead, y right, z down;  φ roll, right side down;  ψ yaw, front to the right;  θ pitch, front down
//! car ──ports── newton ──ports── rails (plane track: the sum of both rails' vertical motion; lines: the rest)
//!                 │
//!               axle ── ttb_wheel_rail::contact
//! ```
//!
//! Start with [`system`]: the step. Displacements are changes from the dead-load state; gravity acts on the cars.

pub mod axle;
pub mod built;
pub mod car;
pub mod element;
pub mod error;
pub mod line;
mod lu;
pub mod newton;
pub mod outputs;
pub mod point;
pub mod pre_roll;
pub mod prepared;
pub mod rails;
pub mod spec;
pub mod state;
pub mod statics;
pub mod system;
