//! Functions of the place of a force on the deck, several at once: piecewise cubic, on common pieces.
//!
//! ```text
//! y_l(x) = c₀ + c₁ξ + c₂ξ² + c₃ξ³,   ξ = (x − a)/(b − a) on the piece [a, b]
//! ```
//!
//! Shapes of modes and influence lines of a beam without distributed load are cubic between nodes and loaded places, so
//! that four values a piece give them exactly.

/// Several functions on common pieces; zero outside of all.
#[derive(Clone, Debug)]
pub struct Lines {
    count: usize,
    breaks: Vec<f64>,
    /// By piece, power, line.
    coefficients: Vec<f64>,
}

/// Where a piece is sampled, as ξ: inside it, so that a jump at its ends is no matter.
const SAMPLED: [f64; 4] = [0.05, 0.35, 0.65, 0.95];

impl Lines {
    /// Samples `count` functions on the pieces between `breaks` (rising): `values(piece, x)` gives one number a function.
    #[must_use]
    pub fn sampled(breaks: Vec<f64>, count: usize, mut values: impl FnMut(usize, f64) -> Vec<f64>) -> Self {
        let power = newton_to_powers();
        let mut coefficients = Vec::with_capacity(breaks.len() * 4 * count);
        for (piece, ends) in breaks.windows(2).enumerate() {
            let samples = SAMPLED.map(|xi| values(piece, ends[0] + xi * (ends[1] - ends[0])));
            for row in &power {
                coefficients.extend((0..count).map(|l| (0..4).map(|i| row[i] * samples[i][l]).sum::<f64>()));
            }
        }
        Self { count, breaks, coefficients }
    }

    /// Through values at the breaks (rising), one list a function, with the slopes of the parabola through a break and its
    /// neighbours.
    #[must_use]
    pub fn through(breaks: Vec<f64>, functions: &[Vec<f64>]) -> Self {
        let slopes: Vec<Vec<f64>> = functions.iter().map(|y| slopes(&breaks, y)).collect();
        let count = functions.len();
        let mut coefficients = Vec::with_capacity(breaks.len() * 4 * count);
        for (piece, ends) in breaks.windows(2).enumerate() {
            let length = ends[1] - ends[0];
            let cubic = functions.iter().zip(&slopes).map(|(y, m)| {
                let [y0, y1] = [y[piece], y[piece + 1]];
                let [m0, m1] = [m[piece] * length, m[piece + 1] * length];
                [y0, m0, 3.0 * (y1 - y0) - 2.0 * m0 - m1, 2.0 * (y0 - y1) + m0 + m1]
            });
            let cubic: Vec<[f64; 4]> = cubic.collect();
            for power in 0..4 {
                coefficients.extend(cubic.iter().map(|c| c[power]));
            }
        }
        Self { count, breaks, coefficients }
    }

    /// Number of functions.
    #[must_use]
    pub fn count(&self) -> usize {
        self.count
    }

    /// Where they begin and end, m.
    #[must_use]
    pub fn extent(&self) -> [f64; 2] {
        [self.breaks[0], self.breaks[self.breaks.len() - 1]]
    }

    /// The same functions of the distance from the far end: y(a + b − x).
    #[must_use]
    pub fn mirrored(&self) -> Self {
        let [a, b] = self.extent();
        let breaks = self.breaks.iter().rev().map(|x| a + b - x).collect();
        let n = self.count;
        let mut coefficients = Vec::with_capacity(self.coefficients.len());
        for piece in self.coefficients.chunks_exact(4 * n.max(1)).rev() {
            let c = |power: usize, l: usize| piece[power * n + l];
            coefficients.extend((0..n).map(|l| c(0, l) + c(1, l) + c(2, l) + c(3, l)));
            coefficients.extend((0..n).map(|l| -(c(1, l) + 2.0 * c(2, l) + 3.0 * c(3, l))));
            coefficients.extend((0..n).map(|l| c(2, l) + 3.0 * c(3, l)));
            coefficients.extend((0..n).map(|l| -c(3, l)));
        }
        Self { count: n, breaks, coefficients }
    }

    /// The functions from number `first` on times a factor each.
    #[must_use]
    pub fn scaled(mut self, first: usize, factors: &[f64]) -> Self {
        let rows = self.coefficients.chunks_exact_mut(self.count.max(1));
        rows.for_each(|row| row[first..].iter_mut().zip(factors).for_each(|(c, factor)| *c *= factor));
        self
    }

    /// The piece at x, the one before it at a break.
    fn piece(&self, x: f64) -> usize {
        self.breaks.partition_point(|b| *b < x).saturating_sub(1).min(self.breaks.len().saturating_sub(2))
    }

    /// All functions at x; zero outside.
    #[must_use]
    pub fn at(&self, x: f64) -> Vec<f64> {
        let mut y = vec![0.0; self.count];
        self.add(&[x], 1.0, &mut y);
        y
    }

    /// Rows of `out` ← rows + factor · y(x), one row of all functions for each of the rising `places` on the deck.
    pub fn add(&self, places: &[f64], factor: f64, out: &mut [f64]) {
        pulp::Arch::new().dispatch(Add { lines: self, places, factor, out });
    }

    #[inline(always)]
    fn add_each(&self, places: &[f64], factor: f64, out: &mut [f64]) {
        let n = self.count;
        let [begin, end] = self.extent();
        let mut piece = places.first().map_or(0, |x| self.piece(*x));
        for (x, row) in places.iter().zip(out.chunks_exact_mut(n.max(1))) {
            if *x < begin || *x > end {
                continue;
            }
            while piece + 2 < self.breaks.len() && *x > self.breaks[piece + 1] {
                piece += 1;
            }
            let [a, b] = [self.breaks[piece], self.breaks[piece + 1]];
            let xi = (x - a) / (b - a);
            let [w1, w2, w3] = [factor * xi, factor * xi * xi, factor * xi * xi * xi];
            let c = &self.coefficients[4 * n * piece..4 * n * (piece + 1)];
            let (c0, c) = c.split_at(n);
            let (c1, c) = c.split_at(n);
            let (c2, c3) = c.split_at(n);
            for ((((y, c0), c1), c2), c3) in row.iter_mut().zip(c0).zip(c1).zip(c2).zip(c3) {
                *y += (factor * c0 + w1 * c1) + (w2 * c2 + w3 * c3);
            }
        }
    }
}

/// [`Lines::add`] under an instruction set.
struct Add<'a> {
    lines: &'a Lines,
    places: &'a [f64],
    factor: f64,
    out: &'a mut [f64],
}

impl pulp::NullaryFnOnce for Add<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        self.lines.add_each(self.places, self.factor, self.out);
    }
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
