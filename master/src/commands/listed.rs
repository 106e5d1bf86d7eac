//! What every list does: names what is not known, prints JSON.

use std::path::Path;

use ttb_scenario::nearest;

use crate::error::Error;
use crate::files;

/// There is nothing of this name; what may have been meant, and what there is.
pub(super) fn unknown<'a>(what: &str, name: &str, known: impl Iterator<Item = &'a str> + Clone) -> Error {
    let meant = nearest(name, known.clone()).map(|name| format!(" (did you mean `{name}`?)")).unwrap_or_default();
    let known = known.collect::<Vec<_>>().join(", ");
    Error::Input(format!("there is no {what} named `{name}`{meant}; there are: {known}"))
}

/// Prints a value as JSON.
pub(super) fn json(value: &impl serde::Serialize) -> Result<(), Error> {
    say!("{}", files::json(Path::new("standard output"), value)?);
    Ok(())
}
