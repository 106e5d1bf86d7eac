//! Where a key belongs that stands at a wrong place: the keys of a track of one's own beside `type` instead of in it.

use std::collections::VecDeque;

use serde_json::Value;

use super::branch::branches;

/// A key is looked for so many levels deep.
const DEPTH: usize = 6;
/// And among so many places at most.
const PLACES: usize = 4000;

/// The nearest place below `path`, or else anywhere, where the schema has this key; none where it is not exactly so called.
pub(super) fn place(root: &Value, key: &str, path: &str) -> Option<String> {
    let mut queue = VecDeque::from([(root, String::from("$"), 0)]);
    let (mut looked, mut other) = (0, None);
    while let Some((schema, at, depth)) = queue.pop_front() {
        looked += 1;
        if looked > PLACES {
            break;
        }
        let target = schema["$ref"].as_str().and_then(|name| root.pointer(name.strip_prefix('#')?));
        let schema = target.unwrap_or(schema);
        for branch in branches(schema).into_iter().flatten() {
            queue.push_back((branch, at.clone(), depth));
        }
        if depth == DEPTH {
            continue;
        }
        if let items @ Value::Object(_) = &schema["items"] {
            queue.push_back((items, format!("{at}[]"), depth + 1));
        }
        for (name, property) in schema["properties"].as_object().into_iter().flatten() {
            let inner = format!("{at}.{name}");
            if name == key && at != plain(path) {
                if at.starts_with(&plain(path)) {
                    return Some(inner.trim_start_matches("$.").to_owned());
                }
                other.get_or_insert(inner.clone());
            }
            queue.push_back((property, inner, depth + 1));
        }
    }
    // A name that many objects have says nothing.
    other.filter(|_| !COMMON.contains(&key)).map(|inner| inner.trim_start_matches("$.").to_owned())
}

/// Keys that mean something else in every object.
const COMMON: [&str; 12] =
    ["name", "type", "x", "mass", "length", "source", "scale", "from", "at", "nodes", "elements", "section"];

/// A path without the numbers of list entries.
fn plain(path: &str) -> String {
    path.split('[').map(|part| part.split_once(']').map_or(part, |(_, rest)| rest)).collect::<Vec<_>>().join("[]")
}
