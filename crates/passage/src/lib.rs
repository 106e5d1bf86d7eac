//! Passages of axle loads over linear bridges, without vehicles, track and irregularity.
//!
//! ```text
//! BridgeSpec ─ ModalBridge ─┐
//! ForceTrain ───────────────┴─ Passage ─ at(speed) ────────▶ Response: an Extreme for every output
//!                                 ├─ histories(speed) ─────▶ Histories ─ accelerations(filter)
//!                                 └─ statics() ────────────▶ static extremes of the same train at the same places
//! ```
//!
//! **What a passage returns.** [`ModalBridge::outputs`] is the list of what is looked at: an [`Output`] is a [`Quantity`]
//! (name and unit as in the tidy tables) at a [`Place`] (kind, name, x). The first [`ModalBridge::positions`] of them follow
//! displacements (displacement, and with [`Settings::forces`] moment, shear, reaction); the accelerations come after them.
//! [`Response::extremes`] has one [`Extreme`] for every output in that order: maximum and minimum with their times in s from
//! the first axle at the deck's begin. [`Passage::statics`] has one for each of the first group, the static value of the
//! same train, which φ′ needs. A row of a table is one output, one statistic (`max`, `min`, or `abs-max` by
//! [`Extreme::largest`]) and its static value.
//!
//! **Filters.** [`Passage::histories`] gives the few modal accelerations; [`Histories::accelerations`] applies a linear filter to
//! them and combines them at all deck points.
//!
//! **Bridges without such modes** (dashpots, damping matrices, FMUs of other programs): [`one_axle`] runs one axle a speed
//! over a [`ttb_contract::Subsystem`], and every train follows by superposition; [`own::OwnBridge`] is the project's bridge
//! in all degrees of freedom. [`one_axle::Unit::response`] gives the same [`Response`] over [`one_axle::Unit::outputs`].
//!
//! A response depends on bridge, train, heading, free vibration and its own speed alone: not on other speeds, threads or
//! vector instructions.

mod block;
pub mod extreme;
pub mod history;
mod lanes;
pub mod lines;
pub mod load;
pub mod march;
pub mod modal;
pub mod one_axle;
pub mod own;
pub mod passage;
pub mod place;
mod plane;
pub mod recursion;
mod sampled;
mod source;
pub mod statics;
mod sum;

pub use extreme::Extreme;
pub use history::Histories;
pub use load::Heading;
pub use modal::{ModalBridge, Refused, Settings, is_diagonal};
pub use passage::{Passage, Response};
pub use place::{Output, Place, PlaceKind, Quantity};
