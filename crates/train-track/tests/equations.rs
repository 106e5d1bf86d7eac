//! What a step leaves satisfies the equations it was to solve: contact of every axle, motion of every car and of the track,
//! with the matrices applied to the state instead of solved with; and outputs are what the state holds.

mod common;

use common::{initialized, spec, value};
use ttb_contract::{Instance, Model};
use ttb_dynamics::band::Band;
use ttb_dynamics::newmark::Motion;
use ttb_scenario::spec::{Profile, TrainTrackSpec};
use ttb_scenario::travel::wheel_offsets;
use ttb_scenario::types::{RailPoint, Wave};
use ttb_train_track::TrainTrack;
use ttb_train_track::car::{AXLES, Car, DOFS, FIRST_WHEEL};

/// Two cars on a wavy rail; the second is on the bridge's first half.
fn wavy() -> TrainTrackSpec {
    let mut spec = spec();
    spec.cars = vec![common::trailer(), common::trailer()];
    spec.cars[1].secondary_damping *= 0.5;
    let wave = |amplitude, wavelength| Wave { amplitude, wavelength, phase: 0.3 };
    spec.irregularity = Profile::Waves { waves: vec![wave(1e-3, 9.0), wave(2e-4, 3.0)], origin: 0.0, ramp: None };
    (spec.front_wheel, spec.pre_roll) = (52.0, 40.0);
    spec.rail_points = vec![RailPoint { name: "p".into(), x: 33.0 }];
    spec
}

fn on(track: &str) -> TrainTrackSpec {
    let mut spec = wavy();
    spec.track = ttb_scenario::bundled::track(track).unwrap();
    spec.track.spacing = 0.65;
    spec
}

const SUPPORTS: usize = 30;

fn step(instance: &mut Instance<TrainTrack>, n: usize) {
    let references: Vec<u32> = (0..2 * SUPPORTS as u32).collect();
    let motion = |k: usize| (0..2 * SUPPORTS).map(move |i| 1e-3 * ((i + 3 * k) as f64).sin());
    let rates: Vec<f64> = motion(n).zip(motion(n + 1)).map(|(a, b)| (b - a) / 1e-3).collect();
    instance.set(&references, &motion(n).collect::<Vec<_>>()).unwrap();
    instance.set_rates(&references, &rates).unwrap();
    instance.step(n as f64 * 1e-3, 1e-3).unwrap();
}

/// y = A x for the entries of a band.
fn product(a: &Band, x: &[f64]) -> Vec<f64> {
    let b = a.half_bandwidth();
    let row = |i: usize| (i.saturating_sub(b)..=(i + b).min(x.len() - 1)).map(|j| a.get(i, j) * x[j]).sum();
    (0..x.len()).map(row).collect()
}

/// Largest |r|, relative to `scale`.
fn largest(r: impl IntoIterator<Item = f64>, scale: f64) -> f64 {
    r.into_iter().fold(0.0, |most: f64, r| if r.abs() <= most { most } else { r.abs() }) / scale
}

/// δ = z_w − N u − r − c_loc F of every axle at time t.
fn contacts_hold(spec: &TrainTrackSpec, instance: &Instance<TrainTrack>, t: f64) {
    let (state, track) =
        (instance.model().save().plane().expect("a plane run"), &instance.model().prepared().unwrap().track);
    let Profile::Waves { waves, .. } = &spec.irregularity else { panic!("waves") };
    let rough = |x: f64| -> f64 {
        waves.iter().map(|w| w.amplitude * (std::f64::consts::TAU * x / w.wavelength + w.phase).sin()).sum()
    };
    for (axle, offset) in wheel_offsets(&spec.cars).iter().enumerate() {
        let x = spec.front_wheel + spec.speed[0][1] * t - offset;
        let point = track.locate(x).unwrap();
        let z = state.cars.u[axle / AXLES * DOFS + FIRST_WHEEL + axle % AXLES];
        let gap = z - track.deflection(&point, &state.track.u) - rough(x) - point.local_compliance * state.forces[axle];
        assert!(
            (gap - state.delta[axle]).abs() < 1e-12,
            "wheel {axle} at t = {t}: {gap:e}, δ = {:e}",
            state.delta[axle]
        );
        let law = ttb_train_track::law::Law::new(&spec.contact, Car::new(&spec.cars[axle / AXLES]).axle_load);
        assert!((law.force(gap).0 - state.forces[axle]).abs() < 0.01, "wheel {axle}: {} N", state.forces[axle]);
    }
}

