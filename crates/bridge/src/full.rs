//! All degrees of freedom: one sparse factor per step size, one product with M and one solve per new step.
//!
//! Rayleigh damping leaves K̂ = c_K K₀ + c_M M₀ + a₁C₀ with c_K = k(1 + a₁β), c_M = m(a₀ + a₁α). The right-hand side's
//! product with K is expressed by K̂, so that K is never touched in the loop:
//!
//! ```text
//! q  = a₁u + a₄u̇ + a₅ü                      C q = αM q + βK q + C₀q,   K q = (K̂ − c_M M₀ − a₁C₀) k q / c_K
//! p  = m M₀ (a₀u + a₂u̇ + a₃ü + α′q) + γ′C₀q   α′ = α − c_M kβ / (m c_K),   γ′ = 1 − a₁kβ / c_K
//! g  = (kβ/c_K) q
//! ```
//!
//! Modal damping keeps α = β = 0, adds Φ diag(2ζω) ΦᵀM q to what M₀ multiplies, and corrects the solve in closed form
//! ([`ttb_dynamics::damping`]). Φ belongs to K₀ and M₀; under the factors it is Φ/√m with ω² k/m.
//!
//! A large system ([`crate::lazy`]) splits its solve: forward with p when a step begins, backward when u₁ is asked for.

use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use ttb_dynamics::damping::modal_correction;
use ttb_dynamics::newmark::Newmark;
use ttb_sparse::modes::Modes;
use ttb_sparse::vector::{add_scaled, dot};
use ttb_sparse::{Factor, FactorError, Pencil, Product};

use crate::compliance::Compliance;
use crate::lanes::{Lanes, RUNS};
use crate::law::Law;
use crate::lazy::Lazy;
use crate::rows::Rows;
use crate::system::{Base, Lane, Step, System, Work};

/// K₀, M₀, C₀, and the modes that modal damping needs.
#[derive(Debug)]
pub struct Full {
    pencil: Arc<Pencil>,
    /// Factor of K₀: needed while the start is sought, as large as that of K̂.
    statics: Mutex<Option<Arc<Factor>>>,
    modes: Modes,
    /// M₀Φ.
    mass_shapes: Vec<Vec<f64>>,
}

impl Full {
    /// From the assembled matrices and, if it is there already, the factor of K₀; `modes` may be empty where no modal
    /// damping is asked for.
    pub fn new(pencil: Arc<Pencil>, statics: Option<Arc<Factor>>, modes: Modes) -> Self {
        let product = |shape: &Vec<f64>| {
            let mut y = vec![0.0; shape.len()];
            pencil.add_mass(shape, &mut y);
            y
        };
        let mass_shapes = modes.shapes.iter().map(product).collect();
        Self { pencil, statics: Mutex::new(statics), modes, mass_shapes }
    }
}

impl System for Full {
    fn unknowns(&self) -> usize {
        self.pencil.ndof()
    }

    fn statics(&self, law: &Law, x: &mut [f64]) -> Result<(), FactorError> {
        // Nothing that happens while the lock is held leaves it half-done.
        let mut statics = self.statics.lock().unwrap_or_else(PoisonError::into_inner);
        let factor = match &*statics {
            Some(factor) => Arc::clone(factor),
            None => Arc::clone(statics.insert(Arc::new(self.pencil.factor(1.0, 0.0, 0.0)?))),
        };
        drop(statics);
        factor.solve_in_place(x, &mut vec![0.0; x.len()]);
        x.iter_mut().for_each(|x| *x /= law.stiffness);
        Ok(())
    }

    fn rest_statics(&self) {
        let mut statics = self.statics.lock().unwrap_or_else(PoisonError::into_inner);
        // A small factor costs nothing to keep.
        statics.take_if(|factor| factor.panels().is_some());
    }

    fn prepare(
        self: Arc<Self>,
        law: &Law,
        newmark: Newmark,
        rows: &Arc<Rows>,
        supports: usize,
    ) -> Result<Arc<dyn Step>, FactorError> {
        let [a0, a1, ..] = newmark.a;
        let [c_k, c_m] = law.effective(&newmark);
        let [alpha, dashpots, share] = law.history(&newmark);
        let factor = self.pencil.factor(c_k, c_m, a1)?;
        let frequency = law.stiffness / law.mass;
        let corrections = law.rates.iter().zip(&self.modes.omega2);
        let corrections = corrections.map(|(rate, w2)| modal_correction(*rate, frequency * w2, a0, a1) / law.mass);
        let corrections: Vec<f64> = corrections.collect();
        let shapes = &self.modes.shapes[..corrections.len()];
        let lazy = Lazy::new(&factor, rows, supports, shapes, &corrections);
        Ok(Arc::new(FullStep {
            newmark,
            factor,
            mass: law.mass,
            alpha,
            dashpots,
            share,
            rates: law.rates.clone(),
            corrections,
            rows: Arc::clone(rows),
            lazy,
            abreast: OnceLock::new(),
            system: self,
        }))
    }
}

