//! Saved instances as bytes.
//!
//! ```text
//! mark and version | phase, 4 flags | start, time, values, rates | the model's state | sum of all bytes before
//! ```
//!
//! What is read is checked as what is set: numbers are finite, parameters of their kind, and the model can be built with
//! them. Bytes that were damaged on their way are refused by the sum.

use crate::instance::{Instance, Phase};
use crate::model::{Model, ModelError};
use crate::snapshot::Snapshot;
use crate::values::Values;

/// Mark and version of the bytes.
const MARK: &[u8; 8] = b"ttbstat3";
/// Bytes of phase and flags.
const FLAGS: usize = 5;

/// A 64-bit number that changes when a byte does (FNV-1a; Fowler, Noll & Vo, RFC 9923).
pub fn sum(bytes: &[u8]) -> u64 {
    bytes.iter().fold(0xcbf2_9ce4_8422_2325, |sum, byte| (sum ^ u64::from(*byte)).wrapping_mul(0x0000_0100_0000_01b3))
}

fn wrong(what: &str) -> ModelError {
    ModelError(format!("the serialized FMU state cannot be read: {what}"))
}

impl<M: Model> Instance<M> {
    /// A snapshot as bytes.
    pub fn to_bytes(&self, snapshot: &Snapshot<M>) -> Vec<u8> {
        let values = &snapshot.values;
        let mut bytes = MARK.to_vec();
        let flags = [values.has_rates, values.had_rates, snapshot.stale, snapshot.state.is_some()];
        bytes.push(snapshot.phase as u8);
        bytes.extend(flags.map(u8::from));
        for x in [snapshot.start, snapshot.time].iter().chain(&values.all).chain(&values.rates) {
            bytes.extend(x.to_le_bytes());
        }
        if let Some(state) = &snapshot.state {
            self.model.write_state(state, &mut bytes);
        }
        let sum = sum(&bytes);
        bytes.extend(sum.to_le_bytes());
        bytes
    }

    /// The snapshot that [`Instance::to_bytes`] wrote. The instance is afterwards as before, also when the bytes are refused.
    ///
    /// # Errors
    /// Bytes of another version or another model, damaged bytes, parameters that cannot be.
    pub fn from_bytes(&mut self, bytes: &[u8]) -> Result<Snapshot<M>, ModelError> {
        let body = bytes.strip_prefix(MARK);
        let body = body.ok_or_else(|| wrong("it does not begin with this program's mark and version"))?;
        let mut values = Values::start(self.model().interface());
        let numbers = 8 * (2 + values.all.len() + values.rates.len());
        let (body, tail) = body.split_last_chunk::<8>().ok_or_else(|| wrong("it is too short for this model"))?;
        if body.len() < FLAGS + numbers {
            return Err(wrong("it is too short for this model"));
        }
        if u64::from_le_bytes(*tail) != sum(&bytes[..bytes.len() - tail.len()]) {
            return Err(wrong("its sum does not fit its bytes: it was damaged"));
        }
        let (flags, rest) = body.split_at(FLAGS);
        let (real, state) = rest.split_at(numbers);
        let mut real = real.as_chunks::<8>().0.iter().map(|b| f64::from_le_bytes(*b));
        let mut next = || real.next().unwrap_or(f64::NAN);
        let (start, time) = (next(), next());
        values.all.iter_mut().for_each(|x| *x = next());
        values.rates.iter_mut().for_each(|x| *x = next());
        let phase = match flags[0] {
            0 => Phase::Instantiated,
            1 => Phase::Initialization,
            2 => Phase::Stepping,
            other => return Err(wrong(&format!("it is in phase {other}, which there is not"))),
        };
        if let Some(flag) = flags[1..].iter().find(|flag| **flag > 1) {
            return Err(wrong(&format!("a flag is {flag}, neither 0 nor 1")));
        }
        let [has_rates, had_rates, stale, has_state] = [flags[1], flags[2], flags[3], flags[4]].map(|flag| flag == 1);
        if !has_state && !state.is_empty() {
            return Err(wrong(&format!("{} bytes stand behind a state that was not built yet", state.len())));
        }
        if phase == Phase::Stepping && !has_state {
            return Err(wrong("it is in the middle of a run, but holds no state"));
        }
        (values.has_rates, values.had_rates) = (has_rates, had_rates);
        self.check(&values, [start, time])?;
        let state = if has_state { Some(self.read(&values, start, state)?) } else { None };
        Ok(Snapshot { values, phase, start, time, stale, state })
    }

    /// Numbers are finite and parameters of their kind.
    fn check(&self, values: &Values, times: [f64; 2]) -> Result<(), ModelError> {
        if let Some(time) = times.iter().find(|time| !time.is_finite()) {
            return Err(wrong(&format!("it stands at t = {time}")));
        }
        let variables = self.model().interface().variables();
        if let Some((variable, value)) = variables.iter().zip(&values.all).find(|(v, x)| !v.kind.allows(**x)) {
            return Err(wrong(&format!("{} is {value}", variable.name)));
        }
        match values.rates.iter().position(|rate| !rate.is_finite()) {
            Some(at) => Err(wrong(&format!("the derivative of {} is {}", variables[at].name, values.rates[at]))),
            None => Ok(()),
        }
    }

    /// The model's state. Its layout depends on the parameters: the model is built with those of the snapshot while it is
    /// read.
    fn read(&mut self, values: &Values, start: f64, bytes: &[u8]) -> Result<M::State, ModelError> {
        if self.is_built_for(values, start) {
            return self.model().read_state(bytes);
        }
        let before = self.save();
        self.build_for(values, start)?;
        let state = self.model().read_state(bytes);
        self.return_to(&before)?;
        state
    }
}
