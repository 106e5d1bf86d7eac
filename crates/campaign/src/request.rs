//! What a user asks for: the options of `ttb sweep`, or a file for `ttb campaign`.
//!
//! ```json
//! {
//!   "scenario": "bridge.json",
//!   "trains": ["hslm-a", "ice2", "mine.csv"],
//!   "speeds": "140:420", "step": "auto", "refine": true,
//!   "seeds": "1:20",
//!   "variants": "bounds",
//!   "axes": { "bridge.damping.ratio": [0.01, 0.015] },
//!   "way": "auto"
//! }
//! ```

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};
use serde_json::Value;

use crate::error::Error;
use crate::foreign::Named;
use crate::list::Written;
use crate::plan::{Variant, Way};

/// What is asked for. What is left out is not varied.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Request {
    /// JSON Schema of the file, for editors; ignored.
    #[serde(rename = "$schema", default, skip_serializing_if = "Option::is_none")]
    pub schema: Option<String>,
    /// The scenario file, from the request's folder.
    pub scenario: PathBuf,
    /// FMUs of other programs in the place of the scenario's bridge, in track order; their files from the request's folder.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub bridges: Vec<Named>,
    /// Keys of the scenario that have other values in all runs.
    #[serde(default)]
    pub set: BTreeMap<String, Value>,
    /// Names of trains, or files; none: the scenario's own.
    #[serde(default)]
    pub trains: Vec<String>,
    /// km/h: a range `"140:420"`, or a list; none: the scenario's own.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub speeds: Option<Written>,
    /// Step of a range of speeds: `"auto"`, or km/h.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub step: Option<Written>,
    /// Whether resonances are refined.
    #[serde(default)]
    pub refine: bool,
    /// Whether moments, shears and reactions are looked at, too (modal way).
    #[serde(default)]
    pub forces: bool,
    /// Seeds of the irregularity, `"1:20"`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub seeds: Option<Written>,
    /// Changes of the scenario: `"bounds"`, or a list.
    #[serde(default)]
    pub variants: Variants,
    /// Keys of the scenario and their values: every combination is a variant.
    #[serde(default)]
    pub axes: BTreeMap<String, Vec<Value>>,
    /// How runs are computed; none: `auto`.
    #[serde(default)]
    pub way: Choice,
    /// In which direction trains cross the bridge.
    #[serde(default)]
    pub heading: Headings,
    /// Limits by which results are judged: names and files.
    #[serde(default)]
    pub limits: Vec<String>,
}

/// In which direction trains cross the bridge.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Headings {
    /// The first axle enters at the bridge's begin.
    #[default]
    Forward,
    /// It enters at the bridge's end.
    Backward,
    /// Every train once in either direction.
    Both,
}

/// The way, or that the program chooses.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Choice {
    /// The program chooses and says why.
    #[default]
    Auto,
    /// As [`Way::Modal`].
    Modal,
    /// As [`Way::OneAxle`].
    OneAxle,
    /// As [`Way::Coupled`].
    Coupled,
}

impl Choice {
    /// The way, if it is given.
    pub fn given(self) -> Option<Way> {
        match self {
            Self::Auto => None,
            Self::Modal => Some(Way::Modal),
            Self::OneAxle => Some(Way::OneAxle),
            Self::Coupled => Some(Way::Coupled),
        }
    }
}

/// Changes of the scenario.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum Variants {
    /// `bounds`, or `bounds:LOW MASS,HIGH MASS,LOW STIFFNESS` as factors.
    Word(String),
    /// These, beside the scenario as it is.
    These(Vec<Variant>),
}

impl Default for Variants {
    fn default() -> Self {
        Self::These(Vec::new())
    }
}

/// Factors of `bounds`: low mass, high mass, low stiffness. No code gives numbers: EN 1991-2 6.4.6.4 asks for bounds of the
/// ballast's density and of stiffness; a user with better knowledge gives their own.
const BOUNDS: [f64; 3] = [0.95, 1.05, 0.9];

