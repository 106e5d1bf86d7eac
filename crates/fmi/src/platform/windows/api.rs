//! The functions of Windows that are used, as its headers declare them. Handles are pointers, answers 0 where a call failed.
#![allow(non_snake_case, clippy::upper_case_acronyms)]

use std::ffi::c_void;

pub type Handle = *mut c_void;
pub const INVALID: Handle = -1_isize as Handle;

// GetModuleHandleExW
pub const BY_ADDRESS: u32 = 4;
pub const UNCOUNTED: u32 = 2;
// File mappings and memory
pub const PAGE_READWRITE: u32 = 4;
pub const SEC_RESERVE: u32 = 0x0400_0000;
pub const FILE_MAP_WRITE: u32 = 2;
pub const FILE_MAP_READ: u32 = 4;
pub const MEM_COMMIT: u32 = 0x1000;
// Processes
pub const SYNCHRONIZE: u32 = 0x0010_0000;
pub const QUERY_LIMITED: u32 = 0x1000;
pub const INFINITE: u32 = u32::MAX;
pub const EVENT_ALL_ACCESS: u32 = 0x001F_0003;
pub const STD_INPUT: u32 = -10_i32 as u32;
pub const DETACHED: u32 = 8;
pub const NO_WINDOW: u32 = 0x0800_0000;
// Job objects
pub const JOB_BASIC_PROCESS_ID_LIST: u32 = 3;
pub const JOB_EXTENDED_LIMITS: u32 = 9;
pub const KILL_ON_CLOSE: u32 = 0x2000;

#[repr(C)]
#[derive(Default)]
pub struct FileInformation {
    pub attributes: u32,
    pub times: [u32; 6],
    pub volume: u32,
    pub size: [u32; 2],
    pub links: u32,
    pub index: [u32; 2],
}

#[repr(C)]
#[derive(Default)]
pub struct MemoryCounters {
    pub size: u32,
    pub faults: u32,
    pub peak_working_set: usize,
    pub working_set: usize,
    pub others: [usize; 6],
}

/// JOBOBJECT_EXTENDED_LIMIT_INFORMATION.
#[repr(C)]
#[derive(Default)]
pub struct JobLimits {
    pub times: [i64; 2],
    pub flags: u32,
    pub working_set: [usize; 2],
    pub processes: u32,
    pub affinity: usize,
    pub classes: [u32; 2],
    pub transfers: [u64; 6],
    pub memory: [usize; 4],
}

/// JOBOBJECT_BASIC_PROCESS_ID_LIST, for so many processes.
#[repr(C)]
pub struct JobProcesses {
    pub assigned: u32,
    pub listed: u32,
    pub ids: [usize; 256],
}

pub type ConsoleHandler = unsafe extern "system" fn(u32) -> i32;

#[link(name = "kernel32")]
unsafe extern "system" {
    pub fn GetModuleHandleExW(flags: u32, name: *const u16, module: *mut Handle) -> i32;
    pub fn GetModuleFileNameW(module: Handle, name: *mut u16, size: u32) -> u32;
    pub fn CreateFileMappingW(
        file: Handle,
        security: *const c_void,
        protect: u32,
        high: u32,
        low: u32,
        name: *const u16,
    ) -> Handle;
    pub fn MapViewOfFile(mapping: Handle, access: u32, high: u32, low: u32, length: usize) -> *mut c_void;
    pub fn UnmapViewOfFile(view: *const c_void) -> i32;
    pub fn VirtualAlloc(address: *mut c_void, length: usize, kind: u32, protect: u32) -> *mut c_void;
    pub fn CreateEventW(security: *const c_void, manual: i32, set: i32, name: *const u16) -> Handle;
    pub fn OpenEventW(access: u32, inherit: i32, name: *const u16) -> Handle;
    pub fn SetEvent(event: Handle) -> i32;
    pub fn WaitForSingleObject(handle: Handle, milliseconds: u32) -> u32;
    pub fn OpenProcess(access: u32, inherit: i32, id: u32) -> Handle;
    pub fn QueryFullProcessImageNameW(process: Handle, flags: u32, name: *mut u16, size: *mut u32) -> i32;
    pub fn CloseHandle(handle: Handle) -> i32;
    pub fn GetStdHandle(which: u32) -> Handle;
    pub fn SetStdHandle(which: u32, handle: Handle) -> i32;
    pub fn SetConsoleCtrlHandler(handler: Option<ConsoleHandler>, add: i32) -> i32;
    pub fn GetCurrentProcess() -> Handle;
    pub fn GetProcessTimes(
        process: Handle,
        creation: *mut u64,
        exit: *mut u64,
        kernel: *mut u64,
        user: *mut u64,
    ) -> i32;
    pub fn K32GetProcessMemoryInfo(process: Handle, counters: *mut MemoryCounters, size: u32) -> i32;
    pub fn GetFileInformationByHandle(file: Handle, information: *mut FileInformation) -> i32;
    pub fn CreateJobObjectW(security: *const c_void, name: *const u16) -> Handle;
    pub fn SetInformationJobObject(job: Handle, class: u32, information: *const c_void, length: u32) -> i32;
    pub fn QueryInformationJobObject(
        job: Handle,
        class: u32,
        information: *mut c_void,
        length: u32,
        used: *mut u32,
    ) -> i32;
    pub fn AssignProcessToJobObject(job: Handle, process: Handle) -> i32;
    pub fn TerminateJobObject(job: Handle, code: u32) -> i32;
}

/// A text as Windows takes it.
pub fn wide(text: &str) -> Vec<u16> {
    text.encode_utf16().chain([0]).collect()
}

/// A handle that is closed when it is dropped.
pub struct Owned(pub Handle);

// SAFETY: handles of kernel objects may be used by any thread.
unsafe impl Send for Owned {}
// SAFETY: as above.
unsafe impl Sync for Owned {}

impl Owned {
    /// What a function of Windows gave.
    ///
    /// # Errors
    /// It gave none.
    pub fn new(handle: Handle) -> std::io::Result<Self> {
        if handle.is_null() || handle == INVALID { Err(std::io::Error::last_os_error()) } else { Ok(Self(handle)) }
    }
}

impl Drop for Owned {
    fn drop(&mut self) {
        // SAFETY: ours alone.
        unsafe { CloseHandle(self.0) };
    }
}
