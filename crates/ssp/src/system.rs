//! A system as it stands in a document: its elements, its connectors, its connections, its values.

use std::collections::HashSet;

use crate::bindings::bindings;
use crate::problem::Report;
use crate::transform::{boolean, transformation};
use crate::tree::Element;
use crate::types::{Component, Connection, Connector, FileKind, Kind, SignalReference, Source, System, Type};
use crate::uri;

/// What a component's file is where nothing else is said.
const FMU: &str = "application/x-fmu-sharedlibrary";

/// Reads a system and the systems in it.
pub fn system(element: &Element, report: &mut Report) -> System {
    let mut system = System {
        name: element.attribute("name").unwrap_or_default().to_string(),
        description: element.attribute("description").map(str::to_string),
        connectors: connectors(element, report),
        connections: element.children_of("Connections").iter().filter_map(|e| connection(e, report)).collect(),
        bindings: bindings(element, report),
        place: element.place.clone(),
        ..System::default()
    };
    let dictionaries = element.children_of("SignalDictionaries").iter();
    system.dictionaries = dictionaries.filter_map(|e| e.attribute("name").map(str::to_string)).collect();
    let mut names = HashSet::new();
    for child in element.children_of("Elements") {
        let name = child.attribute("name").unwrap_or_default();
        match child.name.as_str() {
            "Component" => system.components.push(component(child, report)),
            "System" => system.systems.push(self::system(child, report)),
            "SignalDictionaryReference" => system.signals.push(SignalReference {
                name: name.to_string(),
                dictionary: child.attribute("dictionary").unwrap_or_default().to_string(),
                connectors: connectors(child, report),
                place: child.place.clone(),
            }),
            other => report.problem(&child.place, format!("an element {other} is not known")),
        }
        if name.is_empty() {
            report.problem(&child.place, "it needs a name");
        } else if !names.insert(name) {
            report.problem(&child.place, "there is another element of this name");
        }
    }
    system
}

fn component(element: &Element, report: &mut Report) -> Component {
    let kind = element.attribute("type").map(str::trim).filter(|kind| !kind.is_empty()).unwrap_or(FMU);
    let content = match kind {
        FMU => FileKind::Fmu,
        "application/x-ssp-definition" => FileKind::Definition,
        "application/x-ssp-package" => FileKind::Package,
        other => {
            report.problem(
                &element.place,
                format!("its type is {other:?}; only FMUs ({FMU}) and structures are supported"),
            );
            FileKind::Fmu
        }
    };
    match element.attribute("implementation").unwrap_or("any").trim() {
        "any" | "CoSimulation" | "" => {}
        "ModelExchange" => report.problem(&element.place, "asks for model exchange; only co-simulation is supported"),
        other => report.problem(&element.place, format!("asks for {other}; only co-simulation is supported")),
    }
    let source = element.attribute("source").ok_or("is missing: there is nothing to run".to_string());
    let source = source.and_then(uri::source).unwrap_or_else(|why| {
        report.problem(&element.place, format!("the attribute source {why}"));
        Source::default()
    });
    Component {
        name: element.attribute("name").unwrap_or_default().to_string(),
        source,
        content,
        file: None,
        description: element.attribute("description").map(str::to_string),
        connectors: connectors(element, report),
        bindings: bindings(element, report),
        geometry: None,
        place: element.place.clone(),
    }
}

fn connectors(element: &Element, report: &mut Report) -> Vec<Connector> {
    let mut known = HashSet::new();
    let mut connectors = Vec::new();
    for child in element.children_of("Connectors").iter().filter(|child| child.name == "Connector") {
        let Some(connector) = connector(child, report) else { continue };
        if !known.insert(connector.name.clone()) {
            report.problem(&child.place, "there is another connector of this name");
        }
        connectors.push(connector);
    }
    connectors
}

fn connector(element: &Element, report: &mut Report) -> Option<Connector> {
    let kind = element.attribute("kind").unwrap_or_default().trim();
    let kind = Kind::NAMES.iter().find(|(name, _)| *name == kind).map(|(_, kind)| *kind);
    let (Some(name), Some(kind)) = (element.attribute("name"), kind) else {
        report.problem(&element.place, "a connector needs a name and a kind: input, output, parameter …");
        return None;
    };
    if let Some(dimension) = element.child("Dimension") {
        report.problem(&dimension.place, "is an array; variables of FMI 2.0 are none");
    }
    // A type is an element of the common namespace; what else can stand here has other names.
    let no_type = ["Dimension", "ConnectorGeometry", "Annotations", "MetaData", "Signature"];
    let kind_of_value = element.children.iter().find(|child| !no_type.contains(&child.name.as_str()));
    let kind_of_value = kind_of_value.map(|child| match child.name.as_str() {
        "Real" | "Float64" | "Float32" => {
            let unit = child.attribute("unit").map(str::trim).filter(|name| !name.is_empty());
            Type::Real(unit.map(str::to_string))
        }
        other => Type::Other(other.to_string()),
    });
    Some(Connector { name: name.to_string(), kind, kind_of_value, place: element.place.clone() })
}

fn connection(element: &Element, report: &mut Report) -> Option<Connection> {
    if element.name != "Connection" {
        return None;
    }
    let text = |name| element.attribute(name).map(str::to_string);
    let mut ends = [("startElement", "startConnector"), ("endElement", "endConnector")].map(|(of, connector)| {
        let name = text(connector);
        if name.is_none() {
            report.problem(&element.place, format!("has no attribute {connector}"));
        }
        name.map(|name| (text(of).filter(|of| !of.is_empty()), name))
    });
    for indices in ["startIndices", "endIndices"] {
        if element.attribute(indices).is_some() {
            report.problem(&element.place, format!("{indices} belong to arrays; variables of FMI 2.0 are none"));
        }
    }
    Some(Connection {
        start: ends[0].take()?,
        end: ends[1].take()?,
        transformation: transformation(element, report),
        suppress_unit_conversion: element.attribute("suppressUnitConversion").and_then(boolean).unwrap_or(false),
        place: element.place.clone(),
    })
}
