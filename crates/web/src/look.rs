//! A scenario as it is typed: what is wrong with it, what was chosen, how it looks, its natural modes.

use std::path::Path;

use serde::Serialize;
use serde_json::Value;
use ttb_assessment::Facts;
use ttb_bridge::drawing::Drawing;
use ttb_campaign::facts;
use ttb_campaign::points::bearings;
use ttb_scenario::spec::{BridgeSpec, StructureSpec, Vehicle};
use ttb_scenario::{Checked, from_str_using};
use ttb_trains::{axles_of, find};

use crate::fault::{Fault, Told};
use crate::request::{Asked, SCENARIO};
use crate::room::Room;

/// Points of a drawing beyond which modes are not searched while somebody types.
const MANY: usize = 3000;
/// Modes that are shown.
const MODES: usize = 6;

/// A scenario without problems.
#[derive(Serialize)]
pub struct Look {
    /// What is wrong with the request beside the scenario.
    asked: Vec<Told>,
    /// What is allowed, but rarely meant.
    warnings: Vec<Told>,
    /// What was chosen for keys that were left out, a sentence each.
    chosen: Vec<String>,
    /// The scenario with everything that was chosen.
    resolved: Value,
    /// Bridge and track as criteria see them.
    facts: Facts,
    sketch: Sketch,
    modes: Vec<Mode>,
}

/// What can be drawn to scale, m; x from the bridge's begin, z up.
#[derive(Serialize)]
struct Sketch {
    length: f64,
    bearings: Vec<f64>,
    /// Monitored points of the deck: name, x.
    points: Vec<(String, f64)>,
    /// Nodes and members of the structure in its own plane; empty of beams.
    nodes: Vec<[f64; 2]>,
    members: Vec<Vec<u32>>,
    /// The leading wheel at the start, and the rail's ends.
    front: f64,
    rail: [f64; 2],
    spacing: f64,
    /// Axles behind the leading wheel: distance m, load N.
    axles: Vec<[f64; 2]>,
    /// Bodies: begin and end behind the leading wheel, m.
    bodies: Vec<[f64; 2]>,
    end: f64,
    step: f64,
}

/// A natural mode: frequency Hz, place and vertical motion, up, of every node, the greatest 1.
#[derive(Serialize)]
struct Mode {
    frequency: f64,
    shape: Vec<[f32; 3]>,
}

/// Looks at a scenario, and at what is asked beside it; the drawing shows the axles of the first train that is asked for.
///
/// # Errors
/// All problems of the scenario, and of what is asked.
pub fn look(text: &str, asked: &Asked, folder: &Path, room: &Room) -> Result<Look, Fault> {
    let told = asked.problems().into_iter().map(|text| Told { path: String::new(), text });
    let told: Vec<Told> = told.collect();
    let checked = from_str_using(text, folder, SCENARIO, &[], &axles_of).map_err(|problems| {
        let mut fault = Fault::of(&problems);
        fault.problems.extend(told.clone());
        fault
    })?;
    room.scenario(&checked)?;
    let drawing = drawing(&checked.bridge);
    let small = drawing.as_ref().is_ok_and(|drawing| drawing.points.len() <= MANY);
    // A bridge that cannot be assembled is told as a run would tell it.
    if small && let Err(error) = ttb_bridge::inspect::remarks(&checked.bridge) {
        return Err(Fault::new(error.to_string()));
    }
    // Of an FMU in its place neither modes nor frequencies are known.
    let own = small && asked.bridge.is_none();
    let modes = drawing.as_ref().ok().filter(|_| own).map(modes).unwrap_or_default();
    let warnings = checked.findings.iter().map(|found| Told {
        path: found.path.clone(),
        text: found.text.strip_prefix(&format!("{}: ", found.path)).unwrap_or(&found.text).into(),
    });
    let chosen = checked.chosen.iter().map(|one| format!("{} = {} {}: {}", one.key, one.value, one.unit, one.why));
    Ok(Look {
        asked: told,
        warnings: warnings.collect(),
        chosen: chosen.collect(),
        resolved: serde_json::to_value(&checked.scenario).unwrap_or_default(),
        facts: if own { facts::of(&checked) } else { facts::of_track(&checked) },
        sketch: with_train(sketch(&checked, drawing.ok().as_ref()), asked.trains.first()),
        modes,
    })
}

