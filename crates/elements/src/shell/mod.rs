//! Flat shells: membrane with drilling rotations, plate in bending with shear deformation.

mod bending;
mod flat;
mod membrane3;
mod membrane4;
mod plate;
mod shell3;
mod shell4;

pub use plate::Plate;
pub use shell3::Shell3;
pub use shell4::Shell4;

#[cfg(test)]
mod tests;
