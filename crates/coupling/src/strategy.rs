//! Which acceleration is in force, and when another one takes its place.

use crate::acceleration::{Acceleration, Aitken, FixedPoint};
use crate::newton::Newton;
use crate::quasi_newton::QuasiNewton;
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
    /// Nobody may ask for a Jacobian again.
    hopeless: bool,
    /// |r| of the trial before, as Newton saw it.
    before: f64,
    /// Trials spent beyond two a step.
    spent: f64,
}

impl Strategy {
    pub fn new(n: usize, settings: &Settings) -> Self {
        let method = if settings.method == Method::Auto { Method::Aitken } else { settings.method };
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
            hopeless: false,
            before: f64::INFINITY,
            spent: 0.0,
        }
    }

    /// In force in the last step.
    pub fn in_force(&self) -> Method {
        self.now
    }

    /// Whether a Jacobian for steps of `h` seconds should be identified now.
    pub fn wants_jacobian(&self) -> bool {
        self.method == Method::Newton && self.newton.is_none() && !self.hopeless
    }

    /// The Jacobian that was asked for; `None`: there is no useful one.
    pub fn take_jacobian(&mut self, jacobian: Option<Vec<f64>>, h: f64) {
        self.newton = jacobian.and_then(|j| Newton::new(self.n, j, h, self.reuse));
        self.hopeless = self.newton.is_none();
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

    /// Begins the step once more with the most robust method: quasi-Newton with an empty memory.
    pub fn begin_rescue(&mut self) {
        self.now = Method::IqnIls;
        self.end_static();
        self.acceleration().begin_step();
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
