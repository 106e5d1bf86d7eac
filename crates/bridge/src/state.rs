//! The dynamic state: motion and end forces, shared between the running bridge and its saved states.

use std::sync::Arc;

use ttb_coupling::ModelError;
use ttb_dynamics::newmark::Motion;

/// What a step starts from.
#[derive(Clone, Debug, PartialEq)]
pub struct Data {
    /// Motion of all unknowns.
    pub motion: Motion,
    /// f_n: support forces at the end of the last step, N.
    pub force: Vec<f64>,
}

/// A shared state: saving is a pointer.
pub type State = Arc<Data>;

impl Data {
    /// At rest.
    pub fn rest(unknowns: usize, supports: usize) -> Self {
        Self { motion: Motion::rest(unknowns), force: vec![0.0; supports] }
    }

    /// Appends all numbers, little endian: u, u̇, ü, f_n.
    pub fn write(&self, bytes: &mut Vec<u8>) {
        bytes.extend(self.motion.numbers().chain(&self.force).flat_map(|x| x.to_le_bytes()));
    }

    /// Reads what [`Data::write`] wrote.
    ///
    /// # Errors
    /// The length does not fit.
    pub fn read(unknowns: usize, supports: usize, bytes: &[u8]) -> Result<Self, ModelError> {
        let mut data = Self::rest(unknowns, supports);
        let expected = 8 * (3 * unknowns + supports);
        if bytes.len() != expected {
            let found = bytes.len();
            return Err(ModelError(format!(
                "the bridge's state has {expected} bytes, {found} were given: it belongs to another bridge"
            )));
        }
        let numbers =
            bytes.chunks_exact(8).map(|b| f64::from_le_bytes([b[0], b[1], b[2], b[3], b[4], b[5], b[6], b[7]]));
        data.motion.numbers_mut().chain(&mut data.force).zip(numbers).for_each(|(x, number)| *x = number);
        Ok(data)
    }
}
