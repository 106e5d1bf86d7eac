//! The scenario file's JSON Schema (2020-12), made from the types; editors complete and check with it, and so does
//! [`crate::walk`].

use serde_json::Value;

use crate::types::Scenario;

/// Name of the schema; nothing is fetched from it.
const ID: &str = "urn:ttb:scenario";

/// The schema of a scenario file.
#[must_use]
pub fn schema() -> Value {
    let mut root = schemars::schema_for!(Scenario);
    root.insert("$id".to_owned(), ID.into());
    root.insert("title".to_owned(), "ttb scenario".into());
    root.to_value()
}
