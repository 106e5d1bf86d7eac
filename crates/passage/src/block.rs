//! Outputs over a block of steps, reduced at once: where no output of a group can reach a new extreme, none is computed.
//!
//! ```text
//! y_k(n) = rest_k(n) + Σ_j Y_kj x_j(n)                        x: q or q̈
//! y_k   ≤ max rest_k + Σ_j max(Y_kj min x_j, Y_kj max x_j)    over the block, and likewise from below
//! top_k ≤ y_k + |bend_k|/8,   |bend_k| ≤ Σ_j |Y_kj| max |x_j(n−2) − 2x_j(n−1) + x_j(n)| + 2 (max rest_k − min rest_k)
//! ```
//!
//! A train that has passed, or passes without resonance, leaves most blocks below what was seen before. What is computed is
//! computed in the same order as without bounds: an extreme has the same bits.

use pulp::Simd;

use crate::extreme::{WIDE, Watch};

/// Modes that are taken together.
pub const QUAD: usize = 4;
/// Steps of a block.
pub const STEPS: usize = 32;
/// Steps before it that a parabola through three samples needs.
const BEFORE: usize = 2;
/// Samples of a block.
const ROWS: usize = BEFORE + STEPS;
/// What rounding may add to a bound, of the sum of magnitudes.
const ROUNDING: f64 = 1e-12;

/// Samples of a block: numbers that go side by side, a row a step.
type Samples<const N: usize> = [[f64; N]; ROWS];

/// Modal motion over a block.
pub struct Block {
    quads: Vec<Samples<QUAD>>,
    /// Number of steps that are filled.
    steps: usize,
    /// Smallest, largest and largest second difference of every mode.
    bounds: Vec<[f64; 3]>,
}

impl Block {
    /// At rest, for so many modes.
    pub fn new(modes: usize) -> Self {
        let quads = vec![[[0.0; QUAD]; ROWS]; modes.div_ceil(QUAD)];
        Self { bounds: vec![[0.0; 3]; modes], quads, steps: 0 }
    }

    /// Begins the next block, of at most [`STEPS`] steps.
    pub fn advance(&mut self, steps: usize) {
        for quad in &mut self.quads {
            quad.copy_within(self.steps..self.steps + BEFORE, 0);
        }
        self.steps = steps;
    }

    /// Four modes at the steps of this block, to be filled.
    #[inline(always)]
    pub fn quad(&mut self, quad: usize) -> &mut [[f64; QUAD]] {
        &mut self.quads[quad][BEFORE..BEFORE + self.steps]
    }

    /// The same, filled.
    pub fn filled(&self) -> impl Iterator<Item = &[[f64; QUAD]]> {
        self.quads.iter().map(|quad| &quad[BEFORE..BEFORE + self.steps])
    }

    /// To be called when all is filled.
    #[inline(always)]
    pub fn bound(&mut self) {
        for (quad, bounds) in self.quads.iter().zip(self.bounds.chunks_mut(QUAD)) {
            let rows = &quad[..BEFORE + self.steps];
            let [low, high] = range(rows);
            let mut bend = [0.0; QUAD];
            for three in rows.windows(3) {
                for i in 0..QUAD {
                    bend[i] = larger(bend[i], (three[0][i] - 2.0 * three[1][i] + three[2][i]).abs());
                }
            }
            for (i, of) in bounds.iter_mut().enumerate() {
                *of = [low[i], high[i], bend[i]];
            }
        }
    }

    #[inline(always)]
    fn outputs<S: Simd>(&self, simd: S, rows: &[[f64; WIDE]], rest: [f64; WIDE], n: usize) -> [f64; WIDE] {
        let mut y = rest;
        for (quad, rows) in self.quads.iter().zip(rows.chunks(QUAD)) {
            add(simd, rows, &quad[n], &mut y);
        }
        y
    }
}

/// What a group of outputs has beside its modes.
pub struct Rest(Samples<WIDE>);

impl Default for Rest {
    fn default() -> Self {
        Self([[0.0; WIDE]; ROWS])
    }
}

impl Rest {
    /// Fills a block that begins with the step `first` from the values at steps; before step 0 there are zeros.
    #[inline(always)]
    pub fn fill(&mut self, first: usize, value: impl Fn(usize) -> [f32; WIDE]) {
        for (row, n) in self.0.iter_mut().zip(first..) {
            *row = n.checked_sub(BEFORE).map_or([0.0; WIDE], |n| value(n).map(f64::from));
        }
    }
}

/// A group of outputs over a block: its rows Y by mode, what it has beside the modes, and which step the block begins with.
pub struct Group<'a> {
    /// Y, a row a mode.
    pub rows: &'a [[f64; WIDE]],
    /// Rest, if there is one.
    pub rest: Option<&'a Rest>,
    /// The first step.
    pub first: usize,
    /// Whether no block comes after this one.
    pub last: bool,
    /// Step, s.
    pub h: f64,
}

