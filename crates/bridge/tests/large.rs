//! Large bridges: the solve split over a step, stored models and reductions, against equations solved plainly.

mod common;

use std::sync::Arc;

use common::{
    GIRDER, Train, difference, drive, girder, girder_spec as spec, girder_stations as stations, outputs, stepping,
};
use ttb_bridge::full::Full;
use ttb_bridge::lanes::RUNS;
use ttb_bridge::law::Law;
use ttb_bridge::rows::Rows;
use ttb_bridge::space;
use ttb_bridge::system::{Base, Lane, Step, System, Work};
use ttb_bridge::{Abreast, Bridge, Prepared};
use ttb_contract::Instance;
use ttb_dynamics::newmark::{Motion, Newmark};
use ttb_scenario::spec::BridgeSpec;
use ttb_scenario::types::{Model as Elements, Reduction};
use ttb_sparse::Layout;
use ttb_sparse::Pencil;

const LENGTH: f64 = GIRDER;

fn assembled(model: &Elements) -> (Arc<Pencil>, Vec<Vec<(u32, f64)>>) {
    let assembled = space::assemble(model, &stations(), &[common::point("mid", 0.5 * LENGTH)]).unwrap();
    let rows = [assembled.supports, assembled.monitors].concat();
    let layout = Layout { node_of: assembled.node_of, place: assembled.nodes, ..Layout::default() };
    (Arc::new(assembled.equations.finish_with(&layout).unwrap()), rows)
}

const LAW: Law = Law { stiffness: 1.2, mass: 0.9, alpha: 0.4, beta: 3e-4, rates: Vec::new() };

fn law() -> Law {
    Law { rates: Vec::new(), ..LAW }
}

/// Newmark's method as the textbook has it: products with K, M and C, no exchange of terms.
fn textbook(pencil: &Pencil, newmark: &Newmark, motion: &Motion, load: &[f64], next: &mut Motion) {
    let [a0, a1, ..] = newmark.a;
    let Law { stiffness: k, mass: m, alpha, beta, .. } = law();
    let n = load.len();
    let inertia: Vec<f64> = (0..n).map(|i| newmark.inertia(motion.u[i], motion.v[i], motion.a[i])).collect();
    let damping: Vec<f64> = (0..n).map(|i| newmark.damping(motion.u[i], motion.v[i], motion.a[i])).collect();
    let product = |of: fn(&Pencil, &[f64], &mut [f64]), x: &[f64]| {
        let mut y = vec![0.0; n];
        of(pencil, x, &mut y);
        y
    };
    let (mi, md) = (product(Pencil::add_mass, &inertia), product(Pencil::add_mass, &damping));
    let (kd, cd) = (product(Pencil::add_stiffness, &damping), product(Pencil::add_damping, &damping));
    next.u = (0..n).map(|i| load[i] + m * (mi[i] + alpha * md[i]) + beta * k * kd[i] + cd[i]).collect();
    let factor = pencil.factor(k * (1.0 + a1 * beta), m * (a0 + a1 * alpha), a1).unwrap();
    factor.solve_in_place(&mut next.u, &mut vec![0.0; n]);
    (next.v, next.a) = (vec![0.0; n], vec![0.0; n]);
    newmark.finish_all(motion, next);
}

#[test]
fn the_split_solve_is_newmarks_method_with_dashpots_too() {
    for dashpots in [false, true] {
        let (pencil, rows) = assembled(&girder(dashpots));
        assert_eq!(pencil.has_dashpots(), dashpots);
        let (newmark, n) = (Newmark::new(0.55, 0.28, 1e-3), pencil.ndof());
        let (sparse, supports) = (Arc::new(Rows::new(&rows)), stations().len());
        let full = Arc::new(Full::new(Arc::clone(&pencil), None, Default::default()));
        let step = full.prepare(&law(), newmark, &sparse, supports).unwrap();
        let compliance = step.compliance().expect("a large system splits its solve");
        let (mut base, mut work, mut next) = (Base::default(), Work::default(), Motion::rest(n));
        base.motion = Motion::rest(n);
        let (mut plain, mut plain_next, mut seen) = (Motion::rest(n), Motion::rest(n), Motion::default());
        for k in 0..6 {
            let forces: Vec<f64> = (0..supports).map(|i| 1e4 * f64::from((i as i32 * 7 + k * 3) % 5)).collect();
            step.begin(&mut base, &mut work);
            base.answer(compliance, &newmark, &forces, &mut seen);
            step.finish(&base, &forces, &mut next, &mut work);
            let mut load = vec![0.0; n];
            sparse.add_transposed(&forces, &mut load);
            textbook(&pencil, &newmark, &plain, &load, &mut plain_next);
            std::mem::swap(&mut plain, &mut plain_next);
            assert!(difference(&next.u, &plain.u) < 1e-9, "{}", difference(&next.u, &plain.u));
            for (seen, next) in [(&seen.u, &next.u), (&seen.v, &next.v)] {
                let direct: Vec<f64> = (0..rows.len()).map(|i| sparse.dot(i, next)).collect();
                assert!(difference(seen, &direct) < 1e-9);
            }
            let direct: Vec<f64> = (supports..rows.len()).map(|i| sparse.dot(i, &next.a)).collect();
            assert!(difference(&seen.a[supports..], &direct) < 1e-9);
            std::mem::swap(&mut base.motion, &mut next);
        }
    }
}

