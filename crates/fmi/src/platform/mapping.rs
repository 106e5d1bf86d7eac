//! A part of shared memory in this process.

use std::io;
use std::ptr::NonNull;

use super::memory::{Shared, map, unmap};

/// A part of shared memory in this process's memory.
pub struct Mapping {
    base: NonNull<u8>,
    length: usize,
}

// SAFETY: plain memory that stays mapped as long as this lives; who reads and writes it when is the handshake's affair.
unsafe impl Send for Mapping {}
// SAFETY: as above.
unsafe impl Sync for Mapping {}

impl Mapping {
    /// `length` bytes from `offset`, both multiples of 64 KiB.
    pub fn new(memory: &Shared, offset: usize, length: usize) -> io::Result<Self> {
        Ok(Self { base: map(memory, offset, length)?, length })
    }

    /// Address of `length` bytes at `offset`; both are computed on this side, so that a place outside is a bug.
    pub fn at(&self, offset: usize, length: usize) -> *mut u8 {
        assert!(offset.checked_add(length).is_some_and(|end| end <= self.length), "outside of shared memory");
        // SAFETY: inside the mapping.
        unsafe { self.base.as_ptr().add(offset) }
    }
}

impl Drop for Mapping {
    fn drop(&mut self) {
        // SAFETY: our mapping; nobody holds a reference into it longer than this.
        unsafe { unmap(self.base, self.length) };
    }
}
