//! Histories of a passage: few, of modes, from which those of all places follow. A linear filter that is applied to them is
//! applied to every place.

use crate::block::Motion;
use crate::extreme::{Extreme, WIDE};
use crate::load::{Rest, TrainLoad};
use crate::march::{March, Motions, accelerations};
use crate::modal::ModalBridge;

/// Modal motions of a passage at steps 0 (at rest), 1, …
#[derive(Clone, Debug)]
pub struct Histories<'a> {
    bridge: &'a ModalBridge,
    load: &'a TrainLoad,
    stride: usize,
    /// Step, s; time counts from the first axle at the deck's begin.
    pub h: f64,
    motions: Motions,
}

impl<'a> Histories<'a> {
    pub(crate) fn of(bridge: &'a ModalBridge, load: &'a TrainLoad, march: &March, motions: Motions) -> Self {
        Self { bridge, load, stride: march.stride(), h: march.h, motions }
    }

    /// Number of samples.
    #[must_use]
    pub fn samples(&self) -> usize {
        self.motions.q.samples()
    }

    /// History of an output of the bridge.
    #[must_use]
    pub fn output(&self, output: usize) -> Vec<f64> {
        let positions = self.bridge.positions();
        let modes = self.bridge.modes().len();
        let (rows, source, place) = if output < positions {
            (self.bridge.position_rows(), &self.motions.q, output)
        } else {
            (self.bridge.acceleration_rows(), &self.motions.a, output - positions)
        };
        let (group, lane) = (place / WIDE, place % WIDE);
        let mut y = vec![0.0; self.samples()];
        if output < positions {
            let rest = Rest { load: self.load, group, stride: self.stride };
            y.iter_mut().enumerate().skip(1).for_each(|(n, y)| *y = rest.at(n)[lane]);
        }
        for (mode, row) in rows[group * modes..(group + 1) * modes].iter().enumerate() {
            y.iter_mut().zip(source.history(mode)).for_each(|(y, x)| *y += row[lane] * x);
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
        let a = &self.motions.a;
        let mut filtered: Vec<Vec<f64>> = (0..a.modes()).map(|mode| a.history(mode).collect()).collect();
        filter(self.h, &mut filtered)?;
        Ok(accelerations(self.bridge, &Motion::of(&filtered), self.h))
    }
}
