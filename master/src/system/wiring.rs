//! The connections of a system structure against the FMUs they connect.

use std::collections::HashMap;

use ttb_fmi::Linear;
use ttb_fmi::description::{ModelDescription, ScalarVariable, VariableType};
use ttb_ssp::{BaseUnit, Component, Connection, Connector, Kind, Report, Structure, Type};

/// A component and what its FMU says.
pub type Side<'a> = (&'a Component, &'a ModelDescription);

/// A connection whose both ends exist and fit.
#[derive(Clone, Debug)]
pub struct Link {
    /// Index of the component it starts from, 0 or 1; it ends in the other.
    pub from: usize,
    /// The output.
    pub output: String,
    /// The input.
    pub input: String,
    /// From the output's unit to SI.
    pub to_si: Linear,
    /// From SI to the input's unit, transformation included.
    pub from_si: Linear,
    /// From the input's unit to SI.
    pub input_to_si: Linear,
    /// Whether it carries forces.
    pub is_force: bool,
}

const NEWTON: [i32; 8] = [1, 1, -2, 0, 0, 0, 0, 0];

/// What connections refer to, by name.
struct Names<'a> {
    connectors: [HashMap<&'a str, &'a Connector>; 2],
    units: HashMap<&'a str, BaseUnit>,
}

/// One end of a connection.
struct End<'a> {
    side: usize,
    variable: &'a ScalarVariable,
    unit: Option<BaseUnit>,
}

/// All connections between the two components.
pub fn links(structure: &Structure, sides: &[Side; 2], report: &mut Report) -> Vec<Link> {
    let names = Names {
        connectors: sides.map(|(component, _)| component.connectors.iter().map(|c| (c.name.as_str(), c)).collect()),
        units: structure.units.iter().map(|unit| (unit.name.as_str(), unit.base)).collect(),
    };
    for (component, description) in sides {
        connectors(&names, component, description, report);
    }
    let mut driven: HashMap<(usize, &str), &str> = HashMap::new();
    let mut links = Vec::new();
    for connection in &structure.system.connections {
        let place = connection.place.as_str();
        // What goes out to the system's own connectors drives nothing here.
        let (Some(start), Some(end)) = (&connection.start.0, &connection.end.0) else {
            if connection.start.0.is_none() {
                report.problem(
                    place,
                    format!("starts from the system's own connector {}, which nothing drives", connection.start.1),
                );
            }
            continue;
        };
        let start = find(&names, sides, (start, &connection.start.1), "output", place, report);
        let end = find(&names, sides, (end, &connection.end.1), "input", place, report);
        let (Some(start), Some(end)) = (start, end) else { continue };
        if start.side == end.side {
            report.problem(place, "connects a component with itself");
            continue;
        }
        if let Some(other) = driven.insert((end.side, &end.variable.name), place) {
            let other = other.rsplit('/').next().unwrap_or(other);
            report.problem(place, format!("{} is driven already, by {other}", connection.end.1));
            continue;
        }
        links.extend(link(connection, &start, &end, report));
    }
    links
}

/// Connectors that the FMU has not, or has as something else.
fn connectors(names: &Names, component: &Component, description: &ModelDescription, report: &mut Report) {
    for connector in &component.connectors {
        let Some(variable) = description.variable(&connector.name) else {
            report.problem(&connector.place, format!("{} has no variable of this name", component.source));
            continue;
        };
        let fits = match connector.kind {
            Kind::Input => variable.causality == "input",
            Kind::Output => variable.causality == "output",
            _ => true,
        };
        if !fits {
            let kind = Kind::NAMES.iter().find(|(_, kind)| *kind == connector.kind).map_or("", |(name, _)| name);
            report.problem(
                &connector.place,
                format!("is an {kind} here, but in the FMU a variable of causality {}", variable.causality),
            );
        }
        if let Some(Type::Real(Some(unit))) = &connector.kind_of_value {
            let here = names.units.get(unit.as_str());
            let there = variable.unit.as_ref().and_then(|name| unit_of(description, name));
            match (here, there) {
                (None, _) => {
                    report.problem(&connector.place, format!("the unit {unit} is not among the structure's Units"))
                }
                (Some(here), Some(there)) if *here != there => {
                    let name = variable.unit.as_deref().unwrap_or_default();
                    report.problem(&connector.place, format!("is in {unit} here, but in {name} in the FMU"));
                }
                _ => {}
            }
        }
    }
}

fn unit_of(description: &ModelDescription, name: &str) -> Option<BaseUnit> {
    let unit = description.units.get(name)?;
    Some(BaseUnit { powers: unit.powers, factor: unit.factor, offset: unit.offset })
}

/// An end of a connection, or a problem.
fn find<'a>(
    names: &Names,
    sides: &[Side<'a>; 2],
    (element, connector): (&str, &str),
    causality: &str,
    place: &str,
    report: &mut Report,
) -> Option<End<'a>> {
    let Some(side) = sides.iter().position(|(component, _)| component.name == element) else {
        report.problem(place, format!("there is no component {element}"));
        return None;
    };
    let description = sides[side].1;
    let declared = names.connectors[side].get(connector);
    let (Some(declared), variable) = (declared, description.variable(connector)) else {
        report.problem(place, format!("the component {element} has no connector {connector}"));
        return None;
    };
    let variable = variable?; // a problem of the connector, reported there
    let other = matches!(declared.kind_of_value, Some(Type::Other(_)));
    if other || variable.kind != VariableType::Real {
        report.problem(place, format!("{element}: {connector} is no Real"));
        return None;
    }
    if variable.causality != causality {
        report.problem(place, format!("{element}: {connector} is no {causality} but an {}", variable.causality));
        return None;
    }
    let declared = match &declared.kind_of_value {
        Some(Type::Real(Some(unit))) => names.units.get(unit.as_str()).copied(),
        _ => None,
    };
    let own = || variable.unit.as_ref().and_then(|name| unit_of(description, name));
    Some(End { side, variable, unit: declared.or_else(own) })
}

/// `input = factor · (output in the input's unit) + offset`, by way of SI.
fn link(connection: &Connection, start: &End, end: &End, report: &mut Report) -> Option<Link> {
    let none = BaseUnit { powers: [0; 8], factor: 1.0, offset: 0.0 };
    let from = start.unit.unwrap_or(none);
    let convert = |to: BaseUnit| (from.factor / to.factor, (from.offset - to.offset) / to.factor);
    let (scale, shift) = match (start.unit, end.unit) {
        (Some(_), Some(to)) if !connection.suppress_unit_conversion => {
            if from.powers != to.powers {
                let name = |end: &End| end.variable.unit.clone().unwrap_or_else(|| "another".into());
                let (a, b) = (name(start), name(end));
                report.problem(
                    &connection.place,
                    format!("{} is in {a}, {} in {b}", connection.start.1, connection.end.1),
                );
                return None;
            }
            convert(to)
        }
        _ => (1.0, 0.0),
    };
    let (f, o) = (connection.factor, connection.offset);
    if f == 0.0 {
        report.problem(&connection.place, "its factor is 0: nothing would pass");
        return None;
    }
    Some(Link {
        from: start.side,
        output: start.variable.name.clone(),
        input: end.variable.name.clone(),
        to_si: Linear { factor: from.factor, offset: from.offset },
        from_si: Linear {
            factor: f * (scale / from.factor),
            offset: f * (shift - scale * from.offset / from.factor) + o,
        },
        input_to_si: end.unit.map_or(Linear::IDENTITY, |to| Linear { factor: to.factor, offset: to.offset }),
        is_force: from.powers == NEWTON,
    })
}
