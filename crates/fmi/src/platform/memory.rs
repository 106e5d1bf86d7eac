//! Shared memory: a file without name, mapped by both processes. It goes with the last of them, however they end.

use rustix::fs::{MemfdFlags, SealFlags, fcntl_add_seals, fcntl_get_seals, ftruncate, memfd_create};
use rustix::mm::{MapFlags, ProtFlags, mmap, munmap};
use std::io;
use std::os::fd::{AsFd, OwnedFd};
use std::ptr::NonNull;

/// A part of the file in this process's memory.
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
    pub fn new(file: impl AsFd, offset: usize, length: usize) -> io::Result<Self> {
        let (access, flags) = (ProtFlags::READ | ProtFlags::WRITE, MapFlags::SHARED);
        // SAFETY: the kernel chooses the place; the file cannot shrink below the mapping (it is sealed).
        let base = unsafe { mmap(std::ptr::null_mut(), length, access, flags, file, offset as u64) }?;
        let base = NonNull::new(base.cast()).ok_or(io::ErrorKind::OutOfMemory)?;
        Ok(Self { base, length })
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
        let _ = unsafe { munmap(self.base.as_ptr().cast(), self.length) };
    }
}

/// A file in memory that may grow and not shrink, so that touching a mapping of it never fails.
pub fn create(length: usize) -> io::Result<OwnedFd> {
    let file = memfd_create("ttb-fmu", MemfdFlags::CLOEXEC | MemfdFlags::ALLOW_SEALING)?;
    ftruncate(&file, length as u64)?;
    fcntl_add_seals(&file, SealFlags::SHRINK)?;
    Ok(file)
}

/// Whether a file is one of those.
pub fn is_ours(file: impl AsFd) -> bool {
    fcntl_get_seals(file).is_ok_and(|seals| seals.contains(SealFlags::SHRINK))
}

/// Makes the file longer.
pub fn grow(file: impl AsFd, length: usize) -> io::Result<()> {
    Ok(ftruncate(file, length as u64)?)
}
