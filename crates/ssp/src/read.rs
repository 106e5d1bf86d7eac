//! SystemStructure.ssd → [`Structure`], or everything that is wrong with it.
//!
//! The order of elements and what is not needed here (geometry, meta data, signatures) are passed over; what would change a
//! result and is not understood is refused. Of SSP 2.0 everything is read that a co-simulation of FMI 2.0 can have. Files
//! that the document names are not opened here: see [`crate::load`].

use crate::parameters::Enumeration;
use crate::problem::Report;
use crate::system::system;
use crate::transform::real;
use crate::tree::{Element, tree};
use crate::types::{Annotation, BaseUnit, Experiment, Structure, System, Unit};

/// Reads the text of a SystemStructure.ssd; `file` is what messages call it.
///
/// # Errors
/// All problems of the document.
pub fn read(bytes: &[u8], file: &str) -> Result<Structure, Report> {
    let mut report = Report::new(file);
    match structure(bytes, &mut report) {
        Some(structure) if report.is_empty() => Ok(structure),
        _ => Err(report),
    }
}

/// What can be read of a document, with its problems in `report`.
pub fn structure(bytes: &[u8], report: &mut Report) -> Option<Structure> {
    let root = tree(bytes, report)?;
    if root.name != "SystemStructureDescription" {
        report.problem("", format!("has the root element {}, not SystemStructureDescription", root.name));
        return None;
    }
    version(&root, report);
    let mut structure = Structure {
        name: root.attribute("name").unwrap_or_default().to_string(),
        description: root.attribute("description").map(str::to_string),
        tool: root.attribute("generationTool").map(str::to_string),
        units: units(&root, report),
        enumerations: enumerations(&root, report),
        experiment: experiment(&root, report),
        system: System::default(),
    };
    match root.child("System") {
        Some(element) => structure.system = system(element, report),
        None => report.problem(&root.place, "has no element System"),
    }
    Some(structure)
}

/// SSP 1 and 2 have the same elements for all that is read here.
pub fn version(root: &Element, report: &mut Report) {
    let version = root.attribute("version").unwrap_or_default().trim();
    let major = version.split('.').next().unwrap_or_default();
    if !matches!(major, "1" | "2") {
        report.problem(&root.place, format!("is for SSP {version:?}; only SSP 1 and 2 are supported"));
    }
}

/// The units that a document defines. One without BaseUnit is a name only.
pub fn units(root: &Element, report: &mut Report) -> Vec<Unit> {
    root.children_of("Units").iter().filter(|e| e.name == "Unit").filter_map(|e| unit(e, report)).collect()
}

fn unit(element: &Element, report: &mut Report) -> Option<Unit> {
    let Some(name) = element.attribute("name").filter(|name| !name.trim().is_empty()) else {
        report.problem(&element.place, "a unit needs a name");
        return None;
    };
    let base = element.child("BaseUnit")?;
    let powers = BaseUnit::NAMES.map(|name| real(base, name, report).unwrap_or(0.0) as i32);
    let factor = real(base, "factor", report).unwrap_or(1.0);
    if factor == 0.0 {
        report.problem(&base.place, "the factor of a unit must not be 0");
    }
    let base = BaseUnit { powers, factor, offset: real(base, "offset", report).unwrap_or(0.0) };
    Some(Unit { name: name.to_string(), base })
}

/// The enumerations that a document defines.
pub fn enumerations(root: &Element, report: &mut Report) -> Vec<Enumeration> {
    let mut item = |element: &Element| {
        let number = element.attribute("value").and_then(|text| text.trim().parse().ok());
        let item = element.attribute("name").map(str::to_string).zip(number);
        if item.is_none() {
            report.problem(&element.place, "an item needs a name and a whole number as value");
        }
        item
    };
    let mut enumeration = |element: &Element| Enumeration {
        name: element.attribute("name").unwrap_or_default().to_string(),
        items: element.children.iter().filter(|e| e.name == "Item").filter_map(&mut item).collect(),
    };
    let all = root.children_of("Enumerations").iter().filter(|element| element.name == "Enumeration");
    all.map(&mut enumeration).collect()
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
