//! A system without isolation.

use super::settings::{Instantiation, Isolation};
use crate::error::FmuError;
use crate::log::Sink;
use crate::slave::Slave;
use crate::version::Version;
use std::time::Duration;

/// The program's answer when it is asked to be a host.
///
/// # Errors
/// Always.
pub fn host(_version: &'static Version) -> Result<(), String> {
    Err("isolating FMUs is available on Linux and Windows only".into())
}

/// An isolated instance, which there is none of.
///
/// # Errors
/// Always.
pub(crate) fn start(
    wanted: &Instantiation,
    _version: &'static Version,
    _isolation: &Isolation,
    _sink: &Sink,
) -> Result<(Box<dyn Slave>, Duration), FmuError> {
    let what = "FMUs can be isolated on Linux and Windows only".to_string();
    Err(FmuError::Impossible { instance: wanted.name.to_string(), what })
}
