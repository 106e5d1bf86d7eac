//! The components of a system, and their connectors.

use std::collections::HashSet;

use crate::problem::Report;
use crate::tree::Element;
use crate::types::{Component, Connector, Kind, Type};

/// What a component's file is where nothing else is said.
const FMU: &str = "application/x-fmu-sharedlibrary";

/// Reads all elements of a system.
pub fn components(system: &Element, report: &mut Report) -> Vec<Component> {
    let mut names = HashSet::new();
    let mut components = Vec::new();
    for element in system.children_of("Elements") {
        match element.name.as_str() {
            "Component" => components.push(component(element, report)),
            "System" => {
                report.problem(&element.place, "systems within systems are not supported: flatten the structure")
            }
            other => report.problem(&element.place, format!("an element {other} is not supported, only Component")),
        }
        if let Some(name) = element.attribute("name")
            && !names.insert(name)
        {
            report.problem(&element.place, "there is another element of this name");
        }
    }
    components
}

/// Values for variables that nothing would set.
pub fn refuse_parameters(element: &Element, report: &mut Report) {
    if let Some(bindings) = element.child("ParameterBindings") {
        report.problem(&bindings.place, "parameter bindings are not supported: set start values in the FMU");
    }
}

fn component(element: &Element, report: &mut Report) -> Component {
    let name = element.attribute("name").unwrap_or_default();
    if name.is_empty() {
        report.problem(&element.place, "a component needs a name");
    }
    let kind = element.attribute("type").unwrap_or(FMU);
    match kind {
        FMU => {}
        "application/x-ssp-package" | "application/x-ssp-definition" => {
            report.problem(&element.place, "a structure within a structure is not supported: flatten it");
        }
        other => report.problem(&element.place, format!("its type is {other:?}; only FMUs ({FMU}) are supported")),
    }
    if element.attribute("implementation") == Some("ModelExchange") {
        report.problem(&element.place, "asks for model exchange; only co-simulation is supported");
    }
    refuse_parameters(element, report);
    let source = element.attribute("source").ok_or("is missing".to_string()).and_then(path);
    let source = source.unwrap_or_else(|why| {
        report.problem(&element.place, format!("the attribute source {why}"));
        String::new()
    });
    let mut known = HashSet::new();
    let mut connectors = Vec::new();
    for child in element.children_of("Connectors").iter().filter(|child| child.name == "Connector") {
        let Some(connector) = connector(child, report) else { continue };
        if !known.insert(connector.name.clone()) {
            report.problem(&child.place, "there is another connector of this name");
        }
        connectors.push(connector);
    }
    Component {
        name: name.to_string(),
        source,
        description: element.attribute("description").map(str::to_string),
        connectors,
        geometry: None,
        place: element.place.clone(),
    }
}

fn connector(element: &Element, report: &mut Report) -> Option<Connector> {
    let kind = element.attribute("kind").unwrap_or_default();
    let kind = Kind::NAMES.iter().find(|(name, _)| *name == kind).map(|(_, kind)| *kind);
    let (Some(name), Some(kind)) = (element.attribute("name"), kind) else {
        report.problem(&element.place, "a connector needs a name and a kind: input, output, parameter …");
        return None;
    };
    let types = ["Real", "Integer", "Boolean", "String", "Enumeration", "Binary"];
    let kind_of_value = element.children.iter().find(|child| types.contains(&child.name.as_str())).map(|child| {
        if child.name == "Real" {
            Type::Real(child.attribute("unit").map(str::to_string))
        } else {
            Type::Other(child.name.clone())
        }
    });
    Some(Connector { name: name.to_string(), kind, kind_of_value, place: element.place.clone() })
}

/// A URI as path inside the archive: relative to the document, which stands at the top.
fn path(uri: &str) -> Result<String, String> {
    let refused = |why: &str| Err(format!("is {uri:?}: {why}"));
    if uri.contains('#') || uri.contains('?') {
        return refused("only a file can be named");
    }
    let Some(text) = decoded(uri) else { return refused("a percent sign that encodes nothing") };
    if text.starts_with('/') || text.contains(['\\', '\0', ':']) {
        return refused("only files inside the archive are read, by their relative paths");
    }
    let parts: Vec<&str> = text.split('/').filter(|part| !part.is_empty() && *part != ".").collect();
    if parts.is_empty() || parts.contains(&"..") {
        return refused("it leads out of the archive");
    }
    Ok(parts.join("/"))
}

/// Without percent encoding.
fn decoded(uri: &str) -> Option<String> {
    let mut bytes = Vec::new();
    let mut rest = uri.bytes();
    while let Some(byte) = rest.next() {
        bytes.push(if byte == b'%' {
            let mut digit = || char::from(rest.next()?).to_digit(16);
            u8::try_from(16 * digit()? + digit()?).ok()?
        } else {
            byte
        });
    }
    String::from_utf8(bytes).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_source_stays_inside_the_archive() {
        assert_eq!(path("resources/My%20Bridge.fmu").as_deref(), Ok("resources/My Bridge.fmu"));
        assert_eq!(path("./resources//a.fmu").as_deref(), Ok("resources/a.fmu"));
        for hostile in ["../a.fmu", "a/../../b.fmu", "%2e%2e/a.fmu", "/etc/passwd", "file:///a.fmu", "http://x/a.fmu"] {
            assert!(path(hostile).is_err(), "{hostile}");
        }
        for odd in ["", ".", "a.ssp#B.ssd", "%zz", "..\\a.fmu"] {
            assert!(path(odd).is_err(), "{odd}");
        }
    }
}
