//! `ttb schema`: JSON Schemas of the files that ttb reads and writes.

use crate::error::Error;
use crate::results::summary;

/// The command: of bridge model files, of summaries, of verdicts, or of scenarios.
pub fn schema(bridge: bool, summary: bool, verdicts: bool) -> Result<(), Error> {
    if verdicts {
        say!("{}", ttb_assessment::verdict::SCHEMA.trim_end());
        return Ok(());
    }
    match (bridge, summary) {
        (true, _) => say!("{:#}", ttb_scenario::model_schema()),
        (_, true) => say!("{:#}", ttb_scenario::strict(summary::schema().to_value())),
        _ => say!("{:#}", ttb_scenario::schema()),
    }
    Ok(())
}
