//! What all kinds of SSP documents have: a version, units, enumerations.

use crate::parameters::Enumeration;
use crate::problem::Report;
use crate::transform::real;
use crate::tree::Element;
use crate::types::{BaseUnit, Unit};

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
