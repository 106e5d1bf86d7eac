//! [`Structure`] → SystemStructure.ssd, valid against the schema of SSP 1.0.
//!
//! Prefixes are `ssd` and `ssc` and the version is 1.0: importers at hand (ecos, libcosim) compare both as text.

use std::io;

use quick_xml::Writer;
use quick_xml::events::{BytesDecl, Event};

use crate::parameters::{Binding, NamedUnit, Value, Values};
use crate::transform::Transformation;
use crate::types::{Annotation, BaseUnit, Component, Connection, Connector, Structure, System, Type, Unit};

type Xml = Writer<Vec<u8>>;

/// The text of SystemStructure.ssd, with a date if one is given.
///
/// # Errors
/// None in practice: it is written to memory.
pub fn write(structure: &Structure, date: Option<&str>) -> io::Result<String> {
    let mut xml = Writer::new_with_indent(Vec::new(), b' ', 2);
    xml.write_event(Event::Decl(BytesDecl::new("1.0", Some("UTF-8"), None)))?;
    // All namespaces stand here: libcosim takes one declared within its annotation for a part of it.
    let mut namespaces = vec![
        ("xmlns:ssc".to_string(), "http://ssp-standard.org/SSP1/SystemStructureCommon"),
        ("xmlns:ssd".to_string(), "http://ssp-standard.org/SSP1/SystemStructureDescription"),
    ];
    if structure.system.components.iter().any(|component| !component.bindings.is_empty()) {
        namespaces.push(("xmlns:ssv".to_string(), "http://ssp-standard.org/SSP1/SystemStructureParameterValues"));
    }
    for annotation in structure.experiment.annotations.iter().filter(|a| !a.elements.is_empty()) {
        let declared = (format!("xmlns:{}", annotation.prefix), annotation.namespace.as_str());
        if !namespaces.contains(&declared) {
            namespaces.push(declared);
        }
    }
    xml.create_element("ssd:SystemStructureDescription")
        .with_attributes(namespaces.iter().map(|(prefix, namespace)| (prefix.as_str(), *namespace)))
        .with_attribute(("version", "1.0"))
        .with_attribute(("name", structure.name.as_str()))
        .with_attributes(structure.description.as_deref().map(|text| ("description", text)))
        .with_attributes(structure.tool.as_deref().map(|tool| ("generationTool", tool)))
        .with_attributes(date.map(|date| ("generationDateAndTime", date)))
        .write_inner_content(|xml| {
            system(xml, &structure.system)?;
            if !structure.units.is_empty() {
                xml.create_element("ssd:Units")
                    .write_inner_content(|xml| structure.units.iter().try_for_each(|u| unit(xml, u)))?;
            }
            experiment(xml, structure)
        })?;
    let mut text = String::from_utf8_lossy(&xml.into_inner()).into_owned();
    text.push('\n');
    Ok(text)
}

/// Shortest decimal that reads back as the same number.
fn number(value: f64) -> String {
    format!("{value:?}")
}

fn system(xml: &mut Xml, system: &System) -> io::Result<()> {
    xml.create_element("ssd:System")
        .with_attribute(("name", system.name.as_str()))
        .with_attributes(system.description.as_deref().map(|text| ("description", text)))
        .write_inner_content(|xml| {
            xml.create_element("ssd:Elements")
                .write_inner_content(|xml| system.components.iter().try_for_each(|c| component(xml, c)))?;
            if !system.connections.is_empty() {
                xml.create_element("ssd:Connections")
                    .write_inner_content(|xml| system.connections.iter().try_for_each(|c| connection(xml, c)))?;
            }
            Ok(())
        })?;
    Ok(())
}

fn component(xml: &mut Xml, component: &Component) -> io::Result<()> {
    xml.create_element("ssd:Component")
        .with_attribute(("name", component.name.as_str()))
        .with_attribute(("type", "application/x-fmu-sharedlibrary"))
        .with_attribute(("source", encoded(&component.source.path).as_str()))
        .with_attribute(("implementation", "CoSimulation"))
        .with_attributes(component.description.as_deref().map(|text| ("description", text)))
        .write_inner_content(|xml| {
            if !component.connectors.is_empty() {
                xml.create_element("ssd:Connectors")
                    .write_inner_content(|xml| component.connectors.iter().try_for_each(|c| connector(xml, c)))?;
            }
            if let Some(corners) = component.geometry {
                let corners = corners.map(number);
                let named = ["x1", "y1", "x2", "y2"].into_iter().zip(corners.iter().map(String::as_str));
                xml.create_element("ssd:ElementGeometry").with_attributes(named).write_empty()?;
            }
            if !component.bindings.is_empty() {
                xml.create_element("ssd:ParameterBindings")
                    .write_inner_content(|xml| component.bindings.iter().try_for_each(|b| binding(xml, b)))?;
            }
            Ok(())
        })?;
    Ok(())
}

fn connector(xml: &mut Xml, connector: &Connector) -> io::Result<()> {
    xml.create_element("ssd:Connector")
        .with_attributes([("name", connector.name.as_str()), ("kind", connector.kind.name())])
        .write_inner_content(|xml| {
            match &connector.kind_of_value {
                Some(Type::Real(unit)) => {
                    let unit = unit.as_deref().map(|unit| ("unit", unit));
                    xml.create_element("ssc:Real").with_attributes(unit).write_empty()?;
                }
                Some(Type::Other(name)) => drop(xml.create_element(format!("ssc:{name}")).write_empty()?),
                None => {}
            }
            Ok(())
        })?;
    Ok(())
}

