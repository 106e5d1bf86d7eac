//! What can be wrong with a modelDescription.xml that can be read.

use std::collections::HashMap;

use ttb_fmi::description::{ModelDescription, ScalarVariable, VariableType};

use super::finding::Finding;

/// Findings of a name that are listed one by one; the rest is counted.
const LISTED: usize = 5;

/// All of them.
pub fn sanity(d: &ModelDescription, xml: &[u8]) -> Vec<Finding> {
    let mut found = Vec::new();
    if xml.windows(8).any(|w| w == b"<!ENTITY") {
        let what = "modelDescription.xml defines entities of its own: some importers expand them without end";
        found.push(Finding::error("xml-entities", what));
    }
    if d.guid.trim().is_empty() {
        found.push(Finding::error("guid-empty", "the attribute guid is missing or empty"));
    }
    if d.co_simulation.needs_execution_tool {
        let tool = if d.generation_tool.is_empty() { "its tool" } else { &d.generation_tool };
        found.push(Finding::warning("needs-tool", format!("it runs only where {tool} is installed")));
    }
    let experiment = [("startTime", d.start_time), ("stopTime", d.stop_time), ("stepSize", d.step_size)];
    for (name, value) in experiment {
        if value.is_some_and(|x| !x.is_finite() || (name == "stepSize" && x <= 0.0)) {
            found.push(Finding::error("experiment", format!("DefaultExperiment has no usable {name}")));
        }
    }
    if d.stop_time.is_some_and(|stop| stop <= d.start_time.unwrap_or(0.0)) {
        found.push(Finding::error("experiment", "DefaultExperiment stops before it starts"));
    }
    found.extend(duplicates(d));
    found.extend(some(d, "variable", variable));
    found.extend(some(d, "unit-undefined", |v| {
        let unit = v.unit.as_ref().filter(|unit| !d.defined_units.contains(*unit))?;
        Some(Finding::warning("unit-undefined", format!("the unit {unit} of {} is defined nowhere", v.name)))
    }));
    found
}

/// The first findings about variables, and how many more there are.
fn some(d: &ModelDescription, name: &str, check: impl Fn(&ScalarVariable) -> Option<Finding>) -> Vec<Finding> {
    let mut all: Vec<Finding> = d.variables.iter().filter_map(check).collect();
    let more = all.len().saturating_sub(LISTED);
    if more > 0 {
        all.truncate(LISTED);
        all.push(Finding {
            severity: all[0].severity,
            ..Finding::error(name, format!("and {more} more of this kind"))
        });
    }
    all.iter_mut().for_each(|finding| finding.at = "modelDescription.xml".into());
    all
}

/// Attributes of a variable that contradict each other.
fn variable(v: &ScalarVariable) -> Option<Finding> {
    const CAUSALITIES: [&str; 6] = ["parameter", "calculatedParameter", "input", "output", "local", "independent"];
    const VARIABILITIES: [&str; 5] = ["constant", "fixed", "tunable", "discrete", "continuous"];
    let (name, causality, variability) = (&v.name, v.causality.as_str(), v.variability.as_str());
    let no = |what: String| Some(Finding::error("variable", what));
    if !CAUSALITIES.contains(&causality) {
        return no(format!("{name} has the causality {causality}, which FMI 2.0 does not know"));
    }
    if !VARIABILITIES.contains(&variability) {
        return no(format!("{name} has the variability {variability}, which FMI 2.0 does not know"));
    }
    let allowed: &[&str] = match causality {
        "parameter" | "calculatedParameter" => &["fixed", "tunable"],
        "input" => &["discrete", "continuous"],
        "output" => &["constant", "discrete", "continuous"],
        "independent" => &["continuous"],
        _ => &VARIABILITIES,
    };
    // The default, continuous, is no choice for a type that is not Real: whoever wrote it left the attribute out.
    if !allowed.contains(&variability) {
        return no(format!("{name} is {variability}, which a variable of causality {causality} cannot be"));
    }
    if variability == "continuous" && v.kind != VariableType::Real && causality != "local" {
        return no(format!("{name} is continuous, but no Real"));
    }
    if v.start.is_none() && matches!(causality, "input" | "parameter") {
        return no(format!("{name} is an {causality} without start value").replace("an p", "a p"));
    }
    let number = v.start.as_ref().filter(|_| v.kind == VariableType::Real)?;
    match number.trim().parse::<f64>() {
        Ok(x) if x.is_finite() => None,
        _ => no(format!("the start value {number:?} of {name} is no number")),
    }
}

/// Names that occur twice, and value references that two inputs or parameters share. Variables that cannot both be set may share
/// one: they are aliases.
fn duplicates(d: &ModelDescription) -> Vec<Finding> {
    let mut names: HashMap<&str, usize> = HashMap::new();
    d.variables.iter().for_each(|v| *names.entry(&v.name).or_default() += 1);
    let mut settable: HashMap<u32, &str> = HashMap::new();
    let twice = some(d, "duplicate-name", |v| {
        let count = names.get(v.name.as_str()).copied().filter(|count| *count > 1)?;
        Some(Finding::error("duplicate-name", format!("{count} variables are called {}", v.name)))
    });
    let mut found: Vec<Finding> = Vec::new();
    for finding in twice {
        if !found.iter().any(|other| other.same(&finding)) {
            found.push(finding);
        }
    }
    for v in d.variables.iter().filter(|v| matches!(v.causality.as_str(), "input" | "parameter")) {
        if v.kind != VariableType::Real {
            continue;
        }
        if let Some(other) = settable.insert(v.value_reference, &v.name)
            && other != v.name
        {
            let what = format!("{other} and {} have the same value reference {}", v.name, v.value_reference);
            found.push(Finding::error("duplicate-reference", what).at("modelDescription.xml"));
        }
    }
    found
}
