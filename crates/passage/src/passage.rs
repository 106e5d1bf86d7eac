//! A train over a bridge at any speed.

use ttb_trains::ForceTrain;

use crate::extreme::Extreme;
use crate::history::Histories;
use crate::load::{Heading, TrainLoad};
use crate::march::{March, Motions};
use crate::modal::ModalBridge;

/// A train over a modal bridge: made once, asked for many speeds, also from several threads.
pub struct Passage<'a> {
    bridge: &'a ModalBridge,
    train: ForceTrain,
    heading: Heading,
    load: TrainLoad,
    /// Time of free vibration that is looked at behind the train, s.
    free: f64,
}

/// What a passage at one speed leaves.
#[derive(Clone, Debug, PartialEq)]
pub struct Response {
    /// Speed, m/s.
    pub speed: f64,
    /// Step, s.
    pub step: f64,
    /// Number of steps.
    pub steps: usize,
    /// Extremes of [`ModalBridge::outputs`], in their order. Times count in s from the first axle at the deck's begin.
    pub extremes: Vec<Extreme>,
}

impl<'a> Passage<'a> {
    /// A train over a bridge, with free vibration behind it for `free` s; `None`: [`ModalBridge::free_vibration`].
    #[must_use]
    pub fn new(bridge: &'a ModalBridge, train: &ForceTrain, heading: Heading, free: Option<f64>) -> Self {
        let load = TrainLoad::new(bridge, train, heading, bridge.grid());
        let free = free.unwrap_or_else(|| bridge.free_vibration());
        Self { bridge, train: train.clone(), heading, load, free }
    }

    /// The bridge.
    #[must_use]
    pub fn bridge(&self) -> &'a ModalBridge {
        self.bridge
    }

    /// The train.
    #[must_use]
    pub fn train(&self) -> &ForceTrain {
        &self.train
    }

    /// Static extremes of the same train at the same places, of the outputs that are no accelerations; instead of times the
    /// places of the first axle, m behind the deck's begin.
    #[must_use]
    pub fn statics(&self) -> &[Extreme] {
        &self.load.statics
    }

    /// Steps that a passage takes at `speed` m/s.
    #[must_use]
    pub fn steps(&self, speed: f64) -> usize {
        self.march(&self.load, speed).steps
    }

    /// The passage at `speed` m/s, above 0: extremes of all outputs. It depends on bridge, train, direction, free vibration
    /// and speed alone, not on other speeds.
    #[must_use]
    pub fn at(&self, speed: f64) -> Response {
        if let Some(grid) = self.finer(speed) {
            return self.of(&TrainLoad::new(self.bridge, &self.train, self.heading, grid), speed).0;
        }
        self.of(&self.load, speed).0
    }

    /// The same with the modal histories, which are those of [`Self::histories`].
    #[must_use]
    pub fn with_histories(&self, speed: f64) -> (Response, Histories<'_>) {
        if self.finer(speed).is_some() {
            return (self.at(speed), self.histories(speed));
        }
        let (response, motions) = self.of(&self.load, speed);
        (response, Histories::of(self.bridge, &self.load, &self.march(&self.load, speed), motions))
    }

    /// Modal histories at `speed` m/s, in the steps of [`Passage::at`] for speeds of 5 m/s and more.
    #[must_use]
    pub fn histories(&self, speed: f64) -> Histories<'_> {
        let march = self.march(&self.load, speed);
        Histories::of(self.bridge, &self.load, &march, march.motions())
    }

    /// The grid of a slower train, on which a step of the shared one would be too long.
    fn finer(&self, speed: f64) -> Option<f64> {
        let finer = libm::log2(self.load.grid / (speed * self.bridge.longest_step())).ceil();
        (finer > 0.0).then(|| self.load.grid * 0.5_f64.powi(finer as i32))
    }

    fn of(&self, load: &TrainLoad, speed: f64) -> (Response, Motions) {
        let march = self.march(load, speed);
        let motions = march.motions();
        (Response { speed, step: march.h, steps: march.steps, extremes: march.extremes(&motions) }, motions)
    }

    fn march<'b>(&'b self, load: &'b TrainLoad, speed: f64) -> March<'b> {
        March::new(self.bridge, load, self.train.length(), speed, self.free)
    }
}
