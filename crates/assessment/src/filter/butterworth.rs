//! Butterworth low-pass of order n, by the bilinear transform with prewarping:
//!
//! ```text
//! c = tan(π f_c/f_s),  |H| = 1/√(1 + (tan(πf/f_s)/c)^{2n})
//! pairs of poles, q_k = 2 sin(π(2k − 1)/2n), k = 1 … ⌊n/2⌋, D = 1 + q c + c²:
//!     b = (1, 2, 1) c²/D,   a₁ = 2(c² − 1)/D,   a₂ = (1 − q c + c²)/D
//! for odd n one real pole:  b = (1, 1) c/(1 + c),   a₁ = (c − 1)/(c + 1)
//! ```
//!
//! Phase zero is scipy's `sosfiltfilt`: the record is extended at both ends by 3(n + 1) values, point-symmetric about its
//! end value (odd), then filtered forwards and backwards, each from the steady state of its first value. Compensated: the same
//! with f_c/(√2 − 1)^{1/2n}.

use std::f64::consts::{PI, SQRT_2};

use super::{Cascade, Phase, Section};
use crate::error::{SignalError, finite};

/// Records that are filtered side by side.
const ABREAST: usize = 4;

/// A low-pass for records of a given rate.
#[derive(Clone, Debug, PartialEq)]
pub struct Butterworth {
    order: usize,
    phase: Phase,
    rate: f64,
    cascade: Cascade,
}

impl Butterworth {
    /// Of this order (1 to 20), cut-off in Hz, number of values in a second, direction.
    ///
    /// # Errors
    /// The order is outside its range, the cut-off not positive, or half the rate not above it.
    pub fn new(order: usize, cut_off: f64, rate: f64, phase: Phase) -> Result<Self, SignalError> {
        if !(1..=20).contains(&order) {
            let (what, rule) = ("the order of a Butterworth filter", "from 1 to 20");
            return Err(SignalError::OutOfRange { what, rule, value: order as f64 });
        }
        if !(cut_off > 0.0 && cut_off.is_finite()) {
            let (what, rule) = ("the cut-off frequency of a Butterworth filter", "positive and finite");
            return Err(SignalError::OutOfRange { what, rule, value: cut_off });
        }
        let cut_off = if phase == Phase::Compensated { Self::compensated_cut_off(order, cut_off) } else { cut_off };
        if rate.is_nan() || rate <= 2.0 * cut_off {
            let (what, needed) = ("a Butterworth filter", 2.0 * cut_off);
            return Err(SignalError::TooCoarse { what, frequency: cut_off, needed, found: rate });
        }
        let c = libm::tan(PI * cut_off / rate);
        let mut sections = Vec::with_capacity(order.div_ceil(2));
        if order % 2 == 1 {
            let b = c / (1.0 + c);
            sections.push(Section { b: [b, b, 0.0], a: [(c - 1.0) / (c + 1.0), 0.0] });
        }
        // The least resonant first, so that values inside the row stay small.
        for k in (1..=order / 2).rev() {
            let q = 2.0 * libm::sin(PI * (2 * k - 1) as f64 / (2 * order) as f64);
            let d = 1.0 + q * c + c * c;
            let b = c * c / d;
            sections.push(Section { b: [b, 2.0 * b, b], a: [2.0 * (c * c - 1.0) / d, (1.0 - q * c + c * c) / d] });
        }
        Ok(Self { order, phase, rate, cascade: Cascade::new(sections) })
    }

    /// The cut-off, Hz, of one pass that gives −3 dB at `cut_off` in two.
    pub fn compensated_cut_off(order: usize, cut_off: f64) -> f64 {
        cut_off / libm::pow(SQRT_2 - 1.0, 1.0 / (2 * order) as f64)
    }

    /// |H| at `frequency`, Hz, of what [`apply`](Self::apply) does: squared for two passes.
    pub fn gain(&self, frequency: f64) -> f64 {
        let once = self.cascade.gain(frequency, self.rate);
        if self.phase == Phase::Causal { once } else { once * once }
    }