/// M q̈ + C q̇ + K q = w − Bᵀ F of every car, and the same of the track under wheels and deck.
fn motions_hold(spec: &TrainTrackSpec, instance: &Instance<TrainTrack>, t: f64) {
    let (state, track) =
        (instance.model().save().plane().expect("a plane run"), &instance.model().prepared().unwrap().track);
    for (c, data) in spec.cars.iter().enumerate() {
        let car = Car::new(data);
        let of = |values: &[f64]| ttb_train_track::car::Vector10::from_column_slice(&values[c * DOFS..(c + 1) * DOFS]);
        let mut r = car.mass.component_mul(&of(&state.cars.a))
            + car.damping * of(&state.cars.v)
            + car.stiffness * of(&state.cars.u)
            - car.weight();
        (0..AXLES).for_each(|i| r[FIRST_WHEEL + i] += state.forces[c * AXLES + i]);
        let off = largest(r.iter().copied(), car.axle_load);
        assert!(off < 1e-7, "car {c} at t = {t}: out of balance by {off:e} axle loads");
    }
    let [k, m, c] = [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0)].map(|(mass, damping)| track.effective(mass, damping));
    let Motion { u, v, a } = &state.track;
    // M and C come with K in them.
    let ([ku, kv, ka], ma, cv) = ([u, v, a].map(|x| product(&k, x)), product(&m, a), product(&c, v));
    let mut load = vec![0.0; u.len()];
    for (axle, offset) in wheel_offsets(&spec.cars).iter().enumerate() {
        let point = track.locate(spec.front_wheel + spec.speed[0][1] * t - offset).unwrap();
        track.add_force(&point, state.forces[axle], &mut load);
    }
    let base = match &spec.track.support {
        ttb_scenario::types::Support::SingleLayer { fastener } => *fastener,
        ttb_scenario::types::Support::TwoLayer { ballast, .. } => *ballast,
        ttb_scenario::types::Support::ThreeLayer { sub_ballast, .. } => *sub_ballast,
    };
    for (i, (_, dof)) in track.bridge_bases().enumerate() {
        let (d, rate) = (state.deck[i], state.deck[SUPPORTS + i]);
        load[dof] += base.stiffness * d + base.damping * rate;
        let force = base.stiffness * (u[dof] - d) + base.damping * (v[dof] - rate);
        assert!((force - state.supports[i]).abs() < 1e-6 * 1e5, "support {i}: {force} N, {} N", state.supports[i]);
    }
    let r = (0..u.len()).map(|i| ku[i] + (ma[i] - ka[i]) + (cv[i] - kv[i]) - load[i]);
    let off = largest(r, 1e5);
    assert!(off < 1e-6, "track at t = {t}: out of balance by {off:e} × 100 kN");
}

#[test]
fn every_step_satisfies_the_equations_of_contacts_cars_and_track_on_one_two_and_three_layers() {
    for spec in [wavy(), on("ballast-two-layer"), on("ballast-zhai")] {
        let mut instance = initialized(TrainTrack::new(spec.clone()).unwrap());
        contacts_hold(&spec, &instance, 0.0);
        for n in 0..30 {
            step(&mut instance, n);
            let t = (n + 1) as f64 * 1e-3;
            contacts_hold(&spec, &instance, t);
            motions_hold(&spec, &instance, t);
        }
    }
}

#[test]
fn outputs_are_what_the_state_holds() {
    let spec = wavy();
    let mut instance = initialized(TrainTrack::new(spec).unwrap());
    (0..10).for_each(|n| step(&mut instance, n));
    let state = instance.model().save().plane().expect("a plane run");
    for car in 0..2 {
        let (u, a) = (&state.cars.u[car * DOFS..], &state.cars.a[car * DOFS..]);
        let names = [
            "displacement",
            "acceleration",
            "pitch_acceleration",
            "front_bogie_acceleration",
            "rear_bogie_acceleration",
        ];
        for (name, expected) in names.iter().zip([u[0], a[0], a[1], a[2], a[4]]) {
            assert_eq!(value(&mut instance, &format!("car[{}].{name}", car + 1)), expected, "{name}");
        }
    }
    for axle in 0..8 {
        let z = state.cars.u[axle / AXLES * DOFS + FIRST_WHEEL + axle % AXLES];
        let of =
            |instance: &mut Instance<TrainTrack>, name: &str| value(instance, &format!("wheel[{}].{name}", axle + 1));
        assert_eq!(of(&mut instance, "displacement"), z);
        assert_eq!(of(&mut instance, "contact_force"), state.forces[axle]);
    }
    for support in [0, 17, 29] {
        assert_eq!(value(&mut instance, &format!("support[{}].force", support + 1)), state.supports[support]);
    }
    let track = &instance.model().prepared().unwrap().track;
    let point = track.locate(33.0).unwrap();
    let of = [&state.track.u, &state.track.v, &state.track.a].map(|x| track.deflection(&point, x));
    for (name, expected) in ["displacement", "velocity", "acceleration"].iter().zip(of) {
        assert_eq!(value(&mut instance, &format!("rail[p].{name}")), expected);
    }
}

