//! The dynamic state of train and track, and its numbers in a fixed order.

use ttb_dynamics::newmark::Motion;

use crate::numbers;

/// Dynamic state of the subsystem.
#[derive(Clone, Debug, PartialEq)]
pub struct State {
    /// The track's degrees of freedom.
    pub track: Motion,
    /// The vehicles'.
    pub cars: Motion,
    /// Approach of every axle, m.
    pub delta: Vec<f64>,
    /// Contact force of every axle, N.
    pub forces: Vec<f64>,
    /// Deck motion [d…, ḋ…] at the end of the step.
    pub deck: Vec<f64>,
    /// Support forces at the end of the step, N.
    pub supports: Vec<f64>,
}

impl State {
    /// Undeformed and at rest, with so many degrees of freedom of track and vehicles, axles, and supports on the bridge.
    pub fn rest(track_dofs: usize, car_dofs: usize, axles: usize, supports: usize) -> Self {
        let axles = vec![0.0; axles];
        Self {
            track: Motion::rest(track_dofs),
            cars: Motion::rest(car_dofs),
            delta: axles.clone(),
            forces: axles,
            deck: vec![0.0; 2 * supports],
            supports: vec![0.0; supports],
        }
    }

    /// All numbers, in a fixed order.
    pub fn numbers(&self) -> impl Iterator<Item = &f64> {
        let rest = self.delta.iter().chain(&self.forces).chain(&self.deck).chain(&self.supports);
        self.track.numbers().chain(self.cars.numbers()).chain(rest)
    }

    /// All numbers, writable, in the same order.
    fn numbers_mut(&mut self) -> impl Iterator<Item = &mut f64> {
        let rest = self.delta.iter_mut().chain(&mut self.forces).chain(&mut self.deck).chain(&mut self.supports);
        self.track.numbers_mut().chain(self.cars.numbers_mut()).chain(rest)
    }

    /// Appends all numbers, little endian.
    pub fn write(&self, bytes: &mut Vec<u8>) {
        numbers::write(self.numbers(), bytes);
    }

    /// Takes over what [`State::write`] wrote of a state of the same size.
    ///
    /// # Errors
    /// Another number of bytes, or a number that is not finite: no step leads to such a state.
    pub fn read(&mut self, bytes: &[u8]) -> Result<(), String> {
        let count = self.numbers().count();
        numbers::read(bytes, count, self.numbers_mut())
    }
}
