//! A run by one of the methods, step by step.
//!
//! ```text
//! 1  wheels to t₁; p of all from the motions at t₀; cars without contacts: q_free = K̂_c⁻¹ p_c
//! 2  the wheels' forces F at t₁, by the method
//! 3  u₁ = g + K̂⁻¹ (p′ + Nᵀ F),   q₁ = q_free − K̂_c⁻¹ Bᵀ F,   Newmark's velocities and accelerations
//! ```

use ttb_dynamics::newmark::{Motion, Newmark};
use ttb_train_track::car::{AXLES, DOFS, Matrix10};

use crate::constant::{History, factorised};
use crate::error::ReferenceError;
use crate::lcm::Lcm;
use crate::schur::Schur;
use crate::scm::Scm;
use crate::sweeps::Sweeps;
use crate::trial::Trial;
use crate::wheels::Wheels;
use crate::whole::{State, Whole, dot};

/// Which method.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Method {
    /// Strongly coupled, refactorised every step.
    Scm,
    /// Strongly coupled, constant matrices.
    Schur,
    /// Loosely coupled, relaxed by ω; 1: plain.
    Lcm(f64),
}

/// How a step went.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct StepReport {
    /// Iterations on the wheels' forces.
    pub iterations: usize,
    /// Matrices factorised.
    pub factors: usize,
}

enum Solver {
    Scm(Box<Scm>),
    Schur(Schur),
    Lcm(Lcm),
}

/// A run.
pub struct Stepper<'a> {
    whole: &'a Whole,
    newmark: Newmark,
    history: History,
    /// K̂ of track and bridge; SCM has its own.
    sweeps: Option<Sweeps>,
    cars: Vec<Matrix10>,
    cars_free: Vec<f64>,
    cars_load: Vec<f64>,
    solver: Solver,
    wheels: Wheels,
    state: State,
    next: State,
    u: Vec<f64>,
    /// p of all.
    all: Vec<f64>,
    load: Vec<(u32, f64)>,
    steps: u64,
}

impl<'a> Stepper<'a> {
    /// Prepares a run with steps of `h` s; `tolerance` is that of the wheels' forces, relative.
    ///
    /// # Errors
    /// A matrix cannot be factorised.
    pub fn new(whole: &'a Whole, method: Method, h: f64, tolerance: f64) -> Result<Self, ReferenceError> {
        let newmark = Newmark::new(whole.newmark.gamma, whole.newmark.beta, h);
        let cars: Option<Vec<Matrix10>> = whole.cars.iter().map(|car| car.effective_inverse(&newmark)).collect();
        let cars =
            cars.ok_or_else(|| ReferenceError::Case("a car's Newmark matrix is not positive definite".into()))?;
        let (sweeps, solver) = match method {
            Method::Scm => {
                let scm = Scm::new(whole, &newmark, tolerance).map_err(ReferenceError::Case)?;
                (None, Solver::Scm(Box::new(scm)))
            }
            Method::Schur => (Some(factorised(whole, &newmark)?), Solver::Schur(Schur::new(&whole.wheels))),
            Method::Lcm(omega) => {
                let lcm = Lcm::new(omega, tolerance, whole.axle_load, &whole.start.forces);
                (Some(factorised(whole, &newmark)?), Solver::Lcm(lcm))
            }
        };
        let cars_free = vec![0.0; whole.cars.len() * DOFS];
        let all = whole.order() + cars_free.len();
        Ok(Self {
            whole,
            newmark,
            history: History::new(whole),
            sweeps,
            cars,
            cars_load: cars_free.clone(),
            cars_free,
            solver,
            wheels: whole.wheels.clone(),
            state: whole.start.clone(),
            next: whole.start.clone(),
            u: vec![0.0; all],
            all: vec![0.0; all],
            load: Vec::with_capacity(AXLES * whole.wheels.len()),
            steps: 0,
        })
    }

    /// The present time, s.
    pub fn time(&self) -> f64 {
        self.steps as f64 * self.newmark.h
    }

    /// The present state.
    pub fn state(&self) -> &State {
        &self.state
    }

    /// Displacement, velocity and acceleration of a monitored point.
    pub fn point(&self, point: usize) -> [f64; 3] {
        let (row, motion) = (&self.whole.bridge.points[point], &self.state.bridge);
        [&motion.u, &motion.v, &motion.a].map(|x| dot(row, x))
    }

    /// One step.
    ///
    /// # Errors
    /// A wheel leaves the rail, an iteration does not converge; the state is that before the step.
    pub fn step(&mut self) -> Result<StepReport, ReferenceError> {
        let t = (self.steps + 1) as f64 * self.newmark.h;
        self.try_step(t).map_err(|what| ReferenceError::Step { t, what })
    }

