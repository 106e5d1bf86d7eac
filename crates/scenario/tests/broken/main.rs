//! Broken scenarios: each is a good one with a change, and must give exactly the problems listed, all at once, each with its
//! path and its rule.

mod frame;
mod rules;
mod schema;
mod space;
mod text;

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use serde_json::Value;
use ttb_scenario::{Problems, from_str};

const BEAMS: &str = include_str!("beams.json");
const FRAME: &str = include_str!("frame.json");
const SPACE: &str = include_str!("space.json");

/// What is done to the scenario, and what must be found.
struct Case {
    name: &'static str,
    /// (JSON pointer, JSON to put there); no JSON: take away what is there. `%` stands for the pointer to the frame
    /// or model.
    changes: &'static [(&'static str, &'static str)],
    /// (path, rule). `%` stands for the path of the frame or model.
    expected: &'static [(&'static str, &'static str)],
}

fn case(
    name: &'static str,
    changes: &'static [(&'static str, &'static str)],
    expected: &'static [(&'static str, &'static str)],
) -> Case {
    Case { name, changes, expected }
}

/// Where the measured profiles of the tests lie.
fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/broken")
}

/// Runs every case of a table; reports all that fail.
fn try_all(base: &str, cases: &[Case]) {
    let mut failures = Vec::new();
    let inner = if base == SPACE { "model" } else { "frame" };
    for case in cases {
        let mut scenario: Value = serde_json::from_str(base).unwrap();
        for (pointer, json) in case.changes {
            change(&mut scenario, &pointer.replace('%', &format!("/bridge/structure/{inner}")), json);
        }
        let place = format!("$.bridge.structure.{inner}");
        let expected: BTreeSet<_> =
            case.expected.iter().map(|(path, rule)| (path.replace('%', &place), *rule)).collect();
        let result = from_str(&scenario.to_string(), &folder(), "broken.json");
        let found = result.err().unwrap_or(Problems(Vec::new()));
        let pairs: BTreeSet<_> = found.0.iter().map(|p| (p.path.clone(), p.rule.as_str())).collect();
        if pairs != expected || found.0.len() != expected.len() {
            failures.push(format!("{}:\n{found}\nexpected {expected:#?}", case.name));
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
    for base in [BEAMS, FRAME, SPACE] {
        let checked = from_str(base, &folder(), "base").unwrap_or_else(|problems| panic!("{problems}"));
        assert_eq!(checked.warnings, Vec::<String>::new());
    }
}

/// All JSON pointers into a value.
fn places(value: &Value, at: &str, found: &mut Vec<String>) {
    let inner: Vec<(String, &Value)> = match value {
        Value::Object(map) => map.iter().map(|(key, value)| (key.clone(), value)).collect(),
        Value::Array(list) => list.iter().enumerate().map(|(i, value)| (i.to_string(), value)).collect(),
        _ => Vec::new(),
    };
    for (key, value) in inner {
        let path = format!("{at}/{key}");
        places(value, &path, found);
        found.push(path);
    }
}

#[test]
fn whatever_stands_wherever_the_answer_is_a_scenario_or_problems() {
    let odd = ["null", "true", "-1", "0", "1", "1e300", "-1e300", "1e-300", "18446744073709551615", "\"\"", "[]", "{}"];
    for base in [BEAMS, FRAME, SPACE] {
        let whole: Value = serde_json::from_str(base).unwrap();
        let mut found = Vec::new();
        places(&whole, "", &mut found);
        for place in &found {
            for value in odd {
                let mut scenario = whole.clone();
                change(&mut scenario, place, value);
                if let Err(problems) = from_str(&scenario.to_string(), &folder(), "odd.json") {
                    assert!(!problems.0.is_empty(), "{place} = {value}");
                    assert!(
                        problems.0.iter().all(|p| p.rule != "must fit the schema"),
                        "{place} = {value}: {problems}"
                    );
                }
            }
        }
    }
}
