//! Outputs of a passage, reduced in blocks of steps: where no output of a group can reach a new extreme, none is computed.
//!
//! ```text
//! y_k(n) = rest_k(n) + Σ_j Y_kj x_j(n)                        x: q or q̈
//! y_k   ≤ max rest_k + Σ_j max(Y_kj min x_j, Y_kj max x_j)    over the block, and likewise from below
//! top_k ≤ y_k + |bend_k|/8,   |bend_k| ≤ Σ_j |Y_kj| max |x_j(n−2) − 2x_j(n−1) + x_j(n)| + 2 (max rest_k − min rest_k)
//! ```
//!
//! The blocks that promise most come first; few others are left that may exceed what was found in them. What is computed is
//! computed in the same order as without bounds: an extreme has the same bits. Where two of the same bits are reached, one of
//! them is kept.

use pulp::{Simd, WithSimd};

use crate::extreme::{Extreme, WIDE, Watch};
use crate::lanes::{QUAD, ROUNDING, larger, smaller};
use crate::load::{Rest, TrainLoad};

/// Steps of a block.
pub const STEPS: usize = 32;
/// Steps before it that a parabola through three samples needs.
const BEFORE: usize = 2;

/// Modal motion of a passage at steps 0, 1, …; before step 0 there is rest.
#[derive(Clone, Debug)]
pub struct Motion {
    /// Four modes each, a row a step, behind the rows of rest.
    quads: Vec<Vec<[f64; QUAD]>>,
    modes: usize,
    samples: usize,
    /// Smallest, largest and largest second difference by block and mode.
    bounds: Vec<[f64; 3]>,
}

impl Motion {
    /// At rest, for so many modes and samples.
    pub fn at_rest(modes: usize, samples: usize) -> Self {
        let quads = vec![vec![[0.0; QUAD]; BEFORE + samples]; modes.div_ceil(QUAD)];
        Self { quads, modes, samples, bounds: vec![[0.0; 3]; modes * samples.div_ceil(STEPS)] }
    }

    /// Of a history a mode, all equally long.
    pub fn of(histories: &[Vec<f64>]) -> Self {
        let samples = histories.first().map_or(0, Vec::len);
        let mut motion = Self::at_rest(histories.len(), samples);
        for (quad, histories) in motion.quads.iter_mut().zip(histories.chunks(QUAD)) {
            for (i, history) in histories.iter().enumerate() {
                quad[BEFORE..].iter_mut().zip(history).for_each(|(row, x)| row[i] = *x);
            }
        }
        (0..motion.blocks()).for_each(|block| motion.bound(block));
        motion
    }

    /// Number of blocks.
    pub fn blocks(&self) -> usize {
        self.samples.div_ceil(STEPS)
    }

    /// Steps of a block.
    pub fn steps(&self, block: usize) -> std::ops::Range<usize> {
        block * STEPS..self.samples.min((block + 1) * STEPS)
    }

    /// Four modes at some steps, to be filled.
    #[inline(always)]
    pub fn quad(&mut self, quad: usize, steps: std::ops::Range<usize>) -> &mut [[f64; QUAD]] {
        &mut self.quads[quad][BEFORE + steps.start..BEFORE + steps.end]
    }

    /// Number of modes.
    pub fn modes(&self) -> usize {
        self.modes
    }

    /// Number of samples.
    pub fn samples(&self) -> usize {
        self.samples
    }

    /// The history of a mode.
    pub fn history(&self, mode: usize) -> impl Iterator<Item = f64> {
        self.quads[mode / QUAD][BEFORE..].iter().map(move |row| row[mode % QUAD])
    }

    /// To be called when a block is filled.
    #[inline(always)]
    pub fn bound(&mut self, block: usize) {
        let steps = self.steps(block);
        let bounds = &mut self.bounds[block * self.modes..(block + 1) * self.modes];
        for (quad, bounds) in self.quads.iter().zip(bounds.chunks_mut(QUAD)) {
            let rows = &quad[steps.start..BEFORE + steps.end];
            let (mut low, mut high, mut bend) = (rows[0], rows[0], [0.0; QUAD]);
            for row in rows {
                for i in 0..QUAD {
                    (low[i], high[i]) = (smaller(low[i], row[i]), larger(high[i], row[i]));
                }
            }
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
}

/// Outputs that follow a motion.
pub struct Outputs<'a> {
    /// The motion, bounded.
    pub motion: &'a Motion,
    /// Y by group, then mode.
    pub rows: &'a [[f64; WIDE]],
    /// What they have beside the modes, by the tables of a train and the rows of a step; none: nothing.
    pub rest: Option<(&'a TrainLoad, usize)>,
    /// Number of outputs: groups are filled up to whole vectors, and of a motion without modes there are none.
    pub count: usize,
    /// Step, s.
    pub h: f64,
}

impl Outputs<'_> {
    /// Extremes of all of them; any instruction set gives the same bits.
    pub fn extremes(self) -> Vec<Extreme> {
        pulp::Arch::new().dispatch(self)
    }
}

impl WithSimd for Outputs<'_> {
    type Output = Vec<Extreme>;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Vec<Extreme> {
        let Self { motion, rest, h, count, .. } = self;
        let mut extremes = Vec::with_capacity(count.next_multiple_of(WIDE));
        for (group, rows) in self.rows.chunks(motion.modes.max(1)).enumerate() {
            let rest = rest.map(|(load, stride)| Rest { load, group, stride });
            extremes.extend(Group { motion, rows, rest, h }.extremes(simd));
        }
        extremes.resize(count, Extreme::default());
        extremes
    }
}

