//! What the parts of the walk share: the schema, the report, and how values are shown.

use std::collections::HashSet;

use serde_json::Value;

use crate::problem::Report;

/// A walk over a value along a schema.
pub struct Walker<'a> {
    /// The whole schema, for its definitions.
    pub root: &'a Value,
    /// Paths that are known to be wrong already.
    pub reported: &'a HashSet<String>,
    /// Where problems go.
    pub report: &'a mut Report,
}

impl<'a> Walker<'a> {
    /// Follows `$ref` to the definition it names.
    pub fn resolve(&self, schema: &'a Value) -> &'a Value {
        let target = schema["$ref"].as_str().and_then(|name| name.strip_prefix('#'));
        target.and_then(|pointer| self.root.pointer(pointer)).unwrap_or(schema)
    }
}

/// A JSON type for people.
pub fn in_words(kind: &str) -> &'static str {
    match kind {
        "object" => "an object",
        "array" => "a list",
        "number" => "a number",
        "integer" => "a whole number",
        "string" => "a text",
        "boolean" => "true or false",
        _ => "null",
    }
}

/// A value for a message: JSON, cut where it gets long.
pub fn shown(value: &Value) -> String {
    const LONG: usize = 40;
    let text = value.to_string();
    match text.char_indices().nth(LONG) {
        Some((cut, _)) => format!("{} …", &text[..cut]),
        None => text,
    }
}
