//! Parameters and states that are refused: by name, at once, and without a trace.

mod common;

use common::{initialized, spec};
use ttb_contract::{Instance, Model, Values};
use ttb_scenario::spec::{Density, Profile, TrainTrackSpec};
use ttb_train_track::TrainTrack;

fn rolling() -> TrainTrackSpec {
    let mut spec = spec();
    let density = Density::German { a: 4.032e-7, omega_c: 0.8246, omega_r: 0.0206 };
    spec.irregularity = Profile::Spectrum { density, seed: 1, wavelengths: [2.0, 60.0], ramp: None };
    spec.pre_roll = 30.0;
    spec
}

/// All outputs at the start and after some steps, as bits.
fn answers(instance: &mut Instance<TrainTrack>) -> Vec<u64> {
    instance.enter_initialization(0.0).unwrap();
    instance.exit_initialization().unwrap();
    let outputs: Vec<u32> = instance.model().interface().outputs().map(|r| r as u32).collect();
    let (mut bits, mut row) = (Vec::new(), vec![0.0; outputs.len()]);
    for n in 0..5 {
        instance.get(&outputs, &mut row).unwrap();
        bits.extend(row.iter().map(|x| x.to_bits()));
        instance.step(f64::from(n) * 1e-3, 1e-3).unwrap();
    }
    bits
}

const BAD: [f64; 8] = [0.0, -1.0, 1e-320, 1e308, -1e308, f64::NAN, f64::INFINITY, 0.7];

#[test]
fn whatever_parameter_was_refused_after_a_reset_the_instance_answers_as_new() {
    let mut instance = Instance::new(TrainTrack::new(rolling()).unwrap());
    let new = answers(&mut instance);
    let parameters = instance.model().interface().parameters();
    let mut refused = 0;
    for parameter in parameters {
        for value in BAD {
            instance.reset();
            let mut set = || {
                instance.set(&[parameter as u32], &[value])?;
                instance.enter_initialization(0.0)?;
                instance.exit_initialization()?;
                instance.step(0.0, 1e-3)
            };
            if let Err(error) = set() {
                refused += 1;
                assert!(!error.0.is_empty());
            }
            instance.reset();
            let name = instance.model().interface().variables()[parameter].name.clone();
            assert_eq!(answers(&mut instance), new, "after {name} = {value}");
        }
    }
    assert!(refused > 60, "{refused}");
}

/// The same one level deeper, where nothing has been checked before; what is out of the question is told by its name.
#[test]
fn a_model_names_the_parameter_that_it_refuses() {
    let mut model = TrainTrack::new(rolling()).unwrap();
    let interface = model.interface().clone();
    for reference in interface.parameters() {
        for value in [f64::NAN, f64::INFINITY, 1e308, -1e308] {
            let mut values = Values::start(&interface);
            values.all[reference] = value;
            let built = model.build(&values, 0.0);
            let name = &interface.variables()[reference].name;
            let known = match name.as_str() {
                // A wheel beyond the rail; a scale that only the contacts find too large.
                "front_wheel" | "irregularity_scale" if value.is_finite() => continue,
                _ => built.unwrap_err().0,
            };
            assert!(known.contains(&format!("parameter {name} is")), "{known}");
        }
    }
}

/// Sets parameters by name; what the instance says when initialization fails.
fn refusal(spec: TrainTrackSpec, parameters: &[(&str, f64)]) -> String {
    let mut instance = Instance::new(TrainTrack::new(spec).unwrap());
    for (name, value) in parameters {
        let reference = instance.model().interface().find(name).unwrap() as u32;
        instance.set(&[reference], &[*value]).unwrap();
    }
    instance.enter_initialization(0.0).and_then(|()| instance.exit_initialization()).unwrap_err().0
}

#[test]
fn a_pre_roll_of_a_train_that_stands_or_creeps_is_told() {
    let needs = "a pre-roll needs a speed above 0";
    assert!(refusal(rolling(), &[("speed", 0.0)]).contains(needs));
    assert!(refusal(rolling(), &[("speed", 1e-6)]).contains("a pre-roll must have at most 1e7 steps"));
    let mut standing = rolling();
    standing.speed = vec![[0.0, 0.0]];
    assert!(refusal(standing, &[]).contains(needs));
    // Hours of it, though each number is allowed.
    assert!(refusal(rolling(), &[("pre_roll", 1e4), ("step_size", 1e-9)]).contains("at most 1e7 steps"));
    assert!(refusal(rolling(), &[("pre_roll", 1.1e4)]).contains("pre_roll is 11000; it must be at most 10000"));
}

#[test]
fn newmarks_parameters_that_are_unstable_are_refused() {
    assert!(refusal(rolling(), &[("gamma", 0.7)]).contains("beta is 0.25; it must be at least gamma/2 = 0.35"));
}

/// The instance finds bytes that were damaged by their sum; whoever makes up a state with the right sum meets the model.
#[test]
fn a_state_with_a_number_that_is_none_or_of_another_size_is_refused() {
    let instance = initialized(TrainTrack::new(rolling()).unwrap());
    let (model, state, mut bytes) = (instance.model(), instance.model().save(), Vec::new());
    model.write_state(&state, &mut bytes);
    let numbers = bytes.len() / 8;
    for bad in [f64::NAN, f64::NEG_INFINITY] {
        for at in [0, numbers / 2, numbers - 1] {
            let mut damaged = bytes.clone();
            damaged[8 * at..8 * at + 8].copy_from_slice(&bad.to_le_bytes());
            let error = model.read_state(&damaged).unwrap_err().0;
            assert!(error.contains(&format!("number {} of the state is {bad}", at + 1)), "{error}");
        }
    }
    for wrong in [0, bytes.len() - 8, bytes.len() - 1] {
        assert!(model.read_state(&bytes[..wrong]).is_err());
    }
    assert!(model.read_state(&[&bytes[..], &[0; 8]].concat()).is_err());
    assert_eq!(model.read_state(&bytes).unwrap(), state);
}

/// A profile that has no value at some place: the wheel that comes there is named, with the time.
#[test]
fn a_wheel_that_meets_a_nan_is_named_with_the_time_also_in_a_train_whose_cars_do_not_feel_each_other() {
    for law in [ttb_scenario::types::ContactLaw::Hertz, ttb_scenario::types::ContactLaw::Linear] {
        let mut spec = spec();
        spec.contact.law = law;
        spec.cars = vec![common::trailer(), common::trailer()];
        spec.front_wheel = 50.0;
        // The wheels stand at 50, 47.5, 32.6, 30.1, 25.2 … m; only the third comes to 32.8 m within the run.
        let x = vec![0.0, 31.0, 32.8, 32.9, 33.0, 33.1, 33.2, 34.0, 99.0];
        let r = x.iter().map(|x| if *x == 33.0 { f64::NAN } else { 0.0 }).collect();
        spec.irregularity = Profile::Samples { x, r, ramp: None };
        let mut instance = initialized(TrainTrack::new(spec).unwrap());
        let failed = (0..20).find_map(|n| instance.step(f64::from(n) * 1e-3, 1e-3).err()).unwrap().0;
        assert!(failed.contains("wheel 3") && failed.contains("t = 0.00"), "{failed}");
    }
}
