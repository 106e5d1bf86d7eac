//! `ttb export-ssp`: a scenario's two FMUs, how they are connected and how they are iterated, as one archive.

use std::collections::BTreeMap;
use std::fs::File;
use std::io;
use std::path::{Path, PathBuf};

use ttb_contract::names::mean_force;
use ttb_fmi::archive::unpack;
use ttb_fmi::description::{ModelDescription, VariableType};
use ttb_fmi::temporary::Temporary;
use ttb_fmi2::import::read_description;
use ttb_model_description::Date;
use ttb_scenario::Checked;
use ttb_scenario::types::{Fmus, ParameterValue};
use ttb_ssp::{
    BaseUnit, Component, Connection, Connector, Content, EXTRA, Experiment, Kind, RESOURCES, Source, Stamp, Structure,
    System, Type, Unit, pack,
};

use super::annotation::{Settings, write};
use super::resolved::bindings;
use crate::cli::{ExportSsp, Master};
use crate::connect::parameters;
use crate::error::Error;
use crate::files::whole;
use crate::prepare::auto::decided;
use crate::prepare::fmus;

const NAME: &str = "TrainTrackBridge";
/// Item `end` of the train–track FMU's `input_meaning`.
const END: f64 = 3.0;
/// Names of the components, and their places in a drawing.
const COMPONENTS: [(&str, [f64; 4]); 2] =
    [("TrainTrack", [0.0, 80.0, 160.0, 140.0]), ("Bridge", [0.0, 0.0, 160.0, 60.0])];

/// The command; returns the archive's path.
pub fn export(arguments: &ExportSsp) -> Result<PathBuf, Error> {
    let (checked, prepared) = decided(arguments.scenario.as_deref(), &arguments.set)?;
    let text = match &arguments.scenario {
        Some(path) => ttb_scenario::read_text(path).map_err(Error::io(path))?,
        None => ttb_scenario::default_scenario_text().to_string(),
    };
    let folder = Temporary::new("ttb-export-").map_err(Error::io(Path::new("temporary folder")))?;
    let built = fmus::build(&checked, prepared, folder.path())?;
    let descriptions = [describe(&built.train_track)?, describe(&built.bridge)?];
    let structure = structure(&checked, &descriptions, arguments.master)?;
    let path = arguments.output.clone().unwrap_or_else(|| {
        let stem = arguments.scenario.as_deref().and_then(Path::file_stem).unwrap_or("default".as_ref());
        Path::new(stem).with_extension("ssp")
    });
    if let Some(parent) = path.parent().filter(|parent| !parent.as_os_str().is_empty()) {
        std::fs::create_dir_all(parent).map_err(Error::io(parent))?;
    }
    let sources = COMPONENTS.map(|(name, _)| source(name));
    let entries = [
        (sources[0].as_str(), Content::File(&built.train_track)),
        (sources[1].as_str(), Content::File(&built.bridge)),
        (&format!("{EXTRA}/org.ttb/scenario.json"), Content::Text(&text)),
    ];
    let date = Date::asked_for().map_err(Error::Input)?;
    let stamp = date.map(|date| Stamp { text: date.text(), entry: date.of_entry() });
    whole(&path, |part| pack(&structure, &entries, stamp.as_ref(), &File::create(part)?).map_err(io::Error::other))?;
    Ok(path)
}

/// Path of a component's FMU inside the archive.
fn source(name: &str) -> String {
    format!("{RESOURCES}/{name}.fmu")
}

fn describe(fmu: &Path) -> Result<ModelDescription, Error> {
    let failed = |why: String| Error::Pack(format!("{}: {why}", fmu.display()));
    let folder = unpack(fmu).map_err(|e| failed(e.to_string()))?;
    let xml = std::fs::read(folder.path().join("modelDescription.xml")).map_err(|e| failed(e.to_string()))?;
    read_description(&xml).map_err(|e| failed(e.to_string()))
}

