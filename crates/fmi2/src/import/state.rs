//! Saved states of an instance. The FMU's handle stays inside: outside there are slots, which are used again and again,
//! so that an FMU that overwrites (ours do) allocates nothing.

use super::error::FmuError;
use super::instance::FmuInstance;
use std::ptr;

/// A place for a saved state of one instance.
#[derive(Debug, PartialEq, Eq)]
pub struct StateSlot(usize);

impl FmuInstance {
    /// Whether states can be saved and restored, by declaration and by symbols.
    pub fn can_restore(&self) -> bool {
        let f = &self.loaded.functions;
        self.description.co_simulation.can_get_and_set_state && f.get_state.is_some() && f.set_state.is_some()
    }

    /// Whether first derivatives of inputs can be set, by declaration and by symbol.
    pub fn can_interpolate(&self) -> bool {
        self.description.co_simulation.can_interpolate_inputs && self.loaded.functions.set_input_derivatives.is_some()
    }

    /// Whether directional derivatives are given, by declaration and by symbol.
    pub fn can_derive(&self) -> bool {
        self.description.co_simulation.provides_directional_derivative
            && self.loaded.functions.directional_derivative.is_some()
    }

    /// An empty slot; it lasts as long as the instance.
    pub fn new_slot(&mut self) -> StateSlot {
        self.states.push(ptr::null_mut());
        StateSlot(self.states.len() - 1)
    }

    /// Saves into a slot, over what it held.
    ///
    /// # Errors
    /// The FMU cannot or refuses.
    pub fn save(&mut self, slot: &StateSlot) -> Result<(), FmuError> {
        let Some(get) = self.loaded.functions.get_state else { return Err(self.missing("fmi2GetFMUstate")) };
        self.tally.saves += 1;
        let mut handle = self.handle(slot)?;
        let place = &raw mut handle;
        // SAFETY: a live instance; the handle is null or of this instance.
        let saved = self.run("fmi2GetFMUstate", |_, c| unsafe { get(c, place) });
        self.states[slot.0] = handle;
        saved
    }

    /// Restores a slot, also after a failed step.
    ///
    /// # Errors
    /// Nothing was saved, or the FMU cannot or refuses.
    pub fn restore(&mut self, slot: &StateSlot) -> Result<(), FmuError> {
        let Some(set) = self.loaded.functions.set_state else { return Err(self.missing("fmi2SetFMUstate")) };
        let handle = self.saved(slot)?;
        self.tally.restores += 1;
        self.mend();
        // SAFETY: a live instance and a state of it.
        self.run("fmi2SetFMUstate", |_, c| unsafe { set(c, handle) })
    }

    /// Frees what a slot holds; the slot can be used again.
    ///
    /// # Errors
    /// The FMU cannot or refuses.
    pub fn free(&mut self, slot: &StateSlot) -> Result<(), FmuError> {
        let mut handle = self.handle(slot)?;
        let Some(free) = self.loaded.functions.free_state else { return Err(self.missing("fmi2FreeFMUstate")) };
        if handle.is_null() {
            return Ok(());
        }
        self.states[slot.0] = ptr::null_mut();
        let place = &raw mut handle;
        // SAFETY: a live instance and a state of it, freed once.
        self.run("fmi2FreeFMUstate", |_, c| unsafe { free(c, place) })
    }

    /// A saved state as bytes.
    ///
    /// # Errors
    /// Nothing was saved, or the FMU cannot or refuses.
    pub fn serialize(&mut self, slot: &StateSlot) -> Result<Vec<u8>, FmuError> {
        let f = &self.loaded.functions;
        let (Some(size_of), Some(serialize)) = (f.serialized_size, f.serialize_state) else {
            return Err(self.missing("fmi2SerializeFMUstate"));
        };
        let handle = self.saved(slot)?;
        let mut size = 0;
        let place = &raw mut size;
        // SAFETY: a live instance and a state of it.
        self.run("fmi2SerializedFMUstateSize", |_, c| unsafe { size_of(c, handle, place) })?;
        let mut bytes = vec![0_u8; size];
        let (out, size) = (bytes.as_mut_ptr().cast(), bytes.len());
        // SAFETY: a live instance, a state of it, and room for what it says it needs.
        self.run("fmi2SerializeFMUstate", |_, c| unsafe { serialize(c, handle, out, size) })?;
        Ok(bytes)
    }

    /// Fills a slot from bytes that [`FmuInstance::serialize`] gave.
    ///
    /// # Errors
    /// The FMU cannot or refuses.
    pub fn deserialize(&mut self, bytes: &[u8], slot: &StateSlot) -> Result<(), FmuError> {
        let Some(deserialize) = self.loaded.functions.deserialize_state else {
            return Err(self.missing("fmi2DeSerializeFMUstate"));
        };
        let mut handle = self.handle(slot)?;
        let place = &raw mut handle;
        // SAFETY: a live instance, the bytes, and a handle that is null or of this instance.
        let done = self.run("fmi2DeSerializeFMUstate", |_, c| unsafe {
            deserialize(c, bytes.as_ptr().cast(), bytes.len(), place)
        });
        self.states[slot.0] = handle;
        done
    }

    /// The handle in a slot, possibly null.
    fn handle(&self, slot: &StateSlot) -> Result<*mut std::ffi::c_void, FmuError> {
        self.states.get(slot.0).copied().ok_or_else(|| self.impossible("the state slot belongs to another instance"))
    }

    fn saved(&self, slot: &StateSlot) -> Result<*mut std::ffi::c_void, FmuError> {
        let handle = self.handle(slot)?;
        if handle.is_null() { Err(self.impossible("there is no saved state to use")) } else { Ok(handle) }
    }
}
