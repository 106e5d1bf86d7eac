//! Windows: paths are UTF-16 outside and UTF-8 in FMI, libraries are opened with the search path of their own folder, a process
//! may end without telling its libraries.

#[cfg_attr(not(feature = "import"), allow(dead_code))] // an FMU itself asks for its own path alone
mod api;
#[cfg(feature = "import")]
mod files;
#[cfg(feature = "import")]
pub mod memory;
#[cfg(feature = "import")]
pub mod process;
#[cfg(feature = "import")]
mod running;
#[cfg(feature = "import")]
pub mod word;

use std::borrow::Cow;
use std::ffi::OsString;
use std::os::windows::ffi::OsStringExt;
use std::path::{Path, PathBuf};

#[cfg(feature = "import")]
pub use files::*;
#[cfg(feature = "import")]
pub use running::*;

/// The path these bytes mean: UTF-8, as FMI has it. `/C:/folder`, the path of a URI, loses its first slash.
pub fn path(bytes: &[u8]) -> Cow<'_, Path> {
    let bytes = match bytes {
        [b'/', rest @ ..] if rest.get(1) == Some(&b':') => rest,
        _ => bytes,
    };
    match String::from_utf8_lossy(bytes) {
        Cow::Borrowed(text) => Cow::Borrowed(Path::new(text)),
        Cow::Owned(text) => Cow::Owned(text.into()),
    }
}

/// A path as bytes.
pub fn bytes(path: &Path) -> &[u8] {
    path.as_os_str().as_encoded_bytes()
}

/// Whether a URI `file://HOST/…` may name a folder of another machine, `//HOST/…`.
pub const NETWORK_PATHS: bool = true;

/// The library file that the code at an address was loaded from.
pub fn library_of(code: usize) -> Option<PathBuf> {
    let (mut module, mut name) = (std::ptr::null_mut(), vec![0_u16; 1 << 15]);
    let flags = api::BY_ADDRESS | api::UNCOUNTED;
    // SAFETY: the address is only looked up; `module` is a place for the answer.
    if unsafe { api::GetModuleHandleExW(flags, code as *const u16, &raw mut module) } == 0 {
        return None;
    }
    // SAFETY: a module of this process, and room for as many letters as said.
    let length = unsafe { api::GetModuleFileNameW(module, name.as_mut_ptr(), name.len() as u32) } as usize;
    (length > 0 && length < name.len()).then(|| OsString::from_wide(&name[..length]).into())
}
