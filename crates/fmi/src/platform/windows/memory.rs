//! Shared memory: a section of the page file, mapped by both processes. It goes with the last of them, however they end.
//!
//! Its whole size is reserved at the beginning, what is mapped is committed: so it grows without moving. The other process gets
//! the section as its standard input, and the name of the bells in its environment.

use super::api::{self, Owned};
use super::word::Bells;
use std::hash::{BuildHasher, RandomState};
use std::io;
use std::os::windows::io::{AsRawHandle, BorrowedHandle};
use std::process::{Command, Stdio};
use std::ptr::NonNull;

/// Room that is reserved: more no FMU hands out at once.
const RESERVED: u64 = (1 << 32) + (1 << 24);
/// Variable with the name of the bells.
const BELLS: &str = "TTB_BELLS";

/// A section that may grow and not shrink.
pub struct Shared {
    section: Owned,
    bells: Bells,
    name: String,
}

impl Shared {
    /// A new one; its length is that of the largest mapping.
    pub fn create(_length: usize) -> io::Result<Self> {
        let (high, low, protect) = ((RESERVED >> 32) as u32, RESERVED as u32, api::PAGE_READWRITE | api::SEC_RESERVE);
        // SAFETY: memory without a file and without a name.
        let section =
            unsafe { api::CreateFileMappingW(api::INVALID, std::ptr::null(), protect, high, low, std::ptr::null()) };
        // A name that nobody can foresee: RandomState has its keys from the system.
        let name = format!("ttb-{}-{:016x}", std::process::id(), RandomState::new().hash_one(1));
        Ok(Self { section: Owned::new(section)?, bells: Bells::create(&name)?, name })
    }

    /// The one that another process gave this one as standard input, which is replaced by an empty one; nothing if it is
    /// none of ours.
    pub fn from_stdin() -> io::Result<Option<Self>> {
        let Ok(name) = std::env::var(BELLS) else { return Ok(None) };
        // SAFETY: a handle of this process, which from now on is `section`'s alone.
        let section = Owned::new(unsafe { api::GetStdHandle(api::STD_INPUT) })?;
        let empty = Box::leak(Box::new(std::fs::File::open("NUL")?));
        // SAFETY: a file that stays open.
        unsafe { api::SetStdHandle(api::STD_INPUT, empty.as_raw_handle()) };
        Ok(Some(Self { section, bells: Bells::open(&name)?, name }))
    }

    /// Gives it to a process that is going to be started.
    pub fn give_to(&self, command: &mut Command) -> io::Result<()> {
        // SAFETY: the section is open; the copy belongs to `stdin`.
        let copy = unsafe { BorrowedHandle::borrow_raw(self.section.0) }.try_clone_to_owned()?;
        command.stdin(Stdio::from(copy)).env(BELLS, &self.name);
        Ok(())
    }

    /// The bells that go with it.
    pub fn bells(&self) -> Bells {
        self.bells.clone()
    }

    /// Makes it longer: what is mapped is committed.
    pub fn grow(&self, length: usize) -> io::Result<()> {
        if length as u64 <= RESERVED { Ok(()) } else { Err(io::ErrorKind::OutOfMemory.into()) }
    }
}

/// Maps `length` bytes of the section from `offset`, and commits them.
pub fn map(memory: &Shared, offset: usize, length: usize) -> io::Result<NonNull<u8>> {
    let (access, high, low) = (api::FILE_MAP_READ | api::FILE_MAP_WRITE, (offset as u64 >> 32) as u32, offset as u32);
    // SAFETY: the system chooses the place.
    let base = unsafe { api::MapViewOfFile(memory.section.0, access, high, low, length) };
    let Some(found) = NonNull::new(base.cast()) else { return Err(io::Error::last_os_error()) };
    // SAFETY: the pages of the view; those that are committed stay as they are.
    if unsafe { api::VirtualAlloc(base, length, api::MEM_COMMIT, api::PAGE_READWRITE) }.is_null() {
        let error = io::Error::last_os_error();
        // SAFETY: just mapped, and nobody has it.
        unsafe { unmap(found, length) };
        return Err(error);
    }
    Ok(found)
}

/// Undoes [`map`].
///
/// # Safety
/// It was mapped, and nobody uses it any more.
pub unsafe fn unmap(base: NonNull<u8>, _length: usize) {
    // SAFETY: the caller's.
    unsafe { api::UnmapViewOfFile(base.as_ptr().cast()) };
}
