//! A folder of results as a report sees it: of one run, or of a sweep.

use std::path::{Path, PathBuf};

use serde_json::Value;
use ttb_assessment::Results;
use ttb_campaign::facts;
use ttb_scenario::Checked;

use super::run::{Assessment, FILE};
use super::tables;
use crate::error::Error;

/// The plan of a sweep.
const PLAN: &str = "plan.json";
/// The scenario of a run.
const RESOLVED: &str = "scenario.resolved.json";

/// What was found in a folder.
pub struct Opened {
    /// Where.
    pub folder: PathBuf,
    /// Runs and rows.
    pub results: Results,
    /// Facts, limits, what is missing.
    pub assessment: Assessment,
    /// The scenario; none of a system structure, or if its file is gone.
    pub checked: Option<Checked>,
    /// The plan of a sweep.
    pub plan: Option<Value>,
    /// The summary of a run.
    pub summary: Option<Value>,
    /// What was noticed.
    pub warnings: Vec<String>,
}

impl Opened {
    /// Reads tables and descriptions.
    pub fn new(folder: &Path) -> Result<Self, Error> {
        let lacking = [tables::RUNS, tables::PEAKS].into_iter().find(|name| !folder.join(name).is_file());
        if let Some(name) = lacking {
            return Err(Error::Input(format!(
                "{}: it has no {name}: give the folder of a run that reached its end, or of a sweep",
                folder.display()
            )));
        }
        let mut results = tables::read(folder)?.with_amplification();
        let (plan, summary) = (json(&folder.join(PLAN))?, json(&folder.join("summary.json"))?);
        let mut warnings = Vec::new();
        let checked = scenario(folder, plan.as_ref(), &mut warnings);
        let path = folder.join(FILE);
        let assessment = match std::fs::read_to_string(&path) {
            Ok(text) => serde_json::from_str(&text).map_err(|e| Error::Input(format!("{}: {e}", path.display())))?,
            Err(_) => Assessment {
                title: checked.as_ref().map_or_else(String::new, |checked| checked.scenario.title.clone()),
                facts: checked.as_ref().map(facts::of).unwrap_or_default(),
                ..Assessment::default()
            },
        };
        results.missing.clone_from(&assessment.missing);
        if let Some(list) = summary.as_ref().and_then(|summary| summary["warnings"].as_array()) {
            warnings.extend(list.iter().filter_map(Value::as_str).map(str::to_string));
        }
        Ok(Self { folder: folder.into(), results, assessment, checked, plan, summary, warnings })
    }
}

/// A JSON file, if it is there.
fn json(path: &Path) -> Result<Option<Value>, Error> {
    match std::fs::read_to_string(path) {
        Ok(text) => serde_json::from_str(&text).map(Some).map_err(|e| Error::Input(format!("{}: {e}", path.display()))),
        Err(_) => Ok(None),
    }
}

/// The scenario of a run or of a plan. A report without it is less, not nothing.
fn scenario(folder: &Path, plan: Option<&Value>, warnings: &mut Vec<String>) -> Option<Checked> {
    let path = match plan {
        Some(plan) => folder.join(plan["scenario"].as_str()?),
        None => Some(folder.join(RESOLVED)).filter(|path| path.is_file())?,
    };
    match ttb_scenario::load(&path) {
        Ok(checked) => Some(checked),
        Err(problems) => {
            warnings.push(format!("the scenario is not shown: {problems}"));
            None
        }
    }
}