/// With the first train of a name in place of the scenario's own; a name that is none is told when runs are asked for.
fn with_train(own: Sketch, name: Option<&String>) -> Sketch {
    let found = name.and_then(|name| find(name).ok()?.into_iter().next());
    match found {
        Some(train) => {
            let axles = train.axles.iter().map(|axle| [axle.x, axle.load]).collect();
            Sketch { axles, bodies: Vec::new(), ..own }
        }
        None => own,
    }
}

/// The bridge with nodes enough for a smooth line, and no more.
fn drawing(spec: &BridgeSpec) -> Result<Drawing, String> {
    let spec = BridgeSpec { points: Vec::new(), modes: None, reduction: None, ..spec.clone() };
    Drawing::new(&spec).map_err(|error| error.to_string())
}

fn sketch(checked: &Checked, drawing: Option<&Drawing>) -> Sketch {
    let (spec, at) = (&checked.train_track, checked.scenario.bridge.at);
    let bearings = bearings(&checked.bridge.structure);
    let beams = matches!(checked.bridge.structure, StructureSpec::Beams { .. });
    let drawn = drawing.filter(|_| !beams);
    let consist = spec.consist();
    let loads = consist.iter().flat_map(Vehicle::axles).map(|[load, _]| load);
    let offsets = spec.offsets();
    // A vehicle begins as far before its first wheel as the outlines of cars say.
    let mut bodies = Vec::new();
    let mut begin = -overhang(consist.first());
    for vehicle in &consist {
        bodies.push([begin, begin + vehicle.length()]);
        begin += vehicle.length();
    }
    let points = checked.bridge.points.iter().filter_map(|point| Some((point.name.clone(), point.x?)));
    let rail = [0.0, spec.bays as f64 * spec.track.spacing].map(|x| spec.from + x - at);
    Sketch {
        length: bearings.last().copied().unwrap_or(0.0),
        bearings,
        points: points.collect(),
        nodes: drawn.map(|one| one.points.iter().map(|[x, _, z]| [*x, *z]).collect()).unwrap_or_default(),
        members: drawn.map(|one| one.cells.clone()).unwrap_or_default(),
        front: spec.front_wheel - at,
        rail,
        spacing: spec.track.spacing,
        axles: offsets.iter().zip(loads).map(|(x, load)| [*x, load]).collect(),
        bodies: if checked.scenario.train.forces.is_some() { Vec::new() } else { bodies },
        end: checked.bridge.end,
        step: checked.bridge.step,
    }
}

/// From the front end of a vehicle to its first wheel, m.
fn overhang(vehicle: Option<&Vehicle>) -> f64 {
    match vehicle {
        Some(Vehicle::Car(car)) => 0.5 * (car.length - car.bogie_distance - car.wheelbase),
        Some(Vehicle::Bodies(vehicle)) => vehicle.wheels.first().map_or(0.0, |wheel| wheel.x),
        None => 0.0,
    }
}

fn modes(drawing: &Drawing) -> Vec<Mode> {
    let Ok(shapes) = drawing.modes(MODES) else { return Vec::new() };
    let of_shape = |shape: &ttb_bridge::drawing::Shape| {
        let node = |(point, by): (&[f64; 3], &[f64; 3])| [point[0] as f32, point[2] as f32, by[2] as f32];
        Mode { frequency: shape.frequency, shape: drawing.points.iter().zip(&shape.displacements).map(node).collect() }
    };
    shapes.iter().map(of_shape).collect()
}