fn structure(
    checked: &Checked,
    [train_track, bridge]: &[ModelDescription; 2],
    master: Master,
) -> Result<Structure, Error> {
    let title = Some(checked.scenario.title.clone()).filter(|title| !title.is_empty());
    let settings = Settings {
        step: Some(checked.steps().step),
        substeps: checked.steps().substeps,
        force_scale: checked.axle_load,
        train_track: Some(COMPONENTS[0].0.into()),
        output: checked.scenario.output.clone(),
        peaks: Some(checked.peaks),
        coupling: checked.scenario.coupling,
        place: String::new(),
    };
    let [first, second] = COMPONENTS.map(|(name, _)| name);
    let equal = |input: &str| input.to_string();
    let means = settings.substeps > 1 || master != Master::OnePassParallel;
    let of_force = |input: &str| if means { mean_force(input) } else { input.to_string() };
    let forces = connections((first, train_track), (second, bridge), &of_force);
    let motions = connections((second, bridge), (first, train_track), &equal);
    let mut units: Vec<Unit> = Vec::new();
    for (name, unit) in train_track.units.iter().chain(&bridge.units) {
        if units.iter().all(|known| known.name != *name) {
            let base = BaseUnit { powers: unit.powers, factor: unit.factor, offset: unit.offset };
            units.push(Unit { name: name.clone(), base });
        }
    }
    units.sort_by(|a, b| a.name.cmp(&b.name));
    let Fmus { train_track: of_track, bridge: of_bridge } = &checked.scenario.fmus;
    let (mut of_track, of_bridge) = (of_track.parameters.clone(), &of_bridge.parameters);
    if master == Master::Iterating {
        of_track.entry("input_meaning".into()).or_insert(ParameterValue::Number(END));
    }
    let bindings =
        [(&of_track, train_track, first), (of_bridge, bridge, second)].map(|(parameters, description, name)| {
            (misfits(parameters, description, name), bindings(parameters, description))
        });
    let problems: Vec<String> = bindings.iter().flat_map(|(problems, _)| problems.clone()).collect();
    if !problems.is_empty() {
        return Err(Error::Input(problems.join("\n")));
    }
    let [of_track, of_bridge] = bindings.map(|(_, bindings)| bindings);
    Ok(Structure {
        name: NAME.into(),
        description: title.clone(),
        tool: Some(concat!("ttb ", env!("CARGO_PKG_VERSION")).into()),
        system: System {
            name: NAME.into(),
            description: title,
            components: COMPONENTS
                .iter()
                .zip([(train_track, of_track), (bridge, of_bridge)])
                .map(|((name, geometry), (description, bindings))| {
                    let component = component(name, *geometry, description);
                    Component { bindings, ..component }
                })
                .collect(),
            connections: forces.chain(motions).collect(),
            ..System::default()
        },
        units,
        enumerations: Vec::new(),
        experiment: Experiment { start: Some(0.0), stop: Some(checked.train_track.end), annotations: write(&settings) },
    })
}

/// Parameters that the FMU has not, or cannot take.
fn misfits(parameters: &BTreeMap<String, ParameterValue>, description: &ModelDescription, name: &str) -> Vec<String> {
    let problems = parameters::problems(description, parameters);
    problems.into_iter().map(|problem| format!("{name}: {problem}")).collect()
}

/// Inputs and outputs; a parameter keeps the value it has inside.
fn component(name: &str, geometry: [f64; 4], description: &ModelDescription) -> Component {
    let connectors = description.variables.iter().filter_map(|v| {
        let kind = match v.causality.as_str() {
            "input" => Kind::Input,
            "output" => Kind::Output,
            _ => return None,
        };
        let kind_of_value = match v.kind {
            VariableType::Real => Type::Real(v.unit.clone()),
            other => Type::Other(format!("{other:?}")),
        };
        Some(Connector { name: v.name.clone(), kind, kind_of_value: Some(kind_of_value), place: String::new() })
    });
    Component {
        name: name.into(),
        source: Source::inside(source(name)),
        connectors: connectors.collect(),
        geometry: Some(geometry),
        ..Component::default()
    }
}

/// Outputs of one to the inputs of the other; `output` names the one for an input.
fn connections<'a>(
    (from, outputs): (&'a str, &'a ModelDescription),
    (to, inputs): (&'a str, &'a ModelDescription),
    output: &'a dyn Fn(&str) -> String,
) -> impl Iterator<Item = Connection> + 'a {
    let fits = |name: &str| outputs.variable(name).is_some_and(|v| v.causality == "output");
    inputs.with_causality("input").filter(move |v| fits(&output(&v.name))).map(move |v| Connection {
        start: (Some(from.into()), output(&v.name)),
        end: (Some(to.into()), v.name.clone()),
        transformation: None,
        suppress_unit_conversion: false,
        place: String::new(),
    })
}
