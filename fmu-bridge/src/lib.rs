//! Bridge.fmu: the bridge subsystem behind the FMI 2.0 shell.
//!
//! Inputs are the support forces, outputs the motion of the supports and the monitored points; the physics is
//! [`ttb_bridge::Bridge`], the C interface [`ttb_fmi2::export`]. Resources are read once, in `fmi2Instantiate`.
//!
//! Nothing may link this crate into another program: both FMUs export the same C symbols. The packed FMU renames the
//! shared library to its model identifier, `Bridge.so`.

ttb_fmi2::export_fmu!(ttb_bridge::Bridge, "Bridge");
