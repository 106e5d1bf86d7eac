//! Contact of one wheel with one rail: profiles, their distance as a table, Hertz, Kalker, creep forces with derivatives.
//!
//! Everything is counted **outwards**, from the middle of the track to the field side, so that a left wheel and a right wheel
//! are one and the same: u is the outward coordinate, D the outward displacement of the wheel relative to its rail, z counts
//! down. Profiles are in millimetres, as drawings give them; the [`geometry::Geometry`] made from them and all else is SI.
//!
//! ```text
//! profile ── geometry (g, g′, u_c, r − r0, B₂ over D) ──┐
//! hertz (G, a₁, b₁), kalker (C₁₁, C₂₂, C₂₃) ────────────┴── contact (forces of a wheel and their derivatives)
//! ```
//!
//! The crate knows no time, no vehicle and no file.

pub mod conicity;
pub mod contact;
pub mod creep;
pub mod elliptic;
pub mod fastsim;
pub mod geometry;
pub mod hertz;
pub mod kalker;
pub mod patch;
pub mod profile;
