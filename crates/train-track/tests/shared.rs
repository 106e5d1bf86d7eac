//! One prepared track serves any number of trains, speeds and seeds, in several threads, and changes no bit of a result.

mod common;

use std::sync::Arc;
use std::thread;

use common::{initialized, spec};
use ttb_contract::{Instance, Model};
use ttb_scenario::spec::{Density, Profile, TrainTrackSpec};
use ttb_train_track::{Prepared, TrainTrack};

/// All outputs of some steps under a moving deck, as bits; the steps have two sizes, so that factors are made on the way.
fn run(mut instance: Instance<TrainTrack>) -> Vec<u64> {
    let supports = 30;
    let inputs: Vec<u32> = (0..2 * supports).collect();
    let outputs: Vec<u32> = instance.model().interface().outputs().map(|r| r as u32).collect();
    let (mut bits, mut row) = (Vec::new(), vec![0.0; outputs.len()]);
    let mut t = 0.0;
    for n in 0..60 {
        let h = if n % 3 == 2 { 5e-4 } else { 1e-3 };
        let motion: Vec<f64> = (0..2 * supports).map(|i| 1e-4 * f64::from(i + n).sin()).collect();
        instance.set(&inputs, &motion).unwrap();
        instance.step(t, h).unwrap();
        t += h;
        instance.get(&outputs, &mut row).unwrap();
        bits.extend(row.iter().map(|x| x.to_bits()));
    }
    bits
}

fn rough(speed: f64, seed: u64, cars: usize) -> TrainTrackSpec {
    let mut spec = spec();
    let density = Density::German { a: 4.032e-7, omega_c: 0.8246, omega_r: 0.0206 };
    spec.irregularity = Profile::Spectrum { density, seed, wavelengths: [2.0, 60.0], ramp: None };
    spec.cars = vec![common::trailer(); cars];
    (spec.speed, spec.pre_roll, spec.front_wheel) = (vec![[0.0, speed]], 50.0, 50.0);
    spec
}

#[test]
fn instances_in_two_threads_share_a_track_and_give_the_bits_of_two_built_alone() {
    let cases = [rough(60.0, 1, 1), rough(80.0, 2, 2)];
    let alone = cases.clone().map(|spec| run(initialized(TrainTrack::new(spec).unwrap())));
    let prepared = Arc::new(Prepared::new(&cases[0]).unwrap());
    let threads = cases.clone().map(|spec| {
        let prepared = Arc::clone(&prepared);
        thread::spawn(move || {
            let instance = initialized(TrainTrack::from_prepared(spec, Arc::clone(&prepared)).unwrap());
            assert!(Arc::ptr_eq(instance.model().prepared().unwrap(), &prepared));
            run(instance)
        })
    });
    let together = threads.map(|thread| thread.join().unwrap());
    assert_eq!(together, alone);
    assert_ne!(together[0], together[1]);
    // Both have met both step sizes: their factors are the same ones.
    let factors = || prepared.factors(&ttb_dynamics::newmark::Newmark::new(0.5, 0.25, 5e-4)).unwrap();
    assert!(Arc::ptr_eq(&factors(), &factors()));
}

#[test]
fn a_track_that_is_not_the_specifications_is_refused() {
    let prepared = Arc::new(Prepared::new(&spec()).unwrap());
    let with = |change: fn(&mut TrainTrackSpec)| {
        let mut spec = spec();
        change(&mut spec);
        TrainTrack::from_prepared(spec, Arc::clone(&prepared))
    };
    assert!(with(|spec| spec.speed[0][1] = 1.0).is_ok() && with(|spec| spec.front_wheel = 40.0).is_ok());
    let others: [fn(&mut TrainTrackSpec); 5] = [
        |spec| spec.bays += 1,
        |spec| spec.from = 1.0,
        |spec| spec.track.spacing = 0.6,
        |spec| spec.on_bridge.truncate(10),
        |spec| spec.local_compliance = false,
    ];
    assert!(others.into_iter().all(|other| with(other).is_err()));
}

/// Fasteners are parameters: an instance that changes them leaves the shared track alone.
#[test]
fn other_fasteners_get_a_track_of_their_own() {
    let prepared = Arc::new(Prepared::new(&spec()).unwrap());
    let mut instance = Instance::new(TrainTrack::from_prepared(spec(), Arc::clone(&prepared)).unwrap());
    let fastener = instance.model().interface().find("fastener_stiffness_factor").unwrap() as u32;
    instance.set(&[fastener], &[0.5]).unwrap();
    instance.enter_initialization(0.0).unwrap();
    assert!(!Arc::ptr_eq(instance.model().prepared().unwrap(), &prepared));
    instance.set(&[fastener], &[1.0]).unwrap();
    instance.exit_initialization().unwrap();
    assert!(Arc::ptr_eq(instance.model().prepared().unwrap(), &prepared));
    // What was built for other fasteners before does not answer for these.
    let softer = |instance: &mut Instance<TrainTrack>| {
        instance.reset();
        instance.set(&[fastener], &[0.5]).unwrap();
        instance.enter_initialization(0.0).unwrap();
        instance.exit_initialization().unwrap();
        common::value(instance, "wheel[1].rail_displacement")
    };
    let stiff = common::value(&mut instance, "wheel[1].rail_displacement");
    let [again, new] = [&mut instance, &mut Instance::new(TrainTrack::new(spec()).unwrap())].map(softer);
    assert_eq!(again, new);
    assert!(again > 1.3 * stiff, "{again} m, {stiff} m");
}
