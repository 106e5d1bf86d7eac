//! Other values for keys of a scenario, as `--set train.speed.km_h=280` on the command line: a path into the file, then the
//! value as JSON, or as text where it is none.
//!
//! A path is written with dots and numbers in brackets, `bridge.structure.spans[0].mass`. Where an object has exactly one of
//! several keys (`km_h`, `m_s`, `profile`), setting one takes the place of the other; where it has a `type`, setting another
//! type takes away what belongs to the former one alone. Where keys are the user's own, all that follows is one of them:
//! `fmus.bridge.parameters.Deck.EI`. Everything else is checked as if it stood in the file.

use serde_json::{Map, Value};

use crate::json::Document;
use crate::problem::{Report, nearest};
use crate::schema;

/// A key and its value.
#[derive(Clone, Debug, PartialEq)]
pub struct Setting {
    /// The path, such as `train.speed.km_h`.
    pub key: String,
    /// What is put there.
    pub value: Value,
}

/// A part of a path.
#[derive(Clone, Debug, PartialEq)]
enum Part {
    Key(String),
    Index(usize),
}

impl std::str::FromStr for Setting {
    type Err = String;

    /// Reads `KEY=VALUE`.
    fn from_str(text: &str) -> Result<Self, String> {
        let Some((key, value)) = text.split_once('=') else {
            return Err("a setting is written KEY=VALUE, such as train.speed.km_h=280".into());
        };
        let setting = Self {
            key: key.trim().into(),
            value: serde_json::from_str(value.trim()).unwrap_or_else(|_| Value::from(value)),
        };
        parts(&setting.key)?;
        Ok(setting)
    }
}

/// `a.b[0].c`, also `a.b.0.c`; a leading `$.` as in messages is allowed.
fn parts(key: &str) -> Result<Vec<Part>, String> {
    let wrong =
        || format!("`{key}` is no path: keys with dots between them, numbers in brackets, as in train.cars[0].length");
    let mut parts = Vec::new();
    for piece in key.strip_prefix("$.").unwrap_or(key).split('.') {
        let (name, indices) = piece.find('[').map_or((piece, ""), |at| piece.split_at(at));
        match name.parse::<usize>() {
            Ok(index) => parts.push(Part::Index(index)),
            Err(_) if name.is_empty() => return Err(wrong()),
            Err(_) => parts.push(Part::Key(name.into())),
        }
        for index in indices.split_inclusive(']') {
            let index = index.strip_prefix('[').and_then(|index| index.strip_suffix(']')).ok_or_else(wrong)?;
            parts.push(Part::Index(index.trim().parse().map_err(|_| wrong())?));
        }
    }
    Ok(parts)
}

/// Puts all settings into a scenario; those that have no place are reported.
pub(crate) fn apply(settings: &[Setting], document: &mut Document, report: &mut Report) {
    for Setting { key, value } in settings {
        let done = parts(key).and_then(|parts| put(&schema::SCENARIO, &mut document.value, &parts, key, value));
        match done {
            Ok(()) => drop(document.reported.remove(&format!("$.{key}"))),
            Err(why) => report.problem(format!("--set {key}"), why, value),
        }
    }
}

