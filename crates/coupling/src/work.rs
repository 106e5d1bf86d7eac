//! The work that passes the interface, as either side counts it: what appears or vanishes there is an error of the
//! coupling.
//!
//! Over a step in which the deck goes by Δd, with the forces that the bridge got (λ) and those that train and track
//! answered (G):
//!
//! ```text
//! f̄_B = λ,  f̄_T = G                               means over the step, where train and track take sub-steps
//! f̄_B = (λ_n + λ)/2,  f̄_T = (G_n + G)/2           end values
//! W_B = f̄_B · Δd                                  what the bridge receives
//! W_T                                             what train and track give, as they say; else f̄_T · Δd
//! ```
//!
//! W_T − W_B has two parts: (f̄_T − f̄_B) · Δd, which the iteration leaves and the tolerance bounds, and W_T − f̄_T · Δd,
//! which is how the exchange itself fails to conserve work.

use std::ops::AddAssign;

use crate::algebra::sum;

/// Work over a step or a run, J.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Work {
    /// W_B.
    pub received: f64,
    /// (f̄_T − f̄_B) · Δd.
    pub residual: f64,
    /// W_T − f̄_T · Δd.
    pub exchange: f64,
    /// Σ |f̄_T Δd| over the supports: what the others are compared with.
    pub turnover: f64,
}

impl Work {
    /// (W_T − W_B) relative to the turnover; 0 if nothing moved.
    pub fn imbalance(&self) -> f64 {
        self.relative(self.residual + self.exchange)
    }
    /// The part of it that the exchange makes, whatever the tolerance.
    pub fn exchange_imbalance(&self) -> f64 {
        self.relative(self.exchange)
    }
    fn relative(&self, work: f64) -> f64 {
        if self.turnover > 0.0 { work.abs() / self.turnover } else { 0.0 }
    }
}

impl AddAssign for Work {
    fn add_assign(&mut self, other: Self) {
        self.received += other.received;
        self.residual += other.residual;
        self.exchange += other.exchange;
        self.turnover += other.turnover;
    }
}

/// What a step's work is counted from, one number a support each.
pub(crate) struct Step<'a> {
    /// λ_n, λ; λ twice if it is a mean.
    pub sent: [&'a [f64]; 2],
    /// G_n, G; G twice if it is a mean.
    pub answered: [&'a [f64]; 2],
    /// Δd.
    pub moved: &'a [f64],
    /// W_T, if train and track say.
    pub given: Option<f64>,
}

impl Step<'_> {
    pub fn work(&self) -> Work {
        let ([sent_before, sent], [answered_before, answered]) = (self.sent, self.answered);
        let work = |[before, after, moved]: [f64; 3]| 0.5 * (before + after) * moved;
        let received = sum([sent_before, sent, self.moved], work);
        let answers = [answered_before, answered, self.moved];
        let (answered, turnover) = (sum(answers, work), sum(answers, |at| work(at).abs()));
        Work { received, residual: answered - received, exchange: self.given.map_or(0.0, |w| w - answered), turnover }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_parts_of_an_imbalance_are_told_apart() {
        let step = Step {
            sent: [&[0.0, 4.0], &[2.0, 2.0]],
            answered: [&[0.0, 4.0], &[2.5, 2.0]],
            moved: &[2.0, -1.0],
            given: Some(0.0),
        };
        // f̄_B = (1, 3), f̄_T = (1.25, 3)
        let work = step.work();
        assert_eq!(work, Work { received: -1.0, residual: 0.5, exchange: 0.5, turnover: 5.5 });
        assert_eq!((work.imbalance(), work.exchange_imbalance()), (1.0 / 5.5, 0.5 / 5.5));
        // As means: f̄_B = (2, 2), f̄_T = (2.5, 2).
        let (sent, answered) = ([step.sent[1]; 2], [step.answered[1]; 2]);
        let mut twice = Step { sent, answered, given: None, ..step }.work();
        assert_eq!(twice, Work { received: 2.0, residual: 1.0, exchange: 0.0, turnover: 7.0 });
        twice += work;
        assert_eq!((twice.received, twice.turnover), (1.0, 12.5));
        assert_eq!(Work::default().imbalance(), 0.0);
    }

    #[test]
    fn every_support_counts_however_many_there_are() {
        for n in 0..11 {
            let (ones, twos) = (vec![1.0; n], vec![2.0; n]);
            let step = Step { sent: [&ones, &ones], answered: [&twos, &twos], moved: &twos, given: None };
            let n = n as f64;
            assert_eq!(step.work(), Work { received: 2.0 * n, residual: 2.0 * n, exchange: 0.0, turnover: 4.0 * n });
        }
    }
}
