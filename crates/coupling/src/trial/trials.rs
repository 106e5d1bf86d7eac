//! The vectors that the trials of a step work on, and the three verbs of a trial.
//!
//! ```text
//! λ    trial forces, sent to the bridge
//! G    what the train–track side answers to the motion they cause
//! r    G − λ
//! ```

use ttb_contract::Ports;

use crate::algebra::{each, norm};
use crate::error::IterationError;
use crate::settings::{Predictor, Settings};
use crate::trial::exchange::{Exchange, Sides};
use crate::trial::history::History;

/// λ, G, r, and what they start from.
pub(crate) struct Trials {
    pub exchange: Exchange,
    /// Forces accepted so far.
    pub forces: History,
    predictor: Predictor,
    /// One axle load in the unit of the first port.
    pub scale: f64,
    pub lambda: Vec<f64>,
    pub answer: Vec<f64>,
    pub residual: Vec<f64>,
}

impl Trials {
    pub fn new(ports: Ports, settings: &Settings) -> Self {
        let (n, scale) = (ports.forces(), ports.scale());
        let zero = || vec![0.0; n];
        Self {
            exchange: Exchange::new(ports, settings),
            forces: History::new(n, settings.mean_forces),
            predictor: settings.predictor,
            scale,
            lambda: zero(),
            answer: zero(),
            residual: zero(),
        }
    }

    /// λ⁰ of a step of `h` seconds.
    pub fn predict(&mut self, h: f64) {
        self.forces.predict(self.predictor, h, &mut self.lambda);
    }

    /// λ → G from the saved states.
    pub fn run(&mut self, sides: &mut Sides) -> Result<(), IterationError> {
        self.exchange.trial(sides, self.forces.now(), &self.lambda, &mut self.answer)
    }

    /// λ → G once, from the states the subsystems are in.
    pub fn run_once(&mut self, sides: &mut Sides) -> Result<(), IterationError> {
        self.run_bridge(sides, false)?;
        self.run_train_track(sides, false)
    }

    /// λ → G in static equilibrium.
    pub fn run_statics(&mut self, sides: &mut Sides) -> Result<(), IterationError> {
        self.exchange.equilibrium(sides, &self.lambda, &mut self.answer)
    }

    /// λ → motion; `back` while the step may still be repeated.
    pub fn run_bridge(&mut self, sides: &mut Sides, back: bool) -> Result<(), IterationError> {
        self.exchange.bridge(sides, self.forces.now(), &self.lambda, back)
    }

    /// Motion → G.
    pub fn run_train_track(&mut self, sides: &mut Sides, back: bool) -> Result<(), IterationError> {
        self.exchange.train_track(sides, &mut self.answer, back)
    }

    /// r, and |r| relative to max(|G|, one axle load). Both norms have the unit of the first port, so their quotient has
    /// none.
    pub fn measure(&mut self) -> f64 {
        each(&mut self.residual, [&self.answer, &self.lambda], |[answer, lambda]| answer - lambda);
        norm(&self.residual) / norm(&self.answer).max(self.scale)
    }

    /// After initialization mode: the run begins with the motion and the forces that both sides answer now. Forces that are
    /// those of the last static trial stay as the bridge has them, to the tolerance.
    pub fn start(&mut self, sides: &mut Sides) -> Result<(), IterationError> {
        self.exchange.start(sides, &mut self.residual)?;
        if self.residual != self.answer {
            self.answer.copy_from_slice(&self.residual);
            self.lambda.copy_from_slice(&self.residual);
        }
        self.forces.start(&self.lambda);
        Ok(())
    }

    /// The trial becomes the state the next step starts from; λ or, where nothing else carries the answer on, G.
    pub fn accept(&mut self, h: f64, answer: bool) {
        self.forces.accept(if answer { &self.answer } else { &self.lambda }, h);
        self.exchange.accept();
    }
}
