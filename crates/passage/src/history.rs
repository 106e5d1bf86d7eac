//! Histories of a passage: few, of modes, from which those of all places follow. A linear filter that is applied to them is
//! applied to every place.

use pulp::{Simd, WithSimd};

use crate::block::{Group, Motion};
use crate::extreme::{Extreme, WIDE};
use crate::load::{Rest, TrainLoad};
use crate::march::{March, Motions};
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

impl<'a> Histories<'a> {
    pub(crate) fn of(bridge: &'a ModalBridge, load: &'a TrainLoad, march: &March, motions: &Motions) -> Self {
        let all = |motion: &Motion| (0..bridge.modes().len()).map(|mode| motion.history(mode)).collect();
        let (stride, h) = (march.stride(), march.h);
        Self { bridge, load, stride, h, positions: all(&motions.q), accelerations: all(&motions.a) }
    }

    /// Number of samples.
    #[must_use]
    pub fn samples(&self) -> usize {
        self.positions.first().map_or(0, Vec::len)
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
            let rest = Rest { load: self.load, group, stride: self.stride };
            y.iter_mut().enumerate().skip(1).for_each(|(n, y)| *y = rest.at(n)[lane]);
        }
        for (row, history) in rows[group * modes..(group + 1) * modes].iter().zip(source) {
            y.iter_mut().zip(history).for_each(|(y, x)| *y += row[lane] * x);
        }
        y
    }

    /// Extremes of all accelerations after `filter(h, histories)` of the modal ones, in the order of the bridge's outputs behind
    /// [`ModalBridge::positions`].
    ///
    /// # Errors
    /// Those of the filter.
    pub fn accelerations<E>(
        &self,
        filter: impl FnOnce(f64, &mut [Vec<f64>]) -> Result<(), E>,
    ) -> Result<Vec<Extreme>, E> {
        let mut filtered = self.accelerations.clone();
        filter(self.h, &mut filtered)?;
        let motion = Motion::of(&filtered);
        Ok(pulp::Arch::new().dispatch(Accelerations { bridge: self.bridge, motion: &motion, h: self.h }))
    }
}

/// Extremes of the accelerations of all places under an instruction set; all of them give the same bits.
struct Accelerations<'a> {
    bridge: &'a ModalBridge,
    motion: &'a Motion,
    h: f64,
}

impl WithSimd for Accelerations<'_> {
    type Output = Vec<Extreme>;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Vec<Extreme> {
        let Self { bridge, motion, h } = self;
        let mut found = Vec::new();
        for rows in bridge.acceleration_rows().chunks(bridge.modes().len().max(1)) {
            found.extend(Group { motion, rows, rest: None, h }.extremes(simd));
        }
        found.truncate(bridge.outputs().len() - bridge.positions());
        found
    }
}
