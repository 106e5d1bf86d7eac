//! Vehicles of bodies against the car of 10 degrees of freedom, forces against closed forms.

mod common;

use ttb_contract::{Instance, Model};
use ttb_scenario::spec::{TrainTrackSpec, Vehicle};
use ttb_scenario::types::{self, Wave};
use ttb_scenario::vehicle::{Equations, of_car};
use ttb_train_track::TrainTrack;
use ttb_train_track::car::Car;

/// Outputs by name after every one of `steps` steps over a deck that stands still.
fn run(spec: &TrainTrackSpec, steps: usize) -> Vec<Vec<(String, f64)>> {
    let model = TrainTrack::new(spec.clone()).unwrap();
    let range = model.interface().outputs();
    let names: Vec<String> = model.interface().variables()[range.clone()].iter().map(|v| v.name.clone()).collect();
    let references: Vec<u32> = range.map(|i| i as u32).collect();
    let mut instance = Instance::new(model);
    instance.enter_initialization(0.0).unwrap();
    instance.exit_initialization().unwrap();
    let mut rows = Vec::new();
    for n in 0..steps {
        instance.step(n as f64 * spec.step, spec.step).unwrap();
        let mut values = vec![0.0; references.len()];
        instance.get(&references, &mut values).unwrap();
        rows.push(names.iter().cloned().zip(values).collect());
    }
    rows
}

fn wavy() -> TrainTrackSpec {
    let mut spec = common::spec();
    let wave = |amplitude, wavelength| Wave { amplitude, wavelength, phase: 0.3 };
    spec.irregularity =
        ttb_scenario::spec::Profile::Waves { waves: vec![wave(1e-3, 9.0), wave(2e-4, 3.0)], origin: 0.0, ramp: None };
    spec
}

/// The path of general vehicles and that of the car, over an irregular rail.
#[test]
fn a_car_of_ten_degrees_of_freedom_is_one_instance_of_a_vehicle() {
    let car = wavy();
    let mut bodies = car.clone();
    bodies.vehicles = vec![Vehicle::Bodies(of_car(&common::trailer()))];
    bodies.cars.clear();
    let (a, b) = (run(&car, 100), run(&bodies, 100));
    let mut compared = 0;
    for (i, (name, _)) in a[0].iter().enumerate() {
        let other = match name.as_str() {
            "car[1].front_bogie_acceleration" => "car[1].front.acceleration",
            "car[1].rear_bogie_acceleration" => "car[1].rear.acceleration",
            same => same,
        };
        let j = b[0].iter().position(|(name, _)| name == other).unwrap_or_else(|| panic!("{other}"));
        let size = a.iter().map(|row| row[i].1.abs()).fold(0.0, f64::max);
        let off = a.iter().zip(&b).map(|(a, b)| (a[i].1 - b[j].1).abs()).fold(0.0, f64::max);
        // An acceleration has the rounding of displacements (the body has sunk by 0.4 m) times 4/h².
        let rounding = 16.0 * f64::EPSILON * 0.4 * 4.0 / car.step.powi(2);
        let allowed = if name.ends_with("acceleration") { rounding } else { 1e-9 * size };
        assert!(off <= allowed, "{name}: {off:e} of {size:e}");
        compared += 1;
    }
    assert!(compared > 20);
}

#[test]
fn the_matrices_of_a_car_written_as_bodies_are_its_own() {
    let data = common::trailer();
    let (car, bodies) = (Car::new(&data), Equations::new(&of_car(&data)).unwrap());
    let same = |a: f64, b: f64, size: f64| (a - b).abs() <= 1e-12 * size;
    for i in 0..10 {
        assert_eq!((car.mass[i], car.weight()[i]), (bodies.mass[i], bodies.weight[i]));
        for j in 0..10 {
            assert!(same(car.stiffness[(i, j)], bodies.stiffness[10 * i + j], car.stiffness.amax()), "K {i} {j}");
            assert!(same(car.damping[(i, j)], bodies.damping[10 * i + j], car.damping.amax()), "C {i} {j}");
        }
    }
}

/// A force alone presses with its load at all times, and the rail under it yields as under a wheel at rest.
#[test]
fn forces_alone_stay_what_they_are() {
    let mut spec = wavy();
    spec.vehicles = vec![Vehicle::Bodies(types::Vehicle::of_forces(&[[0.0, 1e5], [2.5, 1.2e5]]))];
    spec.cars.clear();
    let rows = run(&spec, 50);
    let at = |row: &[(String, f64)], name: &str| row.iter().find(|(known, _)| known == name).map(|(_, value)| *value);
    for row in &rows {
        assert_eq!(at(row, "wheel[1].contact_force"), Some(1e5));
        assert_eq!(at(row, "wheel[2].contact_force"), Some(1.2e5));
        assert_eq!(at(row, "car[1].acceleration"), None);
        let (rail, supports) = (at(row, "wheel[1].rail_displacement").unwrap(), row.iter());
        assert!((1e-5..5e-3).contains(&rail), "{rail}");
        assert!(supports.filter(|(name, _)| name.ends_with(".force")).all(|(_, force)| force.is_finite()));
    }
}

/// Rigid masses on their contacts: each axle carries its weight at rest.
#[test]
fn a_rigid_mass_rests_on_its_contact() {
    let mut spec = common::spec();
    let wheels = [0.0, 3.0].map(|x| types::Wheel { x, mass: 7000.0, load: 0.0 }).to_vec();
    let masses = types::Vehicle { wheels, ..types::Vehicle::of_forces(&[]) };
    (spec.vehicles, spec.speed) = (vec![Vehicle::Bodies(masses)], vec![[0.0, 0.0]]);
    spec.cars.clear();
    let rows = run(&spec, 5);
    for (name, value) in rows.iter().flatten().filter(|(name, _)| name.ends_with("contact_force")) {
        assert!((value / (7000.0 * ttb_scenario::GRAVITY) - 1.0).abs() < 1e-8, "{name} {value}");
    }
}
