//! Shared memory: a file without name, mapped by both processes. It goes with the last of them, however they end.

use super::word::Bells;
use rustix::fs::{MemfdFlags, SealFlags, fcntl_add_seals, fcntl_get_seals, ftruncate, memfd_create};
use rustix::io::fcntl_dupfd_cloexec;
use rustix::mm::{MapFlags, ProtFlags, mmap, munmap};
use std::fs::File;
use std::io;
use std::os::fd::OwnedFd;
use std::process::{Command, Stdio};
use std::ptr::NonNull;

/// A file in memory that may grow and not shrink, so that touching a mapping of it never fails.
pub struct Shared(OwnedFd);

impl Shared {
    /// A new one.
    pub fn create(length: usize) -> io::Result<Self> {
        let file = memfd_create("ttb-fmu", MemfdFlags::CLOEXEC | MemfdFlags::ALLOW_SEALING)?;
        ftruncate(&file, length as u64)?;
        fcntl_add_seals(&file, SealFlags::SHRINK)?;
        Ok(Self(file))
    }

    /// The one that another process gave this one as standard input, which is replaced by an empty one; nothing if it is
    /// none of ours.
    pub fn from_stdin() -> io::Result<Option<Self>> {
        if !fcntl_get_seals(io::stdin()).is_ok_and(|seals| seals.contains(SealFlags::SHRINK)) {
            return Ok(None);
        }
        let taken = fcntl_dupfd_cloexec(io::stdin(), 3)?;
        rustix::stdio::dup2_stdin(File::open("/dev/null")?)?;
        Ok(Some(Self(taken)))
    }

    /// Gives it to a process that is going to be started, as its standard input.
    pub fn give_to(&self, command: &mut Command) -> io::Result<()> {
        command.stdin(Stdio::from(self.0.try_clone()?));
        Ok(())
    }

    /// What wakes the processes that share it.
    pub fn bells(&self) -> Bells {
        Bells
    }

    /// Makes it longer.
    pub fn grow(&self, length: usize) -> io::Result<()> {
        Ok(ftruncate(&self.0, length as u64)?)
    }
}

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
    pub fn new(file: &Shared, offset: usize, length: usize) -> io::Result<Self> {
        let (access, flags) = (ProtFlags::READ | ProtFlags::WRITE, MapFlags::SHARED);
        // SAFETY: the kernel chooses the place; the file cannot shrink below the mapping (it is sealed).
        let base = unsafe { mmap(std::ptr::null_mut(), length, access, flags, &file.0, offset as u64) }?;
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
