//! How a foreign bridge's variables belong to ours: the file `ttb inspect --map` proposes and `ttb run --map` reads.
//!
//! ```json
//! {
//!   "force":        { "name": "f[{i}]",      "first": 0, "factor": 1e-3 },
//!   "displacement": { "name": "Deck.uz_{i}", "first": 0, "factor": -1e3 },
//!   "velocity":     null,
//!   "stations":     { "from": 0.0, "spacing": 2.5 },
//!   "parameters":   { "Deck.EI": 4.4e11 }
//! }
//! ```
//!
//! Our variables are `support[k].force`, `.displacement` and `.velocity` for k = 1 … n in track order, in N, m and m/s,
//! down positive. Theirs at place k has the number `first + k - 1` in place of `{i}`, and for all three
//!
//! ```text
//! their value = factor · our value
//! ```
//!
//! so 1e-3 stands for kN, 1e3 for mm, a negative factor for up positive. In a run in space `force_y`, `displacement_y`,
//! `velocity_y` (to the right) and `moment_x`, `rotation_x`, `angular_velocity_x` (about the track, right side down) do the
//! same for the other components; a component whose force has no key is coupled where the FMU has our names. Without `stations` their places are our supports.

mod fields;

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use ttb_contract::Component;
use ttb_fmi::description::ModelDescription;

use crate::error::Error;
pub use fields::{Even, INDEX, Interpolation, Places, Read, Series, Value};

/// The whole map.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Map {
    /// Inputs of the bridge: forces on the deck.
    #[serde(default = "our_force")]
    pub force: Series,
    /// Outputs: the deck's displacements.
    #[serde(default = "our_displacement")]
    pub displacement: Series,
    /// Outputs: their velocities; null: there are none, they follow from the displacements.
    #[serde(default = "our_velocity")]
    pub velocity: Option<Series>,
    /// Inputs of the bridge in space: forces across the track; absent: by our names, if it has them.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub force_y: Option<Series>,
    /// Outputs: the deck's displacements across the track.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub displacement_y: Option<Series>,
    /// Outputs: their velocities; null: there are none, all velocities follow from displacements and rotations.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub velocity_y: Option<Series>,
    /// Inputs of the bridge in space: moments about the track; absent: by our names, if it has them.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub moment_x: Option<Series>,
    /// Outputs: the deck's rotations about the track.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rotation_x: Option<Series>,
    /// Outputs: their rates; null: there are none, all velocities follow from displacements and rotations.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub angular_velocity_x: Option<Series>,
    /// Where their places are, if they are not our supports.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub stations: Option<Places>,
    /// Shape of the deck between stations.
    #[serde(default, skip_serializing_if = "is_default")]
    pub interpolation: Interpolation,
    /// Where the deck bears without a station, m: it does not move there.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub bearings: Vec<f64>,
    /// Our supports that stand on this bridge, first and last, from 1.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub supports: Option<[usize; 2]>,
    /// Whether to save and restore its state, if it can.
    #[serde(default = "yes", skip_serializing_if = "is_yes")]
    pub roll_back: bool,
    /// Parameters and start values by name, in the FMU's own units.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub parameters: BTreeMap<String, Value>,
    /// The same of the train–track FMU.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub train_track_parameters: BTreeMap<String, Value>,
    /// Where it was read, for messages.
    #[serde(skip)]
    pub path: PathBuf,
}

fn yes() -> bool {
    true
}

fn is_yes(value: &bool) -> bool {
    *value
}

fn is_default<T: Default + PartialEq>(value: &T) -> bool {
    *value == T::default()
}

fn ours(what: &str) -> Series {
    Series { name: Some(format!("support[{INDEX}].{what}")), ..Series::default() }
}
fn our_force() -> Series {
    ours("force")
}
fn our_displacement() -> Series {
    ours("displacement")
}
fn our_velocity() -> Option<Series> {
    Some(ours("velocity"))
}

