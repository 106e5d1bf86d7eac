//! Train and track in space: against the plane model, mirrored, restored, roughly handled.

use std::path::Path;

use ttb_contract::{Instance, Model};
use ttb_record::Table;
use ttb_scenario::from_str;
use ttb_scenario::spec::{LinkLaw, Profile, SpaceCar, SpaceSpec, TrainTrackSpec};
use ttb_scenario::types::{Creep, ProfileCurve, ProfilePiece, ProfileShape, Ramp, RampShape, Wave};
use ttb_train_track::TrainTrack;

use crate::common::{started, value};

mod alone;
mod known;
mod order;
mod rough;
mod stability;

/// A car in space on slab track, the middle third of 90 bays on a bridge.
pub fn spec(car: &str, speed: f64) -> TrainTrackSpec {
    let text = format!(
        r#"{{"title": "a car", "train": {{"cars": ["{car}"], "front_wheel": 30, "speed": {{"m_s": {speed}}}}},
            "space": {{}}, "track": {{"type": "slab", "from": 0}},
            "bridge": {{"at": 39, "structure": {{"type": "beams", "spans": [{{"length": 26,
            "bending_stiffness": 4e11, "mass": 29720}}]}}, "damping": {{"type": "rayleigh", "ratio": 0.02,
            "at": {{"first_times": 4}}}}}}, "time": {{"step": 0.001, "end": 0.2}}}}"#
    );
    let checked = from_str(&text, Path::new("."), "car.json");
    let mut spec = checked.unwrap_or_else(|problems| panic!("{problems:?}")).train_track;
    spec.bays = 140;
    spec
}

pub fn space(spec: &mut TrainTrackSpec) -> &mut SpaceSpec {
    spec.space.as_mut().expect("in space")
}

/// The data of a car; the Manchester car with the primary springs of the benchmark, 1.22e6 N/m an axle box.
pub fn of_benchmark(name: &str) -> SpaceCar {
    let mut data = space(&mut spec(name, 40.0)).cars[0].clone();
    for link in &mut data.links {
        if let LinkLaw::Linear { stiffness, .. } = &mut link.law
            && name == "manchester"
            && stiffness[2] == 1.2e6
        {
            stiffness[2] = 1.22e6;
        }
    }
    data
}

pub fn waves(waves: &[(f64, f64)]) -> Profile {
    let wave =
        |(amplitude, wavelength): &(f64, f64)| Wave { amplitude: *amplitude, wavelength: *wavelength, phase: 0.0 };
    let ramp = Some(Ramp { start: 30.0, length: 10.0, shape: RampShape::Cosine });
    Profile::Waves { waves: waves.iter().map(wave).collect(), origin: 30.0, ramp }
}

/// Level profiles whose contact stays over the rail's axis: a plate on a narrow rail.
pub fn level(spec: &mut TrainTrackSpec) {
    let piece = |from, to, c: &[f64]| ProfilePiece { from, to, curve: ProfileCurve::Polynomial(c.to_vec()) };
    let space = space(spec);
    space.contact.wheel = ProfileShape::PiecesMm(vec![piece(-20.0, 60.0, &[0.0])]);
    let side = |s: f64, m: f64| [-m * s, m];
    // Half of the width; between points of the table, so that the corners weigh the same.
    const EDGE: f64 = 10.0125;
    space.contact.rail = ProfileShape::PiecesMm(vec![
        piece(-12.0, -EDGE, &side(-EDGE, -20.0)),
        piece(-EDGE, EDGE, &[0.0]),
        piece(EDGE, 12.0, &side(EDGE, 20.0)),
    ]);
    space.track.inclination = 0.0;
    // The gauge is measured 14 mm below the top, where the side stands 0.7 mm further out.
    space.track.gauge = 2.0 * (space.track.half_distance - (1e-3 * EDGE + 0.7e-3));
}

/// Moves the deck: 1 mm down, `across` of it to the right, `roll` rad, all as (1 − cos 20t); runs to step `n`.
pub fn advance(instance: &mut Instance<TrainTrack>, n: usize, h: f64, deck: [f64; 3]) {
    let inputs = instance.model().interface().inputs().len();
    // Position and rate of one component, or of three.
    let blocks = if instance.model().interface().find("support[1].rotation_x").is_some() { 6 } else { 2 };
    let supports = inputs / blocks;
    let references: Vec<u32> = (0..inputs as u32).collect();
    let t = n as f64 * h;
    let (mut now, mut rates) = (Vec::new(), Vec::new());
    for block in 0..blocks {
        let size = deck[block / 2];
        let f = |t: f64| if block % 2 == 0 { size * (1.0 - (20.0 * t).cos()) } else { size * 20.0 * (20.0 * t).sin() };
        now.extend(std::iter::repeat_n(f(t), supports));
        rates.extend(std::iter::repeat_n((f(t + h) - f(t)) / h, supports));
    }
    instance.set(&references, &now).unwrap();
    instance.set_rates(&references, &rates).unwrap();
    instance.step(t, h).unwrap_or_else(|e| panic!("step {n}: {e:?}"));
}

/// All outputs, with their names.
pub fn outputs(instance: &mut Instance<TrainTrack>) -> Vec<(String, f64)> {
    let interface = instance.model().interface();
    let range = interface.outputs();
    let names: Vec<String> = interface.variables()[range.clone()].iter().map(|v| v.name.clone()).collect();
    let references: Vec<u32> = range.map(|i| i as u32).collect();
    let mut values = vec![0.0; names.len()];
    instance.get(&references, &mut values).unwrap();
    names.into_iter().zip(values).collect()
}

/// Contact over the rail's axis, slope 0, one Hertz constant, nothing lateral: the plane model with two contacts an axle.
#[test]
fn a_symmetric_run_in_space_is_the_plane_run() {
    let mut own = spec("ice3-trailer", 250.0 / 3.6);
    level(&mut own);
    let constant = 4.2e-8;
    space(&mut own).contact.hertz_constant = Some(constant);
    own.irregularity = waves(&[(2e-3, 25.0), (0.5e-3, 8.0), (0.1e-3, 2.0)]);
    let mut plane = TrainTrackSpec { space: None, ..own.clone() };
    plane.contact.hertz_constant = Some(constant);
    plane.contact.wheels_per_axle = 2;
    let (mut own, mut plane) = (started(own), started(plane));
    let mut peaks = std::collections::HashMap::<String, (f64, f64)>::new();
    let mut lateral: f64 = 0.0;
    for n in 0..200 {
        advance(&mut own, n, 1e-3, [1e-3, 0.0, 0.0]);
        advance(&mut plane, n, 1e-3, [1e-3, 0.0, 0.0]);
        let all: std::collections::HashMap<_, _> = outputs(&mut own).into_iter().collect();
        for (name, value) in outputs(&mut plane) {
            let (peak, miss) = peaks.entry(name.clone()).or_default();
            *peak = peak.max(value.abs());
            *miss = miss.max((value - all[&name]).abs());
        }
        lateral = lateral.max(all["wheel[1].lateral_displacement"].abs());
    }
    for (name, (peak, miss)) in peaks {
        // A support that hardly feels the train is measured by one that does.
        // Accelerations are differences of displacements times 4/h²: both runs have their rounding.
        let scale = if name.contains("force") {
            7e4
        } else if name.contains("acceleration") {
            9.81
        } else {
            peak.max(1e-9)
        };
        assert!(miss <= 1e-9 * scale, "{name}: {miss} of {peak}");
    }
    assert!(lateral < 1e-12, "{lateral} m");
}
