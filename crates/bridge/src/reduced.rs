//! Modal coordinates: u = Φη over the lowest modes, every equation alone.
//!
//! ```text
//! m η̈_j + m c_j η̇_j + k ω_j² η_j = φ_jᵀ f      c_j = α + β (k/m) ω_j²   or   2ζω_j
//! ```

use std::sync::Arc;

use ttb_dynamics::factor::FactorError;
use ttb_dynamics::newmark::{Motion, Newmark};

use crate::system::{History, Law, Step, System};

/// The modes' ω² under K₀ and M₀, (rad/s)²; the shapes live in the rows that lead in and out.
#[derive(Debug)]
pub struct Reduced {
    omega2: Vec<f64>,
}

impl Reduced {
    /// From the modes' ω².
    pub fn new(omega2: Vec<f64>) -> Self {
        Self { omega2 }
    }
}

impl System for Reduced {
    fn unknowns(&self) -> usize {
        self.omega2.len()
    }

    fn statics(&self, law: &Law, x: &mut [f64]) {
        x.iter_mut().zip(&self.omega2).for_each(|(x, w2)| *x /= law.stiffness * w2);
    }

    fn prepare(self: Arc<Self>, law: &Law, newmark: Newmark) -> Result<Box<dyn Step>, FactorError> {
        let rate = |(j, w2): (usize, &f64)| {
            let modal = law.rates.get(j).copied().unwrap_or(0.0);
            modal + law.alpha + law.beta * law.stiffness / law.mass * w2
        };
        let rates: Vec<f64> = self.omega2.iter().enumerate().map(rate).collect();
        let [a0, a1, ..] = newmark.a;
        let inverse =
            rates.iter().zip(&self.omega2).map(|(c, w2)| 1.0 / (law.stiffness * w2 + law.mass * (a0 + a1 * c)));
        Ok(Box::new(ReducedStep { newmark, mass: law.mass, inverse: inverse.collect(), rates }))
    }
}

struct ReducedStep {
    newmark: Newmark,
    /// m.
    mass: f64,
    /// c.
    rates: Vec<f64>,
    /// 1/K̂.
    inverse: Vec<f64>,
}

impl Step for ReducedStep {
    fn newmark(&self) -> &Newmark {
        &self.newmark
    }

    fn history(&mut self, motion: &Motion, history: &mut History) {
        let motion = motion.u.iter().zip(&motion.v).zip(&motion.a);
        for ((load, c), ((u, v), a)) in history.load.iter_mut().zip(&self.rates).zip(motion) {
            *load = self.mass * (self.newmark.inertia(*u, *v, *a) + c * self.newmark.damping(*u, *v, *a));
        }
    }

    fn solve(&mut self, _history: &History, x: &mut [f64]) {
        x.iter_mut().zip(&self.inverse).for_each(|(x, inverse)| *x *= inverse);
    }
}