/// Whether there is one map for all bridges, one for each, or none.
///
/// # Errors
/// There is another number of them.
pub fn maps_fit(bridges: &[PathBuf], maps: &[PathBuf]) -> Result<(), Error> {
    let (bridges, maps) = (bridges.len(), maps.len());
    if maps <= 1 || maps == bridges {
        return Ok(());
    }
    Err(Error::Input(format!("{bridges} bridges and {maps} maps: give one for all, or one for each in the same order")))
}

impl Default for Map {
    /// Our own names.
    fn default() -> Self {
        Self {
            force: our_force(),
            displacement: our_displacement(),
            velocity: our_velocity(),
            force_y: None,
            displacement_y: None,
            velocity_y: None,
            moment_x: None,
            rotation_x: None,
            angular_velocity_x: None,
            stations: None,
            interpolation: Interpolation::default(),
            bearings: Vec::new(),
            supports: None,
            roll_back: true,
            parameters: BTreeMap::new(),
            train_track_parameters: BTreeMap::new(),
            path: PathBuf::new(),
        }
    }
}

impl Map {
    /// Reads the file.
    pub fn load(path: &Path) -> Result<Self, Error> {
        let text = ttb_scenario::read_text(path);
        Self::parse(&text.map_err(|e| Error::Input(format!("{}: {e}", path.display())))?, path)
    }

    /// Reads the text of a file.
    ///
    /// # Errors
    /// Everything that is wrong with it, each with its place.
    pub fn parse(text: &str, path: &Path) -> Result<Self, Error> {
        let refused = |why: String| Error::Input(format!("{}: {why}", path.display()));
        let schema = schemars::schema_for!(Self).to_value();
        let read = ttb_scenario::read_as(text, &schema, &path.display().to_string());
        let mut map: Self = read.map_err(Error::Scenario)?;
        map.path = path.to_path_buf();
        let problems = map.problems();
        if problems.is_empty() { Ok(map) } else { Err(refused(problems.join(&format!("\n{}: ", path.display())))) }
    }

    /// Force, position and rate of a component: as given, or by our names where the bridge has them. `None`: the bridge has no
    /// such component. Of a component whose force the map names its position is needed too, its rate is not.
    pub fn series(&self, component: Component, bridge: &ModelDescription) -> Option<[Option<Series>; 3]> {
        let (force, position, rate) = match component {
            Component::Vertical => {
                return Some([Some(self.force.clone()), Some(self.displacement.clone()), self.velocity.clone()]);
            }
            Component::Lateral => (&self.force_y, &self.displacement_y, &self.velocity_y),
            Component::Roll => (&self.moment_x, &self.rotation_x, &self.angular_velocity_x),
        };
        let or_ours = |given: &Option<Series>, what: &str| {
            given.clone().or_else(|| Some(ours(what)).filter(|series| series.count(bridge) > 0))
        };
        let force = or_ours(force, component.force())?;
        let named = force != ours(component.force());
        let rate = if named { rate.clone() } else { or_ours(rate, component.rate()) };
        Some([Some(force), or_ours(position, component.position()), rate])
    }