/// Twelve steps, each repeated from the saved state and from its bytes.
fn drive_about(mut instance: Instance<Bridge>) -> Vec<Vec<f64>> {
    let n = stations().len();
    let forces = |k: usize| (0..n).map(|i| 2e4 * ((i * 3 + k) % 7) as f64).collect::<Vec<f64>>();
    let mut results = Vec::new();
    for k in 0..12 {
        let before = instance.save();
        let step = |instance: &mut Instance<Bridge>| {
            drive(instance, &forces(k), Some(&forces(k + 3)));
            instance.step(k as f64 * 1e-3, 1e-3).unwrap();
            outputs(instance)
        };
        let first = step(&mut instance);
        instance.restore(&before).unwrap();
        assert_eq!(step(&mut instance), first, "step {k}");
        let bytes = instance.to_bytes(&before);
        let snapshot = instance.from_bytes(&bytes).unwrap();
        instance.restore(&snapshot).unwrap();
        assert_eq!(step(&mut instance), first, "step {k}, from bytes");
        results.push(first);
    }
    results
}

#[test]
fn a_step_repeats_bit_for_bit_also_from_bytes_and_in_a_packed_bridge() {
    for reduction in [None, Some(Reduction { highest_frequency: Some(20.0), ..Reduction::default() })] {
        let spec = BridgeSpec { reduction, ..spec(girder(false)) };
        let here = drive_about(stepping(&spec));
        let folder = common::packed(&spec);
        assert_eq!(drive_about(common::unpacked(folder.path())), here);
        common::assert_cut_is_refused(folder.path(), |length| length / 2);
    }
}

#[test]
fn a_reduced_bridge_keeps_what_it_states() {
    let full = spec(girder(false));
    let reduced = BridgeSpec { reduction: Some(Reduction { error: 0.02, ..Reduction::default() }), ..full.clone() };
    let bridge = Bridge::new(reduced.clone()).unwrap();
    let accuracy = bridge.accuracy().unwrap().clone();
    assert!(accuracy.acceleration <= 0.02 && bridge.unknowns() < bridge.ndof() / 5, "{accuracy:?}");
    let train = Train { axles: (0..4).map(|i| (f64::from(i) * 2.5, 1.5e5)).collect(), speed: 70.0 };
    let run = |spec: &BridgeSpec| {
        let (mut displacement, mut acceleration) = (Vec::new(), Vec::new());
        train.run(spec, 0.3, |_, instance| {
            displacement.push(common::get(instance, "point[mid].displacement"));
            acceleration.push(common::get(instance, "point[mid].acceleration"));
        });
        [displacement, acceleration]
    };
    let (truth, found) = (run(&full), run(&reduced));
    let errors = [0, 1].map(|i| difference(&found[i], &truth[i]));
    println!("stated {accuracy:?}, found {errors:?}");
    // The probe is one load, this train another: the same order, not the same figure.
    assert!(errors[0] < 1e-4 && errors[1] < 3.0 * accuracy.acceleration, "{errors:?}");
}

#[test]
fn an_error_that_no_reduced_model_reaches_ends_and_is_told() {
    let reduction = Some(Reduction { error: 1e-12, ..Reduction::default() });
    // A step of 5 ms shows up to 100 Hz.
    let bridge = Bridge::new(BridgeSpec { reduction, step: 5e-3, ..spec(girder(false)) }).unwrap();
    let reached = bridge.accuracy().unwrap().acceleration;
    let [remark] = bridge.remarks() else { panic!("{:?}", bridge.remarks()) };
    println!("{remark}");
    assert!(remark.contains("1e-12") && remark.contains(&format!("{reached:.1e}")), "{remark}");
    assert!(reached > 1e-12 && reached < 1.0);
}

#[test]
fn a_bridge_that_the_probe_does_not_move_has_no_error() {
    // One support: the probe's axles have nothing to stand between.
    let reduction = Some(Reduction::default());
    let bridge = Bridge::new(BridgeSpec { reduction, supports: vec![12.0], ..spec(girder(false)) }).unwrap();
    let accuracy = bridge.accuracy().unwrap();
    assert_eq!([accuracy.displacement, accuracy.acceleration], [0.0; 2]);
    assert!(bridge.remarks().is_empty());
}

