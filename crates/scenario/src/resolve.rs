//! Replaces names by what they name, and lays the track over the bridge.

use std::path::Path;

use crate::bundled;
use crate::deck::Deck;
use crate::measured;
use crate::model;
use crate::pieces::Pieces;
use crate::problem::Report;
use crate::spans;
use crate::spatial::{self, Spatial};
use crate::spec::{BridgeSpec, Profile, StructureSpec, TrainTrackSpec, Vehicle};
use crate::step::{Excited, Steps};
use crate::types::{
    self, Car, CarChoice, Forces, FrameChoice, Irregularity, Model, ModelChoice, Scenario, Speed, Structure,
    TrackChoice, TrackType,
};

/// What the names in a scenario stand for; `None` where that cannot be told, which has been reported.
pub(crate) struct Resolved {
    pub cars: Option<Vec<Vehicle>>,
    /// Points (time s, speed m/s).
    pub speed: Option<Vec<[f64; 2]>>,
    pub track: Option<TrackType>,
    pub profile: Option<Profile>,
    pub structure: Option<StructureSpec>,
    pub spatial: Option<Spatial>,
}

/// Looks up names and reads the measured irregularity, relative to `base_dir`.
pub(crate) fn resolve(pieces: &Pieces, base_dir: &Path, report: &mut Report) -> Resolved {
    let cars: Option<Vec<Vec<Vehicle>>> = pieces.cars.iter().map(|choice| cars(choice.as_ref()?)).collect();
    let cars = cars.map(|cars| spatial::plane(cars.concat())).filter(|cars| !cars.is_empty());
    let track = pieces.track_type.as_ref().and_then(track);
    let mut profile = pieces.irregularity.as_ref().and_then(|chosen| profile(chosen, base_dir, report));
    let mut spatial = spatial::resolve(pieces, track.as_ref(), base_dir, report);
    if let Some(level) = spatial.as_mut().and_then(|spatial| spatial.level.take()) {
        profile = Some(level);
    }
    Resolved {
        spatial,
        cars: cars.or_else(|| forces(pieces.forces.as_ref()?)),
        speed: pieces.speed.as_ref().map(speed),
        track,
        profile,
        structure: pieces.structure.as_ref().and_then(|chosen| structure(chosen, base_dir, report)),
    }
}

fn cars(choice: &CarChoice) -> Option<Vec<Vehicle>> {
    match choice {
        CarChoice::Bundled(name) => Some(bundled::cars(name)?.into_iter().map(Vehicle::Car).collect()),
        CarChoice::Data(car) => Some(vec![Vehicle::Car((**car).clone())]),
        CarChoice::Vehicle(vehicle) => Some(vec![Vehicle::Bodies((**vehicle).clone())]),
    }
}

/// Names have been looked up before.
fn forces(forces: &Forces) -> Option<Vec<Vehicle>> {
    let Forces::Axles(axles) = forces else { return None };
    Some(vec![Vehicle::Bodies(types::Vehicle::of_forces(axles))])
}

fn speed(speed: &Speed) -> Vec<[f64; 2]> {
    match speed {
        Speed::KmH(v) => vec![[0.0, v / 3.6]],
        Speed::MS(v) => vec![[0.0, *v]],
        Speed::Profile(points) => points.clone(),
    }
}

fn track(choice: &TrackChoice) -> Option<TrackType> {
    match choice {
        TrackChoice::Bundled(name) => bundled::track(name),
        TrackChoice::Data(track) => Some((**track).clone()),
    }
}

fn structure(structure: &Structure, base_dir: &Path, report: &mut Report) -> Option<StructureSpec> {
    match structure {
        Structure::Beams { spans, continuous, first_frequency } => {
            let spans = spans::resolve(spans, *continuous, *first_frequency, report)?;
            Some(StructureSpec::Beams { spans, continuous: *continuous })
        }
        Structure::Frame { frame: FrameChoice::Bundled(name) } => bundled::frame(name).map(StructureSpec::Frame),
        Structure::Frame { frame: FrameChoice::Data(frame) } => Some(StructureSpec::Frame((**frame).clone())),
        Structure::Matrices { files, length } => {
            Some(StructureSpec::Matrices { files: files.clone(), folder: base_dir.to_path_buf(), length: *length })
        }
        Structure::FiniteElements { model: ModelChoice::File(file) } => {
            let model = model::read(&base_dir.join(file), report)?;
            Some(StructureSpec::FiniteElements(Box::new(model)))
        }
        Structure::FiniteElements { model: ModelChoice::Data(model) } => {
            Some(StructureSpec::FiniteElements(Box::new(Model { schema: None, ..(**model).clone() })))
        }
    }
}

