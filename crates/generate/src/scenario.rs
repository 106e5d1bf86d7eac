//! Scenarios for the models: a train over them, as text.
//!
//! The distance run is that of the bundled scenario: the leading wheel starts 40 m before the bridge and stops 232 m behind it, so
//! that the ICE 3's last wheel, 195 m behind the first, leaves it too. The whole train stands on the rail all the time.

use ttb_scenario::types::Model;

use crate::plan;

/// Abscissa of the bridge's begin, m.
const BRIDGE: f64 = 248.0;
/// Leading wheel at the start, m.
const FRONT: f64 = 208.0;
/// How far the leading wheel runs over the bridge's end, m, and how far the rail goes on behind it.
const BEHIND: [f64; 2] = [232.0, 14.0];
/// Distance of supports of the bundled ballasted tracks, m.
const SPACING: f64 = 0.545;
/// Speed, km/h.
const SPEED: f64 = 250.0;

/// An ICE 3 of 8 cars over [`cable_stayed`](crate::cable_stayed()), whose file is called `file`: 560 m at 250 km/h in
/// 8.064 s. Point A is the middle of the main span.
///
/// Damping: 2 % at 0.8 Hz, the first vertical frequency or nearly, and at ten times that. With `highest_frequency` (Hz)
/// the bridge is reduced to its modes up to there.
#[must_use]
pub fn cable_stayed_scenario(model: &Model, file: &str, highest_frequency: Option<f64>) -> String {
    let length = model.deck.length;
    let approach = 0.5 * (length - plan::LENGTH);
    let main = |part: f64| approach + part * plan::SPANS[0];
    let mut points = vec![
        at("A", main(0.5)),
        at("main-quarter", main(0.25)),
        at("main-three-quarters", main(0.75)),
        at("side", approach + plan::SPANS[0] + 0.5 * plan::SPANS[1]),
        at("before", 0.5 * approach),
    ];
    points.extend(top(model).map(|node| format!(r#"{{ "name": "tower", "node": "{node}", "direction": "x" }}"#)));
    let title =
        "ICE 3 (8 cars) over a cable-stayed bridge of shells, 224 m with a girder at either end, ballasted track";
    scenario(title, file, length, r#"{ "hz": [0.8, 8] }"#, &points, highest_frequency)
}

/// An ICE 3 of 8 cars over [`viaduct`](crate::viaduct()) of `spans` girders, whose file is called `file`; points in the
/// middle of the first, the middle and the last span.
///
/// Damping: 2 % at the first frequency and at ten times that.
#[must_use]
pub fn viaduct_scenario(model: &Model, spans: usize, file: &str) -> String {
    let length = model.deck.length;
    let span = length / spans.max(1) as f64;
    let mut places = vec![("first", 0), ("middle", spans / 2), ("last", spans.saturating_sub(1))];
    places.dedup_by_key(|place| place.1);
    let points: Vec<String> = places.iter().map(|(name, i)| at(name, (*i as f64 + 0.5) * span)).collect();
    let title = format!("ICE 3 (8 cars) over a viaduct of {spans} × {span} m, ballasted track");
    scenario(&title, file, length, r#"{ "first_times": 10 }"#, &points, None)
}

fn at(name: &str, x: f64) -> String {
    format!(r#"{{ "name": "{name}", "x": {} }}"#, crate::lines::rounded(x))
}

/// The highest node, of these the one nearest to the axis.
fn top(model: &Model) -> Option<u32> {
    let height = model.nodes.iter().map(|node| node.3).fold(0.0, f64::min);
    let highest = model.nodes.iter().filter(|node| node.3 == height);
    highest.min_by(|a, b| a.2.abs().total_cmp(&b.2.abs())).map(|node| node.0)
}

fn scenario(
    title: &str,
    file: &str,
    length: f64,
    frequencies: &str,
    points: &[String],
    highest_frequency: Option<f64>,
) -> String {
    let distance = BRIDGE - FRONT + length + BEHIND[0];
    let end = (distance / (SPEED / 3.6) * 1e3 - 1e-6).ceil() / 1e3;
    let bays = ((BRIDGE + length + BEHIND[0] + BEHIND[1]) / SPACING).ceil();
    let file = serde_json::Value::from(file);
    let reduction = highest_frequency
        .map_or_else(String::new, |hertz| format!(",\n    \"reduction\": {{ \"highest_frequency\": {hertz} }}"));
    format!(
        r#"{{
  "title": "{title}",
  "train": {{
    "cars": ["ice3"],
    "front_wheel": {FRONT},
    "speed": {{ "km_h": {SPEED} }},
    "pre_roll": 400
  }},
  "track": {{ "type": "ballast-two-layer", "from": 0, "bays": {bays}, "elements_per_bay": 1 }},
  "irregularity": {{
    "type": "spectrum",
    "spectrum": "german-low",
    "seed": 1,
    "wavelengths": [3, 80]
  }},
  "bridge": {{
    "at": {BRIDGE},
    "structure": {{ "type": "finite-elements", "model": {file} }},
    "damping": {{ "type": "rayleigh", "ratio": 0.02, "at": {frequencies} }},
    "points": [
      {}
    ]{reduction}
  }},
  "time": {{ "step": 1e-3, "end": {end} }}
}}
"#,
        points.join(",\n      ")
    )
}
