//! The wires of a system structure against the FMUs they connect.

use std::collections::HashMap;

use ttb_fmi::Linear;
use ttb_fmi::description::{ModelDescription, ScalarVariable, VariableType};
use ttb_ssp::{BaseUnit, Component, Connector, Flat, Kind, Report, Transformation, Type, Wire};

/// A component and what its FMU says.
pub type Side<'a> = (&'a Component, &'a ModelDescription);

/// A wire whose both ends exist and fit.
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
    /// From the output's value to the input's, both as the FMUs have them.
    pub line: Linear,
    /// Whether it carries forces.
    pub is_force: bool,
    /// Where its last connection stands.
    pub place: String,
}

const NEWTON: [i32; 8] = [1, 1, -2, 0, 0, 0, 0, 0];

/// Units that the structure defines, by name.
pub type Units<'a> = HashMap<&'a str, BaseUnit>;

/// A component by the names of its connectors.
struct Known<'a> {
    component: &'a Component,
    description: &'a ModelDescription,
    connectors: HashMap<&'a str, &'a Connector>,
}

/// One end of a connection.
struct End<'a> {
    variable: &'a ScalarVariable,
    unit: Option<BaseUnit>,
}

/// All wires between the two components.
pub fn links(flat: &Flat, units: &Units, sides: &[Side; 2], report: &mut Report) -> Vec<Link> {
    let known = sides.map(|(component, description)| {
        let connectors = component.connectors.iter().map(|connector| (connector.name.as_str(), connector)).collect();
        Known { component, description, connectors }
    });
    let mut links = Vec::new();
    for wire in &flat.wires {
        let [start, end] = [(&wire.from, "output"), (&wire.to, "input")]
            .map(|((side, name), causality)| find(units, known.get(*side)?, name, causality, &wire.place, report));
        let (Some(start), Some(end)) = (start, end) else { continue };
        links.extend(link(wire, &start, &end, report));
    }
    links
}

/// Connectors that the FMU has not, or has as something else.
///
/// Parameters that the FMU does not have and nobody connects are returned for a warning: tools list some of their own.
pub fn connectors(
    units: &Units,
    (component, description): &Side,
    connected: &dyn Fn(&str) -> bool,
    report: &mut Report,
) -> Vec<String> {
    let mut unknown = Vec::new();
    for connector in &component.connectors {
        let Some(variable) = description.variable(&connector.name) else {
            if !matches!(connector.kind, Kind::Input | Kind::Output) && !connected(&connector.name) {
                unknown.push(connector.name.clone());
                continue;
            }
            report.problem(&connector.place, format!("{} has no variable of this name", component.source));
            continue;
        };
        let fits = match connector.kind {
            Kind::Input => variable.causality == "input",
            Kind::Output => variable.causality == "output",
            _ => true,
        };
        if !fits {
            let kind = connector.kind.name();
            report.problem(
                &connector.place,
                format!("is an {kind} here, but in the FMU a variable of causality {}", variable.causality),
            );
        }
        if let Some(Type::Real(Some(unit))) = &connector.kind_of_value {
            let here = units.get(unit.as_str());
            let there = variable.unit.as_ref().and_then(|name| unit_of(description, name));
            match (here, there) {
                // The FMU's own name for its unit needs no definition here.
                (None, _) if variable.unit.as_ref() == Some(unit) => {}
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
    unknown
}

/// What a unit of an FMU is.
pub fn unit_of(description: &ModelDescription, name: &str) -> Option<BaseUnit> {
    let unit = description.units.get(name)?;
    Some(BaseUnit { powers: unit.powers, factor: unit.factor, offset: unit.offset })
}

/// An end of a wire, or a problem.
fn find<'a>(
    units: &Units,
    Known { component, description, connectors }: &Known<'a>,
    connector: &str,
    causality: &str,
    place: &str,
    report: &mut Report,
) -> Option<End<'a>> {
    let element = &component.name;
    let declared = connectors.get(connector)?;
    let variable = description.variable(connector)?; // a problem of the connector, reported there
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
        Some(Type::Real(Some(unit))) => units.get(unit.as_str()).copied(),
        _ => None,
    };
    let own = || variable.unit.as_ref().and_then(|name| unit_of(description, name));
    Some(End { variable, unit: declared.or_else(own) })
}

/// `input = factor · (output in the input's unit) + offset` on every hop of the way.
fn link(wire: &Wire, start: &End, end: &End, report: &mut Report) -> Option<Link> {
    let none = BaseUnit { powers: [0; 8], factor: 1.0, offset: 0.0 };
    let from = start.unit.unwrap_or(none);
    let (mut unit, mut line) = (start.unit, Linear::IDENTITY);
    for (k, hop) in wire.hops.iter().enumerate() {
        let to = if k + 1 == wire.hops.len() { end.unit } else { hop.unit };
        if let (Some(unit), Some(to), false) = (unit, to, hop.suppress_unit_conversion) {
            if unit.powers != to.powers {
                let name = |end: &End| end.variable.unit.clone().unwrap_or_else(|| "another".into());
                let (a, b) = (&start.variable.name, &end.variable.name);
                report.problem(&hop.place, format!("{a} is in {}, {b} in {}", name(start), name(end)));
                return None;
            }
            if unit != to {
                line = line
                    .then(Linear { factor: unit.factor / to.factor, offset: (unit.offset - to.offset) / to.factor });
            }
        }
        unit = to.or(unit);
        match &hop.transformation {
            None => {}
            Some(Transformation::Linear { factor, offset }) => {
                line = line.then(Linear { factor: *factor, offset: *offset });
            }
            Some(other) => {
                report.problem(
                    &hop.place,
                    format!("{} is not for numbers (Real), only LinearTransformation", other.name()),
                );
                return None;
            }
        }
    }
    let to_si = Linear { factor: from.factor, offset: from.offset };
    Some(Link {
        from: wire.from.0,
        output: start.variable.name.clone(),
        input: end.variable.name.clone(),
        to_si,
        from_si: Linear {
            factor: line.factor / from.factor,
            offset: line.offset - line.factor * from.offset / from.factor,
        },
        input_to_si: end.unit.map_or(Linear::IDENTITY, |to| Linear { factor: to.factor, offset: to.offset }),
        line,
        is_force: from.powers == NEWTON,
        place: wire.place.clone(),
    })
}
