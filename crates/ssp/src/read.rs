//! SystemStructure.ssd → [`Structure`], or everything that is wrong with it.
//!
//! The order of elements and what is not needed here (geometry, meta data, signatures) are passed over; what would change a
//! result and is not understood is refused. Of SSP 2.0 everything is read that a co-simulation of FMI 2.0 can have. Files
//! that the document names are not opened here: see [`crate::load`].

use crate::problem::Report;
use crate::shared::{enumerations, units, version};
use crate::system::system;
use crate::transform::real;
use crate::tree::{Element, tree};
use crate::types::{Annotation, Experiment, Structure, System};

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
