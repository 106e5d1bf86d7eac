//! From two FMU files to two coupled subsystems: variables of equal name are connected, or those that a list names.

use std::collections::{HashMap, HashSet};
use std::path::Path;

use ttb_coupling::{Coupling, Settings, Subsystem};
use ttb_fmi2::import::{Fmu, FmuInstance, FmuSubsystem, Linear, ModelDescription, VariableType};
use ttb_scenario::Checked;
use ttb_scenario::types::Send;

use crate::error::Error;
use crate::isolate::{self, Isolated};
use crate::map::Map;

/// Both FMUs in initialization mode, and their coupling.
pub struct Connected {
    /// The train–track FMU.
    pub train_track: FmuSubsystem,
    /// The bridge FMU.
    pub bridge: FmuSubsystem,
    /// The iteration.
    pub coupling: Coupling,
    /// What was noticed.
    pub warnings: Vec<String>,
}

/// A connected pair of variables, and the lines between each of them and the iteration.
#[derive(Clone)]
pub struct Wire {
    /// An output of one FMU.
    pub output: String,
    /// An input of the other.
    pub input: String,
    /// From the output to the iteration.
    pub from_output: Linear,
    /// From the iteration to the input.
    pub to_input: Linear,
}

/// All connections.
pub struct Wiring {
    /// From the train–track side to the bridge.
    pub forces: Vec<Wire>,
    /// From the bridge to the train–track side.
    pub motions: Vec<Wire>,
}

/// Loads both FMUs, enters initialization mode, connects.
///
/// Variables of equal name belong together, or those that `map` names.
pub fn connect(
    train_track: &Path,
    bridge: &Path,
    checked: &Checked,
    isolated: &Isolated,
    map: Option<&Map>,
) -> Result<Connected, Error> {
    let end = checked.train_track.end;
    let train_track = isolate::open(train_track, isolated.train_track.as_ref())?;
    let train_track = instantiate(&train_track, "TrainTrack", end)?;
    let bridge = instantiate(&isolate::open(bridge, isolated.bridge.as_ref())?, "Bridge", end)?;
    if let Some(map) = map {
        let wiring = map.wiring(train_track.description(), bridge.description())?;
        let warnings = checked.warnings.clone();
        return couple(train_track, bridge, &wiring, checked.settings(), checked.scenario.coupling.send, warnings);
    }
    let forces = shared(train_track.description(), bridge.description());
    let motions = shared(bridge.description(), train_track.description());
    let mut warnings = checked.warnings.clone();
    if let Some(open) = unconnected(train_track.description(), &motions) {
        return Err(Error::Input(format!(
            "{}: no output of {} has the name of its input {open}",
            train_track.name(),
            bridge.name()
        )));
    }
    if forces.is_empty() || motions.is_empty() {
        let (a, b) = (bridge.name(), train_track.name());
        return Err(Error::Input(format!(
            "{a} and {b} share no variable of equal name that is an input of one and an output of the other"
        )));
    }
    refuse_strangers(&bridge, &train_track, &forces)?;
    if let Some(open) = unconnected(bridge.description(), &forces) {
        warnings.push(format!("{}: input {open} is connected to nothing and keeps its start value", bridge.name()));
    }
    let equal = |names: Vec<String>| names.into_iter().map(Wire::equal).collect();
    let wiring = Wiring { forces: equal(forces), motions: equal(motions) };
    couple(train_track, bridge, &wiring, checked.settings(), checked.scenario.coupling.send, warnings)
}

impl Wire {
    /// Of two variables of equal name and unit.
    fn equal(name: String) -> Self {
        Self { input: name.clone(), output: name, from_output: Linear::IDENTITY, to_input: Linear::IDENTITY }
    }
}

/// Couples two FMUs in initialization mode by explicit wiring.
pub fn couple(
    train_track: FmuInstance,
    bridge: FmuInstance,
    wiring: &Wiring,
    settings: Settings,
    send: Send,
    mut warnings: Vec<String>,
) -> Result<Connected, Error> {
    if settings.max_iterations > 1 && !train_track.can_restore() {
        return Err(Error::Input(format!(
            "{} cannot save and restore its state (canGetAndSetFMUstate), so its steps cannot be repeated; one pass a step is \
             coupling.max_iterations = 1 with on_failure = accept, which is only accurate for heavy bridges and small steps",
            train_track.name()
        )));
    }
    if settings.max_iterations > 1 && !bridge.can_restore() {
        warnings.push(format!(
            "{} cannot save and restore its state (canGetAndSetFMUstate): its steps are taken once, without iteration; the \
             summary estimates the error",
            bridge.name()
        ));
    }
    if send == Send::Rate && !bridge.can_interpolate() {
        let name = bridge.name();
        return Err(Error::Input(format!(
            "coupling.send is rate, but {name} cannot interpolate inputs: use auto or mean"
        )));
    }
    let displacements = displacements(wiring);
    let means = if settings.mean_forces { Some(means(&train_track, &wiring.forces)?) } else { None };
    let train_track = subsystem(train_track, &wiring.motions, means.as_deref().unwrap_or(&wiring.forces))?;
    let bridge = subsystem(bridge, &wiring.forces, &wiring.motions)?;
    if !train_track.can_interpolate() {
        warnings.push("the train–track FMU cannot interpolate inputs: the deck's motion is sent as held means".into());
    }
    let coupling = Coupling::new(wiring.forces.len(), wiring.motions.len(), settings);
    let coupling = coupling.with_displacements(displacements);
    Ok(Connected { train_track, bridge, coupling, warnings })
}

