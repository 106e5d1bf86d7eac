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

/// Maps `length` bytes of the file from `offset`.
pub fn map(file: &Shared, offset: usize, length: usize) -> io::Result<NonNull<u8>> {
    let (access, flags) = (ProtFlags::READ | ProtFlags::WRITE, MapFlags::SHARED);
    // SAFETY: the kernel chooses the place; the file cannot shrink below the mapping (it is sealed).
    let base = unsafe { mmap(std::ptr::null_mut(), length, access, flags, &file.0, offset as u64) }?;
    NonNull::new(base.cast()).ok_or(io::ErrorKind::OutOfMemory.into())
}

/// Undoes [`map`].
///
/// # Safety
/// It was mapped with this length, and nobody uses it any more.
pub unsafe fn unmap(base: NonNull<u8>, length: usize) {
    // SAFETY: the caller's.
    let _ = unsafe { munmap(base.as_ptr().cast(), length) };
}
