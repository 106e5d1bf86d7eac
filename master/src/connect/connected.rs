//! From FMU files to two coupled subsystems: variables of equal name are connected, or those that maps name.

use std::collections::BTreeMap;
use std::path::Path;

use ttb_assessment::Histories;
use ttb_contract::Subsystem;
use ttb_contract::names::mean_force;
use ttb_coupling::probe::Probe;
use ttb_coupling::{Adapted, Coupling, Joined, Lacks};
use ttb_fmi::isolate::Isolation;
use ttb_fmi::{Another, Fmu, FmuError, FmuInstance, FmuSubsystem};
use ttb_scenario::Checked;
use ttb_scenario::types::{Fmus, Sending};
use ttb_session::Case;

use super::assign::{Assigned, Ends, assign, places, ranges};
use super::equal::equal_names;
use super::isolate::{self, Isolated};
use super::map::{Map, Value};
use super::parameters;
use super::ports::in_order;
use super::probe::Rules;
use super::watched::{self, STATION};
use crate::error::Error;

/// The bridge side of a run: one FMU or several, each as the iteration wants it.
pub type BridgeSide = Joined<Adapted<FmuSubsystem>>;

/// Both sides in initialization mode, and their coupling.
pub struct Connected {
    /// The train–track FMU.
    pub train_track: FmuSubsystem,
    /// The bridge FMUs.
    pub bridge: BridgeSide,
    /// The iteration.
    pub coupling: Coupling,
    /// What was noticed.
    pub warnings: Vec<String>,
    /// Of every bridge: its name and its variables.
    pub parts: Vec<(String, Assigned)>,
    /// What trial steps before the first one showed.
    pub probe: Probe,
    /// Whether there may be more instances of every bridge in this process.
    pub several: bool,
    /// What trial steps are judged by.
    pub rules: Rules,
    /// Stations of the one bridge, m from its begin: where the points `station 1` … are. Of several bridges none.
    pub stations: Vec<f64>,
}

impl Connected {
    /// Gives points at stations their places.
    pub fn place(&self, histories: &mut Histories) {
        for point in histories.points.iter_mut().filter(|point| point.x.is_none()) {
            let number = point.name.strip_prefix(STATION).and_then(|number| number.parse::<usize>().ok());
            point.x = number.and_then(|number| self.stations.get(number.checked_sub(1)?)).copied();
        }
    }
}

/// A bridge FMU that the user gives, or that was built here.
pub struct Given<'a> {
    /// The file.
    pub path: &'a Path,
    /// How its variables belong to ours; none: by equal names.
    pub map: Option<&'a Map>,
}

/// A bridge in initialization mode.
pub struct Bridge {
    /// It.
    pub instance: FmuInstance,
    /// Makes another one, which shares nothing with it.
    pub another: Box<dyn Fn() -> Result<FmuInstance, Error> + Send>,
    /// Whether there may be several in this process.
    pub several: bool,
    /// Whether to save and restore its state, if it can.
    pub trusted: bool,
}

impl Bridge {
    /// Of an FMU file, for a run to `end`.
    pub fn open(
        path: &Path,
        name: &str,
        isolation: Option<&Isolation>,
        end: f64,
        parameters: &BTreeMap<String, Value>,
    ) -> Result<Self, Error> {
        let (path, name, isolation) = (path.to_path_buf(), name.to_string(), isolation.cloned());
        let (apart, parameters) = (isolation.is_some(), parameters.clone());
        let another = move || instantiate(&isolate::open(&path, isolation.as_ref())?, &name, end, &parameters);
        let instance = another()?;
        let several = apart || !instance.description().co_simulation.can_be_instantiated_only_once_per_process;
        Ok(Self { instance, another: Box::new(another), several, trusted: true })
    }
}

