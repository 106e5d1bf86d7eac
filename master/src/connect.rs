//! From two FMU files to two coupled subsystems: variables of equal name are connected, or those that a list names.

use std::collections::HashSet;
use std::path::Path;

use ttb_coupling::probe::Probe;
use ttb_coupling::{Coupling, Subsystem};
use ttb_fmi2::import::{Another, Fmu, FmuError, FmuInstance, FmuSubsystem, Linear, ModelDescription, VariableType};
use ttb_fmi2::isolate::Isolation;
use ttb_scenario::Checked;
use ttb_scenario::types::{CouplingSettings, Send};

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
    /// How they are connected.
    pub wiring: Wiring,
    /// What trial steps before the first one showed.
    pub probe: Probe,
}

/// A bridge in initialization mode.
pub struct Bridge {
    /// It.
    pub instance: FmuInstance,
    /// Makes another one, which shares nothing with it.
    pub another: Box<dyn Fn() -> Result<FmuInstance, Error> + std::marker::Send>,
    /// Whether there may be several in this process.
    pub several: bool,
    /// Whether to believe that it saves and restores its state.
    pub trusted: bool,
}

impl Bridge {
    /// Of an FMU file, for a run to `end`.
    pub fn open(
        path: &Path,
        name: &str,
        isolation: Option<&Isolation>,
        end: f64,
        trusted: bool,
    ) -> Result<Self, Error> {
        let (path, name, isolation) = (path.to_path_buf(), name.to_string(), isolation.cloned());
        let apart = isolation.is_some();
        let another = move || instantiate(&isolate::open(&path, isolation.as_ref())?, &name, end);
        let instance = another()?;
        let several = apart || !instance.description().co_simulation.can_be_instantiated_only_once_per_process;
        Ok(Self { instance, another: Box::new(another), several, trusted })
    }
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
#[derive(Clone)]
pub struct Wiring {
    /// From the train–track side to the bridge.
    pub forces: Vec<Wire>,
    /// From the bridge to the train–track side.
    pub motions: Vec<Wire>,
}

/// Loads both FMUs, enters initialization mode, connects.
///
/// Variables of equal name belong together, or those that `map` names. A bridge that is not `trusted` is taken for one that
/// cannot roll back.
pub fn connect(
    train_track: &Path,
    bridge: &Path,
    checked: &Checked,
    isolated: &Isolated,
    map: Option<&Map>,
    trusted: bool,
) -> Result<Connected, Error> {
    let end = checked.train_track.end;
    let train_track = isolate::open(train_track, isolated.train_track.as_ref())?;
    let train_track = instantiate(&train_track, "TrainTrack", end)?;
    let offered = Bridge::open(bridge, "Bridge", isolated.bridge.as_ref(), end, trusted)?;
    let bridge = &offered.instance;
    if let Some(map) = map {
        let wiring = map.wiring(train_track.description(), bridge.description())?;
        let warnings = checked.warnings.clone();
        return couple(train_track, offered, wiring, &checked.scenario.coupling, checked.axle_load, warnings);
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
    refuse_strangers(bridge, &train_track, &forces)?;
    if let Some(open) = unconnected(bridge.description(), &forces) {
        warnings.push(format!("{}: input {open} is connected to nothing and keeps its start value", bridge.name()));
    }
    let equal = |names: Vec<String>| names.into_iter().map(Wire::equal).collect();
    let wiring = Wiring { forces: equal(forces), motions: equal(motions) };
    couple(train_track, offered, wiring, &checked.scenario.coupling, checked.axle_load, warnings)
}

impl Wire {
    /// Of two variables of equal name and unit.
    fn equal(name: String) -> Self {
        Self { input: name.clone(), output: name, from_output: Linear::IDENTITY, to_input: Linear::IDENTITY }
    }
}

/// Couples two FMUs in initialization mode by explicit wiring; `force_scale` is that of the tolerance, N.
pub fn couple(
    train_track: FmuInstance,
    bridge: Bridge,
    wiring: Wiring,
    coupling: &CouplingSettings,
    force_scale: f64,
    mut warnings: Vec<String>,
) -> Result<Connected, Error> {
    let settings = coupling.settings(force_scale);
    if settings.max_iterations > 1 && !train_track.can_restore() {
        return Err(Error::Input(format!(
            "{} cannot save and restore its state (canGetAndSetFMUstate), so its steps cannot be repeated; one pass a step is \
             coupling.max_iterations = 1 with on_failure = accept, which is only accurate for heavy bridges and small steps",
            train_track.name()
        )));
    }
    let Bridge { instance: bridge, another, several, trusted } = bridge;
    let name = bridge.name().to_string();
    let rolls_back = trusted && bridge.can_restore();
    if settings.max_iterations > 1 && !rolls_back {
        let cannot =
            if trusted { "cannot save and restore its state (canGetAndSetFMUstate)" } else { "is not rolled back" };
        warnings.push(format!(
            "{name} {cannot}: its steps are taken once, without iteration; the summary estimates the error"
        ));
    }
    if coupling.send == Send::Rate && !bridge.can_interpolate() {
        return Err(Error::Input(format!(
            "coupling.send is rate, but {name} cannot interpolate inputs: use auto or mean"
        )));
    }
    let train_track = subsystem(train_track, &wiring.motions, &wiring.forces)?;
    let mut bridge = subsystem(bridge, &wiring.forces, &wiring.motions)?;
    if !rolls_back {
        let wires = wiring.clone();
        let another: Another = Box::new(move || {
            let impossible = |e: Error| FmuError::Impossible { instance: name.clone(), what: e.to_string() };
            subsystem(another().map_err(impossible)?, &wires.forces, &wires.motions).map_err(impossible)
        });
        bridge = bridge.without_roll_back(several.then_some(another));
    }
    if !train_track.can_interpolate() {
        warnings.push("the train–track FMU cannot interpolate inputs: the deck's motion is sent as held means".into());
    }
    let coupling = Coupling::new(wiring.forces.len(), wiring.motions.len(), settings);
    Ok(Connected { train_track, bridge, coupling, warnings, wiring, probe: Probe::default() })
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
