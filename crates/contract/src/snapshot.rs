//! Saved instances in memory, and how one is put back: either wholly or not at all.

use crate::instance::{Instance, Phase};
use crate::model::{Model, ModelError};
use crate::values::Values;

/// A saved instance: values, phase and, once built, the dynamic state.
pub struct Snapshot<M: Model> {
    pub(crate) values: Values,
    pub(crate) phase: Phase,
    pub(crate) start: f64,
    pub(crate) time: f64,
    pub(crate) stale: bool,
    pub(crate) state: Option<M::State>,
}

impl<M: Model> Clone for Snapshot<M> {
    fn clone(&self) -> Self {
        Self {
            values: self.values.clone(),
            phase: self.phase,
            start: self.start,
            time: self.time,
            stale: self.stale,
            state: self.state.clone(),
        }
    }
}

impl<M: Model> Instance<M> {
    /// Saves the instance.
    pub fn save(&self) -> Snapshot<M> {
        let state = self.built.is_some().then(|| self.model.save());
        let (values, phase, start, time) = (self.values.clone(), self.phase, self.start, self.time);
        Snapshot { values, phase, start, time, stale: self.stale, state }
    }

    /// Saves into an existing snapshot without allocating.
    pub fn save_into(&self, snapshot: &mut Snapshot<M>) {
        snapshot.values.all.clone_from(&self.values.all);
        snapshot.values.rates.clone_from(&self.values.rates);
        (snapshot.values.has_rates, snapshot.values.had_rates) = (self.values.has_rates, self.values.had_rates);
        (snapshot.phase, snapshot.start, snapshot.time) = (self.phase, self.start, self.time);
        snapshot.stale = self.stale;
        snapshot.state = self.built.is_some().then(|| self.model.save());
    }

    /// Restores a snapshot of this or of another instance of the same model.
    ///
    /// # Errors
    /// The snapshot carries parameters the model cannot be built with; the instance is then as before.
    pub fn restore(&mut self, snapshot: &Snapshot<M>) -> Result<(), ModelError> {
        if snapshot.state.is_some() && !self.is_built_for(&snapshot.values, snapshot.start) {
            self.build_for(&snapshot.values, snapshot.start)?;
        }
        self.values.all.clone_from(&snapshot.values.all);
        self.values.rates.clone_from(&snapshot.values.rates);
        (self.values.has_rates, self.values.had_rates) = (snapshot.values.has_rates, snapshot.values.had_rates);
        (self.phase, self.start, self.time) = (snapshot.phase, snapshot.start, snapshot.time);
        self.stale = snapshot.stale;
        if let Some(state) = &snapshot.state {
            self.model.restore(state);
        }
        Ok(())
    }

    /// Builds the model for other values than the instance's own.
    ///
    /// # Errors
    /// The model cannot be built with them; it is then as before.
    pub(crate) fn build_for(&mut self, values: &Values, start: f64) -> Result<(), ModelError> {
        let before = self.save();
        self.values.clone_from(values);
        self.start = start;
        let built = self.build();
        self.values.clone_from(&before.values);
        self.start = before.start;
        if built.is_err() {
            self.return_to(&before)?;
        }
        built
    }

    /// After the model was built for other values: builds it for the instance's own and puts its state back. Before
    /// initialization nothing is built in advance, because parameters may be half set.
    pub(crate) fn return_to(&mut self, before: &Snapshot<M>) -> Result<(), ModelError> {
        if let Some(state) = before.state.as_ref().filter(|_| self.phase != Phase::Instantiated) {
            self.build()?;
            self.model.restore(state);
        }
        Ok(())
    }
}
