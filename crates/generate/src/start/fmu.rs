//! A bridge as an FMU in Python, its map, and a scenario that has the same bridge built in to compare with.

use super::{File, Start, beams};
use crate::error::{Refused, Rules};

/// The model, with places for the numbers.
const MODEL: &str = include_str!("bridge.py");
/// Stations of the model: the inner points of 20 equal parts.
const PARTS: usize = 20;

/// Scenario, bridge.py and map.json.
///
/// # Errors
/// Numbers that no bridge has; more than one span.
pub fn fmu(start: &Start) -> Result<Vec<File>, Refused> {
    let mut files = beams(start)?;
    let mut rules = Rules::default();
    rules.demand(start.spans.len() == 1, "the model in bridge.py is one span", format!("{} spans", start.spans.len()));
    rules.result()?;
    let length = start.spans[0];
    let model = MODEL
        .replace("@LENGTH@", &number(length))
        .replace("@MASS@", &number(start.mass()))
        .replace("@N0@", &number(start.frequency()));
    let spacing = length / PARTS as f64;
    let map = format!(
        r#"{{
  "force": {{ "name": "F{{i}}" }},
  "displacement": {{ "name": "w{{i}}" }},
  "velocity": {{ "name": "dw{{i}}" }},
  "stations": {{ "from": {spacing}, "spacing": {spacing} }},
  "bearings": [0.0, {length}]
}}
"#
    );
    files.extend([("bridge.py", model), ("map.json", map)]);
    Ok(files)
}

/// As Python's floats are written.
fn number(x: f64) -> String {
    format!("{x:?}")
}
