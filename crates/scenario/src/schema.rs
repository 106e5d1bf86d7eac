//! The JSON Schemas (2020-12) of scenario and model files, made from the types; editors complete and check with them,
//! and so does [`crate::walk`].

use std::sync::LazyLock;

use serde_json::Value;

use crate::types::{Model, Scenario};

/// Made once, it checks any number of scenarios.
pub(crate) static SCENARIO: LazyLock<Value> =
    LazyLock::new(|| named(schemars::schema_for!(Scenario), "urn:ttb:scenario", "ttb scenario"));

/// The schema of a scenario file.
#[must_use]
pub fn schema() -> Value {
    SCENARIO.clone()
}

/// The schema of a bridge's finite-element model in a file of its own.
#[must_use]
pub fn model_schema() -> Value {
    named(schemars::schema_for!(Model), "urn:ttb:bridge", "ttb finite-element model of a bridge")
}

/// Gives a schema its name, from which nothing is fetched, and its title.
fn named(mut root: schemars::Schema, id: &str, title: &str) -> Value {
    root.insert("$id".to_owned(), id.into());
    root.insert("title".to_owned(), title.into());
    root.to_value()
}
