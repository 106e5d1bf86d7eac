//! Saved instances, in memory and as bytes.

use crate::instance::{Instance, Phase};
use crate::model::{Model, ModelError};
use crate::values::Values;

/// Mark and version of the bytes.
const MAGIC: &[u8; 8] = b"ttbstat2";

/// A saved instance: values, phase and, once built, the dynamic state.
pub struct Snapshot<M: Model> {
    values: Values,
    phase: Phase,
    start: f64,
    time: f64,
    stale: bool,
    state: Option<M::State>,
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
    /// The snapshot carries parameters the model cannot be built with.
    pub fn restore(&mut self, snapshot: &Snapshot<M>) -> Result<(), ModelError> {
        self.values.all.clone_from(&snapshot.values.all);
        self.values.rates.clone_from(&snapshot.values.rates);
        (self.values.has_rates, self.values.had_rates) = (snapshot.values.has_rates, snapshot.values.had_rates);
        (self.phase, self.start, self.time) = (snapshot.phase, snapshot.start, snapshot.time);
        self.stale = snapshot.stale;
        if let Some(state) = &snapshot.state {
            self.build()?;
            self.model.restore(state);
        }
        Ok(())
    }

    /// A snapshot as bytes: magic with version, phase, values, then the model's state.
    pub fn to_bytes(&self, snapshot: &Snapshot<M>) -> Vec<u8> {
        let values = &snapshot.values;
        let mut bytes = MAGIC.to_vec();
        let flags = [values.has_rates, values.had_rates, snapshot.stale, snapshot.state.is_some()];
        bytes.push(snapshot.phase as u8);
        bytes.extend(flags.map(u8::from));
        for x in [snapshot.start, snapshot.time].iter().chain(&values.all).chain(&values.rates) {
            bytes.extend(x.to_le_bytes());
        }
        if let Some(state) = &snapshot.state {
            self.model.write_state(state, &mut bytes);
        }
        bytes
    }

    /// The snapshot that [`Instance::to_bytes`] wrote.
    ///
    /// # Errors
    /// Bytes of another version or another model.
    pub fn from_bytes(&mut self, bytes: &[u8]) -> Result<Snapshot<M>, ModelError> {
        let wrong = |what: &str| ModelError(format!("the serialized FMU state cannot be read: {what}"));
        let mut values = Values::start(self.model.interface());
        let numbers = 2 + values.all.len() + values.rates.len();
        let head = MAGIC.len() + 5;
        if bytes.get(..MAGIC.len()) != Some(MAGIC) {
            return Err(wrong("it does not begin with this program's mark and version"));
        }
        if bytes.len() < head + 8 * numbers {
            return Err(wrong("it is too short for this model"));
        }
        let (flags, rest) = bytes[MAGIC.len()..].split_at(5);
        let (real, state) = rest.split_at(8 * numbers);
        let mut real =
            real.chunks_exact(8).map(|b| f64::from_le_bytes([b[0], b[1], b[2], b[3], b[4], b[5], b[6], b[7]]));
        let mut next = || real.next().unwrap_or(f64::NAN);
        let (start, time) = (next(), next());
        values.all.iter_mut().for_each(|x| *x = next());
        values.rates.iter_mut().for_each(|x| *x = next());
        (values.has_rates, values.had_rates) = (flags[1] != 0, flags[2] != 0);
        let phase = match flags[0] {
            0 => Phase::Instantiated,
            1 => Phase::Initialization,
            _ => Phase::Stepping,
        };
        let state = if flags[4] == 0 {
            None
        } else {
            // The model's layout depends on its parameters: build with those of the snapshot before reading.
            let now = std::mem::replace(&mut self.values, values.clone());
            let start_now = std::mem::replace(&mut self.start, start);
            let read = self.build().and_then(|()| self.model.read_state(state));
            (self.values, self.start) = (now, start_now);
            let rebuilt = self.built.is_some() && self.phase != Phase::Instantiated;
            if rebuilt {
                self.build()?;
            }
            Some(read?)
        };
        Ok(Snapshot { values, phase, start, time, stale: flags[3] != 0, state })
    }
}