/// `count` runs under loads of their own for five steps, side by side: their motions at the end.
fn abreast(step: &dyn Step, [n, supports]: [usize; 2], which: std::ops::Range<usize>) -> Vec<Motion> {
    let mut work = Work::default();
    let mut bases: Vec<Base> = which.clone().map(|_| Base { motion: Motion::rest(n), ..Base::default() }).collect();
    bases.iter_mut().for_each(|base| step.begin(base, &mut work));
    for k in 0..5 {
        let forces: Vec<Vec<f64>> = which.clone().map(|run| of_run(run, k, supports)).collect();
        let mut next = bases.clone();
        let lanes = bases.iter().zip(&forces).zip(&mut next).map(|((base, forces), next)| Lane { base, forces, next });
        step.proceed_abreast(&mut lanes.collect::<Vec<_>>(), &mut work);
        bases = next;
    }
    bases.into_iter().map(|base| base.motion).collect()
}

fn of_run(run: usize, k: usize, supports: usize) -> Vec<f64> {
    (0..supports).map(|i| 1e4 * ((i * (run + 1) + k) % 19) as f64).collect()
}

#[test]
fn runs_abreast_are_the_runs_alone_whoever_their_neighbours_are() {
    let (pencil, rows) = assembled(&girder(false));
    let (newmark, n, supports) = (Newmark::new(0.5, 0.25, 1e-3), pencil.ndof(), stations().len());
    let sparse = Arc::new(Rows::new(&rows));
    let full = Arc::new(Full::new(Arc::clone(&pencil), None, Default::default()));
    let step = full.prepare(&law(), newmark, &sparse, supports).unwrap();
    let (mut work, mut next) = (Work::default(), Base::default());
    let together = abreast(&*step, [n, supports], 0..RUNS + 3);
    for (run, motion) in together.iter().enumerate() {
        let mut base = Base { motion: Motion::rest(n), ..Base::default() };
        step.begin(&mut base, &mut work);
        for k in 0..5 {
            step.proceed(&base, &of_run(run, k, supports), &mut next, &mut work);
            std::mem::swap(&mut base, &mut next);
        }
        for (found, alone) in [(&motion.u, &base.motion.u), (&motion.v, &base.motion.v), (&motion.a, &base.motion.a)] {
            assert!(difference(found, alone) < 1e-9, "run {run}: {}", difference(found, alone));
        }
    }
    for which in [3..4, 5..14, 1..RUNS + 3] {
        assert_eq!(abreast(&*step, [n, supports], which.clone()), together[which]);
    }
}

/// The outputs of bridges under a train each, step by step; side by side or each by itself.
fn passages(prepared: &Arc<Prepared>, abreast: bool) -> Vec<Vec<f64>> {
    let bridge = prepared.spec();
    let ready = |_| {
        let mut instance = Instance::new(Bridge::from_prepared(prepared).unwrap());
        instance.enter_initialization(0.0).unwrap();
        instance.exit_initialization().unwrap();
        instance
    };
    let mut instances: Vec<Instance<Bridge>> = (0..3).map(ready).collect();
    let (mut all, mut forces, mut served) = (Vec::new(), vec![0.0; bridge.supports.len()], Vec::new());
    let mut ahead = Abreast::default();
    for n in 0..40 {
        let t = 1e-3 * f64::from(n);
        if abreast {
            let mut bridges: Vec<&mut Bridge> = instances.iter_mut().map(Instance::model_mut).collect();
            served.push(ahead.ahead(&mut bridges));
            // A second time there is nothing left.
            assert_eq!(ahead.ahead(&mut bridges), 0);
        }
        for (i, instance) in instances.iter_mut().enumerate() {
            let train = Train { axles: vec![(0.0, 1e5), (2.5, 1e5)], speed: 60.0 + 20.0 * i as f64 };
            train.forces(t + 1e-3, &bridge.supports, &mut forces);
            drive(instance, &forces, None);
            // Repeated as an iteration does.
            let saved = instance.save();
            instance.step(t, 1e-3).unwrap();
            let first = outputs(instance);
            instance.restore(&saved).unwrap();
            instance.step(t, 1e-3).unwrap();
            assert_eq!(outputs(instance), first);
            all.push(first);
        }
    }
    assert!(!abreast || (served[0] == 0 && served[1..].iter().all(|served| *served == 3)), "{served:?}");
    all
}

#[test]
fn bridges_find_what_was_computed_ahead() {
    let full = spec(girder(false));
    let reduced = BridgeSpec { reduction: Some(Reduction::default()), ..full.clone() };
    for (bridge, tolerance) in [(full, 1e-9), (reduced, 0.0)] {
        let prepared = Prepared::new(&bridge).unwrap();
        let (together, alone) = (passages(&prepared, true), passages(&prepared, false));
        for i in 0..together[0].len() {
            let of = |all: &[Vec<f64>]| all.iter().map(|outputs| outputs[i]).collect::<Vec<f64>>();
            let (together, alone) = (of(&together), of(&alone));
            assert!(together == alone || difference(&together, &alone) <= tolerance, "output {i}");
        }
    }
}
