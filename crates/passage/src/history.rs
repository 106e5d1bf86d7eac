//! Histories of a passage: few, of modes, from which those of all places follow. A linear filter that is applied to them is
//! applied to every place.

use pulp::{Simd, WithSimd};

use crate::block::{Block, Group, QUAD, STEPS};
use crate::extreme::{Extreme, WIDE, Watch};
use crate::load::TrainLoad;
use crate::march::{March, Visit};
use crate::modal::ModalBridge;

/// Modal motions of a passage at steps 0 (at rest), 1, …
#[derive(Clone, Debug)]
pub struct Histories<'a> {
    bridge: &'a ModalBridge,
    load: &'a TrainLoad,
    stride: usize,
    /// Step, s; time counts from the first axle at the deck's begin.
    pub h: f64,
    /// q_j, one history a mode.
    pub positions: Vec<Vec<f64>>,
    /// q̈_j, one history a mode.
    pub accelerations: Vec<Vec<f64>>,
}

struct Kept {
    positions: Vec<Vec<f64>>,
    accelerations: Vec<Vec<f64>>,
}

impl Visit for Kept {
    fn block<S: Simd>(&mut self, _simd: S, _first: usize, q: &mut Block, a: &mut Block) {
        for (histories, block) in [(&mut self.positions, q), (&mut self.accelerations, a)] {
            for (histories, rows) in histories.chunks_mut(QUAD).zip(block.filled()) {
                let modes = histories.iter_mut().enumerate();
                modes.for_each(|(i, history)| history.extend(rows.iter().map(|row| row[i])));
            }
        }
    }
}

impl<'a> Histories<'a> {
    pub(crate) fn of(bridge: &'a ModalBridge, load: &'a TrainLoad, march: &March, stride: usize) -> Self {
        let start = || {
            let mut history = Vec::with_capacity(march.steps + 1);
            history.push(0.0);
            history
        };
        let all = || (0..bridge.modes().len()).map(|_| start()).collect::<Vec<_>>();
        let mut kept = Kept { positions: all(), accelerations: all() };
        march.visited(&mut kept);
        Self { bridge, load, stride, h: march.h, positions: kept.positions, accelerations: kept.accelerations }
    }

    /// Number of samples.
    #[must_use]
    pub fn samples(&self) -> usize {
        self.positions.first().map_or(0, Vec::len)
    }

    /// The same with `filter(h, histories)` applied to all modal accelerations, and to nothing else.
    ///
    /// # Errors
    /// Those of the filter.
    pub fn filtered<E>(&self, filter: impl FnOnce(f64, &mut [Vec<f64>]) -> Result<(), E>) -> Result<Self, E> {
        let mut filtered = self.clone();
        filter(self.h, &mut filtered.accelerations)?;
        Ok(filtered)
    }

    /// History of an output of the bridge.
    #[must_use]
    pub fn output(&self, output: usize) -> Vec<f64> {
        let positions = self.bridge.positions();
        let modes = self.bridge.modes().len();
        let (rows, source, place) = if output < positions {
            (self.bridge.position_rows(), &self.positions, output)
        } else {
            (self.bridge.acceleration_rows(), &self.accelerations, output - positions)
        };
        let (group, lane) = (place / WIDE, place % WIDE);
        let mut y = vec![0.0; self.samples()];
        if output < positions {
            y.iter_mut().enumerate().for_each(|(n, y)| *y = self.rest(n, group)[lane]);
        }
        for (row, history) in rows[group * modes..(group + 1) * modes].iter().zip(source) {
            y.iter_mut().zip(history).for_each(|(y, x)| *y += row[lane] * x);
        }
        y
    }

    /// Extremes of all accelerations, in the order of the bridge's outputs behind [`ModalBridge::positions`].
    #[must_use]
    pub fn accelerations(&self) -> Vec<Extreme> {
        let modes = self.bridge.modes().len();
        let count = self.bridge.outputs().len() - self.bridge.positions();
        let groups = self.bridge.acceleration_rows().chunks_exact(modes.max(1));
        let mut watches = vec![Watch::default(); groups.len()];
        pulp::Arch::new().dispatch(Accelerations { histories: self, watches: &mut watches });
        let found = watches.iter().flat_map(|watch| watch.finish(self.samples(), self.h));
        found.take(count).collect()
    }

    fn rest(&self, n: usize, group: usize) -> [f64; WIDE] {
        let (row, groups) = (n * self.stride, self.load.rest.len() / self.load.rows.max(1));
        if row < self.load.rows { self.load.rest[row * groups + group].map(f64::from) } else { [0.0; WIDE] }
    }
}

/// The accelerations of all places, watched under an instruction set; all of them give the same bits.
struct Accelerations<'a, 'b> {
    histories: &'a Histories<'b>,
    watches: &'a mut [Watch],
}

impl WithSimd for Accelerations<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Histories { bridge, accelerations, h, .. } = self.histories;
        let (modes, samples) = (accelerations.len(), self.histories.samples());
        let mut block = Block::new(modes);
        for first in (0..samples).step_by(STEPS) {
            let steps = STEPS.min(samples - first);
            block.advance(steps);
            for (quad, histories) in accelerations.chunks(QUAD).enumerate() {
                for (i, history) in histories.iter().enumerate() {
                    let now = &history[first..first + steps];
                    block.quad(quad).iter_mut().zip(now).for_each(|(row, a)| row[i] = *a);
                }
            }
            block.bound();
            let last = first + steps == samples;
            for (watch, rows) in self.watches.iter_mut().zip(bridge.acceleration_rows().chunks(modes.max(1))) {
                Group { rows, rest: None, first, last, h: *h }.watch(simd, &block, watch);
            }
        }
    }
}
