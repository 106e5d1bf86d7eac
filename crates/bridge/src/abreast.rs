//! Several bridges over one structure, side by side: what ends a step of each and begins its next one is computed for all in one
//! sweep over what they share, before they are asked for it.

use std::sync::Arc;

use crate::march::Owed;
use crate::model::Bridge;
use crate::system::{Lane, Step, Work};

/// Room for what is computed ahead.
#[derive(Default)]
pub struct Abreast {
    work: Work,
}

impl Abreast {
    /// Ends the last step of every bridge and begins the next, of the same size. A bridge without anything to end, or over
    /// another structure, is left alone: it does so itself when it steps. How many were served.
    pub fn ahead(&mut self, bridges: &mut [&mut Bridge]) -> usize {
        let mut all: Vec<(&mut Bridge, Owed)> =
            bridges.iter_mut().filter_map(|bridge| bridge.owed().map(|owed| (&mut **bridge, owed))).collect();
        let served = all.len();
        while let Some(step) = all.first().and_then(|(_, owed)| owed.step()) {
            let same = |owed: &Owed| owed.step().is_some_and(|other| Arc::ptr_eq(&other, &step));
            let (mut these, others): (Vec<_>, Vec<_>) = all.into_iter().partition(|(_, owed)| same(owed));
            let mut lanes: Vec<Lane> = these.iter_mut().filter_map(|(_, owed)| owed.lane()).collect();
            step.proceed_abreast(&mut lanes, &mut self.work);
            these.into_iter().for_each(|(bridge, owed)| bridge.keep(owed));
            all = others;
        }
        served
    }
}

impl Owed {
    fn step(&self) -> Option<Arc<dyn Step>> {
        self.state.pending.as_ref().map(|pending| Arc::clone(&pending.step))
    }

    fn lane(&mut self) -> Option<Lane<'_>> {
        let pending = self.state.pending.as_ref()?;
        Some(Lane { base: &pending.base, forces: &self.state.force, next: Arc::get_mut(&mut self.next)? })
    }
}
