//! µs per step of train and track as a master makes it (set motions, rates, step, get forces): the first trial and a
//! repeated one, the train rolling over the bridge: `cargo bench -p ttb-train-track [-- EXAMPLE… [KEY=VALUE…]]`.
//!
//! Eight cars in space against the plane: `cargo bench -p ttb-train-track -- default.json time.step=0.0005`, then with
//! `space={}` behind it.

use std::path::{Path, PathBuf};
use std::time::Instant;

use ttb_contract::{Instance, Model};
use ttb_scenario::Setting;
use ttb_train_track::TrainTrack;

/// Steps that are timed, each with a first trial and a repeated one; best of some rounds, other work shares the machine.
const STEPS: usize = 100;
const ROUNDS: usize = 11;

fn main() {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../examples");
    let chosen: Vec<String> = std::env::args().skip(1).filter(|a| a.ends_with(".json")).collect();
    let settings = std::env::args().skip(1).filter(|a| a.contains('='));
    let settings: Vec<Setting> = settings.map(|text| text.parse().expect("KEY=VALUE")).collect();
    let all = ["r1.json", "default.json"].map(String::from).to_vec();
    for name in if chosen.is_empty() { all } else { chosen } {
        for substeps in [1, 10] {
            time(&folder.join(&name), &settings, substeps);
        }
    }
}

fn time(path: &Path, settings: &[Setting], substeps: usize) {
    let mut checked = ttb_scenario::load_with(path, settings).expect("a good scenario");
    checked.train_track.substeps = substeps;
    let (n, h) = (checked.bridge.supports.len() as u32, checked.train_track.step);
    let setup = Instant::now();
    let mut instance = Instance::new(TrainTrack::new(checked.train_track).expect("valid"));
    instance.enter_initialization(0.0).expect("initialization");
    instance.exit_initialization().expect("start");
    let setup = setup.elapsed().as_secs_f64();
    // The plane interface begins every list: motions of three components follow behind those of one in space only.
    let inputs: Vec<u32> = (0..2 * n).collect();
    let first = instance.model().interface().find("support[1].force").expect("an output") as u32;
    let outputs: Vec<u32> = (first..first + n).collect();
    let motion: Vec<f64> = (0..2 * n).map(|i| 1e-4 * f64::from(i).sin()).collect();
    let (mut rates, mut forces) = (vec![0.0; motion.len()], vec![0.0; n as usize]);
    let mut saved = instance.save();
    let mut best = [f64::INFINITY; 2];
    for round in 0..ROUNDS {
        let mut spent = [0.0; 2];
        for step in 0..STEPS {
            let t = (round * STEPS + step) as f64 * h;
            instance.save_into(&mut saved);
            for (trial, spent) in spent.iter_mut().enumerate() {
                let begin = Instant::now();
                instance.restore(&saved).expect("restored");
                rates.iter_mut().enumerate().for_each(|(i, r)| *r = 1e-3 * ((i + trial) as f64).cos());
                instance.set(&inputs, &motion).expect("set");
                instance.set_rates(&inputs, &rates).expect("set");
                instance.step(t, h).expect("a step");
                instance.get(&outputs, &mut forces).expect("got");
                *spent += begin.elapsed().as_secs_f64();
            }
        }
        best.iter_mut().zip(spent).for_each(|(best, spent)| *best = best.min(spent / STEPS as f64));
    }
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let variables = instance.model().interface().variables().len();
    println!(
        "{name}, {substeps} sub-steps ({variables} variables): set-up {setup:.2} s, first trial {:.1} µs, repeated {:.1} µs",
        1e6 * best[0],
        1e6 * best[1]
    );
}
