//! A tolerant reader of modelDescription.xml: takes what it knows by its place in the tree and passes over the rest.

use super::decode::decode;
use super::description::{Capabilities, ModelDescription, ScalarVariable, Unit, VariableType};
use quick_xml::XmlVersion;
use quick_xml::events::{BytesStart, Event};
use quick_xml::reader::Reader;
use std::collections::HashMap;

/// Why a description cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum DescriptionError {
    /// Missing or unreadable.
    #[error("cannot be read: {0}")]
    Io(#[from] std::io::Error),
    /// No XML.
    #[error("is not well-formed near byte {position}: {message}")]
    NotXml {
        /// Where.
        position: u64,
        /// The parser's words.
        message: String,
    },
    /// Cut short.
    #[error("ends before its last element is closed")]
    Unfinished,
    /// Elements within elements within elements …
    #[error("has elements nested more than {DEPTH} deep")]
    TooDeep,
    /// Another document.
    #[error("has the root element {0}, not fmiModelDescription")]
    WrongRoot(String),
    /// FMI 1.0 or 3.0.
    #[error("is for FMI {0:?}; only FMI 2.0 is supported")]
    WrongVersion(String),
    /// Model exchange only.
    #[error("has no CoSimulation element: this FMU is for model exchange only")]
    NoCoSimulation,
    /// A name or value reference with two meanings.
    #[error("is ambiguous: {0}")]
    Ambiguous(String),
    /// A necessary attribute is missing or is no number.
    #[error("{element} has no usable attribute {attribute}")]
    Attribute {
        /// Which element.
        element: String,
        /// Which attribute.
        attribute: &'static str,
    },
}

/// Real files reach a depth of 6; vendor annotations a few more.
const DEPTH: usize = 100;

/// Reads the text of a modelDescription.xml in any usual encoding.
///
/// Entities a document defines itself are never expanded, so that they cannot explode.
///
/// # Errors
/// No XML, not FMI 2.0, no co-simulation, a variable without name or value reference.
pub fn read_description(bytes: &[u8]) -> Result<ModelDescription, DescriptionError> {
    let text = decode(bytes);
    let mut xml = Reader::from_str(&text);
    let mut reading = Reading::default();
    let mut path: Vec<String> = Vec::new();
    let mut seen_root = false;
    loop {
        let event = xml.read_event();
        match event.map_err(|e| DescriptionError::NotXml { position: xml.error_position(), message: e.to_string() })? {
            Event::Start(element) => {
                reading.element(&path, &element)?;
                path.push(element.local_name().into_inner().to_string());
                seen_root = true;
                if path.len() > DEPTH {
                    return Err(DescriptionError::TooDeep);
                }
            }
            Event::Empty(element) => {
                seen_root = true;
                reading.element(&path, &element)?;
            }
            Event::End(_) => drop(path.pop()),
            Event::Eof if path.is_empty() && seen_root => return reading.finish(),
            Event::Eof => return Err(DescriptionError::Unfinished),
            _ => {}
        }
    }
}

#[derive(Default)]
struct Reading {
    description: ModelDescription,
    co_simulation: bool,
    /// Unit of each declared Real type.
    type_units: HashMap<String, String>,
    /// Declared type of the variables that have one, by index.
    declared: Vec<(usize, String)>,
    /// Name of the Unit or SimpleType being read.
    current: String,
}

impl Reading {
    /// One opening tag at a place in the tree.
    fn element(&mut self, path: &[String], e: &BytesStart) -> Result<(), DescriptionError> {
        let name = e.local_name().into_inner().to_string();
        let below = path.get(1..).unwrap_or_default().iter().map(String::as_str).collect::<Vec<_>>();
        match (path.len(), below.as_slice(), name.as_str()) {
            (0, ..) => self.root(e, &name)?,
            (_, [], "CoSimulation") => self.co_simulation(e)?,
            (_, [], "DefaultExperiment") => {
                let real = |name| attribute(e, name).and_then(|text| text.trim().parse().ok());
                let d = &mut self.description;
                (d.start_time, d.stop_time, d.step_size) = (real("startTime"), real("stopTime"), real("stepSize"));
            }
            (_, ["UnitDefinitions"], "Unit") | (_, ["TypeDefinitions"], "SimpleType") => {
                self.current = attribute(e, "name").unwrap_or_default();
            }
            (_, ["UnitDefinitions", "Unit"], "BaseUnit") => {
                self.description.units.insert(self.current.clone(), unit(e));
            }
            (_, ["TypeDefinitions", "SimpleType"], "Real") => {
                attribute(e, "unit").and_then(|unit| self.type_units.insert(self.current.clone(), unit));
            }
            (_, ["ModelVariables"], "ScalarVariable") => self.scalar_variable(e)?,
            (_, ["ModelVariables", "ScalarVariable"], kind) => self.variable_type(kind, e),
            _ => {}
        }
        Ok(())
    }