impl Group<'_> {
    /// Has the outputs watched over a block that was bounded.
    #[inline(always)]
    pub fn watch<S: Simd>(&self, simd: S, block: &Block, watch: &mut Watch) {
        // The last sample counts as it is: the last block is always looked at.
        if !self.last && watch.holds(&self.reach(block)) {
            return;
        }
        let y = |n: usize| {
            let rest = match self.rest {
                Some(rest) => rest.0[n],
                None => [0.0; WIDE],
            };
            block.outputs(simd, self.rows, rest, n)
        };
        watch.resume(y(0), y(1));
        for n in 0..block.steps {
            watch.look_with(simd, &y(BEFORE + n), self.first + n, self.h);
        }
    }

    /// Bounds from below and above of all parabolas through three samples.
    #[inline(always)]
    fn reach(&self, block: &Block) -> [[f64; WIDE]; 2] {
        let [mut low, mut high] = match self.rest {
            Some(rest) => range(&rest.0[..BEFORE + block.steps]),
            None => [[0.0; WIDE]; 2],
        };
        let (mut slack, mut size) = ([0.0; WIDE], [0.0; WIDE]);
        for k in 0..WIDE {
            slack[k] = 0.25 * (high[k] - low[k]);
            size[k] = larger(low[k].abs(), high[k].abs());
        }
        for (row, [least, most, bend]) in self.rows.iter().zip(&block.bounds) {
            let far = larger(least.abs(), most.abs());
            for k in 0..WIDE {
                let [a, b] = [row[k] * least, row[k] * most];
                low[k] += smaller(a, b);
                high[k] += larger(a, b);
                slack[k] += 0.125 * row[k].abs() * bend;
                size[k] += row[k].abs() * far;
            }
        }
        for k in 0..WIDE {
            let more = slack[k] + ROUNDING * size[k];
            low[k] -= more;
            high[k] += more;
        }
        [low, high]
    }
}

/// Smallest and largest of every column.
#[inline(always)]
fn range<const N: usize>(rows: &[[f64; N]]) -> [[f64; N]; 2] {
    let first = rows.first().copied().unwrap_or([0.0; N]);
    let (mut low, mut high) = (first, first);
    for row in rows {
        for i in 0..N {
            (low[i], high[i]) = (smaller(low[i], row[i]), larger(high[i], row[i]));
        }
    }
    [low, high]
}

/// The larger number: one instruction, where `f64::max` takes several for the sake of NaN.
#[inline(always)]
pub fn larger(a: f64, b: f64) -> f64 {
    if a < b { b } else { a }
}

/// The smaller number, likewise.
#[inline(always)]
pub fn smaller(a: f64, b: f64) -> f64 {
    if b < a { b } else { a }
}

/// y ← y + Σ_j row_j x_j, added in the order of j.
#[inline(always)]
pub fn add<S: Simd>(simd: S, rows: &[[f64; WIDE]], x: &[f64], y: &mut [f64; WIDE]) {
    for (row, x) in rows.iter().zip(x) {
        let x = simd.splat_f64s(*x);
        for (y, row) in S::as_mut_simd_f64s(y).0.iter_mut().zip(S::as_simd_f64s(row).0) {
            *y = simd.add_f64s(*y, simd.mul_f64s(*row, x));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::extreme::Extreme;

    const H: f64 = 0.01;

    /// Eight outputs of five modes that swell and decay, with something beside them; every block looked at, or only those that
    /// are needed. Also how many were passed over.
    fn extremes(all: bool) -> ([Extreme; WIDE], usize) {
        let rows: Vec<[f64; WIDE]> =
            (0..5).map(|j| std::array::from_fn(|k| ((3 * j + k) as f64).sin() / (j + 1) as f64)).collect();
        let swell = |n: usize| (-((n as f64 - 400.0) / 150.0).powi(2)).exp();
        let motion = |n: usize, j: usize| swell(n) * (0.02 * (j * j + 1) as f64 * n as f64).sin();
        let (mut block, mut rest, mut watch) = (Block::new(5), Rest::default(), Watch::default());
        let (samples, mut passed) = (1000, 0);
        for first in (1..samples).step_by(STEPS) {
            let steps = STEPS.min(samples - first);
            block.advance(steps);
            for quad in 0..2 {
                let values = |n: usize| std::array::from_fn(|i| motion(first + n, QUAD * quad + i));
                block.quad(quad).iter_mut().enumerate().for_each(|(n, row)| *row = values(n));
            }
            block.bound();
            rest.fill(first, |n| [0.1 * swell(n) as f32; WIDE]);
            let last = all || first + steps == samples;
            let group = Group { rows: &rows, rest: Some(&rest), first, last, h: H };
            passed += usize::from(!last && watch.holds(&group.reach(&block)));
            group.watch(pulp::Scalar::new(), &block, &mut watch);
        }
        (watch.finish(samples, H), passed)
    }

    #[test]
    fn blocks_that_are_passed_over_take_no_bit_of_an_extreme_away() {
        let ((all, _), (few, passed)) = (extremes(true), extremes(false));
        assert_eq!(all, few);
        assert!(passed > 10 && all.iter().all(|one| one.max > 0.1 && one.min < -0.1), "{passed} {all:?}");
    }
}
