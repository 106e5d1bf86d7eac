//! The dynamic state of train and track in space, and its numbers in a fixed order.

use ttb_dynamics::newmark::Motion;

use crate::numbers;

/// Dynamic state.
#[derive(Clone, Debug, PartialEq)]
pub struct SpaceState {
    /// The plane track: the sum of both rails' vertical motion.
    pub track: Motion,
    /// The lines.
    pub lines: Vec<Motion>,
    /// The cars, 35 degrees of freedom each.
    pub cars: Motion,
    /// f, s and ṡ of the ports of all cars.
    pub ports: [Vec<f64>; 3],
    /// (x, ẋ) of the links with an inner state.
    pub inner: Vec<[f64; 2]>,
    /// Deck motion at the end of the step: blocks of d_z, ḋ_z, d_y, ḋ_y, d_φ, ḋ_φ.
    pub deck: Vec<f64>,
    /// Support forces at the end of the step: blocks of F_z, F_y, M_x.
    pub supports: Vec<f64>,
}

impl SpaceState {
    /// At rest, with so many degrees of freedom, ports, inner states and supports.
    pub fn rest(track: usize, lines: &[usize], cars: usize, ports: usize, inner: usize, supports: usize) -> Self {
        let zeros = || vec![0.0; ports];
        Self {
            track: Motion::rest(track),
            lines: lines.iter().map(|order| Motion::rest(*order)).collect(),
            cars: Motion::rest(cars),
            ports: [zeros(), zeros(), zeros()],
            inner: vec![[0.0; 2]; inner],
            deck: vec![0.0; 6 * supports],
            supports: vec![0.0; 3 * supports],
        }
    }

    /// All numbers, in a fixed order.
    pub fn numbers(&self) -> impl Iterator<Item = &f64> {
        let lines = self.lines.iter().flat_map(Motion::numbers);
        let rest = self.ports.iter().flatten().chain(self.inner.iter().flatten());
        self.track.numbers().chain(lines).chain(self.cars.numbers()).chain(rest).chain(&self.deck).chain(&self.supports)
    }

    fn numbers_mut(&mut self) -> impl Iterator<Item = &mut f64> {
        let lines = self.lines.iter_mut().flat_map(Motion::numbers_mut);
        let rest = self.ports.iter_mut().flatten().chain(self.inner.iter_mut().flatten());
        let motions = self.track.numbers_mut().chain(lines).chain(self.cars.numbers_mut());
        motions.chain(rest).chain(&mut self.deck).chain(&mut self.supports)
    }

    /// Appends all numbers, little endian.
    pub fn write(&self, bytes: &mut Vec<u8>) {
        numbers::write(self.numbers(), bytes);
    }

    /// Takes over what [`SpaceState::write`] wrote of a state of the same size.
    ///
    /// # Errors
    /// Another number of bytes, or a number that is not finite.
    pub fn read(&mut self, bytes: &[u8]) -> Result<(), String> {
        let count = self.numbers().count();
        numbers::read(bytes, count, self.numbers_mut())
    }
}
