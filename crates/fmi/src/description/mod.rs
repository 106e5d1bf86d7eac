//! What a modelDescription.xml says, as far as a co-simulation master wants to know. The words are FMI 2.0's; a reader of
//! another version maps its own onto them. [`tree`] walks through the document, whatever its version.

pub mod decode;
mod error;
pub mod tree;

pub use error::DescriptionError;

use std::collections::{HashMap, HashSet};

/// An FMU's description of itself.
#[derive(Clone, Debug, Default)]
pub struct ModelDescription {
    /// `fmiVersion`: 2.0 or a relative of it.
    pub fmi_version: String,
    /// What the library compares.
    pub guid: String,
    /// Name for people.
    pub model_name: String,
    /// Tool that made the FMU; empty where not said.
    pub generation_tool: String,
    /// Name of the library and what it can do.
    pub co_simulation: Capabilities,
    /// Suggested start time in s.
    pub start_time: Option<f64>,
    /// Suggested stop time in s.
    pub stop_time: Option<f64>,
    /// Suggested communication step in s.
    pub step_size: Option<f64>,
    /// Units by name, those that say what they are in SI.
    pub units: HashMap<String, Unit>,
    /// Names of all defined units: what they are in SI need not be said.
    pub defined_units: HashSet<String>,
    /// Names of the log categories.
    pub log_categories: Vec<String>,
    /// Items of the enumerations, with their numbers, by the type's name.
    pub enumerations: HashMap<String, Vec<(String, i32)>>,
    /// All variables in the order of the file.
    pub variables: Vec<ScalarVariable>,
    by_name: HashMap<String, usize>,
}

/// Attributes of the element `CoSimulation`; absent means false or 0.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Capabilities {
    /// Name of the library.
    pub model_identifier: String,
    /// Another program must be installed.
    pub needs_execution_tool: bool,
    /// Steps may differ.
    pub can_handle_variable_communication_step_size: bool,
    /// Understands `fmi2SetRealInputDerivatives`.
    pub can_interpolate_inputs: bool,
    /// Highest order of `fmi2GetRealOutputDerivatives`.
    pub max_output_derivative_order: u32,
    /// Steps may be asynchronous.
    pub can_run_asynchronously: bool,
    /// One instance per process.
    pub can_be_instantiated_only_once_per_process: bool,
    /// Does not use the memory callbacks.
    pub can_not_use_memory_management_functions: bool,
    /// Can be rolled back.
    pub can_get_and_set_state: bool,
    /// States become bytes.
    pub can_serialize_state: bool,
    /// Answers `fmi2GetDirectionalDerivative`.
    pub provides_directional_derivative: bool,
}

/// A unit in terms of SI: value in SI = factor · value + offset.
#[derive(Clone, Debug, PartialEq)]
pub struct Unit {
    /// Scale to the base unit.
    pub factor: f64,
    /// Shift to the base unit.
    pub offset: f64,
    /// Powers of kg, m, s, A, K, mol, cd, rad.
    pub powers: [i32; 8],
}

/// FMI type of a variable.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum VariableType {
    /// Real.
    #[default]
    Real,
    /// Integer.
    Integer,
    /// Boolean.
    Boolean,
    /// String.
    String,
    /// Enumeration, exchanged as an Integer.
    Enumeration,
}

/// One variable. Where the file does not say, causality and variability have the standard's defaults.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ScalarVariable {
    /// Unique name.
    pub name: String,
    /// Handle for get and set.
    pub value_reference: u32,
    /// For people; empty where not said.
    pub description: String,
    /// `input`, `output`, `parameter`, `local`, …
    pub causality: String,
    /// `continuous`, `discrete`, `fixed`, …
    pub variability: String,
    /// `exact`, `approx` or `calculated`, where said.
    pub initial: Option<String>,
    /// Type.
    pub kind: VariableType,
    /// Start value as it stands in the file.
    pub start: Option<String>,
    /// Unit, its own or its declared type's.
    pub unit: Option<String>,
    /// Name of its declared type.
    pub declared_type: Option<String>,
}

impl ModelDescription {
    /// Adds a variable behind the others.
    pub fn push(&mut self, variable: ScalarVariable) {
        self.by_name.insert(variable.name.clone(), self.variables.len());
        self.variables.push(variable);
    }

    /// The variable of that name.
    pub fn variable(&self, name: &str) -> Option<&ScalarVariable> {
        self.by_name.get(name).map(|i| &self.variables[*i])
    }

    /// What makes it impossible to say which variable a name or a value reference means: two inputs or outputs of one
    /// name, two Real inputs of one reference.
    pub fn ambiguity(&self) -> Option<String> {
        let mut names: HashMap<&str, &str> = HashMap::new();
        let mut inputs: HashMap<u32, &str> = HashMap::new();
        for v in self.variables.iter().filter(|v| matches!(v.causality.as_str(), "input" | "output")) {
            if names.insert(&v.name, &v.causality).is_some() {
                return Some(format!("two variables are called {}", v.name));
            }
            if v.kind != VariableType::Real || v.causality != "input" {
                continue;
            }
            if let Some(other) = inputs.insert(v.value_reference, &v.name) {
                return Some(format!(
                    "the inputs {other} and {} share the value reference {}",
                    v.name, v.value_reference
                ));
            }
        }
        None
    }

    /// All variables of a causality, in the order of the file.
    pub fn with_causality<'a>(&'a self, causality: &'a str) -> impl Iterator<Item = &'a ScalarVariable> {
        self.variables.iter().filter(move |v| v.causality == causality)
    }
}
