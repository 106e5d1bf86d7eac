//! Checks a JSON value against the schema and reports everything that does not fit, not only the first thing.
//!
//! It knows the keywords that [`crate::schema()`] produces (a test tells when it produces another). Where the schema offers
//! branches, `branch` first finds the one that was meant, so that a misspelt key deep inside an irregularity of type
//! `spectrum` is reported as just that.

mod branch;
mod elsewhere;
mod limits;
#[cfg(test)]
mod samples;
mod walker;

use std::collections::HashSet;

use serde_json::Value;

use crate::problem::{Report, nearest};
use walker::{Walker, in_words, shown};

/// Reports what in `value` does not fit the schema `root`; paths in `reported` are known to be wrong already.
pub(crate) fn walk(root: &Value, value: &Value, reported: &HashSet<String>, report: &mut Report) {
    Walker { root, reported, report }.check(root, value, "$");
}

impl<'a> Walker<'a> {
    fn check(&mut self, schema: &'a Value, value: &Value, path: &str) {
        if self.reported.contains(path) {
            return;
        }
        let schema = self.resolve(schema);
        if let Some(branches) = branch::branches(schema) {
            if let Some(meant) = self.choose(branches, value, path) {
                self.check(meant, value, path);
            }
            return;
        }
        if !branch::admits(schema, value) {
            return self.wrong_type(schema, value, path);
        }
        match value {
            Value::Object(map) => self.object(schema, map, path),
            Value::Array(list) => self.array(schema, list, path),
            Value::Number(number) => self.number(schema, number, path),
            Value::String(text) => self.text(schema, text, path),
            Value::Bool(_) | Value::Null => {}
        }
    }

    fn object(&mut self, schema: &'a Value, map: &serde_json::Map<String, Value>, path: &str) {
        let Some(properties) = schema["properties"].as_object() else {
            // Keys of the user's own, all of one kind.
            let own = schema["additionalProperties"].is_object().then_some(&schema["additionalProperties"]);
            let each = own.into_iter().flat_map(|each| map.iter().map(move |(key, value)| (each, key, value)));
            each.for_each(|(each, key, value)| self.check(each, value, &format!("{path}.{key}")));
            return;
        };
        for (key, value) in map {
            match properties.get(key) {
                Some(property) => self.check(property, value, &format!("{path}.{key}")),
                None if schema["additionalProperties"] == false => {
                    let near = nearest(key, properties.keys().map(String::as_str));
                    let near = elsewhere::place(self.root, key, path).or(near);
                    self.report.suggest(format!("{path}.{key}"), "unknown key", format!("`{key}`"), near);
                }
                None => {}
            }
        }
        for key in schema["required"].as_array().into_iter().flatten().filter_map(Value::as_str) {
            if !map.contains_key(key) {
                self.report.problem(format!("{path}.{key}"), "missing key", format!("`{key}`"));
            }
        }
    }

    fn array(&mut self, schema: &'a Value, list: &[Value], path: &str) {
        self.length(schema, list, path);
        // a tuple has a schema for each of its entries
        let each = schema["prefixItems"].as_array().map_or(&[][..], Vec::as_slice);
        for (i, item) in list.iter().enumerate() {
            self.check(each.get(i).unwrap_or(&schema["items"]), item, &format!("{path}[{i}]"));
        }
    }

    fn wrong_type(&mut self, schema: &Value, value: &Value, path: &str) {
        let wanted: Vec<_> = branch::types(schema).filter(|t| *t != "null").map(in_words).collect();
        self.report.problem(path, format!("must be {}", wanted.join(" or ")), shown(value));
    }
}

#[cfg(test)]
mod tests {
    use std::collections::{BTreeSet, HashSet};

    use serde::de::DeserializeOwned;
    use serde_json::Value;

    use super::samples::samples;
    use super::walk;
    use crate::problem::Report;
    use crate::schema::{MODEL, SCENARIO};
    use crate::types::{Model, NAME_PATTERN, Scenario};

    const UNDERSTOOD: &str = "$ref oneOf anyOf const enum type properties required additionalProperties items \
        prefixItems minItems maxItems minimum maximum exclusiveMinimum pattern";
    const ANNOTATIONS: &str = "$schema $id $defs title description default format";

    /// Keywords of a schema and of all schemas in it.
    fn keywords(schema: &Value, found: &mut BTreeSet<String>) {
        for (keyword, value) in schema.as_object().into_iter().flatten() {
            found.insert(keyword.clone());
            match (keyword.as_str(), value) {
                ("properties" | "$defs", Value::Object(named)) => named.values().for_each(|s| keywords(s, found)),
                ("oneOf" | "anyOf" | "prefixItems", Value::Array(list)) => list.iter().for_each(|s| keywords(s, found)),
                ("items", schema) => keywords(schema, found),
                _ => {}
            }
        }
    }

    /// Every constant in a schema.
    fn constants(schema: &Value, found: &mut BTreeSet<String>) {
        match schema {
            Value::Object(map) => map.iter().for_each(|(key, value)| match (key.as_str(), value) {
                ("const", Value::String(text)) => drop(found.insert(text.clone())),
                ("enum", Value::Array(all)) => found.extend(all.iter().filter_map(Value::as_str).map(str::to_owned)),
                _ => constants(value, found),
            }),
            Value::Array(list) => list.iter().for_each(|value| constants(value, found)),
            _ => {}
        }
    }

    /// What the schema documents is accepted by the walk and by the types, value by value.
    fn all_documented_values_are_accepted<T: DeserializeOwned>(schema: &Value) {
        let samples = samples(schema, schema);
        for sample in &samples {
            let mut report = Report::new("sample");
            walk(schema, sample, &HashSet::new(), &mut report);
            assert!(report.problems.is_empty(), "{}\n{sample}", report.into_problems());
            if let Err(error) = T::deserialize(sample) {
                panic!("{error}: {sample}");
            }
        }
        let (mut expected, text) = (BTreeSet::new(), Value::from(samples).to_string());
        constants(schema, &mut expected);
        let lost: Vec<_> = expected.into_iter().filter(|c| !text.contains(&format!("\"{c}\""))).collect();
        assert!(lost.is_empty(), "never tried: {lost:?}");
    }

    #[test]
    fn every_value_that_the_schemas_document_is_accepted() {
        all_documented_values_are_accepted::<Scenario>(&SCENARIO);
        all_documented_values_are_accepted::<Model>(&MODEL);
    }

    #[test]
    fn the_schema_has_no_keyword_that_the_walker_does_not_know() {
        let schemas = serde_json::json!({ "anyOf": [&*SCENARIO, &*MODEL] });
        let mut found = BTreeSet::new();
        keywords(&schemas, &mut found);
        let known: BTreeSet<String> =
            UNDERSTOOD.split_whitespace().chain(ANNOTATIONS.split_whitespace()).map(str::to_owned).collect();
        assert_eq!(found.difference(&known).collect::<Vec<_>>(), Vec::<&String>::new());
        let text = schemas.to_string();
        assert_eq!(
            text.matches("\"pattern\":").count(),
            text.matches(&format!("\"pattern\":\"{NAME_PATTERN}\"")).count()
        );
    }
}