fn connection(xml: &mut Xml, connection: &Connection) -> io::Result<()> {
    let element = xml
        .create_element("ssd:Connection")
        .with_attributes(connection.start.0.as_deref().map(|name| ("startElement", name)))
        .with_attribute(("startConnector", connection.start.1.as_str()))
        .with_attributes(connection.end.0.as_deref().map(|name| ("endElement", name)))
        .with_attribute(("endConnector", connection.end.1.as_str()))
        .with_attributes(connection.suppress_unit_conversion.then_some(("suppressUnitConversion", "true")));
    let Some(transformation) = &connection.transformation else {
        element.write_empty()?;
        return Ok(());
    };
    element.write_inner_content(|xml| {
        let Transformation::Linear { factor, offset } = transformation else {
            return Err(io::Error::other("only linear transformations are written"));
        };
        // Both attributes, always: some importers take a missing factor for 0.
        let (factor, offset) = (number(*factor), number(*offset));
        let attributes = [("factor", factor.as_str()), ("offset", offset.as_str())];
        xml.create_element("ssc:LinearTransformation").with_attributes(attributes).write_empty()?;
        Ok(())
    })?;
    Ok(())
}

/// Values in the document, without prefix and mapping.
fn binding(xml: &mut Xml, binding: &Binding) -> io::Result<()> {
    let Values::Inline(set) = &binding.values else { return Err(io::Error::other("only inline values are written")) };
    xml.create_element("ssd:ParameterBinding").write_inner_content(|xml| {
        xml.create_element("ssd:ParameterValues").write_inner_content(|xml| {
            let attributes = [("version", "1.0"), ("name", set.name.as_str())];
            xml.create_element("ssv:ParameterSet").with_attributes(attributes).write_inner_content(|xml| {
                xml.create_element("ssv:Parameters").write_inner_content(|xml| {
                    set.parameters.iter().try_for_each(|parameter| {
                        let element =
                            xml.create_element("ssv:Parameter").with_attribute(("name", parameter.name.as_str()));
                        element.write_inner_content(|xml| value(xml, &parameter.value)).map(drop)
                    })
                })?;
                Ok(())
            })?;
            Ok(())
        })?;
        Ok(())
    })?;
    Ok(())
}

fn value(xml: &mut Xml, value: &Value) -> io::Result<()> {
    let (kind, text) = match value {
        Value::Real(x, _) => ("Real", number(*x)),
        Value::Integer(i) => ("Integer", i.to_string()),
        Value::Boolean(truth) => ("Boolean", truth.to_string()),
        Value::Text(text) => ("String", text.clone()),
        Value::Item(name, _) => ("Enumeration", name.clone()),
        Value::Other(what) => return Err(io::Error::other(format!("a value cannot be written: {what}"))),
    };
    let unit =
        if let Value::Real(_, Some(NamedUnit { name, .. })) = value { Some(("unit", name.as_str())) } else { None };
    let element = xml.create_element(format!("ssv:{kind}")).with_attribute(("value", text.as_str()));
    element.with_attributes(unit).write_empty()?;
    Ok(())
}

fn unit(xml: &mut Xml, unit: &Unit) -> io::Result<()> {
    let BaseUnit { powers, factor, offset } = unit.base;
    let mut attributes: Vec<(&str, String)> = BaseUnit::NAMES.into_iter().zip(powers.map(|p| p.to_string())).collect();
    attributes.retain(|(_, power)| power != "0");
    attributes.extend((factor != 1.0).then(|| ("factor", number(factor))));
    attributes.extend((offset != 0.0).then(|| ("offset", number(offset))));
    xml.create_element("ssc:Unit").with_attribute(("name", unit.name.as_str())).write_inner_content(|xml| {
        let attributes = attributes.iter().map(|(name, value)| (*name, value.as_str()));
        xml.create_element("ssc:BaseUnit").with_attributes(attributes).write_empty()?;
        Ok(())
    })?;
    Ok(())
}

fn experiment(xml: &mut Xml, structure: &Structure) -> io::Result<()> {
    let experiment = &structure.experiment;
    let times = [("startTime", experiment.start.map(number)), ("stopTime", experiment.stop.map(number))];
    let times = times.iter().filter_map(|(name, time)| Some((*name, time.as_deref()?)));
    let element = xml.create_element("ssd:DefaultExperiment").with_attributes(times);
    if experiment.annotations.is_empty() {
        element.write_empty()?;
        return Ok(());
    }
    element.write_inner_content(|xml| {
        xml.create_element("ssd:Annotations")
            .write_inner_content(|xml| experiment.annotations.iter().try_for_each(|a| annotation(xml, a)))?;
        Ok(())
    })?;
    Ok(())
}

fn annotation(xml: &mut Xml, annotation: &Annotation) -> io::Result<()> {
    xml.create_element("ssc:Annotation")
        .with_attribute(("type", annotation.kind.as_str()))
        .write_inner_content(|xml| nested(xml, annotation, 0))?;
    Ok(())
}

/// The elements of an annotation from the one at `depth` on.
fn nested(xml: &mut Xml, annotation: &Annotation, depth: usize) -> io::Result<()> {
    let Some(name) = annotation.elements.get(depth) else { return Ok(()) };
    let element = xml.create_element(format!("{}:{name}", annotation.prefix));
    if depth + 1 == annotation.elements.len() {
        let attributes = annotation.attributes.iter().map(|(name, value)| (name.as_str(), value.as_str()));
        element.with_attributes(attributes).write_empty()?;
    } else {
        element.write_inner_content(|xml| nested(xml, annotation, depth + 1))?;
    }
    Ok(())
}

/// A path as relative URI.
fn encoded(path: &str) -> String {
    let plain = |byte: u8| byte.is_ascii_alphanumeric() || b"/-._~".contains(&byte);
    let encode = |byte: u8| if plain(byte) { char::from(byte).to_string() } else { format!("%{byte:02X}") };
    path.bytes().map(encode).collect()
}
