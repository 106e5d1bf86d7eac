//! Which acceleration is in force, and when another one takes its place.

use crate::acceleration::newton::{Model, Newton};
use crate::acceleration::quasi_newton::QuasiNewton;
use crate::acceleration::relaxation::{Aitken, FixedPoint};
use crate::acceleration::verbs::Acceleration;
use crate::settings::{Method, Settings};

/// All accelerations of a run.
pub(crate) struct Strategy {
    n: usize,
    asked: Method,
    reuse: usize,
    /// In force from step to step; never `Auto`.
    method: Method,
    /// In force in this step.
    now: Method,
    fixed_point: FixedPoint,
    aitken: Aitken,
    quasi: Option<QuasiNewton>,
    newton: Option<Newton>,
    /// There is no useful model: nobody may ask again.
    no_model: bool,
    /// |r| of the trial before.
    before: f64,
    /// `Auto`: trials beyond [`ENOUGH`] a step so far, and their running mean a step.
    spent: f64,
    mean: f64,
}

/// Trials a step that need no improvement.
const ENOUGH: f64 = 2.0;
/// Up to so many forces Newton's dense model costs less than a trial.
const SMALL: usize = 150;
/// Running means of trials a step above which `Auto` identifies a small model, a large one, gives Newton up.
const MANY: [f64; 3] = [3.0, 5.0, 4.0];
/// Weight of the newest step in the running mean.
const WEIGHT: f64 = 0.1;

impl Strategy {
    pub fn new(n: usize, settings: &Settings) -> Self {
        let method = match settings.method {
            Method::Auto | Method::Explicit => Method::IqnIls,
            asked => asked,
        };
        Self {
            n,
            asked: settings.method,
            reuse: settings.reuse,
            method,
            now: method,
            fixed_point: FixedPoint,
            aitken: Aitken::new(n),
            quasi: None,
            newton: None,
            no_model: false,
            before: f64::INFINITY,
            spent: 0.0,
            mean: 0.0,
        }
    }

    /// In force from step to step.
    pub fn method(&self) -> Method {
        self.method
    }

    /// In force in the last step.
    pub fn in_force(&self) -> Method {
        self.now
    }

    /// Whether a model should be identified now. `Auto` waits until the trials it would have saved exceed those it
    /// costs: whenever the run ends, that was at most twice as dear as to know it beforehand.
    pub fn wants_model(&self) -> bool {
        let pays = || self.spent > self.n as f64 && self.mean > MANY[usize::from(self.n > SMALL)];
        let wanted = self.method == Method::Newton || (self.asked == Method::Auto && pays());
        wanted && self.newton.is_none() && !self.no_model
    }

    /// What was identified for steps of `h` seconds.
    pub fn take(&mut self, model: Model, h: f64) {
        self.newton = Newton::new(model, h, self.reuse);
        self.no_model = self.newton.is_none();
        self.method = if self.no_model { Method::IqnIls } else { Method::Newton };
        self.mean = ENOUGH;
    }

    /// A step took so many trials; the method that takes over, if one does.
    pub fn observe(&mut self, trials: usize) -> Option<Method> {
        if self.asked != Method::Auto {
            return None;
        }
        self.spent += trials as f64 - ENOUGH;
        self.mean += WEIGHT * (trials as f64 - self.mean);
        if self.method != Method::Newton || self.mean <= MANY[2] {
            return None;
        }
        (self.method, self.newton, self.no_model) = (Method::IqnIls, None, true);
        Some(self.method)
    }

    /// Newton's method, if it is in force.
    pub fn newton(&mut self) -> Option<&mut Newton> {
        self.newton.as_mut().filter(|_| self.now == Method::Newton)
    }

    pub fn begin_static(&mut self) {
        self.now = if self.method == Method::Newton { Method::IqnIls } else { self.method };
        self.acceleration().begin_step();
    }

    /// What was learnt in equilibrium says nothing about steps.
    pub fn end_static(&mut self) {
        if let Some(quasi) = &mut self.quasi {
            quasi.forget();
        }
    }

    pub fn begin_step(&mut self, h: f64) {
        self.before = f64::INFINITY;
        let no_newton = !self.newton.as_ref().is_some_and(|newton| newton.fits(h));
        self.now = if self.method == Method::Newton && no_newton { Method::IqnIls } else { self.method };
        self.acceleration().begin_step();
    }

    /// Begins the step once more with the most robust method: quasi-Newton with an empty memory, its first update
    /// relaxed by 1/(1 + ρ).
    pub fn begin_rescue(&mut self, rho: Option<f64>) {
        self.now = Method::IqnIls;
        self.end_static();
        self.acceleration().begin_step();
        if let (Some(quasi), Some(rho)) = (&mut self.quasi, rho) {
            quasi.relax(1.0 / (1.0 + rho));
        }
    }

    pub fn update(&mut self, lambda: &mut [f64], residual: &[f64], size: f64) {
        if self.now == Method::Newton && size > self.before {
            self.now = Method::IqnIls;
            self.acceleration().begin_step();
        }
        self.before = size;
        self.acceleration().update(lambda, residual);
    }

    pub fn end_step(&mut self, lambda: &[f64], residual: &[f64]) {
        self.acceleration().end_step(lambda, residual);
    }

    fn acceleration(&mut self) -> &mut dyn Acceleration {
        match (self.now, &mut self.newton) {
            (Method::FixedPoint, _) => &mut self.fixed_point,
            (Method::Aitken | Method::Auto, _) => &mut self.aitken,
            (Method::Newton, Some(newton)) => newton,
            _ => self.quasi.get_or_insert_with(|| QuasiNewton::new(self.n, self.reuse)),
        }
    }
}
