//! Filled by the FMI layer.
