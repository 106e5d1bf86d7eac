//! All degrees of freedom: one sparse factor per step size, one product with M and one solve per new step.
//!
//! Rayleigh damping leaves K̂ = c_K K₀ + c_M M₀ with c_K = k(1 + a₁β), c_M = m(a₀ + a₁α). The right-hand side's product
//! with K is expressed by K̂, so that K is never touched in the loop:
//!
//! ```text
//! q  = a₁u + a₄u̇ + a₅ü                      C q = αM q + βK q,   K q = (K̂ − M₀ c_M) k q / c_K
//! p  = m M₀ (a₀u + a₂u̇ + a₃ü + α′q)         α′ = α − c_M kβ / (m c_K)
//! g  = (kβ/c_K) q
//! ```
//!
//! Modal damping keeps α = β = 0, adds Φ diag(2ζω) ΦᵀM q to what M₀ multiplies, and corrects the solve in closed form
//! ([`ttb_dynamics::damping`]). Φ belongs to K₀ and M₀; under the factors it is Φ/√m with ω² k/m.

use std::sync::Arc;

use ttb_dynamics::damping::modal_correction;
use ttb_dynamics::factor::{Factor, FactorError};
use ttb_dynamics::modes::Modes;
use ttb_dynamics::newmark::{Motion, Newmark};
use ttb_dynamics::sparse::Pencil;
use ttb_dynamics::vector::{add_scaled, dot};

use crate::system::{History, Law, Step, System};

/// K₀, M₀, the factor of K₀, and the modes that modal damping needs.
#[derive(Debug)]
pub struct Full {
    pencil: Pencil,
    statics: Factor,
    modes: Modes,
    /// M₀Φ.
    mass_shapes: Vec<Vec<f64>>,
}

impl Full {
    /// From the assembled matrices; `modes` may be empty where no modal damping is asked for.
    pub fn new(pencil: Pencil, statics: Factor, modes: Modes) -> Self {
        let product = |shape: &Vec<f64>| {
            let mut y = vec![0.0; shape.len()];
            pencil.add_mass(shape, &mut y);
            y
        };
        let mass_shapes = modes.shapes.iter().map(product).collect();
        Self { pencil, statics, modes, mass_shapes }
    }
}

impl System for Full {
    fn unknowns(&self) -> usize {
        self.pencil.ndof()
    }

    fn statics(&self, law: &Law, x: &mut [f64]) {
        self.statics.solve_in_place(x, &mut vec![0.0; x.len()]);
        x.iter_mut().for_each(|x| *x /= law.stiffness);
    }

    fn prepare(self: Arc<Self>, law: &Law, newmark: Newmark) -> Result<Box<dyn Step>, FactorError> {
        let [a0, a1, ..] = newmark.a;
        let (c_k, c_m) = (law.stiffness * (1.0 + a1 * law.beta), law.mass * (a0 + a1 * law.alpha));
        let factor = self.pencil.factor(c_k, c_m)?;
        let share = law.stiffness * law.beta / c_k;
        let frequency = law.stiffness / law.mass;
        let corrections = law.rates.iter().zip(&self.modes.omega2);
        let corrections = corrections.map(|(rate, w2)| modal_correction(*rate, frequency * w2, a0, a1) / law.mass);
        Ok(Box::new(FullStep {
            newmark,
            factor,
            mass: law.mass,
            alpha: law.alpha - c_m / law.mass * share,
            share,
            rates: law.rates.clone(),
            corrections: corrections.collect(),
            amplitudes: vec![0.0; law.rates.len()],
            work: vec![0.0; self.unknowns()],
            system: self,
        }))
    }
}

struct FullStep {
    system: Arc<Full>,
    newmark: Newmark,
    factor: Factor,
    /// m.
    mass: f64,
    /// α′.
    alpha: f64,
    /// kβ/c_K.
    share: f64,
    /// 2ζω.
    rates: Vec<f64>,
    /// Diagonal of the closed form, over m.
    corrections: Vec<f64>,
    amplitudes: Vec<f64>,
    work: Vec<f64>,
}

impl Step for FullStep {
    fn newmark(&self) -> &Newmark {
        &self.newmark
    }

    fn history(&mut self, motion: &Motion, history: &mut History) {
        let History { load, known } = history;
        let motion = motion.u.iter().zip(&motion.v).zip(&motion.a);
        for (((y, q), load), ((u, v), a)) in self.work.iter_mut().zip(known.iter_mut()).zip(load.iter_mut()).zip(motion)
        {
            *q = self.newmark.damping(*u, *v, *a);
            *y = self.mass * (self.newmark.inertia(*u, *v, *a) + self.alpha * *q);
            *load = 0.0;
        }
        for ((rate, shape), mass_shape) in
            self.rates.iter().zip(&self.system.modes.shapes).zip(&self.system.mass_shapes)
        {
            let amplitude = self.mass * rate * dot(mass_shape, known);
            add_scaled(amplitude, shape, &mut self.work);
        }
        known.iter_mut().for_each(|q| *q *= self.share);
        self.system.pencil.add_mass(&self.work, load);
    }

    fn solve(&mut self, history: &History, x: &mut [f64]) {
        let shapes = &self.system.modes.shapes;
        for ((amplitude, correction), shape) in self.amplitudes.iter_mut().zip(&self.corrections).zip(shapes) {
            *amplitude = correction * dot(shape, x);
        }
        self.factor.solve_in_place(x, &mut self.work);
        for (amplitude, shape) in self.amplitudes.iter().zip(shapes) {
            add_scaled(-amplitude, shape, x);
        }
        add_scaled(1.0, &history.known, x);
    }
}