    fn root(&mut self, e: &BytesStart, name: &str) -> Result<(), DescriptionError> {
        if name != "fmiModelDescription" {
            return Err(DescriptionError::WrongRoot(name.to_string()));
        }
        let text = |name| attribute(e, name).unwrap_or_default();
        let d = &mut self.description;
        (d.fmi_version, d.guid, d.model_name) = (text("fmiVersion"), text("guid"), text("modelName"));
        d.generation_tool = text("generationTool");
        // "2.0" in all published files; later revisions of FMI 2 would say 2.0.x and mean the same interface.
        if d.fmi_version.trim() == "2" || d.fmi_version.trim().starts_with("2.") {
            Ok(())
        } else {
            Err(DescriptionError::WrongVersion(d.fmi_version.clone()))
        }
    }

    fn co_simulation(&mut self, e: &BytesStart) -> Result<(), DescriptionError> {
        let flag = |name| attribute(e, name).is_some_and(|text| matches!(text.trim(), "true" | "1"));
        let identifier = attribute(e, "modelIdentifier").filter(|id| !id.is_empty() && !id.contains(['/', '\\', '\0']));
        self.co_simulation = true;
        self.description.co_simulation = Capabilities {
            model_identifier: identifier.ok_or_else(|| DescriptionError::Attribute {
                element: "CoSimulation".into(),
                attribute: "modelIdentifier",
            })?,
            needs_execution_tool: flag("needsExecutionTool"),
            can_handle_variable_communication_step_size: flag("canHandleVariableCommunicationStepSize"),
            can_interpolate_inputs: flag("canInterpolateInputs"),
            max_output_derivative_order: attribute(e, "maxOutputDerivativeOrder")
                .and_then(|text| text.trim().parse().ok())
                .unwrap_or(0),
            can_run_asynchronously: flag("canRunAsynchronuously"), // sic: the schema has it so
            can_be_instantiated_only_once_per_process: flag("canBeInstantiatedOnlyOncePerProcess"),
            can_not_use_memory_management_functions: flag("canNotUseMemoryManagementFunctions"),
            can_get_and_set_state: flag("canGetAndSetFMUstate"),
            can_serialize_state: flag("canSerializeFMUstate"),
            provides_directional_derivative: flag("providesDirectionalDerivative"),
        };
        Ok(())
    }

    fn scalar_variable(&mut self, e: &BytesStart) -> Result<(), DescriptionError> {
        let without = |element: String, attribute| DescriptionError::Attribute { element, attribute };
        let name = attribute(e, "name").ok_or_else(|| without("a ScalarVariable".into(), "name"))?;
        let value_reference = attribute(e, "valueReference").and_then(|text| text.trim().parse().ok());
        let value_reference =
            value_reference.ok_or_else(|| without(format!("the ScalarVariable {name}"), "valueReference"))?;
        let text = |name, default: &str| attribute(e, name).unwrap_or_else(|| default.to_string());
        self.description.by_name.insert(name.clone(), self.description.variables.len());
        self.description.variables.push(ScalarVariable {
            name,
            value_reference,
            description: text("description", ""),
            causality: text("causality", "local"),
            variability: text("variability", "continuous"),
            initial: attribute(e, "initial"),
            ..ScalarVariable::default()
        });
        Ok(())
    }

    fn variable_type(&mut self, kind: &str, e: &BytesStart) {
        let index = self.description.variables.len().wrapping_sub(1);
        let Some(variable) = self.description.variables.get_mut(index) else { return };
        variable.kind = match kind {
            "Real" => VariableType::Real,
            "Integer" => VariableType::Integer,
            "Boolean" => VariableType::Boolean,
            "String" => VariableType::String,
            "Enumeration" => VariableType::Enumeration,
            _ => return, // annotations
        };
        (variable.start, variable.unit) = (attribute(e, "start"), attribute(e, "unit"));
        self.declared.extend(attribute(e, "declaredType").map(|declared| (index, declared)));
    }

    fn finish(mut self) -> Result<ModelDescription, DescriptionError> {
        for (index, declared) in &self.declared {
            let variable = &mut self.description.variables[*index];
            variable.unit = variable.unit.take().or_else(|| self.type_units.get(declared).cloned());
        }
        if self.co_simulation { Ok(self.description) } else { Err(DescriptionError::NoCoSimulation) }
    }
}

fn unit(e: &BytesStart) -> Unit {
    let real = |name, default| attribute(e, name).and_then(|text| text.trim().parse().ok()).unwrap_or(default);
    let powers = ["kg", "m", "s", "A", "K", "mol", "cd", "rad"];
    let powers = powers.map(|name| attribute(e, name).and_then(|text| text.trim().parse().ok()).unwrap_or(0));
    Unit { factor: real("factor", 1.0), offset: real("offset", 0.0), powers }
}

/// The value of an attribute without prefix. What is wrong with the others does not matter; an entity of the document's
/// own stays as it is written.
fn attribute(e: &BytesStart, name: &str) -> Option<String> {
    let found = e.attributes().with_checks(false).flatten().find(|a| a.key.into_inner() == name)?;
    let value = found.normalized_value(XmlVersion::Implicit1_0);
    Some(value.map_or_else(|_| found.value.to_string(), |value| value.into_owned()))
}
