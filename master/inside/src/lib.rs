//! Puts the FMUs' shared libraries into the program while it is compiled, so that one file is all there is to install.
//!
//! ```text
//!  cargo build                     deps/libfmu_bridge.so, deps/libfmu_train_track.so, as they have just been linked
//!  TTB_LIBRARIES=FILE cargo build  the archive FILE: binaries/linux64/Bridge.so, binaries/win64/Bridge.dll, …, compressed
//! ```
//!
//! Why a macro: `include_bytes!` alone fails where nothing is linked (`cargo check`), and a build script runs before the
//! libraries are there. The crate that uses this macro depends on both FMU crates, and cargo compiles it once they are
//! linked.

use proc_macro::TokenStream;
use std::env::{consts, var};
use std::path::Path;

/// Model identifier and crate of each FMU.
const FMUS: [(&str, &str); 2] = [("TrainTrack", "fmu_train_track"), ("Bridge", "fmu_bridge")];

/// A value of `Inside`, a type in scope with the variants `Archive(&[u8])`, `Here(&[(&str, &[u8])])` and `Nothing`. The build
/// script says where to look: `TTB_INSIDE_ARCHIVE`, or `TTB_INSIDE_FOLDER` for a system with the library names
/// `TTB_INSIDE_PREFIX` and `TTB_INSIDE_SUFFIX`.
#[proc_macro]
pub fn libraries(_: TokenStream) -> TokenStream {
    let said = |name: &str, otherwise: &str| var(name).unwrap_or_else(|_| otherwise.to_string());
    let archive = said("TTB_INSIDE_ARCHIVE", "");
    let folder = said("TTB_INSIDE_FOLDER", "");
    let (prefix, suffix) =
        (said("TTB_INSIDE_PREFIX", consts::DLL_PREFIX), said("TTB_INSIDE_SUFFIX", consts::DLL_SUFFIX));
    let libraries = FMUS.map(|(fmu, name)| (fmu, Path::new(&folder).join(format!("{prefix}{name}{suffix}"))));
    let text = if !archive.is_empty() {
        format!("Inside::Archive(include_bytes!({archive:?}))")
    } else if libraries.iter().all(|(_, path)| path.is_file()) {
        let entries = libraries
            .map(|(fmu, path)| format!("({fmu:?}, include_bytes!({:?}) as &[u8])", path.display().to_string()));
        format!("Inside::Here(&[{}])", entries.join(", "))
    } else {
        "Inside::Nothing".to_string()
    };
    text.parse().unwrap_or_default()
}
