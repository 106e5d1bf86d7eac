//! Trains whose axles far apart have nothing to do with each other.

use std::path::Path;
use std::time::Instant;

use ttb_contract::{Instance, Model};
use ttb_train_track::TrainTrack;

/// A train on even track in front of its bridge, in static equilibrium; the axle load.
fn at_rest(cars: usize) -> (Instance<TrainTrack>, f64) {
    let names = vec!["\"ice3-trailer\""; cars].join(",");
    let (front, bays) = (25 * cars + 20, 40 * cars + 200);
    let text = format!(
        r#"{{"train":{{"cars":[{names}],"front_wheel":{front},"speed":{{"m_s":70}}}},"track":{{"type":"slab","bays":{bays}}},
        "bridge":{{"at":{},"structure":{{"type":"beams","spans":[{{"length":6,"bending_stiffness":4e9,"mass":9000,"elements":4}}]}},
        "damping":{{"type":"none"}}}},"time":{{"step":1e-3,"end":0.01}}}}"#,
        front + 9
    );
    let checked = ttb_scenario::from_str(&text, Path::new(""), "long").unwrap_or_else(|problems| panic!("{problems}"));
    let mut instance = Instance::new(TrainTrack::new(checked.train_track).expect("train and track"));
    instance.enter_initialization(0.0).expect("initialization");
    (instance, checked.axle_load)
}

fn contact_forces(instance: &mut Instance<TrainTrack>, cars: usize) -> Vec<f64> {
    let interface = instance.model().interface();
    let find = |wheel: usize| interface.find(&format!("wheel[{}].contact_force", wheel + 1)).expect("a wheel") as u32;
    let references: Vec<u32> = (0..4 * cars).map(find).collect();
    let mut forces = vec![0.0; references.len()];
    instance.get(&references, &mut forces).expect("outputs");
    forces
}

#[test]
fn every_axle_of_a_long_train_at_rest_carries_its_share() {
    // Bogies and bodies are statically determinate and symmetric: every axle carries the same, wherever it stands.
    let (mut train, load) = at_rest(60);
    for (wheel, force) in contact_forces(&mut train, 60).iter().enumerate() {
        assert!((force / load - 1.0).abs() < 1e-9, "wheel {}: {force} N for {load} N", wheel + 1);
    }
    train.exit_initialization().expect("a start");
    train.step(0.0, 1e-3).expect("a step");
    for (wheel, force) in contact_forces(&mut train, 60).iter().enumerate() {
        // The wheels begin to feel the supports.
        assert!((force / load - 1.0).abs() < 0.05, "wheel {}: {force} N for {load} N", wheel + 1);
    }
}

/// `cargo test --release -p ttb-train-track --test long_trains -- --ignored --nocapture`
#[test]
#[ignore = "measures time"]
fn twice_the_cars_take_about_twice_the_time_to_start() {
    let seconds = [100, 200, 400].map(|cars| {
        let begun = Instant::now();
        let (mut train, _) = at_rest(cars);
        contact_forces(&mut train, cars);
        let seconds = begun.elapsed().as_secs_f64();
        println!("{cars} cars: {seconds:.2} s");
        seconds
    });
    assert!(seconds[2] < 3.0 * seconds[1], "{seconds:?}");
}