/// The train–track FMU's outputs `….force` replaced by `….mean_force`, which sub-steps send.
fn means(train_track: &FmuInstance, forces: &[Wire]) -> Result<Vec<Wire>, Error> {
    let refused = |why: String| Err(Error::Input(format!("{}: several sub-steps need {why}", train_track.name())));
    if !train_track.can_interpolate() {
        return refused("inputs that can be interpolated (canInterpolateInputs)".into());
    }
    let mut wires = forces.to_vec();
    for wire in &mut wires {
        wire.output = mean(&wire.output);
        if train_track.description().variable(&wire.output).is_none() {
            return refused(format!("an output {}", wire.output));
        }
    }
    Ok(wires)
}

/// Where each force finds its displacement among the motions, by the train–track FMU's names `….force` and
/// `….displacement`; none if they are called otherwise.
fn displacements(wiring: &Wiring) -> Vec<usize> {
    let places: HashMap<&str, usize> =
        wiring.motions.iter().enumerate().map(|(i, wire)| (wire.input.as_str(), i)).collect();
    let of_force = |wire: &Wire| places.get(format!("{}.displacement", place(&wire.output)).as_str()).copied();
    wiring.forces.iter().map(of_force).collect::<Option<_>>().unwrap_or_default()
}

/// The output with the mean over a step of a force, `support[3].force`.
pub fn mean(force: &str) -> String {
    format!("{}.mean_force", place(force))
}

/// `support[3]` of `support[3].force`.
fn place(name: &str) -> &str {
    name.rsplit_once('.').map_or(name, |(place, _)| place)
}

/// One side, by the wires to it and from it.
fn subsystem(instance: FmuInstance, to: &[Wire], from: &[Wire]) -> Result<FmuSubsystem, Error> {
    let inputs: Vec<&str> = to.iter().map(|wire| wire.input.as_str()).collect();
    let outputs: Vec<&str> = from.iter().map(|wire| wire.output.as_str()).collect();
    let into: Vec<Linear> = to.iter().map(|wire| wire.to_input).collect();
    let out: Vec<Linear> = from.iter().map(|wire| wire.from_output).collect();
    Ok(FmuSubsystem::new(instance, &inputs, &outputs)?.transformed(&into, &out))
}

/// An instance in initialization mode.
pub fn instantiate(fmu: &Fmu, name: &str, end: f64) -> Result<FmuInstance, Error> {
    let mut instance = fmu.instantiate(name, false)?;
    instance.setup_experiment(0.0, Some(end))?;
    instance.enter_initialization()?;
    Ok(instance)
}

/// Real outputs of `from` that are Real inputs of `to`, in the order of the inputs.
fn shared(from: &ModelDescription, to: &ModelDescription) -> Vec<String> {
    let outputs: HashSet<&str> =
        from.with_causality("output").filter(|v| v.kind == VariableType::Real).map(|v| v.name.as_str()).collect();
    let inputs = to.with_causality("input").filter(|v| v.kind == VariableType::Real);
    inputs.filter(|v| outputs.contains(v.name.as_str())).map(|v| v.name.clone()).collect()
}

/// The first input that is not among `connected`, and how many more there are.
fn unconnected(description: &ModelDescription, connected: &[String]) -> Option<String> {
    let connected: HashSet<&str> = connected.iter().map(String::as_str).collect();
    let mut open = description.with_causality("input").filter(|v| !connected.contains(v.name.as_str()));
    let first = open.next()?.name.clone();
    let more = open.count();
    Some(if more == 0 { first } else { format!("{first} (and {more} more)") })
}

/// Two FMUs of different scenarios share some names of a series, `support[1].force` and so on, and lack others: coupled all
/// the same they would lose forces.
fn refuse_strangers(bridge: &FmuInstance, train_track: &FmuInstance, forces: &[String]) -> Result<(), Error> {
    let series = |name: &str| name.split(|c: char| c.is_ascii_digit()).collect::<Vec<_>>().join("#");
    let coupled: HashSet<String> = forces.iter().map(|name| series(name)).collect();
    let known: HashSet<&str> = forces.iter().map(String::as_str).collect();
    for (fmu, causality) in [(bridge, "input"), (train_track, "output")] {
        let alone = |name: &str| coupled.contains(&series(name)) && !known.contains(name);
        let mut lonely = fmu.description().with_causality(causality).filter(|v| alone(&v.name));
        if let Some(first) = lonely.next() {
            let (name, more) = (&first.name, lonely.count());
            return Err(Error::Input(format!(
                "{}: {causality} {name} (and {more} more) has no partner, though {} others of its series have: the two FMUs \
                 belong to different scenarios",
                fmu.name(),
                forces.len()
            )));
        }
    }
    Ok(())
}