    /// The sections of one pass.
    pub fn cascade(&self) -> &Cascade {
        &self.cascade
    }

    /// The least number of values for two passes.
    pub fn least_length(&self) -> usize {
        if self.phase == Phase::Causal { 1 } else { self.padding() + 1 }
    }

    fn padding(&self) -> usize {
        3 * (self.order + 1)
    }

    /// Over the record, in place.
    ///
    /// # Errors
    /// A value is not finite, or the record is shorter than [`least_length`](Self::least_length).
    pub fn apply(&self, signal: &mut [f64]) -> Result<(), SignalError> {
        finite(signal)?;
        self.run(signal.as_chunks_mut::<1>().0)
    }

    /// Over records, each as by [`apply`](Self::apply) to the last bit. Those of one length go side by side, which takes a
    /// fraction of the time.
    ///
    /// # Errors
    /// As [`apply`](Self::apply).
    pub fn apply_each(&self, records: &mut [Vec<f64>]) -> Result<(), SignalError> {
        for alike in records.chunk_by_mut(|a, b| a.len() == b.len()) {
            for some in alike.chunks_mut(ABREAST) {
                some.iter().try_for_each(|record| finite(record))?;
                let row = |i: usize| std::array::from_fn(|k| some.get(k).map_or(0.0, |record| record[i]));
                let mut rows: Vec<[f64; ABREAST]> = (0..some[0].len()).map(row).collect();
                self.run(&mut rows)?;
                for (k, record) in some.iter_mut().enumerate() {
                    record.iter_mut().zip(&rows).for_each(|(value, row)| *value = row[k]);
                }
            }
        }
        Ok(())
    }

    /// Over records side by side.
    fn run<const N: usize>(&self, signal: &mut [[f64; N]]) -> Result<(), SignalError> {
        if self.phase == Phase::Causal {
            self.cascade.from_rest(signal);
            return Ok(());
        }
        let (n, edge) = (signal.len(), self.padding());
        if n < self.least_length() {
            let (what, needed, found) = ("a Butterworth filter of two passes", self.least_length() as f64, n as f64);
            return Err(SignalError::TooShort { what, needed, found, unit: "values" });
        }
        let mirrored = |end: usize, i: usize| std::array::from_fn(|k| 2.0 * signal[end][k] - signal[i][k]);
        let mut extended = Vec::with_capacity(n + 2 * edge);
        extended.extend((1..=edge).rev().map(|i| mirrored(0, i)));
        extended.extend_from_slice(signal);
        extended.extend((1..=edge).map(|i| mirrored(n - 1, n - 1 - i)));
        self.cascade.run_from_steady(extended.iter_mut());
        self.cascade.run_from_steady(extended.iter_mut().rev());
        signal.copy_from_slice(&extended[edge..edge + n]);
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn records_side_by_side_are_filtered_as_each_alone() {
        let record = |k: usize| (0..200).map(|i| (0.07 * (k + 1) as f64 * i as f64).sin() + k as f64).collect();
        for phase in [Phase::Causal, Phase::Zero] {
            let filter = Butterworth::new(4, 30.0, 1000.0, phase).expect("a filter");
            for count in [1, 4, 6] {
                let mut alone: Vec<Vec<f64>> = (0..count).map(record).collect();
                let mut abreast = alone.clone();
                alone.iter_mut().for_each(|record| filter.apply(record).expect("long enough"));
                filter.apply_each(&mut abreast).expect("long enough");
                assert_eq!(alone, abreast, "{phase:?}");
            }
        }
        let filter = Butterworth::new(4, 30.0, 1000.0, Phase::Zero).expect("a filter");
        assert!(filter.apply_each(&mut [vec![1.0; 200], vec![f64::NAN; 200]]).is_err());
        assert!(filter.apply_each(&mut [vec![1.0; 200], vec![1.0; 3]]).is_err());
        assert!(filter.apply_each(&mut [vec![], vec![1.0; 200]]).is_err());
    }
}
