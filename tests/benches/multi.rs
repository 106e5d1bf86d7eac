//! The cost of sub-steps: 1 ms, 1 ms in 10 sub-steps, 0.1 ms, all on the plain libraries and in one run of this program:
//! `cargo bench -p ttb-tests --bench multi [-- EXAMPLE…]`.

use std::cell::Cell;
use std::time::Instant;

use ttb_contract::{Failure, Subsystem};
use ttb_scenario::step::Steps;
use ttb_session::observe::Iterations;
use ttb_session::{Coupled, Plan, Sides, TimeAxis, drive};
use ttb_tests::{example, sides};

/// Simulated time, s.
const END: f64 = 0.2;

fn main() {
    let chosen: Vec<String> = std::env::args().skip(1).filter(|a| a.ends_with(".json")).collect();
    let all = ["r1.json", "default.json"].map(String::from).to_vec();
    for name in if chosen.is_empty() { all } else { chosen } {
        let costs = [(1e-3, 1), (1e-3, 10), (1e-4, 1)].map(|(step, substeps)| cost(&name, Steps { step, substeps }));
        let [large, multi, small] = costs.map(|cost| cost[0] + cost[1]);
        println!("{name}: sub-steps cost {:.1} times 1 ms, 0.1 ms {:.1} times sub-steps", multi / large, small / multi);
    }
}

/// Seconds inside train and track, and inside the bridge, for a second of simulated time.
fn cost(name: &str, steps: Steps) -> [f64; 2] {
    let mut checked = example(name);
    checked.set_steps(steps);
    let spent = [const { Cell::new(0.0) }; 2];
    let Sides { train_track, bridge, mut coupling, .. } = sides(&checked);
    let mut train_track = Timed { inside: train_track, spent: &spent[0] };
    let mut bridge = Timed { inside: bridge, spent: &spent[1] };
    let mut counted = Iterations::default();
    let axis = TimeAxis::new(steps.step, END);
    let plan = Plan { axis, wanted: &|_| false, clock: &|| 0.0 };
    drive(&mut Coupled::new(&mut train_track, &mut bridge, &mut coupling), &plan, &mut [&mut counted]).expect("run");
    let trials = counted.total();
    let [train_track, bridge] = spent.map(|spent| spent.get() / END);
    let Steps { step, substeps } = steps;
    println!(
        "{name}, {step} s in {substeps:2}: train–track {train_track:6.3} s, bridge {bridge:6.3} s for 1 s; {:.2} trials a step",
        trials as f64 / axis.steps() as f64
    );
    [train_track, bridge]
}

/// A subsystem that is timed.
struct Timed<'a, S> {
    inside: S,
    spent: &'a Cell<f64>,
}

impl<S> Timed<'_, S> {
    fn time<T>(&mut self, call: impl FnOnce(&mut S) -> T) -> T {
        let begin = Instant::now();
        let done = call(&mut self.inside);
        self.spent.set(self.spent.get() + begin.elapsed().as_secs_f64());
        done
    }
}

impl<S: Subsystem> Subsystem for Timed<'_, S> {
    fn name(&self) -> &str {
        self.inside.name()
    }
    fn set_inputs(&mut self, values: &[f64], rates: Option<&[f64]>) -> Result<(), Failure> {
        self.time(|s| s.set_inputs(values, rates))
    }
    fn get_outputs(&mut self, outputs: &mut [f64]) -> Result<(), Failure> {
        self.time(|s| s.get_outputs(outputs))
    }
    fn exit_initialization(&mut self) -> Result<(), Failure> {
        self.inside.exit_initialization()
    }
    fn step(&mut self, t: f64, h: f64, may_restore: bool) -> Result<(), Failure> {
        self.time(|s| s.step(t, h, may_restore))
    }
    fn save(&mut self) -> Result<(), Failure> {
        self.time(S::save)
    }
    fn restore(&mut self) -> Result<(), Failure> {
        self.time(S::restore)
    }
    fn can_interpolate(&self) -> bool {
        self.inside.can_interpolate()
    }
    fn work(&mut self) -> Result<Option<f64>, Failure> {
        self.time(S::work)
    }
}