/// Loads the FMUs, enters initialization mode, connects.
///
/// Variables of equal name belong together, or those that maps name. Bridges that are not `trusted` are taken for such that
/// cannot roll back.
pub fn connect(
    train_track: &Path,
    bridges: &[Given],
    checked: &Checked,
    isolated: &Isolated,
    trusted: bool,
) -> Result<Connected, Error> {
    let end = checked.train_track.end;
    let train_track = isolate::open(train_track, isolated.train_track.as_ref())?;
    let ours = Map::default();
    let maps: Vec<&Map> = bridges.iter().map(|given| given.map.unwrap_or(&ours)).collect();
    let Fmus { train_track: of_track, bridge: of_bridge } = &checked.scenario.fmus;
    let of_maps = maps.iter().map(|map| &map.train_track_parameters);
    let of_track = parameters::together(&of_track.parameters, of_maps);
    let mut problems = Vec::new();
    let train_track = told(instantiate(&train_track, "TrainTrack", end, &of_track), &mut problems)?;
    let mut warnings = checked.warnings.clone();
    let mut offered = Vec::new();
    for (k, (given, map)) in bridges.iter().zip(&maps).enumerate() {
        let name = if bridges.len() == 1 { "Bridge".to_string() } else { format!("Bridge{}", k + 1) };
        let parameters = parameters::together(&of_bridge.parameters, [&map.parameters]);
        let bridge = Bridge::open(given.path, &name, isolated.bridge.as_ref(), end, &parameters);
        let bridge = told(bridge, &mut problems)?;
        offered.extend(bridge.map(|bridge| Bridge { trusted: trusted && map.roll_back, ..bridge }));
    }
    let Some(train_track) = train_track.filter(|_| problems.is_empty()) else {
        return Err(Error::Input(problems.join("\n")));
    };
    let (mut missing, mut stations) = (watched::points(checked), Vec::new());
    let assigned: Vec<Assigned> = match &offered[..] {
        [bridge] if bridges[0].map.is_none() => {
            let assigned = equal_names(&train_track, &bridge.instance, &mut warnings)?;
            let watch = watched::by_names(&assigned, checked, &mut missing);
            vec![Assigned { watch, ..assigned }]
        }
        _ => {
            let mut instances: Vec<&mut FmuInstance> = offered.iter_mut().map(|bridge| &mut bridge.instance).collect();
            let places = maps.iter().zip(&mut instances).map(|(map, bridge)| places(map, bridge));
            let places: Vec<Option<Vec<f64>>> = places.collect::<Result<_, _>>()?;
            let supports = &checked.bridge.supports;
            let ranges = ranges(&maps, &instances, &places, supports)?;
            if let [Some(places)] = &places[..] {
                stations.clone_from(places);
            }
            let each = maps.iter().zip(&instances).zip(ranges.iter().zip(&places));
            let each = each.map(|((map, bridge), (range, places))| {
                let assigned =
                    assign(map, train_track.description(), bridge, range, places.as_ref(), supports, &mut warnings)?;
                let watch = watched::watch(map, checked, range, places.as_ref(), &mut missing);
                Ok(Assigned { watch, ..assigned })
            });
            each.collect::<Result<_, Error>>()?
        }
    };
    let has = |name: &str| {
        let output = format!("point[{name}].displacement");
        offered.iter().any(|bridge| bridge.instance.description().variable(&output).is_some())
    };
    missing.retain(|name| !has(name));
    warnings.extend(watched::told(&missing));
    let parts = offered.into_iter().zip(assigned).collect();
    let connected = couple(train_track, parts, &Case::of(checked), checked.scenario.coupling.send, warnings)?;
    Ok(Connected { stations, ..connected })
}

