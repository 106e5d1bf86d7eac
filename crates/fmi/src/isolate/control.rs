//! The part of the shared memory that stays where it is: request, reply, and the log.

use crate::log::{KEPT, LogTarget, Message};
use crate::platform::mapping::Mapping;
use crate::platform::memory::Shared;
use crate::status::Status;
use std::io;
use std::sync::atomic::{AtomicU32, AtomicU64, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

/// Begin of the payload; a multiple of 64 KiB, the largest page size there is.
pub const CONTROL: usize = 14 << 16;
/// Begin of the log.
const LOG: usize = 4096;
/// Distinguishes this layout from others.
pub const MARK: u64 = u64::from_le_bytes(*b"ttb-fmu1");

const _: () = assert!(LOG + KEPT * size_of::<Entry>() <= CONTROL && size_of::<Header>() <= LOG);

/// What one process tells the other: a cache line that only one of them writes.
#[repr(C, align(64))]
pub struct Side {
    /// Number of the latest message; the other process waits for it to change.
    pub word: AtomicU32,
    /// Not 0: the writer sleeps and wants to be woken when the other's word changes.
    pub parked: AtomicU32,
    /// A request's [`super::call::Op`], a reply's status.
    pub code: AtomicU32,
    /// A request's number of posted requests, a reply's number of warnings they gave.
    pub posted: AtomicU32,
    /// Arguments or results; a reply's are the time inside the FMU in ns, the result, and where it is ([`progress`]).
    pub numbers: [AtomicU64; 6],
}

/// Place of a reply's progress among its numbers.
pub const PROGRESS: usize = 2;
/// Requests that can be posted to go with the next one.
pub const POSTED: usize = 8;

/// A request that waits for the next one.
#[repr(C)]
pub struct Posted {
    pub code: AtomicU32,
    unused: u32,
    pub numbers: [AtomicU64; 6],
}

/// What the host is at: request `n`, its posted request `i` or, behind them, itself.
pub fn progress(n: u32, i: usize) -> u64 {
    u64::from(n) << 8 | i as u64
}

/// The first page.
#[repr(C)]
pub struct Header {
    /// Written by the master.
    pub request: Side,
    /// Written by the host.
    pub reply: Side,
    /// Written by the master.
    pub posted: [Posted; POSTED],
    /// Messages the FMU has logged so far.
    logged: AtomicU64,
    mark: AtomicU64,
}

/// A logged message; the log keeps as many of them as a [`crate::log::Sink`].
#[repr(C)]
struct Entry {
    status: i32,
    category_length: u32,
    text_length: u32,
    unused: u32,
    category: [u8; 240],
    text: [u8; 4096],
}

/// The mapped control part.
#[derive(Clone)]
pub struct Control(Arc<Mapping>);

impl Control {
    /// Maps it.
    pub fn new(file: &Shared) -> io::Result<Self> {
        Ok(Self(Arc::new(Mapping::new(file, 0, CONTROL)?)))
    }

    /// Its header.
    pub fn header(&self) -> &Header {
        let header: *const Header = self.0.at(0, size_of::<Header>()).cast();
        // SAFETY: atomics in memory that starts as zeros and lives as long as `self`; whatever is in them is a number.
        unsafe { &*header }
    }

    /// Signs it as ours.
    pub fn sign(&self) {
        self.header().mark.store(MARK, Ordering::Release);
    }

    /// Whether it is signed.
    pub fn is_signed(&self) -> bool {
        self.header().mark.load(Ordering::Acquire) == MARK
    }

    /// Messages logged so far.
    pub fn logged(&self) -> u64 {
        self.header().logged.load(Ordering::Acquire)
    }

    fn entry(&self, n: u64) -> *mut Entry {
        let place = LOG + (n % KEPT as u64) as usize * size_of::<Entry>();
        self.0.at(place, size_of::<Entry>()).cast()
    }

    /// Message `n`, if it is one of the last [`KEPT`]. An FMU that logs from a thread of its own may be writing it.
    pub fn message(&self, n: u64) -> Message {
        // SAFETY: inside the mapping; any bits are an entry. It is copied before anything in it is believed.
        let entry = unsafe { std::ptr::read_volatile(self.entry(n)) };
        let text = |bytes: &[u8], length: u32| {
            String::from_utf8_lossy(&bytes[..bytes.len().min(length as usize)]).into_owned()
        };
        Message {
            status: Status::from_c(entry.status),
            category: text(&entry.category, entry.category_length),
            text: text(&entry.text, entry.text_length),
        }
    }
}

/// The host's log target: writes straight into shared memory, so that a message outlives a crash right after it.
pub struct Ring {
    control: Control,
    lock: Mutex<()>,
}

impl Ring {
    /// For the log in `control`.
    pub fn new(control: Control) -> Arc<Self> {
        Arc::new(Self { control, lock: Mutex::new(()) })
    }
}

impl LogTarget for Ring {
    fn write(&self, status: Status, category: &[u8], text: &[u8]) {
        let _guard = self.lock.lock().unwrap_or_else(PoisonError::into_inner);
        let n = self.control.logged();
        let entry = self.control.entry(n);
        // SAFETY: inside the mapping, and the lock keeps others from it; the parts are copied within their bounds.
        unsafe {
            let (category_length, text_length) = (category.len().min(240), text.len().min(4096));
            (*entry).status = status as i32;
            (*entry).category_length = category_length as u32;
            (*entry).text_length = text_length as u32;
            (&raw mut (*entry).category).cast::<u8>().copy_from_nonoverlapping(category.as_ptr(), category_length);
            (&raw mut (*entry).text).cast::<u8>().copy_from_nonoverlapping(text.as_ptr(), text_length);
        }
        self.control.header().logged.store(n + 1, Ordering::Release);
    }
}