fn profile(irregularity: &Irregularity, base_dir: &Path, report: &mut Report) -> Option<Profile> {
    match irregularity {
        Irregularity::None => Some(Profile::None),
        Irregularity::Harmonics { waves, origin, ramp, .. } => {
            Some(Profile::Waves { waves: waves.clone(), origin: *origin, ramp: ramp.clone() })
        }
        Irregularity::Spectrum { spectrum, seed, wavelengths, ramp, .. } => Some(Profile::Spectrum {
            density: bundled::spectrum(spectrum)?,
            seed: *seed,
            wavelengths: *wavelengths,
            ramp: ramp.clone(),
        }),
        Irregularity::Measured { file, ramp, .. } => {
            let (x, r) = measured::read(&base_dir.join(file), report)?;
            Some(Profile::Samples { x, r, ramp: ramp.clone() })
        }
    }
}

fn scale(irregularity: &Irregularity) -> f64 {
    match irregularity {
        Irregularity::None => 1.0,
        Irregularity::Harmonics { scale, .. }
        | Irregularity::Spectrum { scale, .. }
        | Irregularity::Measured { scale, .. } => *scale,
    }
}

/// The two subsystems' specs of a scenario whose names are all known and that leaves no place out.
pub(crate) fn specs(scenario: &Scenario, resolved: Resolved) -> Option<(TrainTrackSpec, BridgeSpec)> {
    let (track, structure) = (resolved.track?, resolved.structure?);
    let (laid, bridge, time) = (&scenario.track, &scenario.bridge, scenario.time);
    let (from, bays, end) = (laid.from?, laid.bays?, time.end?);
    let given = Steps { step: time.step.given().unwrap_or(end), substeps: time.substeps.unwrap_or(1) };
    let deck = Deck::new(&structure)?;
    let forward = scenario.train.heading.is_forward();
    let met = if forward { deck.clone() } else { deck.mirrored() };
    let mut supports = met.supports(bridge.at, from, track.spacing, bays + 1, bridge.over_bearings);
    let mut irregularity = resolved.profile?;
    if !forward {
        // The bridge counts from its begin, whoever comes from where.
        supports.reverse();
        supports.iter_mut().for_each(|(_, x)| *x = deck.length - *x);
        irregularity = irregularity.mirrored(bridge.at + 0.5 * deck.length);
    }
    let vehicles = resolved.cars?;
    let car = |vehicle: &Vehicle| match vehicle {
        Vehicle::Car(car) => Some(car.clone()),
        Vehicle::Bodies(_) => None,
    };
    let cars: Option<Vec<Car>> = vehicles.iter().map(car).collect();
    let mut train_track = TrainTrackSpec {
        vehicles: if cars.is_some() { Vec::new() } else { vehicles },
        cars: cars.unwrap_or_default(),
        front_wheel: scenario.train.front_wheel?,
        speed: resolved.speed?,
        pre_roll: scenario.train.pre_roll?,
        contact: scenario.contact.clone(),
        track,
        from,
        bays,
        elements_per_bay: laid.elements_per_bay,
        local_compliance: laid.local_compliance,
        on_bridge: supports.iter().map(|(i, _)| *i).collect(),
        irregularity,
        irregularity_scale: scale(&scenario.irregularity),
        rail_points: laid.points.clone(),
        step: given.step,
        substeps: given.substeps,
        end,
        newmark: time.newmark,
        space: None,
    };
    if time.step.given().is_none() {
        let steps = Excited::of(&train_track).steps(time.substeps);
        (train_track.step, train_track.substeps) = (steps.step.min(end), steps.substeps);
    }
    let bridge = BridgeSpec {
        structure,
        damping: bridge.damping.clone(),
        modes: bridge.modes,
        reduction: bridge.reduction,
        supports: supports.iter().map(|(_, x)| *x).collect(),
        points: bridge.points.clone().unwrap_or_default(),
        step: train_track.step,
        end,
        newmark: time.newmark,
        space: resolved.spatial.is_some(),
        ground: resolved.spatial.as_ref().and_then(|spatial| spatial.spec.ground.clone()),
        ground_points: Vec::new(),
    };
    train_track.space = resolved.spatial.map(|spatial| spatial.spec);
    Some((train_track, bridge))
}
