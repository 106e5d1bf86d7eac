//! A folder of results as a report sees it: of one run, or of a sweep.

use serde::{Deserialize, Serialize};
use serde_json::Value;
use ttb_assessment::{Facts, LossAt, Missing, Results};
use ttb_campaign::foreign::NOTICED;
use ttb_campaign::{Limits, facts};
use ttb_scenario::Checked;

use crate::error::Error;
use crate::files::Files;
use crate::{statics, tables};

/// Name of the file beside the tables of one run, and of a sweep over FMUs.
pub const FILE: &str = NOTICED;

/// What a report must know that is in no table.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Assessment {
    /// For people.
    pub title: String,
    /// Bridge and track.
    pub facts: Facts,
    /// Limits files that the filters were made for.
    pub limits: Vec<String>,
    /// What could not be made.
    pub missing: Vec<Missing>,
    /// Every loss of contact.
    #[serde(default)]
    pub losses: Vec<LossAt>,
    /// What was noticed in the runs of a sweep over FMUs.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub warnings: Vec<String>,
}

/// The plan of a sweep.
const PLAN: &str = "plan.json";
/// The scenario of a run.
const RESOLVED: &str = "scenario.resolved.json";

/// What was found in a folder.
pub struct Opened<'a> {
    /// Its files.
    pub files: &'a dyn Files,
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
    /// Whether an FMU of another program stands for the scenario's bridge.
    pub over_fmu: bool,
    /// What was noticed.
    pub warnings: Vec<String>,
}

impl<'a> Opened<'a> {
    /// Reads tables and descriptions.
    ///
    /// # Errors
    /// A file is missing or cannot be read.
    pub fn new(files: &'a dyn Files) -> Result<Self, Error> {
        let lacking = [tables::RUNS, tables::PEAKS].into_iter().find(|name| !files.has(name));
        if let Some(name) = lacking {
            return Err(Error::Input(format!(
                "{}: it has no {name}: give the folder of a run that reached its end, or of a sweep",
                files.name()
            )));
        }
        let mut results = tables::read(files)?.with_amplification();
        let (plan, summary) = (json(files, PLAN)?, json(files, "summary.json")?);
        let mut warnings = Vec::new();
        let checked = scenario(files, plan.as_ref(), &mut warnings);
        let over_fmu = is_foreign(summary.as_ref()) || has_fmus(plan.as_ref());
        let assessment = match files.text(FILE)? {
            Some(text) => {
                serde_json::from_str(&text).map_err(|e| Error::Input(format!("{}: {e}", files.shown(FILE))))?
            }
            None => Assessment {
                title: checked.as_ref().map_or_else(String::new, |checked| checked.scenario.title.clone()),
                facts: checked.as_ref().map(|checked| facts::of_plan(checked, over_fmu)).unwrap_or_default(),
                ..Assessment::default()
            },
        };
        results.missing.clone_from(&assessment.missing);
        results.statics = match &checked {
            Some(_) if over_fmu => statics::unknown("the bridge is a foreign FMU, whose influence lines are not known"),
            Some(checked) => statics::of(checked),
            None => statics::unknown("the scenario of these results is not known"),
        };
        if let Some(list) = summary.as_ref().and_then(|summary| summary["warnings"].as_array()) {
            warnings.extend(list.iter().filter_map(Value::as_str).map(str::to_string));
        }
        warnings.extend(assessment.warnings.iter().cloned());
        Ok(Self { files, results, assessment, checked, plan, summary, over_fmu, warnings })
    }

    /// The limits that a sweep was asked for with, if it was.
    #[must_use]
    pub fn limits(&self) -> Option<Limits> {
        let texts: Vec<[String; 2]> = serde_json::from_value(self.plan.as_ref()?.get("limits")?.clone()).ok()?;
        (!texts.is_empty()).then_some(Limits { texts })
    }
}

/// Whether the bridges of a plan are FMUs.
fn has_fmus(plan: Option<&Value>) -> bool {
    plan.and_then(|plan| plan["bridges"].as_array()).is_some_and(|bridges| !bridges.is_empty())
}

/// Whether a foreign FMU stands for the scenario's bridge in a run.
fn is_foreign(summary: Option<&Value>) -> bool {
    let inputs = summary.and_then(|summary| summary["inputs"].as_array());
    inputs.is_some_and(|inputs| inputs.iter().any(|one| one["role"] == "bridge"))
}

/// A JSON file, if it is there.
fn json(files: &dyn Files, name: &str) -> Result<Option<Value>, Error> {
    let Some(text) = files.text(name)? else { return Ok(None) };
    serde_json::from_str(&text).map(Some).map_err(|e| Error::Input(format!("{}: {e}", files.shown(name))))
}

/// The scenario of a run or of a plan. A report without it is less, not nothing.
fn scenario(files: &dyn Files, plan: Option<&Value>, warnings: &mut Vec<String>) -> Option<Checked> {
    let name = match plan {
        Some(plan) => plan["scenario"].as_str()?,
        None => Some(RESOLVED).filter(|name| files.has(name))?,
    };
    match files.scenario(name) {
        Ok(checked) => Some(checked),
        Err(problems) => {
            warnings.push(format!("the scenario is not shown: {problems}"));
            None
        }
    }
}
