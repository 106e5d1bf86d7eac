//! One bridge, stage by stage.

use std::path::Path;
use std::sync::Arc;

use ttb_bridge::full::Full;
use ttb_bridge::lanes::RUNS;
use ttb_bridge::law::Law;
use ttb_bridge::reduction::Supports;
use ttb_bridge::rows::Rows;
use ttb_bridge::structure::eliminated_last;
use ttb_bridge::system::{Base, Lane, Step, System, Work};
use ttb_bridge::{reduction, space};
use ttb_dynamics::damping::rayleigh;
use ttb_dynamics::newmark::{Motion, Newmark};
use ttb_scenario::spec::StructureSpec;
use ttb_scenario::types::Reduction;
use ttb_sparse::Layout;

use crate::meter::{least, peak_memory, stream, timed};

/// A line of the table.
pub struct Row {
    ndof: usize,
    supports: usize,
    /// Numbers of L.
    factor: usize,
    /// CPU time until the first step, s.
    start: f64,
    /// s.
    step: f64,
    /// Reading L once, s.
    stream: f64,
    /// A trial through S, s.
    trial: f64,
    /// A run and step in lockstep, s.
    lockstep: f64,
    /// Most memory of the above, bytes.
    memory: f64,
    /// Vectors, CPU time of the set-up (s), a step (s), most memory (bytes).
    reduced: Option<[f64; 4]>,
}

impl Row {
    pub const HEAD: &str = "\
| degrees of freedom | supports | numbers of L | start, CPU s | memory, GB | step, ms | L streamed twice, ms | ratio \
| trial, µs | lockstep, ms | reduced: vectors | set-up, CPU s | memory, GB | step, µs |
|---|---|---|---|---|---|---|---|---|---|---|---|---|---|";
}

impl std::fmt::Display for Row {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { ndof, supports, start, .. } = self;
        let (factor, memory) = (self.factor as f64 * 1e-6, self.memory * 1e-9);
        let [step, stream, lockstep] = [self.step, 2.0 * self.stream, self.lockstep].map(|s| s * 1e3);
        write!(f, "| {ndof} | {supports} | {factor:.1} M | {start:.1} | {memory:.2} | {step:.2} | {stream:.2} ")?;
        write!(f, "| {:.2} | {:.0} | {lockstep:.2} |", step / stream, self.trial * 1e6)?;
        match self.reduced {
            Some([vectors, setup, step, memory]) => {
                write!(f, " {vectors} | {setup:.0} | {:.2} | {:.0} |", memory * 1e-9, step * 1e6)
            }
            None => write!(f, " – | – | – | – |"),
        }
    }
}

/// All stages of the bridge in a scenario; reduces those with at most `reducible` supports.
pub fn measure(scenario: &Path, reduce: Option<f64>, reducible: usize) -> Row {
    println!("\n{}", scenario.display());
    let checked = ttb_scenario::load(scenario).expect("a scenario");
    let spec = &checked.bridge;
    let supports = spec.supports.len();
    let StructureSpec::FiniteElements(model) = &spec.structure else { panic!("finite elements") };
    peak_memory();
    let mut start = 0.0;
    let assembled =
        timed("assemble", &mut start, || space::assemble(model, &spec.supports, &spec.points).expect("a model"));
    let rows = [assembled.supports.clone(), assembled.monitors.clone()].concat();
    let ndof = assembled.equations.ndof();
    println!("{ndof} degrees of freedom, {supports} supports");
    let last = eliminated_last(&assembled.supports, ndof);
    let layout = Layout { node_of: assembled.node_of, place: assembled.nodes, last, order: Vec::new() };
    let pencil = timed("merge, order, analyse", &mut start, || {
        Arc::new(assembled.equations.finish_with(&layout).expect("an order"))
    });
    let (alpha, beta) = rayleigh(0.02, [0.8, 8.0].map(|hz| hz * std::f64::consts::TAU));
    let law = Law { stiffness: 1.0, mass: 1.0, alpha, beta, rates: Vec::new() };
    let newmark = Newmark::new(0.5, 0.25, spec.step);
    let factor = timed("factorise K", &mut start, || pencil.factor(1.0, 0.0, 0.0).expect("a factor").entries());
    let full = Arc::new(Full::new(Arc::clone(&pencil), None, Default::default()));
    let sparse = Arc::new(Rows::new(&rows));
    let prepared =
        timed("factorise the step, S", &mut start, || full.prepare(&law, newmark, &sparse, supports).expect("a step"));
    let [step, trial] = run(&*prepared, ndof, supports);
    let lockstep = abreast(&*prepared, ndof, supports);
    drop(prepared);
    let memory = peak_memory();
    let reduced = reduce.filter(|_| supports <= reducible).map(|hertz| {
        let wish = Reduction { highest_frequency: Some(hertz), ..Reduction::default() };
        let mut setup = 0.0;
        let built = timed("reduce", &mut setup, || {
            let factor = pencil.factor(1.0, 0.0, 0.0).expect("a factor");
            let supports = Supports { stations: &spec.supports, ports: supports };
            reduction::build(&pencil, &factor, &law, newmark, &rows, supports, &wish).expect("a basis")
        });
        println!("{:?}", built.accuracy);
        let (system, shared) = (Arc::new(built.system), Arc::new(built.rows));
        let vectors = system.unknowns();
        let prepared = system.prepare(&law, newmark, &shared, supports).expect("a step");
        let [step, _] = run(&*prepared, vectors, supports);
        println!("reduced, a run and step of {RUNS} abreast: {:.0} µs", 1e6 * abreast(&*prepared, vectors, supports));
        [vectors as f64, setup, step, peak_memory()]
    });
    Row { ndof, supports, factor, start, step, stream: stream(factor), trial, lockstep, memory, reduced }
}

/// Least seconds of a step with two trials, and of a trial.
fn run(step: &dyn Step, unknowns: usize, supports: usize) -> [f64; 2] {
    let (mut base, mut next, mut work) = (Base::default(), Base::default(), Work::default());
    base.motion = Motion::rest(unknowns);
    step.begin(&mut base, &mut work);
    let (mut seen, forces) = (Motion::default(), vec![1e4; supports]);
    let mut trial = |base: &Base| {
        step.compliance().into_iter().for_each(|s| base.answer(s, step.newmark(), &forces, &mut seen));
    };
    let alone = least(30, || trial(&base));
    let whole = least(30, || {
        (0..2).for_each(|_| trial(&base));
        step.proceed(&base, &forces, &mut next, &mut work);
        std::mem::swap(&mut base, &mut next);
    });
    [whole, alone]
}

/// Least seconds of a run and step of [`RUNS`] runs side by side, with two trials each.
fn abreast(step: &dyn Step, unknowns: usize, supports: usize) -> f64 {
    let (mut work, mut seen, forces) = (Work::default(), Motion::default(), vec![1e4; supports]);
    let mut bases: Vec<Base> = (0..RUNS).map(|_| Base { motion: Motion::rest(unknowns), ..Base::default() }).collect();
    bases.iter_mut().for_each(|base| step.begin(base, &mut work));
    let mut next = bases.clone();
    let step = least(10, || {
        for base in bases.iter().chain(&bases) {
            step.compliance().into_iter().for_each(|s| base.answer(s, step.newmark(), &forces, &mut seen));
        }
        let lanes = bases.iter().zip(&mut next).map(|(base, next)| Lane { base, forces: &forces, next });
        step.proceed_abreast(&mut lanes.collect::<Vec<_>>(), &mut work);
        std::mem::swap(&mut bases, &mut next);
    });
    step / RUNS as f64
}
