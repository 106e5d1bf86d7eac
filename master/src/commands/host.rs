//! `ttb host`: the process that `ttb run --isolate` runs an FMU in.

use std::path::PathBuf;

use crate::connect::preload;
use crate::error::Error;

/// The command; returns when its master goes.
pub fn host(preloaded: &[PathBuf]) -> Result<(), Error> {
    preload::load(preloaded)?;
    ttb_fmi2::import::host().map_err(Error::Input)
}
