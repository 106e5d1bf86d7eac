//! Saved states of an instance. The FMU's handle stays inside: outside there are slots, which are used again and again,
//! so that an FMU that overwrites (ours do) allocates nothing.

use super::life::{FmuInstance, Saved};
use crate::error::FmuError;
use crate::slave::Call;

/// A place for a saved state of one instance.
#[derive(Debug, PartialEq, Eq)]
pub struct StateSlot(usize);

impl FmuInstance {
    /// Whether states can be saved and restored, by declaration and by symbols.
    pub fn can_restore(&self) -> bool {
        let there = self.slave.has(Call::GetState) && self.slave.has(Call::SetState);
        self.description.co_simulation.can_get_and_set_state && there
    }

    /// Whether first derivatives of inputs can be set, by declaration and by symbol.
    pub fn can_interpolate(&self) -> bool {
        self.description.co_simulation.can_interpolate_inputs && self.slave.has(Call::SetInputDerivatives)
    }

    /// Whether directional derivatives are given, by declaration and by symbol.
    pub fn can_derive(&self) -> bool {
        let declared = self.description.co_simulation.provides_directional_derivative;
        declared && self.slave.has(Call::DirectionalDerivative)
    }

    /// An empty slot; it lasts as long as the instance.
    pub fn new_slot(&mut self) -> StateSlot {
        self.states.push(Saved::default());
        StateSlot(self.states.len() - 1)
    }

    /// Saves into a slot, over what it held.
    ///
    /// # Errors
    /// The FMU cannot or refuses.
    pub fn save(&mut self, slot: &StateSlot) -> Result<(), FmuError> {
        self.needs(Call::GetState)?;
        self.tally.saves += 1;
        let mut handle = self.content(slot)?.handle;
        let saved = self.run(Call::GetState, |slave| slave.get_state(&mut handle));
        self.states[slot.0] = Saved { handle, time: self.time };
        saved
    }

    /// Restores a slot, also after a failed step.
    ///
    /// # Errors
    /// Nothing was saved, or the FMU cannot or refuses.
    pub fn restore(&mut self, slot: &StateSlot) -> Result<(), FmuError> {
        self.needs(Call::SetState)?;
        let Saved { handle, time } = self.saved(slot)?;
        self.tally.restores += 1;
        self.mend();
        self.time = time;
        self.run(Call::SetState, |slave| slave.set_state(handle))
    }

    /// Frees what a slot holds; the slot can be used again.
    ///
    /// # Errors
    /// The FMU cannot or refuses.
    pub fn free(&mut self, slot: &StateSlot) -> Result<(), FmuError> {
        let mut handle = self.content(slot)?.handle;
        self.needs(Call::FreeState)?;
        if handle == 0 {
            return Ok(());
        }
        self.states[slot.0].handle = 0;
        self.run(Call::FreeState, |slave| slave.free_state(&mut handle))
    }

    /// A saved state as bytes.
    ///
    /// # Errors
    /// Nothing was saved, or the FMU cannot or refuses.
    pub fn serialize(&mut self, slot: &StateSlot) -> Result<Vec<u8>, FmuError> {
        self.needs(Call::Serialize)?;
        let handle = self.saved(slot)?.handle;
        let mut bytes = Vec::new();
        self.run(Call::Serialize, |slave| slave.serialize(handle, &mut bytes)).map(|()| bytes)
    }

    /// Fills a slot from bytes that [`FmuInstance::serialize`] gave.
    ///
    /// # Errors
    /// The FMU cannot or refuses.
    pub fn deserialize(&mut self, bytes: &[u8], slot: &StateSlot) -> Result<(), FmuError> {
        self.needs(Call::Deserialize)?;
        let mut handle = self.content(slot)?.handle;
        let done = self.run(Call::Deserialize, |slave| slave.deserialize(bytes, &mut handle));
        self.states[slot.0] = Saved { handle, time: self.time };
        done
    }

    /// What is in a slot, possibly nothing.
    fn content(&self, slot: &StateSlot) -> Result<Saved, FmuError> {
        self.states.get(slot.0).copied().ok_or_else(|| self.impossible("the state slot belongs to another instance"))
    }

    fn saved(&self, slot: &StateSlot) -> Result<Saved, FmuError> {
        let saved = self.content(slot)?;
        if saved.handle == 0 { Err(self.impossible("there is no saved state to use")) } else { Ok(saved) }
    }
}
