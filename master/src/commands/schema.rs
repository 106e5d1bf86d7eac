//! `ttb schema`: JSON Schemas of the files that ttb reads and writes.

use crate::error::Error;
use crate::results::summary;

/// The command: of bridge model files, of summaries, or of scenarios.
pub fn schema(bridge: bool, summary: bool) -> Result<(), Error> {
    match (bridge, summary) {
        (true, _) => say!("{:#}", ttb_scenario::model_schema()),
        (_, true) => say!("{:#}", summary::schema().to_value()),
        _ => say!("{:#}", ttb_scenario::schema()),
    }
    Ok(())
}