    fn try_step(&mut self, t: f64) -> Result<StepReport, String> {
        let whole = self.whole;
        self.wheels.place(&whole.track, t)?;
        self.history.begin(whole, &self.newmark, &self.state.track, &self.state.bridge);
        self.begin_cars();
        let State { forces, approach, cars: moved, .. } = &mut self.next;
        forces.copy_from_slice(&self.state.forces);
        approach.copy_from_slice(&self.state.approach);
        let (order, mut report) = (whole.order(), StepReport::default());
        if let Solver::Scm(scm) = &mut self.solver {
            self.all[..order].copy_from_slice(&self.history.load);
            self.all[order..].copy_from_slice(&self.cars_load);
            let work = scm.solve(whole, &self.wheels, &self.all, approach, forces, &mut self.u)?;
            moved.u.copy_from_slice(&self.u[order..]);
            report = StepReport { iterations: work.iterations, factors: work.factors };
        } else if let Some(sweeps) = &mut self.sweeps {
            sweeps.begin(&self.history.load);
            let mut trial = Trial {
                whole,
                wheels: &self.wheels,
                sweeps,
                cars: &self.cars,
                cars_free: &self.cars_free,
                moved: &mut moved.u,
                load: &mut self.load,
            };
            match &mut self.solver {
                Solver::Schur(schur) => report.iterations = schur.solve(&mut trial, forces)?,
                Solver::Lcm(lcm) => report.iterations = lcm.solve(&mut trial, forces)?,
                Solver::Scm(_) => {}
            }
            trial.press_cars(forces);
            self.wheels.load(&whole.track, forces, &mut self.load);
            sweeps.finish(&self.load, &mut self.u[..order]);
        }
        self.finish();
        Ok(report)
    }

    /// p_c and q_free of all cars.
    fn begin_cars(&mut self) {
        for (c, (car, inverse)) in self.whole.cars.iter().zip(&self.cars).enumerate() {
            let (own, old) = (c * DOFS..(c + 1) * DOFS, &self.state.cars);
            let p = car.history(&self.newmark, &old.u[own.clone()], &old.v[own.clone()], &old.a[own.clone()]);
            self.cars_load[own.clone()].copy_from_slice(p.as_slice());
            self.cars_free[own].copy_from_slice((inverse * p).as_slice());
        }
    }

    /// From displacements to the state at the step's end.
    fn finish(&mut self) {
        let n = self.whole.track.order();
        let (track, bridge) = self.u[..self.whole.order()].split_at(n);
        self.next.track.u.copy_from_slice(track);
        let bridge = bridge.iter().zip(&self.history.known).map(|(u, g)| u + g);
        self.next.bridge.u.iter_mut().zip(bridge).for_each(|(to, u)| *to = u);
        let (old, new) = (&self.state, &mut self.next);
        let all: [(&Motion, &mut Motion); 3] =
            [(&old.track, &mut new.track), (&old.bridge, &mut new.bridge), (&old.cars, &mut new.cars)];
        all.into_iter().for_each(|(old, new)| self.newmark.finish_all(old, new));
        std::mem::swap(&mut self.state, &mut self.next);
        self.steps += 1;
    }

    /// Least and greatest eigenvalue of D Y at time t under the present forces' stiffnesses: how the loosely coupled method
    /// converges ([`crate::lcm`]). `None` for the method that has no constant factor.
    ///
    /// # Errors
    /// A wheel is beyond the rail.
    pub fn wheel_rail_gains(&mut self, t: f64) -> Result<Option<[f64; 2]>, ReferenceError> {
        let failed = |what| ReferenceError::Step { t, what };
        self.wheels.place(&self.whole.track, t).map_err(failed)?;
        let Some(sweeps) = &mut self.sweeps else { return Ok(None) };
        let n = self.wheels.len();
        let mut trial = Trial {
            whole: self.whole,
            wheels: &self.wheels,
            sweeps,
            cars: &self.cars,
            cars_free: &self.cars_free,
            moved: &mut self.next.cars.u,
            load: &mut self.load,
        };
        let mut y = vec![0.0; n * n];
        trial.compliance(&mut y);
        // D^{1/2} Y D^{1/2} has the same eigenvalues.
        let root: Vec<f64> = (0..n)
            .map(|axle| self.wheels.force(axle, self.state.approach_or_static(&self.wheels, axle)).1.sqrt())
            .collect();
        let scaled = nalgebra::DMatrix::from_fn(n, n, |i, j| root[i] * y[i * n + j] * root[j]);
        let values = scaled.symmetric_eigenvalues();
        Ok(Some([values.min(), values.max()]))
    }
}

impl State {
    /// s of an axle under its static load.
    fn approach_or_static(&self, wheels: &Wheels, axle: usize) -> f64 {
        let law = &wheels.laws[axle];
        let delta = law.static_approach();
        delta + wheels.points[axle].local_compliance * law.force(delta).0
    }
}
