//! FMU states: saved, restored, freed, serialized.
//!
//! The handle of a state is the address of its box, but it is only ever *compared*, never followed: a stale or foreign
//! handle is refused instead of read. What a state holds: [`super::saved`].

use super::component::Component;
use super::guard::{Call, DONE, guard, place, refuse, slice, slice_mut};
use super::saved::{Progress, SavedState};
use super::stage::{ALWAYS, READABLE, Stage, USABLE};
use crate::types::*;
use ttb_contract::bytes::sum;
use ttb_contract::{Model, ModelError};

/// Mark and version of the serialized form; the total length in bytes (u64) follows, then the GUID, then the sum of
/// all that is behind it: stop time and stage are not under the sum of the instance's own bytes.
const MARK: &[u8; 8] = b"ttbfmu03";
const GUID_LENGTH: usize = 38;
const SUM: usize = MARK.len() + 8 + GUID_LENGTH;
const HEAD: usize = SUM + 8;
const PROGRESS: usize = 2 * 8 + 2;
/// A failed step or a panic leaves nothing worth saving.
const SAVEABLE: u8 = USABLE | Stage::Terminated as u8;

impl<M: Model> Component<M> {
    fn find(&self, handle: fmi2FMUstate) -> Result<usize, ModelError> {
        let found = self.states.iter().position(|s| std::ptr::eq(&raw const **s, handle.cast()));
        found.ok_or_else(|| {
            ModelError("this FMU state was not saved by this instance, or was freed; begin with a NULL handle".into())
        })
    }

    /// Keeps a state, in the place of the one that `handle` names unless that is null, and names it.
    fn keep(&mut self, handle: &mut fmi2FMUstate, state: SavedState<M>) -> Result<(), ModelError> {
        if handle.is_null() {
            let mut state = Box::new(state);
            *handle = (&raw mut *state).cast();
            self.states.push(state);
        } else {
            let index = self.find(*handle)?;
            *self.states[index] = state;
        }
        Ok(())
    }

    fn serialize(&self, state: &SavedState<M>) -> Vec<u8> {
        let Progress { start, stop, terminated } = state.progress;
        let mut bytes = MARK.to_vec();
        bytes.extend([0; 8]); // the length, known at the end
        bytes.extend(self.guid.as_bytes());
        bytes.extend([0; HEAD - SUM]); // the sum, at the very end
        for x in [start, stop.unwrap_or(0.0)] {
            bytes.extend(x.to_le_bytes());
        }
        bytes.extend([stop.is_some(), terminated].map(u8::from));
        bytes.extend(self.instance.to_bytes(&state.snapshot));
        let length = bytes.len() as u64;
        bytes[MARK.len()..MARK.len() + 8].copy_from_slice(&length.to_le_bytes());
        let sum = sum(&bytes[HEAD..]);
        bytes[SUM..HEAD].copy_from_slice(&sum.to_le_bytes());
        bytes
    }

    fn deserialize(&mut self, bytes: &[u8]) -> Result<SavedState<M>, ModelError> {
        let wrong = |what: &str| Err(ModelError(format!("the serialized FMU state cannot be read: {what}")));
        if bytes.len() < HEAD + PROGRESS || !bytes.starts_with(MARK) {
            return wrong("it does not begin with this program's mark and version");
        }
        let number = |at: usize| std::array::from_fn(|i| bytes[at + i]);
        let length = u64::from_le_bytes(number(MARK.len()));
        if length != bytes.len() as u64 {
            return wrong(&format!("it has {} bytes, not the {length} that it was written with", bytes.len()));
        }
        if &bytes[SUM - GUID_LENGTH..SUM] != self.guid.as_bytes() {
            return wrong("it belongs to an FMU with another GUID");
        }
        if u64::from_le_bytes(number(SUM)) != sum(&bytes[HEAD..]) {
            return wrong("its sum does not fit its bytes: it was damaged");
        }
        let real = |i: usize| f64::from_le_bytes(number(HEAD + 8 * i));
        let [has_stop, terminated] = [bytes[HEAD + 16] != 0, bytes[HEAD + 17] != 0];
        let progress = Progress { start: real(0), stop: has_stop.then_some(real(1)), terminated };
        let snapshot = self.instance.from_bytes(&bytes[HEAD + PROGRESS..])?;
        Ok(SavedState { snapshot, progress })
    }
}

