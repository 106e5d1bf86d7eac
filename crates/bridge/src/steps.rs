//! Which steps are factorised: the nominal one and, when a master asks for others, a few more.

use std::sync::Arc;

use ttb_contract::ModelError;
use ttb_dynamics::newmark::Newmark;

use crate::law::Law;
use crate::prepared::Prepared;
use crate::system::Step;

/// Step sizes within this relative distance are the same.
const SAME: f64 = 1e-9;
/// Factorised sizes kept.
const KEPT: usize = 4;

/// The nominal step, how a macro step divides, and the factorised sizes in use, the last used first.
#[derive(Default)]
pub struct Steps {
    /// Nominal step, s.
    nominal: f64,
    gamma: f64,
    beta: f64,
    known: Vec<(f64, Arc<dyn Step>)>,
}

impl Steps {
    /// A nominal step (s) and Newmark parameters; nothing is factorised yet.
    pub fn new(nominal: f64, gamma: f64, beta: f64) -> Self {
        Self { nominal, gamma, beta, known: Vec::with_capacity(KEPT) }
    }

    /// The nominal step, s.
    pub fn nominal(&self) -> f64 {
        self.nominal
    }

    /// Number of sub-steps of a macro step of `h` seconds, none longer than the nominal one, and their size.
    ///
    /// Sizes arrive with rounding, 0.3 − 0.2 for 0.1. So that they need no factor of their own, and so that the result
    /// does not depend on which came first, a size near the nominal one is the nominal one, any other is rounded to ten
    /// decimal digits.
    pub fn divide(&self, h: f64) -> (usize, f64) {
        let count = (h / self.nominal * (1.0 - SAME)).ceil().max(1.0);
        let size = h / count;
        let size = if (size / self.nominal - 1.0).abs() <= SAME { self.nominal } else { round(size) };
        (count as usize, size)
    }

    /// The size of a factorised step in use, s.
    pub fn size(&self, step: &Arc<dyn Step>) -> Option<f64> {
        self.known.iter().find(|(_, known)| Arc::ptr_eq(known, step)).map(|(size, _)| *size)
    }

    /// The factorised step of a size from [`Steps::divide`].
    ///
    /// # Errors
    /// As [`Prepared::step`].
    pub fn get(&mut self, size: f64, prepared: &Prepared, law: &Law) -> Result<Arc<dyn Step>, ModelError> {
        if let Some(position) = self.known.iter().position(|(known, _)| *known == size) {
            self.known[..=position].rotate_right(1);
        } else {
            let step = prepared.step(law, Newmark::new(self.gamma, self.beta, size))?;
            self.known.truncate(KEPT - 1);
            self.known.insert(0, (size, step));
        }
        Ok(Arc::clone(&self.known[0].1))
    }
}

/// To ten decimal digits.
fn round(size: f64) -> f64 {
    let scale = 10_f64.powi(9 - size.log10().floor() as i32);
    if scale.is_finite() && scale > 0.0 { (size * scale).round() / scale } else { size }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_snap_and_divide() {
        let steps = Steps::new(0.1, 0.5, 0.25);
        assert_eq!(steps.divide(0.1 + 0.2 - 0.2), (1, 0.1));
        assert_eq!(steps.divide(0.1 + 0.2), (3, 0.1));
        assert_eq!(steps.divide(0.099_999_999_999_999_85), (1, 0.1));
        assert_eq!(steps.divide(0.2), (2, 0.1));
        assert_eq!(steps.divide(0.05 + 1e-17), (1, 0.05));
        assert_eq!(steps.divide(0.15), (2, 0.075));
        assert_eq!(steps.divide(1e-13), (1, 1e-13));
        assert_eq!(steps.divide(1e-300).0, 1);
    }
}
