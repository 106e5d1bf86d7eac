//! A run is a value: a [`Case`] says what is coupled, how and how long; [`drive()`] takes its steps; [`observe`] holds those who
//! look on.
//!
//! ```text
//! Case ──► drive(Stepping, Plan, observers) ──► Ended
//!              │  start, step, read                 Observer: start, step, end
//!              └─ Coupled (two Subsystems and their Coupling), or any other method that takes steps
//! ```
//!
//! [`drive()`] takes the steps of one run, [`drive_abreast()`] those of several side by side; both go along a [`course::Course`],
//! which alone knows what a step is for those who look on. Nothing here prints, opens a file, or knows a clock: the caller hands over
//! writers and a clock. A recorded variable is a [`Column`]: quantity, of what, unit; nowhere else are names taken apart.

pub mod abreast;
pub mod axis;
pub mod case;
pub mod column;
pub mod coupled;
pub mod course;
pub mod drive;
pub mod error;
pub mod observe;
pub mod prepared;
pub mod quantity;
pub mod sides;
pub mod stepping;

pub use abreast::drive_abreast;
pub use axis::TimeAxis;
pub use case::Case;
pub use column::{Column, Of};
pub use coupled::Coupled;
pub use drive::drive;
pub use error::RunError;
pub use observe::{Begin, Moment, Observer, Table};
pub use prepared::Prepared;
pub use quantity::Quantity;
pub use sides::Sides;
pub use stepping::{Ended, Plan, Stepping};
