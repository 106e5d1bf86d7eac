//! Damping of large and of reduced bridges, against equations solved plainly.

mod common;

use std::sync::Arc;

use common::{GIRDER, beams, difference, drive, girder, girder_stations, outputs, set, span};
use ttb_bridge::full::Full;
use ttb_bridge::law::Law;
use ttb_bridge::rows::Rows;
use ttb_bridge::system::{Base, System, Work};
use ttb_bridge::{Bridge, space};
use ttb_contract::Instance;
use ttb_dynamics::newmark::{Motion, Newmark};
use ttb_scenario::spec::BridgeSpec;
use ttb_scenario::types::{Damping, RayleighAt};
use ttb_sparse::modes::lowest;
use ttb_sparse::vector::dot;
use ttb_sparse::{Factor, Layout, Pencil};

/// M ü + C u̇ + K u = f with C = U diag(c) Uᵀ of two columns, solved by the general formula of Woodbury.
struct Plain<'a> {
    pencil: &'a Pencil,
    newmark: Newmark,
    mass: f64,
    factor: Factor,
    columns: [Vec<f64>; 2],
    rates: [f64; 2],
    /// A⁻¹U.
    solved: [Vec<f64>; 2],
}

impl<'a> Plain<'a> {
    fn new(pencil: &'a Pencil, newmark: Newmark, law: &Law, columns: [Vec<f64>; 2]) -> Self {
        let factor = pencil.factor(law.stiffness, law.mass * newmark.a[0], 0.0).unwrap();
        let solved = columns.clone().map(|mut column| {
            factor.solve_in_place(&mut column, &mut vec![0.0; pencil.ndof()]);
            column
        });
        Self { pencil, newmark, mass: law.mass, factor, columns, rates: [law.rates[0], law.rates[1]], solved }
    }

    fn step(&self, motion: &Motion, load: &[f64], next: &mut Motion) {
        let n = load.len();
        let of = |part: fn(&Newmark, f64, f64, f64) -> f64| -> Vec<f64> {
            (0..n).map(|i| part(&self.newmark, motion.u[i], motion.v[i], motion.a[i])).collect()
        };
        let (inertia, damped) = (of(Newmark::inertia), of(Newmark::damping));
        let mut product = vec![0.0; n];
        self.pencil.add_mass(&inertia, &mut product);
        let mut x: Vec<f64> = load.iter().zip(&product).map(|(f, m)| f + self.mass * m).collect();
        for (column, rate) in self.columns.iter().zip(self.rates) {
            let amplitude = rate * dot(column, &damped);
            x.iter_mut().zip(column).for_each(|(x, u)| *x += amplitude * u);
        }
        self.factor.solve_in_place(&mut x, &mut vec![0.0; n]);
        // (E⁻¹ + UᵀA⁻¹U) y = Uᵀx, two equations.
        let e = self.rates.map(|rate| 1.0 / (self.newmark.a[1] * rate));
        let g = |i: usize, j: usize| dot(&self.columns[i], &self.solved[j]) + if i == j { e[i] } else { 0.0 };
        let [p, q] = [0, 1].map(|i| dot(&self.columns[i], &x));
        let determinant = g(0, 0) * g(1, 1) - g(0, 1) * g(1, 0);
        let y = [(p * g(1, 1) - q * g(0, 1)) / determinant, (q * g(0, 0) - p * g(1, 0)) / determinant];
        for (solved, y) in self.solved.iter().zip(y) {
            x.iter_mut().zip(solved).for_each(|(x, s)| *x -= y * s);
        }
        next.u = x;
        (next.v, next.a) = (vec![0.0; n], vec![0.0; n]);
        self.newmark.finish_all(motion, next);
    }
}

