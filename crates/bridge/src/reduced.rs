//! Modal coordinates: u = Φη over modes and pseudo-modes, every equation alone.
//!
//! ```text
//! m η̈_j + m c_j η̇_j + k ω_j² η_j = φ_jᵀ f      c_j = α + β (k/m) ω_j²   or   2ζω_j
//! ```
//!
//! What the outside sees is dense here: RΦ. So a step reads it twice, for r⁰ and for Φᵀ f, and repetitions read S.

use std::sync::Arc;

use ttb_dynamics::dense::Dense;
use ttb_dynamics::factor::FactorError;
use ttb_dynamics::newmark::{Motion, Newmark};

use crate::rows::Rows;
use crate::system::{Base, Law, Step, System, Work};

/// The coordinates' ω² under K₀ and M₀, (rad/s)²; the shapes live in the rows that lead in and out.
#[derive(Debug)]
pub struct Reduced {
    omega2: Vec<f64>,
}

impl Reduced {
    /// From the ω².
    pub fn new(omega2: Vec<f64>) -> Self {
        Self { omega2 }
    }

    /// The ω².
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
        let compliance = (supports < inverse.len()).then(|| compliance(rows, supports, &inverse));
        Ok(Arc::new(ReducedStep { newmark, mass: law.mass, inverse, rates, rows: Arc::clone(rows), compliance }))
    }
}

/// S = RΦ diag(1/K̂) (BΦ)ᵀ.
fn compliance(rows: &Rows, supports: usize, inverse: &[f64]) -> Dense {
    let mut s = Dense::zeros(rows.len(), supports);
    for j in 0..supports {
        let mut column = vec![0.0; inverse.len()];
        rows.add_row(j, 1.0, &mut column);
        column.iter_mut().zip(inverse).for_each(|(x, inverse)| *x *= inverse);
        (0..rows.len()).for_each(|i| s.row_mut(i)[j] = rows.dot(i, &column));
    }
    s
}

struct ReducedStep {
    newmark: Newmark,
    /// m.
    mass: f64,
    /// c.
    rates: Vec<f64>,
    /// 1/K̂.
    inverse: Vec<f64>,
    rows: Arc<Rows>,
    compliance: Option<Dense>,
}

impl Step for ReducedStep {
    fn newmark(&self) -> &Newmark {
        &self.newmark
    }

    fn begin(&self, base: &mut Base, work: &mut Work) {
        let n = self.inverse.len();
        let Base { motion: Motion { u, v, a }, load, known, rows, free, .. } = base;
        [&mut *load, known, &mut work.x].into_iter().for_each(|x| x.resize(n, 0.0));
        for ((load, c), ((u, v), a)) in load.iter_mut().zip(&self.rates).zip(u.iter().zip(&*v).zip(&*a)) {
            *load = self.mass * (self.newmark.inertia(*u, *v, *a) + c * self.newmark.damping(*u, *v, *a));
        }
        if self.compliance.is_some() {
            work.x.iter_mut().zip(&*load).zip(&self.inverse).for_each(|((x, load), inverse)| *x = load * inverse);
            [&mut rows.u, &mut rows.v, &mut rows.a, &mut *free]
                .into_iter()
                .for_each(|r| r.resize(self.rows.len(), 0.0));
            self.rows.multiply([u, v, a, &work.x], [&mut rows.u, &mut rows.v, &mut rows.a, free]);
        }
    }

    fn compliance(&self) -> Option<&Dense> {
        self.compliance.as_ref()
    }

    fn solve(&self, base: &Base, forces: &[f64], u: &mut Vec<f64>, _work: &mut Work) {
        u.resize(self.inverse.len(), 0.0);
        u.copy_from_slice(&base.load);
        self.rows.add_transposed(forces, u);
        u.iter_mut().zip(&self.inverse).for_each(|(x, inverse)| *x *= inverse);
    }
}
