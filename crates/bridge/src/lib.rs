//! the bridge subsystem.