#[test]
fn modal_damping_of_a_large_bridge_is_the_low_rank_matrix_it_stands_for() {
    let assembled = space::assemble(&girder(false), &girder_stations(), &[common::point("mid", 0.5 * GIRDER)]).unwrap();
    let rows = [assembled.supports, assembled.monitors].concat();
    let layout = Layout { node_of: assembled.node_of, place: assembled.nodes, ..Layout::default() };
    let pencil = Arc::new(assembled.equations.finish_with(&layout).unwrap());
    assert!(pencil.ndof() > 3000);
    let (newmark, n, supports) = (Newmark::new(0.55, 0.28, 1e-3), pencil.ndof(), girder_stations().len());
    let modes = lowest(&pencil, &pencil.factor(1.0, 0.0, 0.0).unwrap(), 2).unwrap();
    // Strong, so that every term shows.
    let law = Law { stiffness: 1.3, mass: 0.8, alpha: 0.0, beta: 0.0, rates: vec![40.0, 25.0] };
    let columns = [0, 1].map(|j| {
        let mut column = vec![0.0; n];
        pencil.add_mass(&modes.shapes[j], &mut column);
        column.iter_mut().for_each(|x| *x *= law.mass.sqrt());
        column
    });
    let plain = Plain::new(&pencil, newmark, &law, columns);
    let sparse = Arc::new(Rows::new(&rows));
    let step = Arc::new(Full::new(Arc::clone(&pencil), None, modes)).prepare(&law, newmark, &sparse, supports).unwrap();
    let compliance = step.compliance().expect("a large system splits its solve");
    let (mut base, mut work, mut next) = (Base::default(), Work::default(), Motion::rest(n));
    base.motion = Motion::rest(n);
    let (mut alone, mut alone_next, mut seen) = (Motion::rest(n), Motion::rest(n), Motion::default());
    for k in 0..12 {
        let forces: Vec<f64> = (0..supports).map(|i| 1e4 * f64::from((i as i32 * 7 + k * 3) % 5)).collect();
        step.begin(&mut base, &mut work);
        base.answer(compliance, &newmark, &forces, &mut seen);
        step.finish(&base, &forces, &mut next, &mut work);
        let mut load = vec![0.0; n];
        sparse.add_transposed(&forces, &mut load);
        plain.step(&alone, &load, &mut alone_next);
        std::mem::swap(&mut alone, &mut alone_next);
        assert!(difference(&next.u, &alone.u) < 1e-9, "step {k}: {}", difference(&next.u, &alone.u));
        for (seen, next) in [(&seen.u, &next.u), (&seen.v, &next.v)] {
            let direct: Vec<f64> = (0..rows.len()).map(|i| sparse.dot(i, next)).collect();
            assert!(difference(seen, &direct) < 1e-9, "step {k}: {}", difference(seen, &direct));
        }
        std::mem::swap(&mut base.motion, &mut next);
    }
}

#[test]
fn factors_and_rayleigh_damping_are_the_same_in_all_modes_as_in_all_degrees_of_freedom() {
    let run = |modes: Option<usize>, at: RayleighAt| {
        let damping = Damping::Rayleigh { ratio: 0.08, at };
        let spec = BridgeSpec { damping, modes, ..beams(vec![span(20.0, 1.5e10, 5000.0, 6)], 4, 1e-3) };
        let mut bridge = Instance::new(Bridge::new(spec).unwrap());
        set(&mut bridge, "stiffness_factor", 2.5);
        set(&mut bridge, "mass_factor", 0.4);
        bridge.enter_initialization(0.0).unwrap();
        bridge.exit_initialization().unwrap();
        for k in 0..60 {
            let force = if k < 20 { 1e5 } else { 0.0 };
            drive(&mut bridge, &[0.0, 0.3 * force, force, 0.0, 0.0], None);
            bridge.step(f64::from(k) * 1e-3, 1e-3).unwrap();
        }
        outputs(&mut bridge)
    };
    for at in [RayleighAt::Hz([5.0, 60.0]), RayleighAt::Modes([1, 3]), RayleighAt::FirstTimes(6.0)] {
        // Six elements on two bearings: 12 rotations and displacements are free.
        let (all, modal) = (run(None, at.clone()), run(Some(12), at));
        let largest = all.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
        for (i, (a, b)) in all.iter().zip(&modal).enumerate() {
            assert!((a - b).abs() < 1e-7 * a.abs().max(1e-9 * largest), "output {i}: {a} {b}");
        }
    }
}
