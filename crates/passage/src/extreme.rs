//! Largest and smallest values, reduced step by step.
//!
//! ```text
//! b − (c − a)²/(8 (a − 2b + c))       top of the parabola through three samples a, b, c, b the greatest
//! |top − b| ≤ |a − 2b + c|/8          so most samples are passed over without a division
//! ```

use pulp::Simd;

/// The largest and the smallest value of a history, and when. A history begins at rest: 0 at time 0.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Extreme {
    /// Largest value.
    pub max: f64,
    /// When, s.
    pub max_time: f64,
    /// Smallest value.
    pub min: f64,
    /// When, s.
    pub min_time: f64,
}

impl Extreme {
    /// The larger magnitude, with its sign, and when.
    #[must_use]
    pub fn largest(&self) -> (f64, f64) {
        if self.max >= -self.min { (self.max, self.max_time) } else { (self.min, self.min_time) }
    }

    /// Of a history from rest in steps of `h` s.
    #[must_use]
    pub fn of(history: &[f64], h: f64) -> Self {
        let mut watch = Watch::default();
        for (n, value) in history.iter().enumerate() {
            let mut sample = [0.0; WIDE];
            sample[0] = *value;
            watch.look(&sample, n, h);
        }
        watch.finish(history.len(), h)[0]
    }
}

/// Histories that are watched together.
pub const WIDE: usize = 8;

/// Several histories while they are reduced.
#[derive(Clone, Debug, Default)]
pub struct Watch {
    before: [f64; WIDE],
    last: [f64; WIDE],
    max: [f64; WIDE],
    min: [f64; WIDE],
    times: [[f64; 2]; WIDE],
}

impl Watch {
    /// Whether values between these bounds are no new extremes.
    #[inline(always)]
    pub fn holds(&self, [low, high]: &[[f64; WIDE]; 2]) -> bool {
        let mut holds = true;
        for k in 0..WIDE {
            // Without a branch a lane, so that it is done in vectors.
            holds = holds & (low[k] >= self.min[k]) & (high[k] <= self.max[k]);
        }
        holds
    }

    /// Goes on behind steps that were passed over, from the last two samples.
    #[inline(always)]
    pub fn resume(&mut self, before: [f64; WIDE], last: [f64; WIDE]) {
        (self.before, self.last) = (before, last);
    }

    /// Takes the samples of step `n`, at time n h.
    pub fn look(&mut self, sample: &[f64; WIDE], n: usize, h: f64) {
        self.look_with(pulp::Scalar::new(), sample, n, h);
    }

    /// The same in a vector's lanes; any instruction set gives the same bits.
    #[inline(always)]
    pub fn look_with<S: Simd>(&mut self, simd: S, sample: &[f64; WIDE], n: usize, h: f64) {
        let [zero, two, eighth] = [0.0, 2.0, 0.125].map(|x| simd.splat_f64s(x));
        let (before, last) = (S::as_simd_f64s(&self.before).0, S::as_simd_f64s(&self.last).0);
        let (max, min) = (S::as_simd_f64s(&self.max).0, S::as_simd_f64s(&self.min).0);
        // Positive where a sample may be a new extreme.
        let mut excess = zero;
        for (i, c) in S::as_simd_f64s(sample).0.iter().enumerate() {
            let (a, b, c) = (before[i], last[i], *c);
            let bend = simd.add_f64s(simd.sub_f64s(a, simd.mul_f64s(two, b)), c);
            let most = simd.mul_f64s(eighth, simd.abs_f64s(bend));
            let up = simd.sub_f64s(simd.add_f64s(b, most), max[i]);
            let down = simd.add_f64s(simd.sub_f64s(min[i], b), most);
            let turns = simd.mul_f64s(simd.sub_f64s(b, a), simd.sub_f64s(c, b));
            let turned = simd.less_than_or_equal_f64s(turns, zero);
            excess = simd.max_f64s(excess, simd.select_f64s(turned, simd.max_f64s(up, down), zero));
        }
        if simd.reduce_max_f64s(excess) > 0.0 {
            self.improve(sample, n, h);
        }
        self.before = self.last;
        self.last = *sample;
    }

    #[cold]
    #[inline(never)]
    fn improve(&mut self, sample: &[f64; WIDE], n: usize, h: f64) {
        for (i, c) in sample.iter().enumerate() {
            let [a, b] = [self.before[i], self.last[i]];
            let bend = a - 2.0 * b + c;
            let (top, place) =
                if bend == 0.0 { (b, 0.0) } else { (b - (c - a).powi(2) / (8.0 * bend), 0.5 * (a - c) / bend) };
            let time = (n as f64 - 1.0 + place) * h;
            if b >= a && b >= *c && top > self.max[i] {
                (self.max[i], self.times[i][0]) = (top, time);
            }
            if b <= a && b <= *c && top < self.min[i] {
                (self.min[i], self.times[i][1]) = (top, time);
            }
        }
    }

    /// The extremes after `steps` samples; the last sample counts, too.
    #[must_use]
    pub fn finish(&self, samples: usize, h: f64) -> [Extreme; WIDE] {
        let time = samples.saturating_sub(1) as f64 * h;
        std::array::from_fn(|i| {
            let mut found =
                Extreme { max: self.max[i], max_time: self.times[i][0], min: self.min[i], min_time: self.times[i][1] };
            let last = self.last[i];
            if last > found.max {
                (found.max, found.max_time) = (last, time);
            }
            if last < found.min {
                (found.min, found.min_time) = (last, time);
            }
            found
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sine_of_twenty_samples_a_period_has_its_amplitude_within_two_in_ten_thousand() {
        for phase in [0.0, 0.1, 0.2, 0.3] {
            let angle = |n: usize| std::f64::consts::TAU * n as f64 / 20.0 + phase;
            let history: Vec<f64> = (0..200).map(|n| 3.0 * angle(n).sin() + 1.0).collect();
            let found = Extreme::of(&history, 0.01);
            assert!((found.max - 4.0).abs() < 2e-4 * 4.0, "{found:?}");
            assert!((found.min + 2.0).abs() < 4e-4 * 2.0, "{found:?}");
        }
    }
}
