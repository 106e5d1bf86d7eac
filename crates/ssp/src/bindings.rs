//! ParameterBindings, parameter sets (.ssv) and parameter mappings (.ssm) → values and names.
//!
//! Empty containers are nothing: no bindings, a binding without values, a set without parameters.

use std::collections::hash_map::Entry;
use std::collections::{HashMap, HashSet};

use crate::parameters::{self, Binding, Enumeration, Mapping, NamedUnit, Parameter, ParameterSet, Value, Values};
use crate::problem::Report;
use crate::shared::{enumerations, units, version};
use crate::transform::{boolean, real, transformation};
use crate::tree::{Element, tree};
use crate::types::{Source, Unit};
use crate::uri;

const SET: &str = "application/x-ssp-parameter-set";
const MAPPING: &str = "application/x-ssp-parameter-mapping";

/// All bindings of an element.
pub fn bindings(of: &Element, report: &mut Report) -> Vec<Binding> {
    let bindings = of.children_of("ParameterBindings").iter().filter(|child| child.name == "ParameterBinding");
    bindings.filter_map(|element| binding(element, report)).collect()
}

fn binding(element: &Element, report: &mut Report) -> Option<Binding> {
    of_type(element, SET, report)?;
    let inline = element.child("ParameterValues").and_then(|values| values.children.first());
    let values = match (source(element, report), inline) {
        (Some(_), Some(inline)) => {
            report.problem(&inline.place, "the binding names a source, too: there must be one of them");
            return None;
        }
        (Some(source), None) => Values::File(source),
        (None, Some(set)) => Values::Inline(parameter_set(set, report)?),
        (None, None) => Values::default(),
    };
    let mapping = element.child("ParameterMapping").and_then(|element| mapping(element, report));
    let prefix = element.attribute("prefix").unwrap_or_default().to_string();
    Some(Binding { values, prefix, mapping, place: element.place.clone() })
}

fn mapping(element: &Element, report: &mut Report) -> Option<Mapping> {
    of_type(element, MAPPING, report)?;
    match (source(element, report), element.children.first()) {
        (Some(_), Some(inline)) => {
            report.problem(&inline.place, "the mapping names a source, too: there must be one of them");
            None
        }
        (Some(source), None) => Some(Mapping::File(source)),
        (None, Some(inline)) => Some(Mapping::Inline(entries(inline, report)?)),
        (None, None) => None,
    }
}

/// Nothing if the element is of another type than this one, which is reported.
fn of_type(element: &Element, only: &str, report: &mut Report) -> Option<()> {
    let kind = element.attribute("type").unwrap_or(only).trim();
    if kind.is_empty() || kind == only {
        return Some(());
    }
    report.problem(&element.place, format!("its type is {kind:?}; only {only} is known"));
    None
}

/// The file that an element names, if it names one; an empty name is none.
fn source(element: &Element, report: &mut Report) -> Option<Source> {
    let text = element.attribute("source").filter(|text| !text.trim().is_empty())?;
    let base = element.attribute("sourceBase").unwrap_or("SSD").trim();
    if !matches!(base, "" | "SSD" | "component") {
        report.problem(&element.place, format!("its sourceBase is {base:?}; there are SSD and component"));
    }
    match uri::source(text) {
        Ok(source) => Some(Source { in_component: base == "component", ..source }),
        Err(why) => {
            report.problem(&element.place, format!("the attribute source {why}"));
            None
        }
    }
}

/// Reads the text of a parameter set (.ssv); problems go to `report`, which is the file's.
pub fn read_set(bytes: &[u8], report: &mut Report) -> Option<ParameterSet> {
    parameter_set(&tree(bytes, report)?, report)
}

/// Reads the text of a parameter mapping (.ssm); problems go to `report`, which is the file's.
pub fn read_mapping(bytes: &[u8], report: &mut Report) -> Option<Vec<parameters::Entry>> {
    entries(&tree(bytes, report)?, report)
}

/// The root element is as it must be; else reported.
fn root(element: &Element, name: &str, report: &mut Report) -> Option<()> {
    if element.name != name {
        report.problem(&element.place, format!("is an element {}, not {name}", element.name));
        return None;
    }
    version(element, report);
    Some(())
}

