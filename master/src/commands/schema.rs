//! `ttb schema`: JSON Schemas of the files that ttb reads.

use crate::error::Error;

/// The command: of bridge model files, or of scenarios.
pub fn schema(bridge: bool) -> Result<(), Error> {
    say!("{:#}", if bridge { ttb_scenario::model_schema() } else { ttb_scenario::schema() });
    Ok(())
}
