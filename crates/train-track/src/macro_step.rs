//! What macro steps of plane and of spatial trains share: how a step divides, which sizes are factorised, what inputs mean.
//!
//! ```text
//! with rates     d(t + τ) = d + τ ḋ for positions and velocities alike
//! meaning 0      values at the end of the step                                        d
//! meaning 1      positions run with their velocities, which are held                  d + τ v
//! meaning 2      means over the step                                                  2 d − d_n
//! ```

use ttb_dynamics::newmark::Newmark;
use ttb_scenario::limits::MOST_SUBSTEPS;

/// Steps within this of a factorised one are that one.
const SAME_STEP: f64 = 1e-9;
/// Step sizes kept factorised.
const STEP_SIZES: usize = 4;

/// Matrices of the sizes that sub-steps have: the nominal one first, then others as they come.
pub struct Sizes<M> {
    nominal: Newmark,
    /// Size of a sub-step, s, and its matrices.
    known: Vec<(f64, M)>,
}

impl<M> Sizes<M> {
    /// Of the nominal step.
    pub fn new(nominal: Newmark, matrices: M) -> Self {
        Self { nominal, known: vec![(nominal.h, matrices)] }
    }

    /// Newmark's constants of the nominal step.
    pub fn newmark(&self) -> Newmark {
        self.nominal
    }

    /// Matrices of the nominal step.
    pub fn nominal(&self) -> &M {
        &self.known[0].1
    }

    /// Into how many equal sub-steps, none longer than the nominal step, a macro step of `h` seconds divides.
    ///
    /// # Errors
    /// Far too many.
    pub fn parts(&self, h: f64) -> Result<f64, String> {
        let nominal = self.nominal.h;
        let parts = (h / nominal * (1.0 - SAME_STEP)).ceil().max(1.0);
        if parts > MOST_SUBSTEPS as f64 {
            return Err(format!("a step of {h} s has more than {MOST_SUBSTEPS} parts of step_size = {nominal} s"));
        }
        Ok(parts)
    }

    /// Matrices for sub-steps of `h` seconds; factorises when the size is new.
    ///
    /// # Errors
    /// They cannot be made.
    pub fn of(&mut self, h: f64, make: impl FnOnce(Newmark) -> Result<M, String>) -> Result<&M, String> {
        let known = self.known.iter().position(|(size, _)| (size - h).abs() <= SAME_STEP * h);
        let at = match known {
            Some(at) => at,
            None => {
                let matrices = make(Newmark::new(self.nominal.gamma, self.nominal.beta, h))?;
                if self.known.len() == STEP_SIZES {
                    self.known.remove(1);
                }
                self.known.push((h, matrices));
                self.known.len() - 1
            }
        };
        Ok(&self.known[at].1)
    }
}

/// Deck motion over a macro step: blocks of as many numbers as there are supports, positions and velocities in turn.
#[derive(Clone, Copy)]
pub struct Inputs<'a> {
    /// At the step's begin, or what `meaning` says.
    pub values: &'a [f64],
    /// Their rates, if they were set.
    pub rates: Option<&'a [f64]>,
    /// Parameter `input_meaning`, of inputs without rates.
    pub meaning: f64,
    /// Supports on the bridge.
    pub supports: usize,
}

impl Inputs<'_> {
    /// The motion `tau` seconds into the step; `last` is that at the end of the step before.
    pub fn at(&self, tau: f64, last: &[f64], deck: &mut [f64]) {
        let Self { values, rates, meaning, supports } = *self;
        for (block, deck) in deck.chunks_mut(supports.max(1)).enumerate() {
            let positions = block.is_multiple_of(2);
            for (i, deck) in (block * supports..).zip(deck) {
                *deck = match rates {
                    Some(rates) => values[i] + rates[i] * tau,
                    None if meaning == 2.0 => 2.0 * values[i] - last[i],
                    None if meaning == 1.0 && positions => values[i] + tau * values[i + supports],
                    None => values[i],
                };
            }
        }
    }
}
