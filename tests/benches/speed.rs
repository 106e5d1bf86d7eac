//! Speed of whole runs as multiples of real time, on the plain libraries and through the FMUs (results written):
//! `cargo build --release && cargo bench -p ttb-tests --bench speed [-- EXAMPLE…]`.

use std::process::{Command, Stdio};
use std::time::Instant;

use ttb_session::observe::Iterations;
use ttb_session::{Case, Plan};
use ttb_tests::{example, examples, sides, ttb};

fn main() {
    let chosen: Vec<String> = std::env::args().skip(1).filter(|a| a.ends_with(".json")).collect();
    let all = ["r1.json", "default.json"].map(String::from).to_vec();
    for name in if chosen.is_empty() { all } else { chosen } {
        let checked = example(&name);
        let axis = Case::of(&checked).axis();
        let mut best = f64::INFINITY;
        let (mut start, mut iterations) = (0.0, 0);
        for _ in 0..3 {
            let begin = Instant::now();
            let mut sides = sides(&checked);
            start = begin.elapsed().as_secs_f64();
            let mut counted = Iterations::default();
            let clock = || begin.elapsed().as_secs_f64();
            let begin = Instant::now();
            let plan = Plan { axis, wanted: &|_| false, clock: &clock };
            sides.run(&plan, &mut [&mut counted]).expect("run");
            iterations = counted.total();
            best = best.min(begin.elapsed().as_secs_f64());
        }
        let (steps, end) = (axis.steps() as f64, checked.train_track.end);
        println!(
            "{name}, libraries: {:.1} µs a step, {:.2} trials a step, {:.1} × real time; start {start:.2} s",
            1e6 * best / steps,
            iterations as f64 / steps,
            end / best
        );
        let mut factors: Vec<f64> = (0..5).map(|_| through_fmus(&name)).collect();
        factors.sort_by(f64::total_cmp);
        println!(
            "{name}, FMUs: {:.1} … {:.1} … {:.1} × real time (least, median, most of 5)",
            factors[0], factors[2], factors[4]
        );
    }
}

/// How many times faster than real time the steps of `ttb run` were.
fn through_fmus(name: &str) -> f64 {
    let folder = tempfile::tempdir().expect("temporary folder");
    let mut command = Command::new(ttb());
    command.arg("run").arg(examples().join(name)).arg("--output").arg(folder.path()).arg("--quiet");
    assert!(command.stderr(Stdio::null()).status().expect("ttb runs").success());
    let text = std::fs::read_to_string(folder.path().join("summary.json")).expect("summary.json");
    let summary: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    summary["times_faster_than_real_time"].as_f64().expect("number")
}
