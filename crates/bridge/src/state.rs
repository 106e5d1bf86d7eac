//! The dynamic state: motion and end forces, shared between the running bridge and its saved states.

use std::sync::Arc;

use ttb_contract::ModelError;
use ttb_dynamics::newmark::Motion;

use crate::system::{Base, Step, Work};

/// What a step starts from. After a step of a large system the motion is not there yet: the step that led here and the
/// forces at its end say what it is.
#[derive(Clone, Default)]
pub struct Data {
    /// Motion of all unknowns, unless it is pending.
    pub motion: Motion,
    /// The step that led here, while the motion is pending.
    pub pending: Option<Pending>,
    /// f_n: support forces at the end of the last step, N.
    pub force: Vec<f64>,
}

/// A step whose end is known to the outside but not to all unknowns.
#[derive(Clone)]
pub struct Pending {
    /// Where it began.
    pub base: Arc<Base>,
    /// Its factor.
    pub step: Arc<dyn Step>,
}

/// A shared state: saving is a pointer.
pub type State = Arc<Data>;

impl Data {
    /// At rest.
    pub fn rest(unknowns: usize, supports: usize) -> Self {
        Self { motion: Motion::rest(unknowns), pending: None, force: vec![0.0; supports] }
    }

    /// Motion of all unknowns into `motion`.
    pub fn complete(&self, motion: &mut Motion, work: &mut Work) {
        match &self.pending {
            None => motion.clone_from(&self.motion),
            Some(Pending { base, step }) => step.finish(base, &self.force, motion, work),
        }
    }

    /// Appends all numbers, little endian: u, u̇, ü, f_n.
    pub fn write(&self, bytes: &mut Vec<u8>) {
        let mut motion = Motion::default();
        self.complete(&mut motion, &mut Work::default());
        bytes.extend(motion.numbers().chain(&self.force).flat_map(|x| x.to_le_bytes()));
    }

    /// Reads what [`Data::write`] wrote.
    ///
    /// # Errors
    /// The length does not fit; a number is not finite.
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
        if !data.motion.numbers().chain(&data.force).all(|x| x.is_finite()) {
            return Err(ModelError("the bridge's state holds a number that is none".into()));
        }
        Ok(data)
    }
}
