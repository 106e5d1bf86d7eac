//! Bridges that say that they roll back, and do not.

use super::connected::Connected;
use crate::error::Error;

/// Runs with bridges as they describe themselves; should it turn out that one does not roll back, once more with other
/// instances, as ones that say so.
///
/// # Errors
/// Those of `open` and `run`.
pub fn trusting<T>(
    open: impl Fn(bool) -> Result<Connected, Error>,
    run: impl Fn(&mut Connected) -> Result<T, Error>,
) -> Result<T, Error> {
    let mut first = open(true)?;
    match run(&mut first) {
        Err(Error::NoReturn(text)) => {
            // Not unloaded before the others, if it may stay: NumPy, for one, cannot be loaded twice.
            let _stays = first.several.then_some(first);
            let mut second = open(false)?;
            second.warnings.push(text);
            run(&mut second)
        }
        done => done,
    }
}