/// Couples FMUs in initialization mode.
pub fn couple(
    train_track: FmuInstance,
    bridges: Vec<(Bridge, Assigned)>,
    case: &Case,
    send: Sending,
    mut warnings: Vec<String>,
) -> Result<Connected, Error> {
    let settings = case.settings;
    if settings.max_iterations > 1 && !train_track.can_restore() {
        return Err(Error::Input(format!(
            "{} cannot save and restore its state (canGetAndSetFMUstate), so its steps cannot be repeated; one pass a step is \
             coupling.max_iterations = 1 with on_failure = accept, which is only accurate for heavy bridges and small steps",
            train_track.name()
        )));
    }
    let all_several = bridges.iter().all(|(bridge, _)| bridge.several);
    let rolls_back = bridges.iter().all(|(bridge, _)| bridge.trusted && bridge.instance.can_restore());
    let mut forces_out = Ends::default();
    let (mut displacements, mut velocities) = (Ends::default(), Ends::default());
    let (mut sides, mut parts) = (Vec::new(), Vec::new());
    for (bridge, mut assigned) in bridges {
        let ports = in_order(&mut assigned, train_track.description(), case.axle_load);
        let name = bridge.instance.name().to_string();
        let ports = ports.ok_or_else(|| {
            Error::Input(format!("{name}: a force that counts must be positive, not {} N", case.axle_load))
        })?;
        let Bridge { mut instance, another, several, trusted } = bridge;
        if settings.max_iterations > 1 && !(trusted && instance.can_restore()) {
            let cannot =
                if trusted { "cannot save and restore its state (canGetAndSetFMUstate)" } else { "is not rolled back" };
            warnings.push(format!("{name} {cannot}: steps are taken once, without iteration; the error is estimated"));
        }
        if !rolls_back && !several {
            warnings.push(format!(
                "{name} may exist only once in a process: nothing of it is tried before the run; --isolate makes it possible"
            ));
        }
        if send == Sending::Rate && !instance.can_interpolate() {
            return Err(Error::Input(format!(
                "coupling.send is rate, but {name} cannot interpolate inputs: use auto or mean"
            )));
        }
        if settings.hold_forces || settings.mean_forces {
            parameters::takes_means(&mut instance)?;
        }
        let mut side = subsystem(instance, &assigned.forces_in, &assigned.motions_out)?;
        if !rolls_back {
            let (name, ends) = (name.clone(), (assigned.forces_in.clone(), assigned.motions_out.clone()));
            let another: Another = Box::new(move || {
                let impossible = |e: Error| FmuError::Impossible { instance: name.clone(), what: e.to_string() };
                subsystem(another().map_err(impossible)?, &ends.0, &ends.1).map_err(impossible)
            });
            side = side.without_roll_back(several.then_some(another));
        }
        let plain = assigned.stations.is_none() && assigned.velocities;
        let side = if plain {
            Adapted::plain(side)
        } else {
            let (components, stations) = (assigned.components.max(1), assigned.stations.clone());
            let points = assigned.forces_in.names.len() / components;
            Adapted::new(side, Lacks { points, components, stations, velocities: !assigned.velocities }, case.step)
        };
        let side = match assigned.watch.take() {
            Some(watch) => side.watched(watch),
            None => side,
        };
        forces_out.extend(assigned.forces_out.clone());
        let (d, v) = assigned.motions_in.clone().split(ports.positions());
        displacements.extend(d);
        velocities.extend(v);
        sides.push((side, ports));
        parts.push((name, assigned));
    }
    displacements.extend(velocities);
    if settings.mean_forces {
        means(&train_track, &mut forces_out.names)?;
    }
    let train_track = subsystem(train_track, &displacements, &forces_out)?;
    if !train_track.can_interpolate() {
        warnings.push("the train–track FMU cannot interpolate inputs: the deck's motion is sent as held means".into());
    }
    let bridge = Joined::new(sides)
        .ok_or_else(|| Error::Input("of several bridges every force must have a displacement and a velocity".into()))?;
    let coupling = Coupling::new(bridge.ports().clone(), settings);
    Ok(Connected {
        train_track,
        bridge,
        coupling,
        warnings,
        parts,
        probe: Probe::default(),
        several: all_several,
        rules: Rules::default(),
        stations: Vec::new(),
    })
}

/// The train–track FMU's outputs `….force` replaced by `….mean_force`, which sub-steps send.
fn means(train_track: &FmuInstance, forces: &mut [String]) -> Result<(), Error> {
    let refused = |why: String| Err(Error::Input(format!("{}: several sub-steps need {why}", train_track.name())));
    if !train_track.can_interpolate() {
        return refused("inputs that can be interpolated (canInterpolateInputs)".into());
    }
    for force in forces {
        *force = mean_force(force);
        if train_track.description().variable(force).is_none() {
            return refused(format!("an output {force}"));
        }
    }
    Ok(())
}

/// What was made; nothing if its input was refused, which is noted.
fn told<T>(made: Result<T, Error>, problems: &mut Vec<String>) -> Result<Option<T>, Error> {
    match made {
        Err(Error::Input(problem)) => {
            problems.push(problem);
            Ok(None)
        }
        made => made.map(Some),
    }
}

/// One side, by its coupled variables.
fn subsystem(instance: FmuInstance, inputs: &Ends, outputs: &Ends) -> Result<FmuSubsystem, Error> {
    Ok(FmuSubsystem::new(instance, &inputs.names, &outputs.names)?.transformed(&inputs.lines, &outputs.lines))
}

/// An instance in initialization mode.
pub fn instantiate(
    fmu: &Fmu,
    name: &str,
    end: f64,
    parameters: &BTreeMap<String, Value>,
) -> Result<FmuInstance, Error> {
    let mut instance = fmu.instantiate(name, false)?;
    parameters::set(&mut instance, parameters)?;
    instance.setup_experiment(0.0, Some(end))?;
    instance.enter_initialization()?;
    Ok(instance)
}
