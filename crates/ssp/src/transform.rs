//! What happens to a value on a connection or in a parameter mapping, after a change of units (SSP 1.0 and 2.0, "Transformation
//! Choice").
//!
//! ```text
//! linear                          target = factor · source + offset
//! Boolean, integer, enumeration   target = the entry of source; a value without entry stays
//! ```

use crate::problem::Report;
use crate::tree::Element;

/// A transformation.
#[derive(Clone, Debug, PartialEq)]
pub enum Transformation {
    /// Of a number.
    Linear {
        /// Factor, not 0.
        factor: f64,
        /// Offset in the target's unit.
        offset: f64,
    },
    /// Of true and false.
    Boolean(Vec<(bool, bool)>),
    /// Of integers, also those behind the items of an enumeration.
    Integer(Vec<(i64, i64)>),
    /// Of items by their names.
    Enumeration(Vec<(String, String)>),
}

impl Transformation {
    /// A linear one, or none where it would change nothing.
    pub fn linear(factor: f64, offset: f64) -> Option<Self> {
        ((factor, offset) != (1.0, 0.0)).then_some(Self::Linear { factor, offset })
    }

    /// Its name in a document.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Linear { .. } => "LinearTransformation",
            Self::Boolean(_) => "BooleanMappingTransformation",
            Self::Integer(_) => "IntegerMappingTransformation",
            Self::Enumeration(_) => "EnumerationMappingTransformation",
        }
    }
}

/// The transformation among the children of a connection or of a mapping's entry.
pub fn transformation(of: &Element, report: &mut Report) -> Option<Transformation> {
    let mut found = of.children.iter().filter(|child| child.name.ends_with("Transformation"));
    let element = found.next()?;
    if let Some(second) = found.next() {
        report.problem(&second.place, "there is another transformation before it");
    }
    match element.name.as_str() {
        "LinearTransformation" => {
            let factor = real(element, "factor", report).unwrap_or(1.0);
            let offset = real(element, "offset", report).unwrap_or(0.0);
            if factor == 0.0 {
                report.problem(&element.place, "its factor is 0: nothing would pass");
            }
            Transformation::linear(factor, offset)
        }
        "BooleanMappingTransformation" => {
            Some(Transformation::Boolean(entries(element, "true or false", boolean, report)))
        }
        "IntegerMappingTransformation" => {
            let whole = |text: &str| text.trim().parse().ok();
            Some(Transformation::Integer(entries(element, "a whole number", whole, report)))
        }
        "EnumerationMappingTransformation" => {
            Some(Transformation::Enumeration(entries(element, "an item", |text| Some(text.to_string()), report)))
        }
        other => {
            report.problem(&element.place, format!("{other} is no transformation that SSP knows"));
            None
        }
    }
}

/// Entries of a table; two for one source are a problem.
fn entries<T: PartialEq>(
    table: &Element,
    what: &str,
    parse: impl Fn(&str) -> Option<T>,
    report: &mut Report,
) -> Vec<(T, T)> {
    let mut entries: Vec<(T, T)> = Vec::new();
    for entry in table.children.iter().filter(|child| child.name == "MapEntry") {
        let [source, target] = ["source", "target"].map(|name| entry.attribute(name).and_then(&parse));
        let (Some(source), Some(target)) = (source, target) else {
            report.problem(&entry.place, format!("source and target must each be {what}"));
            continue;
        };
        if entries.iter().any(|(known, _)| *known == source) {
            report.problem(&entry.place, "there is another entry for this source");
        }
        entries.push((source, target));
    }
    entries
}

/// As XML writes it.
pub fn boolean(text: &str) -> Option<bool> {
    match text.trim() {
        "true" | "1" => Some(true),
        "false" | "0" => Some(false),
        _ => None,
    }
}

/// A finite number, where there is one.
pub fn real(element: &Element, name: &str, report: &mut Report) -> Option<f64> {
    let text = element.attribute(name)?;
    let value = text.trim().parse().ok().filter(|value: &f64| value.is_finite());
    if value.is_none() {
        report.problem(&element.place, format!("the attribute {name} is no number: {text:?}"));
    }
    value
}