    /// Everything that is wrong with it, each with its place.
    fn problems(&self) -> Vec<String> {
        let series = [
            ("force", Some(&self.force)),
            ("displacement", Some(&self.displacement)),
            ("velocity", self.velocity.as_ref()),
            ("force_y", self.force_y.as_ref()),
            ("displacement_y", self.displacement_y.as_ref()),
            ("velocity_y", self.velocity_y.as_ref()),
            ("moment_x", self.moment_x.as_ref()),
            ("rotation_x", self.rotation_x.as_ref()),
            ("angular_velocity_x", self.angular_velocity_x.as_ref()),
        ];
        let told = |(key, series): (&str, Option<&Series>)| series?.problem().map(|rule| format!("$.{key}: {rule}"));
        let mut problems: Vec<String> = series.into_iter().filter_map(told).collect();
        match &self.stations {
            None if !self.bearings.is_empty() => {
                problems.push("$.bearings: belong to stations, and there are none".into())
            }
            Some(Places::Even(Even { from, spacing }))
                if !(from.is_finite() && *spacing > 0.0 && spacing.is_finite()) =>
            {
                problems.push(format!("$.stations: spacing must be positive: {spacing}"));
            }
            Some(Places::Read(read)) if !read.name.contains(INDEX) => {
                problems.push(format!("$.stations: name must contain {INDEX}: `{}`", read.name));
            }
            Some(Places::Read(read)) if !fields::counts(read.first) => {
                problems.push(format!("$.stations: {}", fields::uncounted(read.first)));
            }
            _ => {}
        }
        if let Some([first, last]) = self.supports.filter(|[first, last]| *first == 0 || last < first) {
            problems.push(format!("$.supports: first and last, counted from 1: [{first}, {last}]"));
        }
        problems
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_follow_the_number_and_defaults_are_ours() {
        let text =
            r#"{ "force": { "name": "f[{i}]", "first": 0, "factor": 1e-3 }, "displacement": { "names": ["a", "b"] } }"#;
        let map: Map = serde_json::from_str(text).unwrap();
        let at = |series: &Series, k| series.at(k).unwrap_or_default();
        assert_eq!([at(&map.force, 1), at(&map.force, 12), at(&map.displacement, 2)], ["f[0]", "f[11]", "b"]);
        assert_eq!((map.displacement.at(3), map.displacement.factor), (None, None));
        assert_eq!(at(map.velocity.as_ref().unwrap(), 7), "support[7].velocity");
        assert!(serde_json::from_str::<Map>(&text.replace("first", "frist")).is_err());
        assert_eq!(serde_json::from_str::<Map>("{}").unwrap(), Map::default());
    }

    #[test]
    fn a_first_number_that_cannot_be_counted_from_is_refused() {
        let problems = |text: &str| serde_json::from_str::<Map>(text).unwrap().problems();
        let text = r#"{ "force": { "name": "f{i}", "first": 9223372036854775807 },
                        "stations": { "name": "x{i}", "first": -9223372036854775808 } }"#;
        assert_eq!(problems(text).len(), 2, "{:?}", problems(text));
        assert_eq!(problems(r#"{ "force": { "name": "f{i}", "first": -1000000000 } }"#), Vec::<String>::new());
    }

    #[test]
    fn a_map_that_cannot_be_read_is_told_with_its_places() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("map.json");
        let refused = |text: &str| {
            std::fs::write(&path, text).unwrap();
            let error = Map::load(&path).unwrap_err();
            assert_eq!(error.code(), 2);
            error.to_string()
        };
        let place = path.display();
        for (text, expected) in [
            ("{ \"force\": }", "$.force: not JSON: expected a value: found `}` in line 1, column 12"),
            ("{ \"force\": { \"nmae\": \"f[{i}]\" } }", "$.force.nmae: unknown key: `nmae` (did you mean `name`?)"),
            ("{ \"stations\": { \"from\": 0 } }", "$.stations.spacing: missing key: `spacing`"),
            ("{ \"stations\": \"0, 1\" }", "$.stations: must be a list or an object: \"0, 1\""),
            (
                "{ \"interpolation\": \"qubic\" }",
                "$.interpolation: must be one of linear, cubic: \"qubic\" (did you mean `cubic`?)",
            ),
            ("", "$: not JSON: expected a value: found the end of the file in line 1, column 1"),
        ] {
            let said = refused(text);
            assert!(said.contains(&format!("{place}: {expected}")), "{text}\n{said}");
        }
        // All at once.
        assert_eq!(refused("{ \"forec\": {}, \"velocity\": 3, \"roll_back\": \"no\" }").lines().count(), 3);
    }

    #[test]
    fn all_problems_are_told() {
        let text = r#"{ "force": { "name": "f" }, "displacement": { "name": "u{i}", "names": ["u"] }, "velocity": { "factor": 2 },
                        "bearings": [0.0], "supports": [3, 2] }"#;
        assert_eq!(serde_json::from_str::<Map>(text).unwrap().problems().len(), 5);
    }
}
