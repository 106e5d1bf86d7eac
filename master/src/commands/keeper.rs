//! `ttb keeper`: what clears up after another `ttb` that was killed or has crashed; not for people.

use std::path::Path;

use crate::error::Error;

/// Waits for the end of the program that has started this one and removes the folders it leaves behind.
pub fn keep() -> Result<(), Error> {
    ttb_fmi::temporary::keep().map_err(Error::io(Path::new("temporary folders")))
}
