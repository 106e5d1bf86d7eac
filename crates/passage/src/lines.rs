//! Functions of the place of a force on the deck, several at once: piecewise cubic, on common pieces.
//!
//! ```text
//! y_l(x) = c₀ + c₁ξ + c₂ξ² + c₃ξ³,   ξ = (x − a)/(b − a) on the piece [a, b]
//! ```
//!
//! Shapes of modes and influence lines of a beam without distributed load are cubic between nodes and loaded places, so
//! that four values a piece give them exactly.

use crate::lanes::QUAD;

/// c of four functions on a piece, by power.
pub type Cubics = [[f64; QUAD]; 4];

/// Several functions on common pieces; zero outside of all.
#[derive(Clone, Debug)]
pub struct Lines {
    count: usize,
    breaks: Vec<f64>,
    /// By piece, then four functions each; those that fill up the last four are zero.
    cubics: Vec<Cubics>,
}

/// Where a piece is sampled, as ξ: inside it, so that a jump at its ends is no matter.
const SAMPLED: [f64; 4] = [0.05, 0.35, 0.65, 0.95];

impl Lines {
    /// Of the coefficients on every piece: `cubic(piece)` gives those of a function by its number.
    fn made<F: Fn(usize) -> [f64; 4]>(breaks: Vec<f64>, count: usize, mut cubic: impl FnMut(usize) -> F) -> Self {
        let mut cubics = Vec::with_capacity(breaks.len() * count.div_ceil(QUAD));
        for piece in 0..breaks.len().saturating_sub(1) {
            let of = cubic(piece);
            for first in (0..count).step_by(QUAD) {
                let four: [[f64; 4]; QUAD] =
                    std::array::from_fn(|i| if first + i < count { of(first + i) } else { [0.0; 4] });
                cubics.push(std::array::from_fn(|power| four.map(|c| c[power])));
            }
        }
        Self { count, breaks, cubics }
    }

    /// Samples `count` functions on the pieces between `breaks` (rising): `values(piece, x)` gives one number a function.
    #[must_use]
    pub fn sampled(breaks: Vec<f64>, count: usize, mut values: impl FnMut(usize, f64) -> Vec<f64>) -> Self {
        let power = newton_to_powers();
        let ends: Vec<[f64; 2]> = breaks.windows(2).map(|ends| [ends[0], ends[1]]).collect();
        Self::made(breaks, count, |piece| {
            let [a, b] = ends[piece];
            let samples = SAMPLED.map(|xi| values(piece, a + xi * (b - a)));
            move |l| power.map(|row| (0..4).map(|i| row[i] * samples[i][l]).sum())
        })
    }

    /// Through values at the breaks (rising), one list a function, with the slopes of the parabola through a break and its
    /// neighbours.
    #[must_use]
    pub fn through(breaks: Vec<f64>, functions: &[Vec<f64>]) -> Self {
        let slopes: Vec<Vec<f64>> = functions.iter().map(|y| slopes(&breaks, y)).collect();
        let lengths: Vec<f64> = breaks.windows(2).map(|ends| ends[1] - ends[0]).collect();
        Self::made(breaks, functions.len(), |piece| {
            let (length, slopes) = (lengths[piece], &slopes);
            move |l| {
                let [y0, y1] = [functions[l][piece], functions[l][piece + 1]];
                let [m0, m1] = [slopes[l][piece] * length, slopes[l][piece + 1] * length];
                [y0, m0, 3.0 * (y1 - y0) - 2.0 * m0 - m1, 2.0 * (y0 - y1) + m0 + m1]
            }
        })
    }

    /// Number of functions.
    #[must_use]
    pub fn count(&self) -> usize {
        self.count
    }

    /// Where the pieces begin and end, m, rising.
    #[must_use]
    pub fn breaks(&self) -> &[f64] {
        &self.breaks
    }

    /// Where the functions begin and end, m.
    #[must_use]
    pub fn extent(&self) -> [f64; 2] {
        [self.breaks[0], self.breaks[self.breaks.len() - 1]]
    }

    /// Coefficients of all functions on a piece, four functions at a time.
    #[inline(always)]
    #[must_use]
    pub fn cubics(&self, piece: usize) -> &[Cubics] {
        let quads = self.count.div_ceil(QUAD);
        &self.cubics[quads * piece..quads * (piece + 1)]
    }

    /// The same functions of the distance from the far end: y(a + b − x).
    #[must_use]
    pub fn mirrored(&self) -> Self {
        let [a, b] = self.extent();
        let breaks = self.breaks.iter().rev().map(|x| a + b - x).collect();
        let pieces = (0..self.breaks.len().saturating_sub(1)).rev();
        let turned = |[c0, c1, c2, c3]: &Cubics| -> Cubics {
            let by_lane = |power: fn([f64; 4]) -> f64| std::array::from_fn(|l| power([c0[l], c1[l], c2[l], c3[l]]));
            [
                by_lane(|[c0, c1, c2, c3]| c0 + c1 + c2 + c3),
                by_lane(|[_, c1, c2, c3]| -(c1 + 2.0 * c2 + 3.0 * c3)),
                by_lane(|[_, _, c2, c3]| c2 + 3.0 * c3),
                by_lane(|[_, _, _, c3]| -c3),
            ]
        };
        let cubics = pieces.flat_map(|piece| self.cubics(piece)).map(turned);
        Self { count: self.count, breaks, cubics: cubics.collect() }
    }

