//! SystemStructure.ssd → [`Structure`], or everything that is wrong with it.
//!
//! The order of elements and what is not needed here (geometry, enumerations, signal dictionaries that nobody refers to)
//! are passed over; what would change a result and is not understood is refused.

use crate::components::{components, refuse_parameters};
use crate::problem::Report;
use crate::tree::{Element, tree};
use crate::types::{Annotation, BaseUnit, Connection, Experiment, Structure, System, Unit};

/// Reads the text of a SystemStructure.ssd; `file` is what messages call it.
///
/// # Errors
/// All problems of the document.
pub fn read(bytes: &[u8], file: &str) -> Result<Structure, Report> {
    let mut report = Report::new(file);
    let Some(root) = tree(bytes, &mut report) else { return Err(report) };
    if root.name != "SystemStructureDescription" {
        report.problem("", format!("has the root element {}, not SystemStructureDescription", root.name));
        return Err(report);
    }
    let version = root.attribute("version").unwrap_or_default().trim();
    if !version.starts_with("1.") {
        report.problem(&root.place, format!("is for SSP {version:?}; only SSP 1 is supported"));
    }
    let mut structure = Structure {
        name: root.attribute("name").unwrap_or_default().to_string(),
        description: root.attribute("description").map(str::to_string),
        tool: root.attribute("generationTool").map(str::to_string),
        units: root.children_of("Units").iter().filter_map(|e| unit(e, &mut report)).collect(),
        experiment: experiment(&root, &mut report),
        system: System::default(),
    };
    match root.child("System") {
        Some(element) => structure.system = system(element, &mut report),
        None => report.problem(&root.place, "has no element System"),
    }
    if report.is_empty() { Ok(structure) } else { Err(report) }
}

fn system(element: &Element, report: &mut Report) -> System {
    refuse_parameters(element, report);
    System {
        name: element.attribute("name").unwrap_or_default().to_string(),
        description: element.attribute("description").map(str::to_string),
        components: components(element, report),
        connections: element.children_of("Connections").iter().filter_map(|e| connection(e, report)).collect(),
    }
}

fn connection(element: &Element, report: &mut Report) -> Option<Connection> {
    let text = |name| element.attribute(name).map(str::to_string);
    let mut ends = [("startElement", "startConnector"), ("endElement", "endConnector")].map(|(of, connector)| {
        let name = text(connector);
        if name.is_none() {
            report.problem(&element.place, format!("has no attribute {connector}"));
        }
        name.map(|name| (text(of), name))
    });
    let mut linear = (1.0, 0.0);
    for child in &element.children {
        if child.name == "LinearTransformation" {
            let (factor, offset) = (real(child, "factor", report), real(child, "offset", report));
            linear = (factor.unwrap_or(1.0), offset.unwrap_or(0.0));
        } else if child.name.ends_with("Transformation") {
            report.problem(&child.place, format!("{} is not supported, only LinearTransformation", child.name));
        }
    }
    let suppress_unit_conversion = matches!(element.attribute("suppressUnitConversion"), Some("true" | "1"));
    Some(Connection {
        start: ends[0].take()?,
        end: ends[1].take()?,
        factor: linear.0,
        offset: linear.1,
        suppress_unit_conversion,
        place: element.place.clone(),
    })
}

fn unit(element: &Element, report: &mut Report) -> Option<Unit> {
    let name = element.attribute("name").map(str::to_string);
    let (Some(name), Some(base)) = (name, element.child("BaseUnit")) else {
        report.problem(&element.place, "a unit needs a name and an element BaseUnit");
        return None;
    };
    let powers = BaseUnit::NAMES.map(|name| real(base, name, report).unwrap_or(0.0) as i32);
    let factor = real(base, "factor", report).unwrap_or(1.0);
    if factor == 0.0 {
        report.problem(&base.place, "the factor of a unit must not be 0");
    }
    Some(Unit { name, base: BaseUnit { powers, factor, offset: real(base, "offset", report).unwrap_or(0.0) } })
}

fn experiment(root: &Element, report: &mut Report) -> Experiment {
    let element = root.child("DefaultExperiment");
    let mut time = |name| element.and_then(|element| real(element, name, report));
    let (start, stop) = (time("startTime"), time("stopTime"));
    let holders = [element, root.child("System"), Some(root)].into_iter().flatten();
    let annotations = holders.flat_map(|holder| holder.children_of("Annotations")).map(annotation).collect();
    Experiment { start, stop, annotations }
}

/// The elements of an annotation down to the first that has not exactly one child.
fn annotation(element: &Element) -> Annotation {
    let mut annotation = Annotation {
        kind: element.attribute("type").unwrap_or_default().trim().to_string(),
        place: element.place.clone(),
        ..Annotation::default()
    };
    let mut inner = element;
    while let [only] = inner.children.as_slice() {
        annotation.prefix.clone_from(&only.prefix);
        annotation.elements.push(only.name.clone());
        inner = only;
    }
    if !annotation.elements.is_empty() {
        let own = |name: &str| name == "xmlns" || name.contains(':');
        annotation.attributes = inner.attributes.iter().filter(|(name, _)| !own(name)).cloned().collect();
        annotation.place.clone_from(&inner.place);
    }
    annotation
}

/// A finite number, where there is one.
fn real(element: &Element, name: &str, report: &mut Report) -> Option<f64> {
    let text = element.attribute(name)?;
    let value = text.trim().parse().ok().filter(|value: &f64| value.is_finite());
    if value.is_none() {
        report.problem(&element.place, format!("the attribute {name} is no number: {text:?}"));
    }
    value
}
