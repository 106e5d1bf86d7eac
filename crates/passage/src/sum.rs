//! All axles of a train together. Between two rows at which an axle comes, goes or reaches the next piece of the lines, their
//! sum is one cubic in the number of rows, so that a row costs as much as one axle, however many are on the deck.
//!
//! ```text
//! Σ_i P_i y(s − x_i) = C₀ + C₁u + C₂u² + C₃u³              s = (first + u) Δs,   u = 0, 1, …, count − 1
//! y(ξ₀ + δu) = (c₀ + c₁ξ₀ + c₂ξ₀² + c₃ξ₀³) + (c₁ + 2c₂ξ₀ + 3c₃ξ₀²) δu + (c₂ + 3c₃ξ₀) δ²u² + c₃δ³u³
//! ```
//!
//! ξ₀ is the axle's place on its piece [a, b] at the first of these rows, and δ = Δs/(b − a). From one stretch to the next the
//! sum moves on, C₀ + C₁n + C₂n² + C₃n³ and so on, and axles that changed their piece are exchanged. Every [`RENEWED`]
//! stretches it is made anew, so that rounding does not grow.

use ttb_trains::Axle;

use crate::lanes::QUAD;
use crate::lines::{Cubics, Lines};

/// After so many stretches the sum is made anew.
const RENEWED: usize = 32;

/// Rows over which the sum of all axles is one cubic.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Stretch {
    /// Number of its first row.
    pub first: usize,
    /// Number of rows.
    pub count: usize,
    /// Whether any axle is on the deck.
    pub loaded: bool,
}

/// An axle on a piece of the lines.
#[derive(Clone, Copy)]
struct On {
    axle: Axle,
    piece: usize,
    /// The last row at which it is there.
    until: usize,
}

/// The stretches of a train's way over lines, one after the other.
pub struct Sums<'a> {
    lines: &'a Lines,
    /// Δs, m.
    grid: f64,
    rows: usize,
    /// First row of every axle that has not yet come, the next one last.
    coming: Vec<(usize, Axle)>,
    on: Vec<On>,
    /// The stretch that came last, and how many came since the sum was made anew.
    last: Stretch,
    since: usize,
    /// C of four lines at a time.
    sums: Vec<Cubics>,
}

impl<'a> Sums<'a> {
    /// Of `axles` over so many rows, a distance Δs = `grid` m each: the first axle enters at row 0.
    #[must_use]
    pub fn new(lines: &'a Lines, axles: &[Axle], grid: f64, rows: usize) -> Self {
        let first = |axle: &Axle| ((axle.x / grid).ceil() as usize, *axle);
        let mut coming: Vec<(usize, Axle)> = axles.iter().map(first).collect();
        coming.sort_by_key(|(row, _)| std::cmp::Reverse(*row));
        let sums = vec![Cubics::default(); lines.count().div_ceil(QUAD)];
        let last = Stretch { first: 0, count: 0, loaded: false };
        Self { lines, grid, rows, coming, on: Vec::new(), last, since: 0, sums }
    }

    /// C of the stretch that came last, of four lines at a time.
    #[must_use]
    pub fn sums(&self) -> &[Cubics] {
        &self.sums
    }

    /// The next stretch, with its sums in [`Self::sums`].
    #[inline(always)]
    pub fn advance(&mut self) -> Option<Stretch> {
        let first = self.last.first + self.last.count;
        if first >= self.rows {
            return None;
        }
        let goes_on = self.last.loaded && self.since < RENEWED;
        if goes_on {
            shift(&mut self.sums, self.last.count as f64);
        }
        self.take(first, goes_on);
        if !goes_on {
            self.sums.fill(Cubics::default());
            for i in 0..self.on.len() {
                self.add(i, first, 1.0);
            }
        }
        self.since = if goes_on { self.since + 1 } else { 0 };
        let until = self.on.iter().map(|on| on.until).chain(self.coming.last().map(|(row, _)| row - 1));
        let until = until.fold(self.rows - 1, usize::min);
        self.last = Stretch { first, count: until + 1 - first, loaded: !self.on.is_empty() };
        Some(self.last)
    }

    /// Place of an axle at a row, m.
    fn place(&self, axle: &Axle, row: usize) -> f64 {
        self.lines.extent()[0] + (row as f64 * self.grid - axle.x)
    }

    /// The last row at which an axle is on a piece or before it.
    fn until(&self, axle: &Axle, piece: usize) -> usize {
        let end = self.lines.breaks()[piece + 1];
        let about = ((end - self.lines.extent()[0] + axle.x) / self.grid).floor() as usize;
        // Rounding may have led to a neighbour.
        if self.place(axle, about + 1) <= end {
            about + 1
        } else if self.place(axle, about) > end {
            about.saturating_sub(1)
        } else {
            about
        }
    }