    /// The functions from number `first` on times a factor each.
    #[must_use]
    pub fn scaled(mut self, first: usize, factors: &[f64]) -> Self {
        for four in self.cubics.chunks_exact_mut(self.count.div_ceil(QUAD).max(1)) {
            for (l, factor) in (first..).zip(factors) {
                four[l / QUAD].iter_mut().for_each(|c| c[l % QUAD] *= factor);
            }
        }
        self
    }

    /// All functions at x, on a break as before it; zero outside.
    #[must_use]
    pub fn at(&self, x: f64) -> Vec<f64> {
        let [begin, end] = self.extent();
        if x < begin || x > end {
            return vec![0.0; self.count];
        }
        let piece = self.breaks.partition_point(|b| *b < x).saturating_sub(1).min(self.breaks.len() - 2);
        let [a, b] = [self.breaks[piece], self.breaks[piece + 1]];
        let xi = (x - a) / (b - a);
        let mut y: Vec<f64> = self.cubics(piece).iter().flat_map(|four| value(four, xi)).collect();
        y.truncate(self.count);
        y
    }
}

/// c₀ + c₁ξ + c₂ξ² + c₃ξ³ of neighbouring functions.
#[inline(always)]
pub fn value<const N: usize>([c0, c1, c2, c3]: &[[f64; N]; 4], xi: f64) -> [f64; N] {
    std::array::from_fn(|l| c0[l] + xi * (c1[l] + xi * (c2[l] + xi * c3[l])))
}

/// Rows that give the four coefficients from the values at [`SAMPLED`].
fn newton_to_powers() -> [[f64; 4]; 4] {
    let mut rows = [[0.0; 4]; 4];
    for (i, own) in SAMPLED.iter().enumerate() {
        // Lagrange's polynomial of sample i, as coefficients.
        let mut p = [1.0, 0.0, 0.0, 0.0];
        for (_, other) in SAMPLED.iter().enumerate().filter(|(k, _)| *k != i) {
            let scale = 1.0 / (own - other);
            p = [
                -scale * other * p[0],
                scale * (p[0] - other * p[1]),
                scale * (p[1] - other * p[2]),
                scale * (p[2] - other * p[3]),
            ];
        }
        p.iter().zip(&mut rows).for_each(|(value, row)| row[i] = *value);
    }
    rows
}

/// Slopes at the breaks.
fn slopes(x: &[f64], y: &[f64]) -> Vec<f64> {
    let n = x.len();
    let secant = |i: usize| (y[i + 1] - y[i]) / (x[i + 1] - x[i]);
    match n {
        0 | 1 => vec![0.0; n],
        2 => vec![secant(0); 2],
        _ => {
            // Slope at break i of the parabola through breaks j, j + 1, j + 2.
            let slope = |i: usize| {
                let j = i.saturating_sub(1).min(n - 3);
                let [before, behind] = [secant(j), secant(j + 1)];
                let bend = (behind - before) / (x[j + 2] - x[j]);
                before + bend * (2.0 * x[i] - x[j] - x[j + 1])
            };
            (0..n).map(slope).collect()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cubics_are_met_exactly_also_from_the_far_end() {
        let f = |x: f64| vec![1.0 + x - 2.0 * x.powi(2) + 0.3 * x.powi(3), 5.0 - x];
        let lines = Lines::sampled(vec![0.0, 1.0, 4.0, 5.0], 2, |_, x| f(x));
        for x in [0.0, 0.3, 1.0, 2.2, 4.999, 5.0] {
            for (y, expected) in lines.at(x).iter().zip(f(x)) {
                assert!((y - expected).abs() < 1e-12 * expected.abs().max(10.0), "{x}: {y}");
            }
            for (y, expected) in lines.mirrored().at(5.0 - x).iter().zip(f(x)) {
                assert!((y - expected).abs() < 1e-12 * expected.abs().max(10.0), "{x}: {y}");
            }
        }
        assert_eq!(lines.at(5.1), [0.0, 0.0]);
    }

    #[test]
    fn a_line_through_values_of_a_parabola_is_the_parabola() {
        let f = |x: f64| 2.0 - x + 0.5 * x * x;
        let breaks = vec![0.0, 0.5, 1.7, 2.0, 3.0];
        let lines = Lines::through(breaks.clone(), &[breaks.iter().map(|x| f(*x)).collect()]);
        assert!([0.2, 1.0, 1.9, 2.7].iter().all(|x| (lines.at(*x)[0] - f(*x)).abs() < 1e-13));
    }
}