impl Variants {
    /// The variants, the scenario as it is first.
    ///
    /// # Errors
    /// What is wrong, a sentence.
    pub fn list(&self) -> Result<Vec<Variant>, String> {
        let mut list = vec![Variant::default()];
        match self {
            Self::Word(word) => {
                let [low, high, soft] = bounds(word)?;
                let of = |name: &str, mass_factor, stiffness_factor| Variant {
                    name: name.into(),
                    mass_factor,
                    stiffness_factor,
                    set: Vec::new(),
                };
                list.extend([of("low mass", low, 1.0), of("high mass, low stiffness", high, soft)]);
            }
            Self::These(these) => {
                for variant in these {
                    if variant.name.is_empty() || list.iter().any(|other| other.name == variant.name) {
                        return Err(format!("every variant must have a name of its own: `{}`", variant.name));
                    }
                    let factors = [variant.mass_factor, variant.stiffness_factor];
                    if factors.iter().any(|factor| !(*factor > 0.0 && factor.is_finite())) {
                        return Err(format!("factors must be positive: {factors:?} of `{}`", variant.name));
                    }
                    list.push(variant.clone());
                }
            }
        }
        Ok(list)
    }
}

fn bounds(word: &str) -> Result<[f64; 3], String> {
    let wrong = || format!("variants must be `bounds`, `bounds:0.95,1.05,0.9` or a file: `{word}`");
    match word.split_once(':') {
        None if word == "bounds" => Ok(BOUNDS),
        Some(("bounds", factors)) => {
            let factors: Vec<f64> = factors.split(',').filter_map(|factor| factor.trim().parse().ok()).collect();
            let factors: [f64; 3] = factors.try_into().map_err(|_| wrong())?;
            if factors.iter().all(|factor| (0.1..=10.0).contains(factor)) { Ok(factors) } else { Err(wrong()) }
        }
        _ => Err(wrong()),
    }
}

impl Request {
    /// Reads a request's file; paths in it count from its folder.
    ///
    /// # Errors
    /// It cannot be read, or is no request.
    pub fn read(path: &Path) -> Result<Self, Error> {
        let text = ttb_scenario::read_text(path).map_err(Error::io(path))?;
        let name = path.display().to_string();
        let mut request: Self =
            serde_json::from_str(&text).map_err(|error| Error::Input(format!("{name}: {error}")))?;
        let folder = path.parent().unwrap_or(Path::new(""));
        request.scenario = folder.join(&request.scenario);
        for Named { fmu, map } in &mut request.bridges {
            std::iter::once(fmu).chain(map).for_each(|file| *file = folder.join(&*file));
        }
        for name in request.trains.iter_mut().chain(&mut request.limits) {
            let beside = folder.join(&*name);
            if beside.is_file() {
                *name = beside.display().to_string();
            }
        }
        Ok(request)
    }

    /// Every combination of the axes, with a name each; one without a name if there are no axes.
    pub fn combinations(&self) -> Vec<(String, Vec<(String, Value)>)> {
        let mut all = vec![(String::new(), Vec::new())];
        for (key, values) in &self.axes {
            let with = |(name, set): &(String, Vec<(String, Value)>), value: &Value| {
                let between = if name.is_empty() { "" } else { ", " };
                let mut set = set.clone();
                set.push((key.clone(), value.clone()));
                (format!("{name}{between}{key}={value}"), set)
            };
            all = all.iter().flat_map(|one| values.iter().map(move |value| with(one, value))).collect();
        }
        all
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn axes_combine_and_bounds_have_names() {
        let text = r#"{ "scenario": "a.json", "axes": { "b": [1, 2], "a": ["x"] }, "variants": "bounds:0.9,1.1,0.8" }"#;
        let request: Request = serde_json::from_str(text).unwrap();
        let names: Vec<String> = request.combinations().into_iter().map(|(name, _)| name).collect();
        assert_eq!(names, [r#"a="x", b=1"#, r#"a="x", b=2"#]);
        let variants = request.variants.list().unwrap();
        assert_eq!((variants.len(), variants[1].mass_factor, variants[2].stiffness_factor), (3, 0.9, 0.8));
        assert!(Variants::Word("bound".into()).list().is_err());
        assert!(Variants::Word("bounds:1,2".into()).list().is_err());
        assert!(serde_json::from_str::<Request>(r#"{ "scenario": "a", "train": ["x"] }"#).is_err());
    }

    #[test]
    fn files_of_a_request_are_sought_beside_it() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("request.json");
        let text = r#"{ "scenario": "a.json", "bridges": [{ "fmu": "b.fmu", "map": "c.json" }, { "fmu": "/d.fmu" }] }"#;
        std::fs::write(&path, text).unwrap();
        let Request { scenario, bridges, .. } = Request::read(&path).unwrap();
        let beside = |name: &str| folder.path().join(name);
        assert_eq!((scenario, &bridges[0].fmu), (beside("a.json"), &beside("b.fmu")));
        assert_eq!((&bridges[0].map, &bridges[1].fmu), (&Some(beside("c.json")), &beside("/d.fmu")));
    }
}
