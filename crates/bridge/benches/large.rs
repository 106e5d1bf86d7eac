//! A large bridge: what building, a step of all degrees of freedom and a reduction cost, against the memory's bandwidth.
//!
//!     cargo bench -p ttb-bridge --bench large -- SCENARIO.json [reduce HERTZ]

use std::hint::black_box;
use std::path::Path;
use std::sync::Arc;
use std::time::Instant;

use ttb_bridge::lockstep::Lockstep;
use ttb_bridge::reduction;
use ttb_bridge::rows::Rows;
use ttb_bridge::space;
use ttb_bridge::system::{Base, Law, Step, System, Work};
use ttb_dynamics::damping::rayleigh;
use ttb_dynamics::factor::Layout;
use ttb_dynamics::newmark::{Motion, Newmark};
use ttb_dynamics::sparse::Pencil;
use ttb_dynamics::sweeps::LANES;
use ttb_scenario::spec::StructureSpec;
use ttb_scenario::types::Reduction;

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).filter(|a| a != "--bench").collect();
    let Some(scenario) = arguments.first() else {
        return println!("usage: cargo bench -p ttb-bridge --bench large -- SCENARIO.json [reduce HERTZ]");
    };
    let checked = ttb_scenario::load(Path::new(scenario)).expect("a scenario");
    let spec = &checked.bridge;
    let StructureSpec::FiniteElements(model) = &spec.structure else { panic!("finite elements") };
    let assembled = timed("assemble", || space::assemble(model, &spec.supports, &spec.points).expect("a model"));
    let rows = [assembled.supports.clone(), assembled.monitors.clone()].concat();
    let mut last: Vec<u32> = assembled.supports.iter().flatten().map(|(dof, _)| *dof).collect();
    last.sort_unstable();
    last.dedup();
    println!(
        "{} degrees of freedom, {} supports on {} of them",
        assembled.equations.ndof(),
        spec.supports.len(),
        last.len()
    );
    let layout = Layout { node_of: assembled.node_of, place: assembled.nodes, last, order: Vec::new() };
    let pencil =
        Arc::new(timed("merge, order, analyse", || assembled.equations.finish_with(&layout).expect("an order")));
    let (alpha, beta) = rayleigh(0.02, [0.8, 8.0].map(|hz| hz * std::f64::consts::TAU));
    let law = Law { stiffness: 1.0, mass: 1.0, alpha, beta, rates: Vec::new() };
    let newmark = Newmark::new(0.5, 0.25, spec.step);
    let factor = timed("factorise K", || pencil.factor(1.0, 0.0, 0.0).expect("a factor"));
    let entries = factor.entries();
    println!("{:.2} M entries of K, {:.2} M numbers of L", pencil.entries() as f64 * 1e-6, entries as f64 * 1e-6);
    drop(factor);
    let full = Arc::new(ttb_bridge::full::Full::new(Arc::clone(&pencil), None, Default::default()));
    let sparse = Arc::new(Rows::new(&rows));
    let step =
        timed("factorise the step, S", || full.prepare(&law, newmark, &sparse, spec.supports.len()).expect("a step"));
    let per_step = run(&*step, pencil.ndof(), spec.supports.len());
    drop(step);
    let stream = stream(entries);
    println!(
        "step {:.2} ms; L streamed twice {:.2} ms; ratio {:.2}",
        per_step * 1e3,
        2e3 * stream,
        per_step / stream / 2.0
    );
    let many = together(&pencil, &law, newmark, &sparse, spec.supports.len());
    println!("{LANES} runs in lockstep: {:.2} ms a run and step", many * 1e3 / LANES as f64);
    if arguments.get(1).is_some_and(|a| a == "reduce") {
        let highest_frequency = arguments.get(2).and_then(|a| a.parse().ok());
        let wish = Reduction { highest_frequency, ..Reduction::default() };
        let built = timed("reduce", || {
            reduction::build(&pencil, &law, newmark, &rows, &spec.supports, &wish).expect("a basis")
        });
        println!("{:?}", built.accuracy);
        let (system, shared) = (Arc::new(built.system), Arc::new(built.rows));
        let unknowns = system.unknowns();
        let step = system.prepare(&law, newmark, &shared, spec.supports.len()).expect("a step");
        println!("reduced step {:.1} µs", run(&*step, unknowns, spec.supports.len()) * 1e6);
    }
}

fn timed<T>(what: &str, work: impl FnOnce() -> T) -> T {
    let (begin, cpu) = (Instant::now(), cpu());
    let result = work();
    println!("{what}: {:.2} s, CPU {:.2} s", begin.elapsed().as_secs_f64(), self::cpu() - cpu);
    result
}

/// CPU time of this process, s.
fn cpu() -> f64 {
    let text = std::fs::read_to_string("/proc/self/stat").unwrap_or_default();
    let fields: Vec<f64> =
        text.rsplit(')').next().unwrap_or("").split_whitespace().filter_map(|f| f.parse().ok()).collect();
    // After the state letter, which is no number, utime and stime are the 11th and 12th.
    (fields.get(10).unwrap_or(&0.0) + fields.get(11).unwrap_or(&0.0)) / 100.0
}

/// Least seconds of a step with two trials.
fn run(step: &dyn Step, unknowns: usize, supports: usize) -> f64 {
    let (mut base, mut next, mut work) = (Base::default(), Base::default(), Work::default());
    base.motion = Motion::rest(unknowns);
    step.begin(&mut base, &mut work);
    let (mut seen, forces) = (Motion::default(), vec![1e4; supports]);
    let mut best = f64::INFINITY;
    for _ in 0..30 {
        let begin = Instant::now();
        if let Some(compliance) = step.compliance() {
            (0..2).for_each(|_| base.answer(compliance, step.newmark(), &forces, &mut seen));
        }
        step.proceed(&base, &forces, &mut next, &mut work);
        std::mem::swap(&mut base, &mut next);
        best = best.min(begin.elapsed().as_secs_f64());
    }
    best
}

/// Least seconds of a step of all runs in lockstep, with two trials each.
fn together(pencil: &Pencil, law: &Law, newmark: Newmark, rows: &Rows, supports: usize) -> f64 {
    let mut runs = Lockstep::new(pencil, law, newmark, rows, supports).expect("a large bridge");
    let (forces, mut seen) = (vec![1e4; supports], vec![0.0; rows.len()]);
    let mut best = f64::INFINITY;
    for _ in 0..10 {
        let begin = Instant::now();
        runs.begin();
        (0..2 * LANES).for_each(|i| runs.trial(i % LANES, &forces, &mut seen));
        runs.finish([&forces; LANES]);
        best = best.min(begin.elapsed().as_secs_f64());
    }
    best
}

/// Least seconds of reading as many numbers once.
fn stream(entries: usize) -> f64 {
    let numbers = vec![1.0; entries];
    let once = || {
        let begin = Instant::now();
        let sums = numbers.chunks_exact(16).fold([0.0; 16], |mut sums: [f64; 16], chunk| {
            (0..16).for_each(|k| sums[k] += chunk[k]);
            sums
        });
        black_box(sums);
        begin.elapsed().as_secs_f64()
    };
    (0..10).map(|_| once()).fold(f64::INFINITY, f64::min)
}