/// A group of outputs over a motion: its rows Y by mode, and what it has beside the modes.
struct Group<'a> {
    motion: &'a Motion,
    rows: &'a [[f64; WIDE]],
    rest: Option<Rest<'a>>,
    h: f64,
}

impl Group<'_> {
    /// Extremes of the outputs from begin to end.
    #[inline(always)]
    fn extremes<S: Simd>(&self, simd: S) -> [Extreme; WIDE] {
        self.watch(simd).finish(self.motion.samples, self.h)
    }

    #[inline(always)]
    fn watch<S: Simd>(&self, simd: S) -> Watch {
        let mut watch = Watch::default();
        let Some(last) = self.motion.blocks().checked_sub(1) else { return watch };
        let mut reaches = Vec::with_capacity(last);
        // No closures: what they hold would not be compiled for the instruction set.
        for block in 0..last {
            reaches.push(self.reach(block));
        }
        let first = promising(&reaches);
        for block in first.into_iter().flatten() {
            self.look(simd, block, &mut watch);
        }
        for (block, reach) in reaches.iter().enumerate() {
            if !first.contains(&Some(block)) && !watch.holds(reach) {
                self.look(simd, block, &mut watch);
            }
        }
        // The last sample counts as it is: the last block is always looked at.
        self.look(simd, last, &mut watch);
        watch
    }

    #[inline(always)]
    fn look<S: Simd>(&self, simd: S, block: usize, watch: &mut Watch) {
        let steps = self.motion.steps(block);
        watch.resume(self.outputs(simd, steps.start), self.outputs(simd, steps.start + 1));
        for n in steps {
            watch.look_with(simd, &self.outputs(simd, BEFORE + n), n, self.h);
        }
    }

    /// The outputs at a row, which lies two steps before the step of the same number.
    #[inline(always)]
    fn outputs<S: Simd>(&self, simd: S, row: usize) -> [f64; WIDE] {
        let mut y = match &self.rest {
            Some(rest) if row > BEFORE => rest.at(row - BEFORE),
            _ => [0.0; WIDE],
        };
        for (quad, rows) in self.motion.quads.iter().zip(self.rows.chunks(QUAD)) {
            add(simd, rows, &quad[row], &mut y);
        }
        y
    }

    /// Bounds from below and above of all parabolas through three samples of a block.
    #[inline(always)]
    fn reach(&self, block: usize) -> [[f64; WIDE]; 2] {
        let [mut low, mut high] = match &self.rest {
            Some(rest) => rest.range(self.motion.steps(block), BEFORE),
            None => [[0.0; WIDE]; 2],
        };
        let (mut slack, mut size) = ([0.0; WIDE], [0.0; WIDE]);
        for k in 0..WIDE {
            slack[k] = 0.25 * (high[k] - low[k]);
            size[k] = larger(low[k].abs(), high[k].abs());
        }
        let bounds = &self.motion.bounds[block * self.motion.modes..(block + 1) * self.motion.modes];
        for (row, [least, most, bend]) in self.rows.iter().zip(bounds) {
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

/// Blocks in which the outputs of a group reach highest and lowest, by the sum of their bounds.
fn promising(reaches: &[[[f64; WIDE]; 2]]) -> [Option<usize>; 2] {
    let sum = |block: usize, side: usize| reaches[block][side].iter().sum::<f64>();
    let blocks = 0..reaches.len();
    let lowest = blocks.clone().min_by(|a, b| sum(*a, 0).total_cmp(&sum(*b, 0)));
    let highest = blocks.max_by(|a, b| sum(*a, 1).total_cmp(&sum(*b, 1)));
    [highest, lowest.filter(|_| lowest != highest)]
}

/// y ← y + Σ_j row_j x_j, added in the order of j.
#[inline(always)]
fn add<S: Simd>(simd: S, rows: &[[f64; WIDE]], x: &[f64], y: &mut [f64; WIDE]) {
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

    #[test]
    fn blocks_that_are_passed_over_take_no_bit_of_an_extreme_away() {
        const H: f64 = 0.01;
        let samples = 1000;
        // Eight outputs of five modes that swell and decay.
        let rows: Vec<[f64; WIDE]> =
            (0..5).map(|j| std::array::from_fn(|k| ((3 * j + k) as f64).sin() / (j + 1) as f64)).collect();
        let swell = |n: usize| (-((n as f64 - 400.0) / 150.0).powi(2)).exp();
        let mode = |j: usize| (0..samples).map(|n| swell(n) * (0.02 * (j * j + 1) as f64 * n as f64).sin()).collect();
        let histories: Vec<Vec<f64>> = (0..5).map(mode).collect();
        let motion = Motion::of(&histories);
        let group = Group { motion: &motion, rows: &rows, rest: None, h: H };
        let watch = group.watch(pulp::Scalar::new());
        let passed = (0..motion.blocks()).filter(|block| watch.holds(&group.reach(*block))).count();
        for (k, found) in watch.finish(samples, H).iter().enumerate() {
            let y = |n: usize| rows.iter().zip(&histories).fold(0.0, |y, (row, x)| y + row[k] * x[n]);
            let history: Vec<f64> = (0..samples).map(y).collect();
            assert_eq!(*found, Extreme::of(&history, H));
            assert!(found.max > 0.1 && found.min < -0.1, "{found:?}");
        }
        assert!(passed > 10, "{passed}");
    }
}
