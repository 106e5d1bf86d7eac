//! A train over a bridge at any speed.

use ttb_trains::ForceTrain;

use crate::extreme::Extreme;
use crate::history::Histories;
use crate::load::{Heading, TrainLoad};
use crate::march::March;
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
        let run = |load: &TrainLoad| {
            let march = self.march(load, speed);
            Response { speed, step: march.h, steps: march.steps, extremes: march.extremes() }
        };
        // On the shared grid a step of a slower train would be too long.
        let finer = libm::log2(self.load.grid / (speed * self.bridge.longest_step())).ceil();
        if finer > 0.0 {
            let grid = self.load.grid * 0.5_f64.powi(finer as i32);
            return run(&TrainLoad::new(self.bridge, &self.train, self.heading, grid));
        }
        run(&self.load)
    }

    /// Modal histories at `speed` m/s, in the steps of [`Passage::at`] for speeds of 5 m/s and more.
    #[must_use]
    pub fn histories(&self, speed: f64) -> Histories<'_> {
        let march = self.march(&self.load, speed);
        let stride = march.stride();
        Histories::of(self.bridge, &self.load, &march, stride)
    }

    fn march<'b>(&'b self, load: &'b TrainLoad, speed: f64) -> March<'b> {
        March::new(self.bridge, load, self.train.length(), speed, self.free)
    }
}
