//! The JSON Schemas (2020-12) of scenario and model files, made from the types; editors complete and check with them,
//! and so does [`crate::walk`].

use std::sync::LazyLock;

use serde_json::{Value, json};

use crate::json::COMMENT;
use crate::types::{Model, Scenario};

/// Made once, it checks any number of scenarios.
pub(crate) static SCENARIO: LazyLock<Value> =
    LazyLock::new(|| named(schemars::schema_for!(Scenario), "urn:ttb:scenario", "ttb scenario"));

/// The same of model files.
pub(crate) static MODEL: LazyLock<Value> =
    LazyLock::new(|| named(schemars::schema_for!(Model), "urn:ttb:bridge", "ttb finite-element model of a bridge"));

/// The schema of a scenario file, with an example.
#[must_use]
pub fn schema() -> Value {
    with_example(with_comments(&SCENARIO), include_str!("../data/examples/scenario.json"))
}

/// The schema of a bridge's finite-element model in a file of its own.
#[must_use]
pub fn model_schema() -> Value {
    with_example(with_comments(&MODEL), include_str!("../data/examples/bridge.json"))
}

/// A schema without formats of numbers that JSON Schema does not know (`uint32`, `double`), which strict validators refuse;
/// what they say of the range stands in `minimum` and `maximum`.
#[must_use]
pub fn strict(mut schema: Value) -> Value {
    without_formats(&mut schema);
    schema
}

fn without_formats(schema: &mut Value) {
    match schema {
        Value::Object(map) => {
            // A property that is called `format` is a schema, not a text.
            let is_format = |format: &Value| format.is_string();
            if let Some(format) = map.get("format").filter(|format| is_format(format)).cloned() {
                map.remove("format");
                if format == "uint32" {
                    map.entry("maximum").or_insert(json!(u32::MAX));
                }
            }
            map.values_mut().for_each(without_formats);
        }
        Value::Array(list) => list.iter_mut().for_each(without_formats),
        _ => {}
    }
}

fn with_example(mut schema: Value, example: &str) -> Value {
    let example = serde_json::from_str::<Value>(example);
    debug_assert!(example.is_ok());
    if let (Some(root), Ok(example)) = (schema.as_object_mut(), example) {
        root.insert("examples".into(), json!([example]));
    }
    schema
}

/// As editors need it: every object may also have a comment, which the reader leaves out before the walk.
fn with_comments(schema: &Value) -> Value {
    let mut schema = schema.clone();
    comment(&mut schema);
    strict(schema)
}

fn comment(schema: &mut Value) {
    match schema {
        Value::Object(map) => {
            map.values_mut().for_each(comment);
            if map.get("additionalProperties") == Some(&Value::Bool(false))
                && let Some(Value::Object(properties)) = map.get_mut("properties")
            {
                properties.insert(COMMENT.into(), json!({ "description": "For readers of the file; ignored." }));
            }
        }
        Value::Array(list) => list.iter_mut().for_each(comment),
        _ => {}
    }
}

/// Gives a schema its name, from which nothing is fetched, and its title.
fn named(mut root: schemars::Schema, id: &str, title: &str) -> Value {
    root.insert("$id".to_owned(), id.into());
    root.insert("title".to_owned(), title.into());
    root.to_value()
}