fn parameter_set(element: &Element, report: &mut Report) -> Option<ParameterSet> {
    root(element, "ParameterSet", report)?;
    let (units, enumerations) = (units(element, report), enumerations(element, report));
    let mut names = HashMap::new();
    let mut parameters = Vec::new();
    for child in element.children_of("Parameters").iter().filter(|child| child.name == "Parameter") {
        let Some(name) = child.attribute("name").filter(|name| !name.is_empty()) else {
            report.problem(&child.place, "a parameter needs a name");
            continue;
        };
        let Some(value) = value(child, &units, &enumerations, report) else { continue };
        match names.entry(name) {
            Entry::Vacant(free) => drop(free.insert(value.clone())),
            Entry::Occupied(other) if *other.get() == value => continue,
            Entry::Occupied(_) => {
                report.problem(&child.place, "there is another parameter of this name with another value")
            }
        }
        let (file, place) = (report.file().to_string(), child.place.clone());
        parameters.push(Parameter { name: name.to_string(), value, file, place });
    }
    Some(ParameterSet { name: element.attribute("name").unwrap_or_default().to_string(), parameters })
}

/// The value of a parameter, whatever its type in SSP 1.0 or 2.0.
fn value(parameter: &Element, units: &[Unit], enumerations: &[Enumeration], report: &mut Report) -> Option<Value> {
    let Some(element) =
        parameter.children.iter().find(|child| !matches!(child.name.as_str(), "Dimension" | "Annotations"))
    else {
        report.problem(&parameter.place, "has no value");
        return None;
    };
    let several = element.children.iter().filter(|child| child.name == "Value").count() > 1;
    if several || parameter.child("Dimension").is_some() {
        return Some(Value::Other("an array".into()));
    }
    let single = || element.child("Value").and_then(|value| value.attribute("value"));
    let Some(text) = element.attribute("value").or_else(single).map(str::to_string) else {
        report.problem(&element.place, "has no attribute value");
        return None;
    };
    let mut no = |what: &str| report.problem(&element.place, format!("the attribute value is no {what}: {text:?}"));
    match element.name.as_str() {
        "Real" | "Float64" | "Float32" => {
            let unit = element.attribute("unit").map(str::trim).filter(|name| !name.is_empty()).map(|name| NamedUnit {
                name: name.to_string(),
                base: units.iter().find(|unit| unit.name == name).map(|unit| unit.base),
            });
            Some(Value::Real(real(element, "value", report)?, unit))
        }
        "Integer" | "Int8" | "UInt8" | "Int16" | "UInt16" | "Int32" | "UInt32" | "Int64" | "UInt64" => {
            let whole = text.trim().parse().ok();
            if whole.is_none() {
                no("whole number");
            }
            whole.map(Value::Integer)
        }
        "Boolean" => {
            let truth = boolean(&text);
            if truth.is_none() {
                no("true or false");
            }
            truth.map(Value::Boolean)
        }
        "String" => Some(Value::Text(text)),
        "Enumeration" => {
            let of = enumerations.iter().find(|known| element.attribute("name") == Some(&known.name));
            let number = of.and_then(|of| of.items.iter().find(|(name, _)| *name == text)).map(|(_, number)| *number);
            Some(Value::Item(text, number))
        }
        other => Some(Value::Other(format!("of type {other}"))),
    }
}

fn entries(element: &Element, report: &mut Report) -> Option<Vec<parameters::Entry>> {
    root(element, "ParameterMapping", report)?;
    let mut targets = HashSet::new();
    let mut entries = Vec::new();
    for child in element.children.iter().filter(|child| child.name == "MappingEntry") {
        let (Some(source), Some(target)) = (child.attribute("source"), child.attribute("target")) else {
            report.problem(&child.place, "an entry needs source and target");
            continue;
        };
        // A template that is not filled in maps nothing.
        if source.is_empty() || target.is_empty() {
            continue;
        }
        if !targets.insert(target) {
            report.problem(&child.place, format!("there is another entry for the target {target}"));
        }
        entries.push(parameters::Entry {
            source: source.to_string(),
            target: target.to_string(),
            suppress_unit_conversion: child.attribute("suppressUnitConversion").and_then(boolean).unwrap_or(false),
            transformation: transformation(child, report),
            file: report.file().to_string(),
            place: child.place.clone(),
        });
    }
    Some(entries)
}