/// Static equilibrium is that of the deck's displacements; its velocities are none of its business.
#[test]
fn velocities_of_the_deck_do_not_count_at_rest() {
    let at_rest = |velocity: f64| {
        let mut instance = Instance::new(TrainTrack::new(wavy()).unwrap());
        instance.enter_initialization(0.0).unwrap();
        let references: Vec<u32> = (0..2 * SUPPORTS as u32).collect();
        let values: Vec<f64> = (0..2 * SUPPORTS).map(|i| if i < SUPPORTS { 2e-3 } else { velocity }).collect();
        instance.set(&references, &values).unwrap();
        (value(&mut instance, "support[20].force"), value(&mut instance, "wheel[1].displacement"))
    };
    assert_eq!(at_rest(0.0), at_rest(0.5));
}

/// The last car has run as far as asked: the cars roll over the train's length more. A car's length shows nowhere else in a
/// train of one car.
#[test]
fn the_pre_roll_begins_a_trains_length_earlier() {
    let start = |length: f64, pre_roll: f64| {
        let mut spec = wavy();
        spec.cars.truncate(1);
        (spec.cars[0].length, spec.pre_roll) = (length, pre_roll);
        initialized(TrainTrack::new(spec).unwrap()).model().save().plane().expect("a plane run")
    };
    assert_eq!(start(25.0, 60.0), start(45.0, 40.0));
    assert_ne!(start(25.0, 60.0), start(25.0, 40.0));
}

/// Displacement and velocity, and their rates if they are told.
type Told = ([f64; 2], Option<[f64; 2]>);

/// Outputs after a deck motion d = ½ a t² that is told step by step, from (d, ḋ) at a step's begin and end.
fn under(meaning: f64, told: fn([f64; 2], [f64; 2], f64) -> Told) -> [f64; 2] {
    let mut instance = Instance::new(TrainTrack::new(wavy()).unwrap());
    let parameter = instance.model().interface().find("input_meaning").unwrap() as u32;
    instance.set(&[parameter], &[meaning]).unwrap();
    instance.enter_initialization(0.0).unwrap();
    instance.exit_initialization().unwrap();
    let references: Vec<u32> = (0..2 * SUPPORTS as u32).collect();
    let all = |[d, v]: [f64; 2]| (0..2 * SUPPORTS).map(|i| if i < SUPPORTS { d } else { v }).collect::<Vec<f64>>();
    let h = 1e-3;
    for n in 0..20 {
        let at = |n: i32| [2.0 * (f64::from(n) * h).powi(2), 4.0 * f64::from(n) * h];
        let (values, rates) = told(at(n), at(n + 1), h);
        instance.set(&references, &all(values)).unwrap();
        if let Some(rates) = rates {
            instance.set_rates(&references, &all(rates)).unwrap();
        }
        instance.step(f64::from(n) * h, h).unwrap();
    }
    ["support[15].force", "car[1].acceleration"].map(|name| value(&mut instance, name))
}

/// A line with its rates is the same motion as its mean and as its end; a displacement that runs on with a velocity is a line
/// with this rate, under a velocity that is held.
#[test]
fn each_meaning_of_a_held_input_tells_the_same_motion() {
    let line = under(1.0, |a, b, h| (a, Some([0, 1].map(|i| (b[i] - a[i]) / h))));
    let end = under(3.0, |_, b, _| (b, None));
    let mean = under(2.0, |a, b, _| ([0, 1].map(|i| 0.5 * (a[i] + b[i])), None));
    for held in [end, mean] {
        let near = held.iter().zip(line).all(|(a, b)| (a - b).abs() <= 1e-9 * b.abs().max(1.0));
        assert!(near, "{held:?}, as a line {line:?}");
    }
    let chord = under(1.0, |a, b, h| ([a[0], (b[0] - a[0]) / h], Some([(b[0] - a[0]) / h, 0.0])));
    let extrapolated = under(1.0, |a, b, h| ([a[0], (b[0] - a[0]) / h], None));
    assert_eq!(extrapolated, chord);
}
