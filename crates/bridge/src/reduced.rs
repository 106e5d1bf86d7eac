//! Coordinates that stand alone: u = Φη over modes and pseudo-modes, or modes and what [`crate::local`] adds.
//!
//! ```text
//! m η̈_j + m c_j η̇_j + k ω_j² η_j = φ_jᵀ f      c_j = α + β (k/m) ω_j²   or   2ζω_j
//! ```
//!
//! What the outside sees of every coordinate, R φ_j, is dense, or few numbers where its motion is local. A step reads these
//! once: as the equations stand alone, one pass ends a step and begins the next, coordinate by coordinate. Repetitions read S.

use std::sync::Arc;

use ttb_dynamics::newmark::{Motion, Newmark};
use ttb_sparse::FactorError;

use crate::compliance::Compliance;
use crate::law::Law;
use crate::rows::Rows;
use crate::system::{Base, Step, System, Work};

/// The coordinates' ω² under K₀ and M₀, (rad/s)²; the shapes live in the rows that lead in and out.
#[derive(Debug)]
pub struct Reduced {
    omega2: Vec<f64>,
}

impl Reduced {
    /// Equations of the ω² given, (rad/s)².
    pub fn new(omega2: Vec<f64>) -> Self {
        Self { omega2 }
    }

    /// ω² of all coordinates, (rad/s)².
    pub fn omega2(&self) -> &[f64] {
        &self.omega2
    }
}

impl System for Reduced {
    fn unknowns(&self) -> usize {
        self.omega2.len()
    }

    fn statics(&self, law: &Law, x: &mut [f64]) -> Result<(), FactorError> {
        x.iter_mut().zip(&self.omega2).for_each(|(x, w2)| *x /= law.stiffness * w2);
        Ok(())
    }

    fn prepare(
        self: Arc<Self>,
        law: &Law,
        newmark: Newmark,
        rows: &Arc<Rows>,
        supports: usize,
    ) -> Result<Arc<dyn Step>, FactorError> {
        let rate = |(j, w2): (usize, &f64)| {
            let modal = law.rates.get(j).copied().unwrap_or(0.0);
            modal + law.alpha + law.beta * law.stiffness / law.mass * w2
        };
        let rates: Vec<f64> = self.omega2.iter().enumerate().map(rate).collect();
        let [a0, a1, ..] = newmark.a;
        let inverse =
            rates.iter().zip(&self.omega2).map(|(c, w2)| 1.0 / (law.stiffness * w2 + law.mass * (a0 + a1 * c)));
        let inverse: Vec<f64> = inverse.collect();
        // S pays where it is smaller than RΦ.
        let pays = supports < inverse.len();
        let compliance = if pays { rows.compliance(&inverse, supports) } else { None };
        Ok(Arc::new(ReducedStep { newmark, mass: law.mass, inverse, rates, rows: Arc::clone(rows), compliance }))
    }
}

struct ReducedStep {
    newmark: Newmark,
    /// Factor m on the mass.
    mass: f64,
    /// Damping c of every coordinate, 1/s.
    rates: Vec<f64>,
    /// Reciprocals of K̂, one a coordinate.
    inverse: Vec<f64>,
    rows: Arc<Rows>,
    compliance: Option<Compliance>,
}

impl ReducedStep {
    /// p_j: what m and c multiply at the step's begin.
    fn owed(&self, j: usize, u: f64, v: f64, a: f64) -> f64 {
        self.mass * (self.newmark.inertia(u, v, a) + self.rates[j] * self.newmark.damping(u, v, a))
    }

    /// η_j, η̇_j, η̈_j at the step's end without forces, and η̇_j at its begin.
    fn free(&self, j: usize, load: f64, u: f64, v: f64, a: f64) -> [f64; 4] {
        let end = load * self.inverse[j];
        let (velocity, acceleration) = self.newmark.finish(end, u, v, a);
        [end, velocity, acceleration, v]
    }
}

/// What [`Base`] says of the rows, all zero, in the order of [`ReducedStep::free`].
fn unseen<'a>(free: &'a mut Motion, before: &'a mut Vec<f64>, rows: usize, supports: usize) -> [&'a mut [f64]; 4] {
    let monitors = rows - supports;
    [(&mut free.u, rows), (&mut free.v, rows), (&mut free.a, monitors), (before, monitors)].map(|(r, length)| {
        r.clear();
        r.resize(length, 0.0);
        &mut r[..]
    })
}

impl Step for ReducedStep {
    fn newmark(&self) -> &Newmark {
        &self.newmark
    }

    fn begin(&self, base: &mut Base, _work: &mut Work) {
        let Base { motion: Motion { u, v, a }, load, free, before, .. } = base;
        load.resize(u.len(), 0.0);
        load.iter_mut().enumerate().for_each(|(j, p)| *p = self.owed(j, u[j], v[j], a[j]));
        if let Some(compliance) = &self.compliance {
            let weights = |j: usize, _| self.free(j, load[j], u[j], v[j], a[j]);
            self.rows.fold(&[], weights, unseen(free, before, compliance.rows(), compliance.columns()));
        }
    }

    fn compliance(&self) -> Option<&Compliance> {
        self.compliance.as_ref()
    }

    fn solve(&self, base: &Base, forces: &[f64], u: &mut Vec<f64>, _work: &mut Work) {
        u.clone_from(&base.load);
        self.rows.add_transposed(forces, u);
        u.iter_mut().zip(&self.inverse).for_each(|(x, inverse)| *x *= inverse);
    }

    fn proceed(&self, base: &Base, forces: &[f64], next: &mut Base, work: &mut Work) {
        let Some(compliance) = &self.compliance else {
            self.finish(base, forces, &mut next.motion, work);
            return self.begin(next, work);
        };
        let Base { motion: Motion { u, v, a }, load, free, before, .. } = next;
        [&mut *u, v, a, load].into_iter().for_each(|x| x.resize(self.inverse.len(), 0.0));
        let old = &base.motion;
        let weights = |j: usize, p: f64| {
            u[j] = (base.load[j] + p) * self.inverse[j];
            (v[j], a[j]) = self.newmark.finish(u[j], old.u[j], old.v[j], old.a[j]);
            load[j] = self.owed(j, u[j], v[j], a[j]);
            self.free(j, load[j], u[j], v[j], a[j])
        };
        self.rows.fold(forces, weights, unseen(free, before, compliance.rows(), compliance.columns()));
    }
}