    /// Takes the axles to where they are at a row; the sums follow if they are to.
    #[inline(always)]
    fn take(&mut self, row: usize, follow: bool) {
        for i in 0..self.on.len() {
            if self.on[i].until < row {
                if follow {
                    self.add(i, row, -1.0);
                }
                self.find(i, row);
                if follow && self.on[i].until >= row {
                    self.add(i, row, 1.0);
                }
            }
        }
        self.on.retain(|on| on.until >= row);
        while let Some((_, axle)) = self.coming.pop_if(|(first, _)| *first <= row) {
            let i = self.on.len();
            self.on.push(On { axle, piece: 0, until: self.until(&axle, 0) });
            self.find(i, row);
            if self.on[i].until < row {
                // On a deck that is shorter than a row.
                self.on.truncate(i);
            } else if follow {
                self.add(i, row, 1.0);
            }
        }
    }

    /// The piece on which an axle is at a row; behind the last one it stays there.
    fn find(&mut self, i: usize, row: usize) {
        while self.on[i].until < row && self.on[i].piece + 2 < self.lines.breaks().len() {
            self.on[i].piece += 1;
            self.on[i].until = self.until(&self.on[i].axle, self.on[i].piece);
        }
    }

    /// Adds an axle times a factor to the sums, for a stretch that begins with a row.
    #[inline(always)]
    fn add(&mut self, i: usize, row: usize, factor: f64) {
        let On { axle, piece, .. } = self.on[i];
        let [a, b] = [self.lines.breaks()[piece], self.lines.breaks()[piece + 1]];
        let (xi, delta) = ((self.place(&axle, row) - a) / (b - a), self.grid / (b - a));
        let load = factor * axle.load;
        let [w1, w2, w3] = [load * delta, load * delta * delta, load * delta * delta * delta];
        for (sum, [c0, c1, c2, c3]) in self.sums.iter_mut().zip(self.lines.cubics(piece)) {
            let [mut p0, mut p1, mut p2, mut p3] = *sum;
            for l in 0..QUAD {
                p0[l] += load * (c0[l] + xi * (c1[l] + xi * (c2[l] + xi * c3[l])));
                p1[l] += w1 * (c1[l] + xi * (2.0 * c2[l] + 3.0 * xi * c3[l]));
                p2[l] += w2 * (c2[l] + 3.0 * xi * c3[l]);
                p3[l] += w3 * c3[l];
            }
            *sum = [p0, p1, p2, p3];
        }
    }
}

/// The same cubics, counted from n rows further on.
#[inline(always)]
fn shift(sums: &mut [Cubics], n: f64) {
    for sum in sums {
        let [mut p0, mut p1, mut p2, p3] = *sum;
        for l in 0..QUAD {
            p0[l] += n * (p1[l] + n * (p2[l] + n * p3[l]));
            p1[l] += n * (2.0 * p2[l] + 3.0 * n * p3[l]);
            p2[l] += 3.0 * n * p3[l];
        }
        *sum = [p0, p1, p2, p3];
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lines::value;

    #[test]
    fn stretches_give_every_row_what_the_axles_give_one_by_one() {
        // Pieces of all lengths, one far below a row; a function with a jump, one that is nothing but a cubic.
        let breaks = vec![2.0, 2.001, 4.5, 4.7, 11.0];
        let f = |piece: usize, x: f64| vec![1.0 + x - 0.2 * x.powi(2) + 0.03 * x.powi(3), 5.0 * piece as f64 - x];
        let lines = Lines::sampled(breaks, 2, f);
        let axles: Vec<Axle> = [0.0, 2.6, 2.9, 14.0].map(|x| Axle { x, load: 1.0 + x }).into();
        for grid in [0.0071, 0.3] {
            let rows = ((9.0 + 14.0) / grid) as usize + 20;
            let (mut sums, mut seen, mut long) = (Sums::new(&lines, &axles, grid, rows), 0, 0);
            while let Some(stretch) = sums.advance() {
                assert_eq!(stretch.first, seen);
                seen += stretch.count;
                long = long.max(stretch.count);
                for u in 0..stretch.count {
                    let place = |axle: &Axle| 2.0 + ((stretch.first + u) as f64 * grid - axle.x);
                    let sums = if stretch.loaded { sums.sums()[0] } else { Cubics::default() };
                    let y = value(&sums, u as f64);
                    for (l, y) in y.iter().enumerate().take(lines.count()) {
                        let expected: f64 = axles.iter().map(|axle| axle.load * lines.at(place(axle))[l]).sum();
                        assert!((y - expected).abs() < 1e-11, "row {} of line {l}", stretch.first + u);
                    }
                }
            }
            assert_eq!(seen, rows);
            assert!(long > 1);
        }
    }
}
