//! A system as it was understood, as an archive of its own: flattened, with all values inside, in the FMUs' own units, and
//! with all settings. `ttb run` of it gives the same results from anywhere.

use std::collections::BTreeMap;
use std::fs::File;
use std::io;
use std::path::{Path, PathBuf};

use ttb_fmi::description::{ModelDescription, VariableType};
use ttb_ssp::{
    Binding, Component, Connection, Content, Experiment, Parameter, ParameterSet, RESOURCES, Source, Structure, System,
    Transformation, Values, pack,
};

use super::annotation::{Settings, write};
use super::wiring::{Link, Side};
use crate::connect::map::Value;
use crate::error::Error;
use crate::files::whole;

/// Name of the archive in a folder of results.
pub const NAME: &str = "system.resolved.ssp";

/// The structure, and the FMUs by their paths in the archive.
pub struct Resolved {
    structure: Structure,
    fmus: Vec<(String, PathBuf)>,
}

impl Resolved {
    /// Of two components, how they are linked, their start values and all settings.
    pub fn new(
        of: &Structure,
        sides: &[Side; 2],
        links: &[Link],
        parameters: &[BTreeMap<String, Value>],
        settings: &Settings,
        end: f64,
    ) -> Self {
        let mut fmus = Vec::new();
        let mut components = Vec::new();
        for (k, ((component, description), parameters)) in sides.iter().zip(parameters).enumerate() {
            let plain = |c: char| if c.is_ascii_alphanumeric() || "-_.".contains(c) { c } else { '_' };
            let name: String = component.name.chars().take(60).map(plain).collect();
            let path = format!("{RESOURCES}/{}-{name}.fmu", k + 1);
            fmus.push((path.clone(), component.file.clone().unwrap_or_default()));
            components.push(Component {
                name: component.name.clone(),
                source: Source::inside(path),
                description: component.description.clone(),
                connectors: component.connectors.clone(),
                bindings: bindings(parameters, description),
                ..Component::default()
            });
        }
        let connection = |link: &Link| {
            let transformation = Transformation::linear(link.line.factor, link.line.offset);
            let name = |side: usize| Some(sides[side].0.name.clone());
            Connection {
                start: (name(link.from), link.output.clone()),
                end: (name(1 - link.from), link.input.clone()),
                suppress_unit_conversion: transformation.is_some(),
                transformation,
                place: String::new(),
            }
        };
        let structure = Structure {
            name: of.name.clone(),
            description: of.description.clone(),
            tool: Some(concat!("ttb ", env!("CARGO_PKG_VERSION")).into()),
            system: System {
                name: of.system.name.clone(),
                description: of.system.description.clone(),
                components,
                connections: links.iter().map(connection).collect(),
                ..System::default()
            },
            units: of.units.clone(),
            enumerations: Vec::new(),
            experiment: Experiment { start: Some(0.0), stop: Some(end), annotations: write(settings) },
        };
        Self { structure, fmus }
    }

    /// Writes it into a folder; returns its path.
    pub fn write(&self, folder: &Path) -> Result<PathBuf, Error> {
        let path = folder.join(NAME);
        let entries: Vec<(&str, Content)> =
            self.fmus.iter().map(|(name, file)| (name.as_str(), Content::File(file))).collect();
        whole(&path, |part| pack(&self.structure, &entries, None, &File::create(part)?).map_err(io::Error::other))?;
        Ok(path)
    }
}

/// Start values as a binding, in the FMU's own units.
pub fn bindings(parameters: &BTreeMap<String, Value>, description: &ModelDescription) -> Vec<Binding> {
    let parameter = |(name, value): (&String, &Value)| {
        let whole = description
            .variable(name)
            .is_some_and(|v| matches!(v.kind, VariableType::Integer | VariableType::Enumeration));
        let value = match value {
            Value::Number(x) if whole => ttb_ssp::Value::Integer(*x as i64),
            Value::Number(x) => ttb_ssp::Value::Real(*x, None),
            Value::Boolean(truth) => ttb_ssp::Value::Boolean(*truth),
            Value::Text(text) => ttb_ssp::Value::Text(text.clone()),
        };
        Parameter { name: name.clone(), value, file: String::new(), place: String::new() }
    };
    if parameters.is_empty() {
        return Vec::new();
    }
    let set = ParameterSet { name: "parameters".into(), parameters: parameters.iter().map(parameter).collect() };
    vec![Binding { values: Values::Inline(set), ..Binding::default() }]
}