/// Saves the instance; into an existing state without allocating.
///
/// # Safety
/// As [`guard`]; `state` leads to a handle that is null or came from this instance.
pub unsafe fn get_state<M: Model>(c: fmi2Component, state: *mut fmi2FMUstate) -> fmi2Status {
    let work = |c: &mut Component<M>| {
        // SAFETY: by contract.
        let handle = unsafe { place(state) }?;
        if handle.is_null() {
            c.keep(handle, SavedState { snapshot: c.instance.save(), progress: c.progress })?;
        } else {
            let index = c.find(*handle)?;
            let saved = &mut c.states[index];
            c.instance.save_into(&mut saved.snapshot);
            saved.progress = c.progress;
        }
        DONE
    };
    // SAFETY: by contract.
    unsafe { guard::<M>(c, Call { name: "fmi2GetFMUstate", allowed: SAVEABLE }, work) }
}

/// Restores a state, also after a failed step or a panic.
///
/// # Safety
/// As [`guard`].
pub unsafe fn set_state<M: Model>(c: fmi2Component, state: fmi2FMUstate) -> fmi2Status {
    let work = |c: &mut Component<M>| {
        let saved = &c.states[c.find(state)?];
        c.step_failed = true; // should restoring fail half-way
        c.instance.restore(&saved.snapshot)?;
        c.progress = saved.progress;
        (c.step_failed, c.panicked) = (false, false);
        DONE
    };
    // SAFETY: by contract.
    unsafe { guard::<M>(c, Call { name: "fmi2SetFMUstate", allowed: ALWAYS }, work) }
}

/// Frees a state and sets its handle to null; a null handle is fine.
///
/// # Safety
/// As [`guard`]; `state` is null or leads to a handle.
pub unsafe fn free_state<M: Model>(c: fmi2Component, state: *mut fmi2FMUstate) -> fmi2Status {
    let work = |c: &mut Component<M>| {
        // SAFETY: by contract.
        let Some(handle) = (unsafe { state.as_mut() }) else { return DONE };
        if !handle.is_null() {
            c.states.swap_remove(c.find(*handle)?);
            *handle = std::ptr::null_mut();
        }
        DONE
    };
    // SAFETY: by contract.
    unsafe { guard::<M>(c, Call { name: "fmi2FreeFMUstate", allowed: ALWAYS }, work) }
}

/// Length of the serialized form in bytes.
///
/// # Safety
/// As [`guard`]; `size` leads to a place for the result.
pub unsafe fn serialized_size<M: Model>(c: fmi2Component, state: fmi2FMUstate, size: *mut usize) -> fmi2Status {
    let work = |c: &mut Component<M>| {
        // SAFETY: by contract.
        *unsafe { place(size) }? = c.serialize(&c.states[c.find(state)?]).len();
        DONE
    };
    // SAFETY: by contract.
    unsafe { guard::<M>(c, Call { name: "fmi2SerializedFMUstateSize", allowed: READABLE }, work) }
}

/// Writes a state into `size` bytes.
///
/// # Safety
/// As [`guard`]; `bytes` leads to `size` bytes.
pub unsafe fn serialize_state<M: Model>(
    c: fmi2Component,
    state: fmi2FMUstate,
    bytes: *mut fmi2Byte,
    size: usize,
) -> fmi2Status {
    let work = |c: &mut Component<M>| {
        let serialized = c.serialize(&c.states[c.find(state)?]);
        // SAFETY: by contract.
        let bytes = unsafe { slice_mut(bytes.cast::<u8>(), size) }?;
        let Some(room) = bytes.get_mut(..serialized.len()) else {
            return refuse(format!("the state needs {} bytes, {size} were offered", serialized.len()));
        };
        room.copy_from_slice(&serialized);
        DONE
    };
    // SAFETY: by contract.
    unsafe { guard::<M>(c, Call { name: "fmi2SerializeFMUstate", allowed: READABLE }, work) }
}

/// Makes a state of what [`serialize_state`] wrote, in this or another instance of the same FMU.
///
/// # Safety
/// As [`guard`]; `bytes` leads to `size` bytes, `state` to a handle that is null or came from this instance.
pub unsafe fn deserialize_state<M: Model>(
    c: fmi2Component,
    bytes: *const fmi2Byte,
    size: usize,
    state: *mut fmi2FMUstate,
) -> fmi2Status {
    let work = |c: &mut Component<M>| {
        // SAFETY: by contract.
        let (bytes, handle) = unsafe { (slice(bytes.cast::<u8>(), size)?, place(state)?) };
        let state = c.deserialize(bytes)?;
        c.keep(handle, state)?;
        DONE
    };
    // SAFETY: by contract.
    unsafe { guard::<M>(c, Call { name: "fmi2DeSerializeFMUstate", allowed: SAVEABLE }, work) }
}
