//! A tolerant reader of FMI 2.0's modelDescription.xml: takes what it knows by its place in the tree and passes over the rest.

use std::collections::HashMap;
use ttb_fmi::description::tree::{Element, walk};
use ttb_fmi::description::{Capabilities, DescriptionError, ModelDescription, ScalarVariable, Unit, VariableType};

/// Reads the text of a modelDescription.xml in any usual encoding.
///
/// # Errors
/// No XML, not FMI 2.0, no co-simulation, a variable without name or value reference.
pub fn read_description(bytes: &[u8]) -> Result<ModelDescription, DescriptionError> {
    let mut reading = Reading::default();
    walk(bytes, |path, element| reading.element(path, element))?;
    reading.finish()
}

#[derive(Default)]
struct Reading {
    description: ModelDescription,
    co_simulation: bool,
    /// Unit of each declared Real type.
    type_units: HashMap<String, String>,
    /// Name of the Unit or SimpleType being read.
    current: String,
}

impl Reading {
    /// One opening tag at a place in the tree.
    fn element(&mut self, path: &[String], e: &Element) -> Result<(), DescriptionError> {
        let name = e.name();
        let below = path.get(1..).unwrap_or_default().iter().map(String::as_str).collect::<Vec<_>>();
        match (path.len(), below.as_slice(), name) {
            (0, ..) => self.root(e, name)?,
            (_, [], "CoSimulation") => self.co_simulation(e)?,
            (_, [], "DefaultExperiment") => {
                let d = &mut self.description;
                (d.start_time, d.stop_time) = (e.number("startTime"), e.number("stopTime"));
                d.step_size = e.number("stepSize");
            }
            (_, ["UnitDefinitions"], "Unit") => {
                self.current = e.attribute("name").unwrap_or_default();
                self.description.defined_units.insert(self.current.clone());
            }
            (_, ["TypeDefinitions"], "SimpleType") => self.current = e.attribute("name").unwrap_or_default(),
            (_, ["LogCategories"], "Category") => {
                self.description.log_categories.extend(e.attribute("name"));
            }
            (_, ["UnitDefinitions", "Unit"], "BaseUnit") => {
                self.description.units.insert(self.current.clone(), unit(e));
            }
            (_, ["TypeDefinitions", "SimpleType"], "Real") => {
                e.attribute("unit")
                    .filter(|unit| !unit.trim().is_empty())
                    .and_then(|unit| self.type_units.insert(self.current.clone(), unit));
            }
            (_, ["TypeDefinitions", "SimpleType", "Enumeration"], "Item") => {
                let item = e.attribute("name").zip(e.number("value"));
                self.description.enumerations.entry(self.current.clone()).or_default().extend(item);
            }
            (_, ["ModelVariables"], "ScalarVariable") => self.scalar_variable(e)?,
            (_, ["ModelVariables", "ScalarVariable"], kind) => self.variable_type(kind, e),
            _ => {}
        }
        Ok(())
    }

    fn root(&mut self, e: &Element, name: &str) -> Result<(), DescriptionError> {
        if name != "fmiModelDescription" {
            return Err(DescriptionError::WrongRoot(name.to_string()));
        }
        let text = |name| e.attribute(name).unwrap_or_default();
        let d = &mut self.description;
        (d.fmi_version, d.guid, d.model_name) = (text("fmiVersion"), text("guid"), text("modelName"));
        d.generation_tool = text("generationTool");
        // "2.0" in all published files; later revisions of FMI 2 would say 2.0.x and mean the same interface.
        if d.fmi_version.trim() == "2" || d.fmi_version.trim().starts_with("2.") {
            Ok(())
        } else {
            Err(DescriptionError::WrongVersion { found: d.fmi_version.clone(), supported: "2.0" })
        }
    }

    fn co_simulation(&mut self, e: &Element) -> Result<(), DescriptionError> {
        let flag = |name| e.flag(name);
        let identifier = e.attribute("modelIdentifier").filter(|id| !id.is_empty() && !id.contains(['/', '\\', '\0']));
        self.co_simulation = true;
        self.description.co_simulation = Capabilities {
            model_identifier: identifier.ok_or_else(|| DescriptionError::Attribute {
                element: "CoSimulation".into(),
                attribute: "modelIdentifier",
            })?,
            needs_execution_tool: flag("needsExecutionTool"),
            can_handle_variable_communication_step_size: flag("canHandleVariableCommunicationStepSize"),
            can_interpolate_inputs: flag("canInterpolateInputs"),
            max_output_derivative_order: e.number("maxOutputDerivativeOrder").unwrap_or(0),
            can_run_asynchronously: flag("canRunAsynchronuously"), // sic: the schema has it so
            can_be_instantiated_only_once_per_process: flag("canBeInstantiatedOnlyOncePerProcess"),
            can_not_use_memory_management_functions: flag("canNotUseMemoryManagementFunctions"),
            can_get_and_set_state: flag("canGetAndSetFMUstate"),
            can_serialize_state: flag("canSerializeFMUstate"),
            provides_directional_derivative: flag("providesDirectionalDerivative"),
        };
        Ok(())
    }

    fn scalar_variable(&mut self, e: &Element) -> Result<(), DescriptionError> {
        let without = |element: String, attribute| DescriptionError::Attribute { element, attribute };
        let name = e.attribute("name").ok_or_else(|| without("a ScalarVariable".into(), "name"))?;
        let value_reference = e.number("valueReference");
        let value_reference =
            value_reference.ok_or_else(|| without(format!("the ScalarVariable {name}"), "valueReference"))?;
        let text = |name, default: &str| e.attribute(name).unwrap_or_else(|| default.to_string());
        self.description.push(ScalarVariable {
            name,
            value_reference,
            description: text("description", ""),
            causality: text("causality", "local"),
            variability: text("variability", "continuous"),
            initial: e.attribute("initial"),
            ..ScalarVariable::default()
        });
        Ok(())
    }

    fn variable_type(&mut self, kind: &str, e: &Element) {
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
        variable.start = e.attribute("start");
        // An empty one says nothing.
        variable.unit = e.attribute("unit").filter(|unit| !unit.trim().is_empty());
        variable.declared_type = e.attribute("declaredType");
    }

    fn finish(mut self) -> Result<ModelDescription, DescriptionError> {
        for variable in &mut self.description.variables {
            let declared = || self.type_units.get(variable.declared_type.as_ref()?).cloned();
            variable.unit = variable.unit.take().or_else(declared);
        }
        if self.co_simulation { Ok(self.description) } else { Err(DescriptionError::NoCoSimulation) }
    }
}

fn unit(e: &Element) -> Unit {
    let real = |name, default| e.number(name).unwrap_or(default);
    let powers = ["kg", "m", "s", "A", "K", "mol", "cd", "rad"];
    let powers = powers.map(|name| e.number(name).unwrap_or(0));
    Unit { factor: real("factor", 1.0), offset: real("offset", 0.0), powers }
}
