//! Speed of whole runs without FMUs, as multiples of real time: `cargo bench -p ttb-tests --bench speed`.

use std::ops::ControlFlow;
use std::time::Instant;

use ttb_coupling::Coupling;
use ttb_coupling::iteration::IterationError;
use ttb_coupling::run::{TimeAxis, run};
use ttb_tests::{Pair, example, pair, settings};

fn main() {
    for name in ["r1.json", "default.json"] {
        let checked = example(name);
        let axis = TimeAxis::new(checked.train_track.step, checked.train_track.end);
        let mut best = f64::INFINITY;
        let (mut start, mut iterations) = (0.0, 0);
        for _ in 0..3 {
            let begin = Instant::now();
            let Pair { mut train_track, mut bridge, coupled, .. } = pair(&checked);
            let mut coupling = Coupling::new(coupled.0, coupled.1, settings(&checked));
            coupling.initialise(&mut train_track, &mut bridge, 0.0).expect("static equilibrium");
            start = begin.elapsed().as_secs_f64();
            let begin = Instant::now();
            iterations = 0;
            let ended = run(&mut coupling, &mut train_track, &mut bridge, axis, |_, _, _, _, info| {
                iterations += info.iterations;
                Ok::<_, IterationError>(ControlFlow::Continue(()))
            });
            assert!(ended.expect("run").is_continue());
            best = best.min(begin.elapsed().as_secs_f64());
        }
        let (steps, end) = (axis.steps() as f64, checked.train_track.end);
        println!(
            "{name}: {:.1} µs a step, {:.2} trials a step, {:.1} × real time; start {start:.2} s",
            1e6 * best / steps,
            iterations as f64 / steps,
            end / best
        );
    }
}