/// Goes along the path, in the value and in the schemas that may describe it.
fn put(root: &Value, mut at: &mut Value, parts: &[Part], key: &str, value: &Value) -> Result<(), String> {
    let mut schemas = vec![root];
    let mut been = String::new();
    for (i, part) in parts.iter().enumerate() {
        let last = i + 1 == parts.len();
        let here = if been.is_empty() { "a scenario".to_string() } else { format!("`{been}`") };
        let branches: Vec<&Value> = schemas.iter().flat_map(|schema| branches(root, schema)).collect();
        match part {
            Part::Key(name) => {
                if branches.iter().any(|branch| has_own_keys(branch)) {
                    // Names of a user's own, such as those of an FMU's variables, may contain dots and brackets.
                    let whole = key.strip_prefix("$.").unwrap_or(key);
                    let own = whole.strip_prefix(&been).and_then(|rest| rest.strip_prefix('.')).unwrap_or(name);
                    if at.is_null() {
                        *at = Value::Object(Map::new());
                    }
                    let Value::Object(map) = at else { return Err(format!("{here} is {} here", short(at))) };
                    map.insert(own.to_string(), value.clone());
                    return Ok(());
                }
                let known =
                    || branches.iter().filter_map(|branch| branch["properties"].as_object()).flat_map(Map::keys);
                if !known().any(|other| other == name) {
                    let meant = nearest(name, known().map(String::as_str));
                    let meant = meant.map_or_else(
                        || format!("it has {}", listed(known())),
                        |meant| format!("did you mean `{}`?", key.replacen(name.as_str(), &meant, 1)),
                    );
                    return Err(match known().next() {
                        None => format!("{here} has no keys inside"),
                        Some(_) => format!("{here} has no key `{name}`: {meant}"),
                    });
                }
                if at.is_null() {
                    *at = Value::Object(Map::new());
                }
                let Value::Object(map) = at else {
                    return Err(format!("{here} is {} here, which has no keys: set it as a whole", short(at)));
                };
                let having = |branch: &&Value| branch["properties"].get(name).is_some();
                let mut fitting: Vec<&Value> = branches.iter().copied().filter(having).collect();
                // One of several keys takes the place of the other.
                let single = |branch: &Value| branch["properties"].as_object().is_some_and(|all| all.len() == 1);
                if branches.len() > 1 && fitting.len() == 1 && single(fitting[0]) && tag(fitting[0]).is_none() {
                    map.retain(|other, _| other == name);
                }
                // Of a type that is set, only what it knows stays; of one that stands there, only its keys are meant.
                let tagged = |value: &Value| {
                    let of = |branch: &&Value| branch["properties"]["type"]["const"] == *value;
                    branches.iter().copied().find(of)
                };
                if last
                    && name == "type"
                    && let Some(branch) = tagged(value)
                {
                    map.retain(|other, _| branch["properties"].get(other).is_some());
                }
                if let Some(branch) = map.get("type").and_then(tagged).filter(|_| name != "type") {
                    if branch["properties"].get(name).is_none() {
                        let known = branch["properties"].as_object().into_iter().flat_map(Map::keys);
                        return Err(format!(
                            "{here} of type {} has no key `{name}`: it has {}",
                            map["type"],
                            listed(known)
                        ));
                    }
                    fitting = vec![branch];
                }
                at = map.entry(name.clone()).or_insert(Value::Null);
                schemas = fitting.iter().map(|branch| &branch["properties"][name]).collect();
                been = if been.is_empty() { name.clone() } else { format!("{been}.{name}") };
            }
            Part::Index(index) => {
                let Value::Array(list) = at else {
                    return Err(format!("{here} is {} and no list", short(at)));
                };
                let (length, index) = (list.len(), *index);
                if index == length && last {
                    list.push(Value::Null);
                }
                at = list.get_mut(index).ok_or_else(|| {
                    format!("{here} has {length} entries, which count from 0: there is no entry {index}")
                })?;
                let item =
                    |branch: &&'_ Value| branch["prefixItems"].get(index).is_some() || branch.get("items").is_some();
                let lists: Vec<&Value> = branches.iter().copied().filter(item).collect();
                schemas = lists.iter().map(|list| list["prefixItems"].get(index).unwrap_or(&list["items"])).collect();
                been = format!("{been}[{index}]");
            }
        }
    }
    *at = value.clone();
    Ok(())
}

/// Whether the keys of an object are the user's own, not the scenario's.
fn has_own_keys(branch: &Value) -> bool {
    branch["properties"].is_null() && branch["additionalProperties"].is_object()
}

/// The constant key that tells a branch from its sisters, if it has one.
fn tag(branch: &Value) -> Option<&Value> {
    branch["properties"].as_object()?.values().find(|property| property.get("const").is_some())
}

/// What a schema may be: itself, or the branches it offers, all the way down.
fn branches<'a>(root: &'a Value, schema: &'a Value) -> Vec<&'a Value> {
    let target = schema["$ref"].as_str().and_then(|name| root.pointer(name.strip_prefix('#')?));
    let schema = target.unwrap_or(schema);
    match schema["oneOf"].as_array().or_else(|| schema["anyOf"].as_array()) {
        Some(inner) => inner.iter().flat_map(|inner| branches(root, inner)).collect(),
        None => vec![schema],
    }
}

fn listed<'a>(keys: impl Iterator<Item = &'a String>) -> String {
    let mut keys: Vec<&str> = keys.map(String::as_str).collect();
    keys.sort_unstable();
    keys.dedup();
    keys.join(", ")
}

/// A value for a message.
fn short(value: &Value) -> String {
    match value {
        Value::Object(_) => "an object".into(),
        Value::Array(_) => "a list".into(),
        other => other.to_string(),
    }
}
