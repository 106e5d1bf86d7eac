//! Broken scenarios: each is a good one with a change, and must give exactly the problems listed, all at once, each with its
//! path and its rule.

mod frame;
mod rules;
mod schema;
mod text;

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use serde_json::Value;
use ttb_scenario::{Problems, from_str};

const BEAMS: &str = include_str!("beams.json");
const FRAME: &str = include_str!("frame.json");

/// What is done to the scenario, and what must be found.
pub struct Case {
    name: &'static str,
    /// (JSON pointer, JSON to put there); no JSON: take away what is there.
    changes: &'static [(&'static str, &'static str)],
    /// (path, rule).
    expected: &'static [(&'static str, &'static str)],
}

pub fn case(
    name: &'static str,
    changes: &'static [(&'static str, &'static str)],
    expected: &'static [(&'static str, &'static str)],
) -> Case {
    Case { name, changes, expected }
}

/// Where the measured profiles of the tests lie.
pub fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/broken")
}

/// Runs every case of a table; reports all that fail.
pub fn try_all(base: &str, cases: &[Case]) {
    let mut failures = Vec::new();
    for case in cases {
        let mut scenario: Value = serde_json::from_str(base).unwrap();
        for (pointer, json) in case.changes {
            change(&mut scenario, pointer, json);
        }
        let result = from_str(&scenario.to_string(), &folder(), "broken.json");
        let found = result.err().unwrap_or(Problems(Vec::new()));
        let pairs: BTreeSet<_> = found.0.iter().map(|p| (p.path.as_str(), p.rule.as_str())).collect();
        if pairs != case.expected.iter().copied().collect() || found.0.len() != case.expected.len() {
            failures.push(format!("{}:\n{found}\nexpected {:#?}", case.name, case.expected));
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n\n"));
}

/// Puts JSON at the place `pointer` names, or takes away what is there.
fn change(scenario: &mut Value, pointer: &str, json: &str) {
    let (parent, key) = pointer.rsplit_once('/').unwrap();
    match (scenario.pointer_mut(parent).unwrap(), json) {
        (Value::Object(map), "") => drop(map.remove(key).unwrap()),
        (Value::Object(map), json) => drop(map.insert(key.to_owned(), serde_json::from_str(json).unwrap())),
        (Value::Array(list), json) => {
            let value = serde_json::from_str(json).unwrap();
            match key.parse::<usize>() {
                Ok(i) => list[i] = value,
                Err(_) => list.push(value),
            }
        }
        _ => panic!("{pointer} is no place"),
    }
}

#[test]
fn the_scenarios_that_are_broken_here_are_whole() {
    for base in [BEAMS, FRAME] {
        let checked = from_str(base, &folder(), "base").unwrap_or_else(|problems| panic!("{problems}"));
        assert_eq!(checked.warnings, Vec::<String>::new());
    }
}
