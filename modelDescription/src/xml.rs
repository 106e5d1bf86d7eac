//! Interface list → modelDescription.xml (FMI 2.0, co-simulation).
//!
//! Choices that every validator and importer at hand accepts, and why:
//! * naming convention *flat*: `point[mid].displacement` is no structured name;
//! * outputs are `calculated`, without start, and stand in InitialUnknowns: their first value is static equilibrium;
//! * `dependencies=""` for an output without direct feed-through; with it the attribute is absent, which means *all
//!   inputs*: never a list of n² references;
//! * there is no date unless one is asked for ([`crate::date`]), so that the same model gives the same file.

use crate::about::{About, LOG_CATEGORIES};
use crate::date::Date;
use crate::units;
use quick_xml::Writer;
use quick_xml::events::{BytesDecl, Event};
use std::io;
use ttb_contract::{Causality, Interface, Kind, Variable};

/// Why an interface cannot be described.
#[derive(Debug, thiserror::Error)]
pub enum XmlError {
    /// A variable has a unit that is not in [`units::UNITS`].
    #[error("variable {variable} has the unit \"{unit}\"; add it to the table in modelDescription/src/units.rs")]
    UnknownUnit {
        /// Name of the variable.
        variable: String,
        /// Unit of the variable.
        unit: &'static str,
    },
    /// Two variables have the same name.
    #[error("two variables are called {0}; FMI wants unique names")]
    Duplicate(String),
    /// A name is empty, or has a comma or line break, which CSV readers of importers cannot read.
    #[error("the variable name {0:?} must be non-empty and without comma or line break")]
    BadName(String),
    /// A number is not finite.
    #[error("{what} is {value}; it must be finite")]
    NotFinite {
        /// Name of the attribute or variable that has the value.
        what: String,
        /// The value that cannot be written.
        value: f64,
    },
    /// The XML could not be written.
    #[error("modelDescription.xml cannot be written: {0}")]
    Io(#[from] io::Error),
}

type Xml = Writer<Vec<u8>>;

/// The text of modelDescription.xml.
///
/// # Errors
/// A name, unit or number that does not fit into FMI 2.0.
pub fn xml(interface: &Interface, about: &About) -> Result<String, XmlError> {
    check(interface, about)?;
    let guid = crate::guid(about.model_identifier, interface);
    let tool = concat!("ttb ", env!("CARGO_PKG_VERSION"));
    let mut xml = Writer::new_with_indent(Vec::new(), b' ', 2);
    xml.write_event(Event::Decl(BytesDecl::new("1.0", Some("UTF-8"), None)))?;
    xml.create_element("fmiModelDescription")
        .with_attribute(("fmiVersion", "2.0"))
        .with_attribute(("modelName", about.model_name))
        .with_attribute(("guid", guid.as_str()))
        .with_attribute(("description", about.full_description().as_str()))
        .with_attribute(("version", env!("CARGO_PKG_VERSION")))
        .with_attribute(("license", env!("CARGO_PKG_LICENSE")))
        .with_attribute(("generationTool", tool))
        .with_attributes(about.date.map(Date::text).as_deref().map(|text| ("generationDateAndTime", text)))
        .with_attribute(("variableNamingConvention", "flat"))
        .write_inner_content(|xml| {
            co_simulation(xml, about)?;
            unit_definitions(xml, interface)?;
            type_definitions(xml, interface)?;
            xml.create_element("LogCategories").write_inner_content(|xml| {
                for category in LOG_CATEGORIES {
                    xml.create_element("Category")
                        .with_attributes([("name", category.0), ("description", category.1)])
                        .write_empty()?;
                }
                Ok(())
            })?;
            xml.create_element("DefaultExperiment")
                .with_attribute(("startTime", "0"))
                .with_attribute(("stopTime", number(about.stop).as_str()))
                .with_attribute(("stepSize", number(about.step).as_str()))
                .write_empty()?;
            xml.create_element("ModelVariables").write_inner_content(|xml| {
                interface
                    .variables()
                    .iter()
                    .enumerate()
                    .try_for_each(|(reference, v)| scalar_variable(xml, reference, v, interface))
            })?;
            model_structure(xml, interface)
        })?;
    let mut text = String::from_utf8_lossy(&xml.into_inner()).into_owned();
    text.push('\n');
    Ok(text)
}

fn check(interface: &Interface, about: &About) -> Result<(), XmlError> {
    let finite = |what: &str, value: f64| {
        if value.is_finite() { Ok(()) } else { Err(XmlError::NotFinite { what: what.to_string(), value }) }
    };
    finite("the default step", about.step)?;
    finite("the default stop time", about.stop)?;
    let mut names = std::collections::HashSet::new();
    for v in interface.variables() {
        finite(&format!("the start value of {}", v.name), v.start)?;
        if v.name.is_empty() || v.name.contains([',', '\n', '\r', '\t']) {
            return Err(XmlError::BadName(v.name.clone()));
        }
        if !names.insert(&v.name) {
            return Err(XmlError::Duplicate(v.name.clone()));
        }
        if let Kind::Real { unit } = v.kind
            && unit != "1"
            && units::find(unit).is_none()
        {
            return Err(XmlError::UnknownUnit { variable: v.name.clone(), unit });
        }
    }
    Ok(())
}

/// Shortest decimal that reads back as the same f64, with an exponent where that is shorter (`1e-9`, not 0.000000001).
fn number(value: f64) -> String {
    format!("{value:?}")
}

fn co_simulation(xml: &mut Xml, about: &About) -> io::Result<()> {
    xml.create_element("CoSimulation")
        .with_attribute(("modelIdentifier", about.model_identifier))
        .with_attribute(("canHandleVariableCommunicationStepSize", "true"))
        .with_attribute(("canInterpolateInputs", "true"))
        .with_attribute(("maxOutputDerivativeOrder", "0"))
        .with_attribute(("canNotUseMemoryManagementFunctions", "true"))
        .with_attribute(("canGetAndSetFMUstate", "true"))
        .with_attribute(("canSerializeFMUstate", "true"))
        .with_attribute(("providesDirectionalDerivative", if about.directional_derivatives { "true" } else { "false" }))
        .write_empty()?;
    Ok(())
}

/// The units in use, each once, in the order of the table.
fn unit_definitions(xml: &mut Xml, interface: &Interface) -> io::Result<()> {
    let uses = |name: &str| interface.variables().iter().any(|v| matches!(v.kind, Kind::Real { unit } if unit == name));
    let used: Vec<_> = units::UNITS.iter().filter(|(name, _)| uses(name)).collect();
    if used.is_empty() {
        return Ok(()); // the schema wants at least one unit
    }
    xml.create_element("UnitDefinitions").write_inner_content(|xml| {
        for (name, powers) in used {
            xml.create_element("Unit").with_attribute(("name", *name)).write_inner_content(|xml| {
                xml.create_element("BaseUnit").with_attributes(powers.iter().copied()).write_empty()?;
                Ok(())
            })?;
        }
        Ok(())
    })?;
    Ok(())
}

/// Name of the type of an enumeration; variables with the same items share the type of the first of them.
fn enumeration_type(interface: &Interface, items: &[(&str, &str)]) -> String {
    let first = interface.variables().iter().find(|v| matches!(v.kind, Kind::Enumeration(other) if other == items));
    format!("{}_choice", first.map_or("", |v| v.name.as_str()))
}

fn type_definitions(xml: &mut Xml, interface: &Interface) -> io::Result<()> {
    let mut types: Vec<(String, &[(&str, &str)])> = Vec::new();
    for v in interface.variables() {
        if let Kind::Enumeration(items) = v.kind
            && types.iter().all(|(_, known)| *known != items)
        {
            types.push((enumeration_type(interface, items), items));
        }
    }
    if types.is_empty() {
        return Ok(());
    }
    xml.create_element("TypeDefinitions").write_inner_content(|xml| {
        for (name, items) in types {
            xml.create_element("SimpleType").with_attribute(("name", name.as_str())).write_inner_content(|xml| {
                xml.create_element("Enumeration").write_inner_content(|xml| {
                    for (i, (name, description)) in items.iter().enumerate() {
                        let value = (i + 1).to_string();
                        xml.create_element("Item")
                            .with_attributes([
                                ("name", *name),
                                ("value", value.as_str()),
                                ("description", *description),
                            ])
                            .write_empty()?;
                    }
                    Ok(())
                })?;
                Ok(())
            })?;
        }
        Ok(())
    })?;
    Ok(())
}

fn scalar_variable(xml: &mut Xml, reference: usize, v: &Variable, interface: &Interface) -> io::Result<()> {
    let description = v.description.split_whitespace().collect::<Vec<_>>().join(" ");
    let mut element = xml
        .create_element("ScalarVariable")
        .with_attribute(("name", v.name.as_str()))
        .with_attribute(("valueReference", reference.to_string().as_str()));
    if !description.is_empty() {
        element = element.with_attribute(("description", description.as_str()));
    }
    // A Boolean, Integer or Enumeration is never continuous; parameters, of whatever type, are fixed.
    let continuous = if matches!(v.kind, Kind::Real { .. }) { "continuous" } else { "discrete" };
    element = match v.causality {
        Causality::Input => element.with_attributes([("causality", "input"), ("variability", continuous)]),
        Causality::Output => {
            element.with_attributes([("causality", "output"), ("variability", continuous), ("initial", "calculated")])
        }
        Causality::Parameter => {
            element.with_attributes([("causality", "parameter"), ("variability", "fixed"), ("initial", "exact")])
        }
    };
    element.write_inner_content(|xml| typed_start(xml, v, interface))?;
    Ok(())
}

fn typed_start(xml: &mut Xml, v: &Variable, interface: &Interface) -> io::Result<()> {
    let whole = format!("{:.0}", v.start);
    match &v.kind {
        Kind::Real { unit } => {
            let element = xml.create_element("Real");
            let element = if *unit == "1" { element } else { element.with_attribute(("unit", *unit)) };
            // An output's first value is computed: static equilibrium.
            let start = (v.causality != Causality::Output).then(|| number(v.start));
            element.with_attributes(start.as_deref().map(|start| ("start", start))).write_empty()?;
        }
        Kind::Boolean => {
            let start = if v.start == 0.0 { "false" } else { "true" };
            xml.create_element("Boolean").with_attribute(("start", start)).write_empty()?;
        }
        Kind::Integer { min, max } => {
            xml.create_element("Integer")
                .with_attribute(("min", min.to_string().as_str()))
                .with_attribute(("max", max.to_string().as_str()))
                .with_attribute(("start", whole.as_str()))
                .write_empty()?;
        }
        Kind::Enumeration(items) => {
            xml.create_element("Enumeration")
                .with_attribute(("declaredType", enumeration_type(interface, items).as_str()))
                .with_attribute(("start", whole.as_str()))
                .write_empty()?;
        }
    }
    Ok(())
}

fn model_structure(xml: &mut Xml, interface: &Interface) -> io::Result<()> {
    let structure = xml.create_element("ModelStructure");
    if interface.outputs().is_empty() {
        structure.write_empty()?;
        return Ok(());
    }
    structure.write_inner_content(|xml| {
        xml.create_element("Outputs").write_inner_content(|xml| {
            for reference in interface.outputs() {
                let index = (reference + 1).to_string();
                let element = xml.create_element("Unknown").with_attribute(("index", index.as_str()));
                let feeds_through = interface.variables()[reference].feed_through;
                let element = if feeds_through { element } else { element.with_attribute(("dependencies", "")) };
                element.write_empty()?;
            }
            Ok(())
        })?;
        // In initialization mode every output answers with static equilibrium under all inputs: no dependencies named
        // means all of them.
        xml.create_element("InitialUnknowns").write_inner_content(|xml| {
            for reference in interface.outputs() {
                let index = (reference + 1).to_string();
                xml.create_element("Unknown").with_attribute(("index", index.as_str())).write_empty()?;
            }
            Ok(())
        })?;
        Ok(())
    })?;
    Ok(())
}