struct FullStep {
    system: Arc<Full>,
    newmark: Newmark,
    factor: Factor,
    /// Factor m on the mass.
    mass: f64,
    /// α′ of the module comment, 1/s.
    alpha: f64,
    /// γ′ of the module comment.
    dashpots: f64,
    /// kβ/c_K.
    share: f64,
    /// 2ζω of the damped modes, 1/s.
    rates: Vec<f64>,
    /// Diagonal of the closed form, over m.
    corrections: Vec<f64>,
    rows: Arc<Rows>,
    /// How a large system splits its solve.
    lazy: Option<Lazy>,
    /// What several bridges side by side need besides; `None`: they have nothing in common.
    abreast: OnceLock<Option<Common>>,
}

impl FullStep {
    fn shapes(&self) -> &[Vec<f64>] {
        &self.system.modes.shapes[..self.corrections.len()]
    }

    /// p into `load`, g into `base.known`.
    fn history(&self, base: &mut Base, load: &mut [f64], inertia: &mut [f64]) {
        let n = load.len();
        base.known.resize(n, 0.0);
        let Base { motion, known, .. } = base;
        let motion = motion.u.iter().zip(&motion.v).zip(&motion.a);
        for (((y, q), load), ((u, v), a)) in inertia.iter_mut().zip(known.iter_mut()).zip(&mut *load).zip(motion) {
            *q = self.newmark.damping(*u, *v, *a);
            *y = self.mass * (self.newmark.inertia(*u, *v, *a) + self.alpha * *q);
            *load = 0.0;
        }
        for ((rate, shape), mass_shape) in self.rates.iter().zip(self.shapes()).zip(&self.system.mass_shapes) {
            let amplitude = self.mass * rate * dot(mass_shape, known);
            add_scaled(amplitude, shape, inertia);
        }
        self.system.pencil.add_mass(inertia, load);
        if self.system.pencil.has_dashpots() {
            inertia.iter_mut().zip(&*known).for_each(|(y, q)| *y = self.dashpots * q);
            self.system.pencil.add_damping(inertia, load);
        }
        known.iter_mut().for_each(|q| *q *= self.share);
    }
}

impl FullStep {
    /// M₀ in the order of elimination, where runs side by side share the factor.
    fn common(&self) -> Option<Common> {
        let (pattern, _) = self.factor.panels().filter(|_| self.lazy.is_some())?;
        let alone = self.system.pencil.has_dashpots() || !self.rates.is_empty();
        (!alone).then(|| {
            let mass = self.system.pencil.mass_in(&pattern.position);
            Common { mass, zeros: vec![0.0; self.lazy.as_ref().map_or(0, Lazy::supports)] }
        })
    }
}

/// What runs side by side share besides the factor.
struct Common {
    /// M₀ in the order of elimination.
    mass: Product,
    /// No forces.
    zeros: Vec<f64>,
}

impl Step for FullStep {
    fn newmark(&self) -> &Newmark {
        &self.newmark
    }

    fn begin(&self, base: &mut Base, work: &mut Work) {
        let n = self.system.unknowns();
        let mut load = std::mem::take(&mut base.load);
        [&mut load, &mut work.x, &mut work.y].into_iter().for_each(|v| v.resize(n, 0.0));
        self.history(base, &mut load, &mut work.x);
        base.amplitudes.clear();
        base.amplitudes.extend(self.shapes().iter().map(|shape| dot(shape, &load)));
        if let Some(lazy) = &self.lazy {
            lazy.begin(&self.factor, base, &mut load, work);
            base.see(&self.rows, &self.newmark, lazy.supports());
        }
        base.load = load;
    }

    fn compliance(&self) -> Option<&Compliance> {
        self.lazy.as_ref().map(Lazy::compliance)
    }

    fn solve(&self, base: &Base, forces: &[f64], u: &mut Vec<f64>, work: &mut Work) {
        let n = self.system.unknowns();
        u.resize(n, 0.0);
        match &self.lazy {
            Some(lazy) => lazy.solve(&self.factor, base, forces, u, work),
            None => {
                work.x.resize(n, 0.0);
                u.copy_from_slice(&base.load);
                self.rows.add_transposed(forces, u);
                self.factor.solve_in_place(u, &mut work.x);
            }
        }
        for (i, (correction, shape)) in self.corrections.iter().zip(self.shapes()).enumerate() {
            let amplitude = base.amplitudes[i] + self.rows.dot_transposed(forces, shape);
            add_scaled(-correction * amplitude, shape, u);
        }
        add_scaled(1.0, &base.known, u);
    }

    fn proceed_abreast(&self, lanes: &mut [Lane], work: &mut Work) {
        match self.abreast.get_or_init(|| self.common()) {
            Some(Common { mass, zeros }) if let Some(lazy) = &self.lazy => {
                let constants = [self.mass, self.alpha, self.share];
                let Self { factor, rows, newmark, .. } = self;
                let together = Lanes { factor, lazy, mass, rows, newmark, constants, zeros };
                lanes.chunks_mut(RUNS).for_each(|lanes| together.proceed(lanes, work));
            }
            _ => lanes.iter_mut().for_each(|lane| self.proceed(lane.base, lane.forces, lane.next, work)),
        }
    }
}
