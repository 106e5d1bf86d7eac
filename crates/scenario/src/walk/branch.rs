//! Which branch of a `oneOf` or `anyOf` was meant: by constant, by tag, by JSON type, or by the key that is there.

use serde_json::Value;

use super::walker::{Walker, in_words, shown};
use crate::problem::nearest;

/// The branches of a schema that has some.
pub(super) fn branches(schema: &Value) -> Option<&Vec<Value>> {
    schema["oneOf"].as_array().or_else(|| schema["anyOf"].as_array())
}

/// The JSON types a schema admits; none said: none.
pub(super) fn types(schema: &Value) -> impl Iterator<Item = &str> {
    let listed = schema["type"].as_array().into_iter().flatten().filter_map(Value::as_str);
    schema["type"].as_str().into_iter().chain(listed)
}

/// Whether the value's JSON type is among those the schema admits.
pub(super) fn admits(schema: &Value, value: &Value) -> bool {
    types(schema).any(|kind| match kind {
        "object" => value.is_object(),
        "array" => value.is_array(),
        "number" => value.is_number(),
        "integer" => value.is_u64() || value.is_i64(),
        "string" => value.is_string(),
        "boolean" => value.is_boolean(),
        _ => value.is_null(),
    })
}

impl<'a> Walker<'a> {
    /// All branches, those of a branch that only names others in its place: an enumeration or null is one list.
    fn flatten(&self, branches: &'a [Value], into: &mut Vec<&'a Value>) {
        for branch in branches.iter().map(|branch| self.resolve(branch)) {
            match self::branches(branch) {
                Some(inner) => self.flatten(inner, into),
                None => into.push(branch),
            }
        }
    }

    /// The branch that was meant; if that cannot be told, why not is reported.
    pub(super) fn choose(&mut self, branches: &'a [Value], value: &Value, path: &str) -> Option<&'a Value> {
        let mut resolved = Vec::new();
        self.flatten(branches, &mut resolved);
        if let Some(meant) = resolved.iter().find(|branch| branch.get("const").is_some_and(|c| c == value)) {
            return Some(meant);
        }
        if resolved.iter().all(|branch| branch.get("const").is_some()) {
            self.not_among(resolved.iter().filter_map(|branch| branch["const"].as_str()), value, path);
            return None;
        }
        if let Some(text) = value.as_str()
            && let words = resolved.iter().filter_map(|branch| branch["const"].as_str()).collect::<Vec<_>>()
            && let [word, more @ ..] = words.as_slice()
        {
            if !more.is_empty() {
                self.not_among(words.iter().copied(), value, path);
                return None;
            }
            let others = resolved.iter().flat_map(|b| types(b)).filter(|kind| *kind != "string").map(in_words);
            let rule = others.fold(format!("must be {word}"), |rule, other| rule + " or " + other);
            self.report.suggest(path, rule, shown(value), nearest(text, std::iter::once(*word)));
            return None;
        }
        let fitting: Vec<&Value> = resolved.iter().copied().filter(|branch| admits(branch, value)).collect();
        match (fitting.as_slice(), value) {
            ([], _) => {
                let mut wanted: Vec<_> = resolved.iter().flat_map(|b| types(b)).filter(|t| *t != "null").collect();
                wanted.dedup();
                let wanted: Vec<_> = wanted.into_iter().map(in_words).collect();
                self.report.problem(path, format!("must be {}", wanted.join(" or ")), shown(value));
                None
            }
            ([only], _) => Some(only),
            ([first, ..], Value::Object(map)) => match tag(first) {
                Some(tag) => self.by_tag(&fitting, tag, map.get(tag), path),
                None => self.by_key(&fitting, map, path),
            },
            ([first, ..], _) => Some(first),
        }
    }

    /// Branches that differ in a constant under the same key.
    fn by_tag(&mut self, branches: &[&'a Value], tag: &str, found: Option<&Value>, path: &str) -> Option<&'a Value> {
        let constant = |branch: &'a Value| &branch["properties"][tag]["const"];
        let Some(found) = found else {
            self.report.problem(format!("{path}.{tag}"), "missing key", format!("`{tag}`"));
            return None;
        };
        let meant = branches.iter().copied().find(|branch| constant(branch) == found);
        if meant.is_none() {
            let names = branches.iter().filter_map(|branch| constant(branch).as_str());
            self.not_among(names, found, &format!("{path}.{tag}"));
        }
        meant
    }

    /// Branches that differ in which single key they require.
    fn by_key(
        &mut self,
        branches: &[&'a Value],
        map: &serde_json::Map<String, Value>,
        path: &str,
    ) -> Option<&'a Value> {
        let key = |branch: &'a Value| branch["required"][0].as_str().unwrap_or_default();
        let present: Vec<&Value> = branches.iter().copied().filter(|branch| map.contains_key(key(branch))).collect();
        if let [only] = present.as_slice() {
            return Some(only);
        }
        // Of branches with several keys the one that knows most of those that are there.
        let known = |branch: &Value| map.keys().filter(|key| branch["properties"].get(key.as_str()).is_some()).count();
        let most = branches.iter().copied().max_by_key(|branch| known(branch));
        if let Some(meant) = most.filter(|branch| present.is_empty() && known(branch) > 1) {
            return Some(meant);
        }
        let keys: Vec<&str> = branches.iter().map(|branch| key(branch)).collect();
        let rule = format!("must have exactly one of the keys {}", keys.join(", "));
        let found: Vec<String> = map.keys().map(|k| format!("`{k}`")).collect();
        let near = map.keys().find_map(|found| nearest(found, keys.iter().copied()));
        let near = if present.is_empty() { near } else { None };
        self.report.suggest(path, rule, if found.is_empty() { "none".to_owned() } else { found.join(", ") }, near);
        None
    }

    /// A value that is none of the names it should be one of.
    pub(super) fn not_among<'b>(&mut self, names: impl Iterator<Item = &'b str>, value: &Value, path: &str) {
        let names: Vec<&str> = names.collect();
        let near = value.as_str().and_then(|text| nearest(text, names.iter().copied()));
        self.report.suggest(path, format!("must be one of {}", names.join(", ")), shown(value), near);
    }
}

/// The key whose constant tells a branch from its sisters.
fn tag(branch: &Value) -> Option<&str> {
    let properties = branch["properties"].as_object()?;
    properties.iter().find(|(_, property)| property.get("const").is_some()).map(|(key, _)| key.as_str())
}
