//! Parameters and start values that the user gives an FMU, by name and in its own units.

use std::collections::BTreeMap;

use ttb_fmi::FmuInstance;
use ttb_fmi::description::{ModelDescription, ScalarVariable, VariableType};
use ttb_scenario::nearest;

use super::map::Value;
use crate::error::Error;

/// Sets them before initialization.
///
/// # Errors
/// Names that do not exist or may not be set, values of another type: all of them; or the FMU refuses one.
pub fn set(instance: &mut FmuInstance, parameters: &BTreeMap<String, Value>) -> Result<(), Error> {
    let problems = problems(instance.description(), parameters);
    if !problems.is_empty() {
        return Err(Error::Input(format!("{}: {}", instance.name(), problems.join("\n  "))));
    }
    for (name, value) in parameters {
        match value {
            Value::Number(number) => instance.set_number(name, *number)?,
            Value::Boolean(truth) => instance.set_number(name, f64::from(u8::from(*truth)))?,
            Value::Text(text) => {
                let reference = instance.description().variable(name).map_or(0, |variable| variable.value_reference);
                instance.set_string(reference, text)?;
            }
        }
    }
    Ok(())
}

/// Names that do not exist or may not be set, values of another type: all of them.
pub fn problems(description: &ModelDescription, parameters: &BTreeMap<String, Value>) -> Vec<String> {
    let problem = |(name, value): (&String, &Value)| match description.variable(name) {
        None => {
            let settable = description.variables.iter().filter(|v| is_settable(v)).map(|v| v.name.as_str());
            let like = nearest(name, settable).map_or_else(String::new, |like| format!(" (did you mean `{like}`?)"));
            Some(format!("parameters: it has no variable `{name}`{like}"))
        }
        Some(variable) if !is_settable(variable) => {
            Some(format!("parameters: {name} cannot be set: it is a {} {}", variable.variability, variable.causality))
        }
        Some(variable) => misfit(variable, value).map(|kind| format!("parameters: {name} is {kind}, not {value}")),
    };
    parameters.iter().filter_map(problem).collect()
}

/// Whether FMI lets a master set it before initialization: parameters, inputs, and what starts from a value.
pub fn is_settable(variable: &ScalarVariable) -> bool {
    let starts = matches!(variable.initial.as_deref(), Some("exact" | "approx")) || variable.start.is_some();
    match variable.causality.as_str() {
        "parameter" | "input" => true,
        "calculatedParameter" | "independent" => false,
        _ => starts && variable.variability != "constant",
    }
}

/// What kind of value it takes, if not this one.
fn misfit(variable: &ScalarVariable, value: &Value) -> Option<&'static str> {
    let whole = |number: f64| number == f64::from(number as i32);
    match (variable.kind, value) {
        (VariableType::Real, Value::Number(number)) if number.is_finite() => None,
        (VariableType::Integer | VariableType::Enumeration, Value::Number(number)) if whole(*number) => None,
        (VariableType::Boolean, Value::Boolean(_)) | (VariableType::String, Value::Text(_)) => None,
        (VariableType::Real, _) => Some("a Real"),
        (VariableType::Integer, _) => Some("an Integer"),
        (VariableType::Enumeration, _) => Some("an enumeration (an integer)"),
        (VariableType::Boolean, _) => Some("a Boolean"),
        (VariableType::String, _) => Some("a String"),
    }
}

/// Refuses an FMU whose parameter `input_meaning` says that a held force is no mean, where means are sent.
pub fn takes_means(bridge: &mut FmuInstance) -> Result<(), Error> {
    const NAME: &str = "input_meaning";
    let description = bridge.description();
    let variable = description.variable(NAME);
    let items = variable.and_then(|variable| description.enumerations.get(variable.declared_type.as_ref()?)).cloned();
    let Some(items) = items else { return Ok(()) };
    let value = bridge.get_number(NAME)?;
    match items.iter().find(|(_, number)| f64::from(*number) == value) {
        Some((item, _)) if item != "mean" => Err(Error::Input(format!(
            "{}: its parameter {NAME} is {item}, but forces are sent as held means here (coupling.send, time.substeps)",
            bridge.name()
        ))),
        _ => Ok(()),
    }
}

/// Parameters from several places; a later one comes after those before.
pub fn together<'a>(
    first: &BTreeMap<String, Value>,
    others: impl IntoIterator<Item = &'a BTreeMap<String, Value>>,
) -> BTreeMap<String, Value> {
    let mut all = first.clone();
    all.extend(others.into_iter().flatten().map(|(name, value)| (name.clone(), value.clone())));
    all
}
