//! Unix: paths are bytes, libraries are opened by `dlopen`, a process may end without its exit handlers.

use std::borrow::Cow;
use std::ffi::OsStr;
use std::os::unix::ffi::OsStrExt;
use std::path::{Path, PathBuf};

/// The path these bytes mean.
pub fn path(bytes: &[u8]) -> Cow<'_, Path> {
    Cow::Borrowed(Path::new(OsStr::from_bytes(bytes)))
}

/// Whether a URI `file://HOST/…` may name a folder of another machine.
pub const NETWORK_PATHS: bool = false;

/// A path as bytes.
pub fn bytes(path: &Path) -> &[u8] {
    path.as_os_str().as_bytes()
}

/// The library file that the code at an address was loaded from, by the memory map of this process (no library call beyond
/// libc is needed for it). Nothing where the map cannot be read.
pub fn library_of(code: usize) -> Option<PathBuf> {
    let map = std::fs::read("/proc/self/maps").unwrap_or_default();
    map.split(|b| *b == b'\n').find_map(|line| library_at(line, code))
}

/// The file of one line `from-to rwxp offset device inode   /path` of the map, if `code` lies in it.
fn library_at(line: &[u8], code: usize) -> Option<PathBuf> {
    let range = std::str::from_utf8(line.split(|b| *b == b' ').next()?).ok()?;
    let (from, to) = range.split_once('-')?;
    let (from, to) = (usize::from_str_radix(from, 16).ok()?, usize::from_str_radix(to, 16).ok()?);
    let start = line.iter().position(|b| *b == b'/')?;
    (from..to).contains(&code).then(|| path(&line[start..]).into_owned())
}

#[cfg(feature = "import")]
pub use import::*;

#[cfg(feature = "import")]
mod import {
    use libloading::os::unix::{RTLD_GLOBAL, RTLD_LOCAL, RTLD_NOW};
    use std::ffi::c_int;
    use std::fs::File;
    use std::io;
    use std::os::unix::fs::{FileExt, MetadataExt};
    use std::path::Path;

    /// A loaded library; dropping it unloads it.
    pub type Library = libloading::os::unix::Library;

    /// Loads a library with all it needs at once; `global`: others find its symbols. The error is what the loader says.
    pub(crate) fn open_library(path: &Path, global: bool) -> Result<Library, String> {
        let scope = if global { RTLD_GLOBAL } else { RTLD_LOCAL };
        // SAFETY: loading foreign code is what an importer is for: the user chose this library and trusts it to run.
        let opened = unsafe { Library::open(Some(path), RTLD_NOW | scope) };
        opened.map_err(|e| {
            let message = std::error::Error::source(&e).map_or_else(|| e.to_string(), ToString::to_string);
            message.strip_prefix(&format!("{}: ", path.display())).map_or(message.clone(), str::to_string)
        })
    }

    unsafe extern "C" {
        fn ttb_exit_now(code: c_int) -> !;
        fn signal(number: c_int, handler: usize) -> usize;
    }

    /// Variables that name the temporary folder.
    pub const TEMPORARY_VARIABLES: &[&str] = &["TMPDIR"];

    /// Seconds of CPU that this process has taken so far, all threads.
    pub fn cpu() -> f64 {
        let now = rustix::time::clock_gettime(rustix::time::ClockId::ProcessCPUTime);
        now.tv_sec as f64 + 1e-9 * now.tv_nsec as f64
    }

    /// Memory of this process, kB; 0 where the kernel does not tell.
    pub fn resident() -> f64 {
        let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
        let line = status.lines().find_map(|line| line.strip_prefix("VmRSS:"));
        line.and_then(|line| line.split_whitespace().next()?.parse().ok()).unwrap_or(0.0)
    }

    /// Which file it is: equal for two handles of the same one.
    ///
    /// # Errors
    /// The system does not tell.
    pub fn identity(file: &File) -> io::Result<(u64, u64)> {
        file.metadata().map(|found| (found.dev(), found.ino()))
    }

    /// Writes at the beginning of a file.
    ///
    /// # Errors
    /// The system does not take it.
    pub fn write_at_begin(file: &File, bytes: &[u8]) -> io::Result<usize> {
        file.write_at(bytes, 0)
    }

    /// A folder under another name.
    ///
    /// # Errors
    /// It cannot be linked.
    pub fn link_folder(folder: &Path, name: &Path) -> io::Result<()> {
        std::os::unix::fs::symlink(folder, name)
    }

    /// A new folder that only this user may enter.
    pub(crate) fn create_private_folder(path: &Path) -> std::io::Result<()> {
        std::os::unix::fs::DirBuilderExt::mode(&mut std::fs::DirBuilder::new(), 0o700).create(path)
    }

    /// A group of its own keeps Ctrl-C from a process.
    pub(crate) fn in_own_group(command: &mut std::process::Command) {
        std::os::unix::process::CommandExt::process_group(command, 0);
    }

    /// All that the parent process writes into standard input until it is gone.
    #[cfg(not(target_os = "linux"))]
    pub(crate) fn read_until_parent_is_gone(_parent: Option<u32>) -> std::io::Result<Vec<u8>> {
        let mut read = Vec::new();
        std::io::Read::read_to_end(&mut std::io::stdin(), &mut read).map(|_| read)
    }

    /// Ends the process without exit handlers and destructors of libraries; what C code has printed is written first.
    pub(crate) fn exit_now(code: u8) -> ! {
        // SAFETY: takes any code and never returns.
        unsafe { ttb_exit_now(c_int::from(code)) }
    }

    /// A descriptor that nothing needs: who finds it closed knows that foreign code closes what is not its own. −1 if there is
    /// none to be had.
    pub(crate) fn sentinel() -> c_int {
        std::fs::File::open("/dev/null").map_or(-1, std::os::fd::IntoRawFd::into_raw_fd)
    }

    /// Makes this process deaf to what users and batch systems end programs with: SIGHUP, SIGINT, SIGTERM.
    pub(crate) fn ignore_requests_to_end() {
        const IGNORE: usize = 1;
        for number in [1, 2, 15] {
            // SAFETY: the numbers are those of POSIX, and SIG_IGN, which is 1, is a handler for each.
            unsafe { signal(number, IGNORE) };
        }
    }
}
