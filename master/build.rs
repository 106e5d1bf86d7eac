//! Makes `_exit` and its like of the guard around foreign calls (`ttb_fmi::guard`) visible to libraries that are loaded later,
//! and says where the FMUs' shared libraries are that go into the program (`ttb_inside`).

use std::env::var;
use std::path::{Path, PathBuf};

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    let system = var("CARGO_CFG_TARGET_OS").unwrap_or_default();
    let out = var("OUT_DIR").map(PathBuf::from).unwrap_or_default();
    if system == "linux" {
        visible(&["_exit", "_Exit", "pthread_exit"], &out);
    }
    inside(&system, &out);
}

/// Makes functions of the program visible. Zig's linker does not know the option for it; there a version script does the same.
fn visible(names: &[&str], out: &Path) {
    if !var("RUSTC_LINKER").is_ok_and(|linker| linker.contains("zigcc")) {
        for name in names {
            println!("cargo::rustc-link-arg-bins=-Wl,--export-dynamic-symbol={name}");
        }
        return;
    }
    let script = out.join("visible");
    match std::fs::write(&script, format!("{{ global: {}; local: *; }};\n", names.join("; "))) {
        Ok(()) => println!("cargo::rustc-link-arg-bins=-Wl,--version-script={}", script.display()),
        Err(error) => println!("cargo::error={}: {error}", script.display()),
    }
}

fn inside(system: &str, out: &Path) {
    println!("cargo::rerun-if-env-changed=TTB_LIBRARIES");
    if let Ok(archive) = var("TTB_LIBRARIES") {
        let path = PathBuf::from(&archive);
        if path.is_absolute() && path.is_file() {
            println!("cargo::rerun-if-changed={archive}");
            println!("cargo::rustc-env=TTB_INSIDE_ARCHIVE={archive}");
        } else {
            println!("cargo::error=TTB_LIBRARIES must be the whole path of an archive that exists: {archive}");
        }
        return;
    }
    // target/release/build/ttb-…/out → target/release/deps, where cargo links the libraries before it compiles this crate.
    let Some(folder) = out.ancestors().nth(3) else { return };
    println!("cargo::rustc-env=TTB_INSIDE_FOLDER={}", folder.join("deps").display());
    let (prefix, suffix) = match system {
        "windows" => ("", ".dll"),
        "macos" => ("lib", ".dylib"),
        _ => ("lib", ".so"),
    };
    println!("cargo::rustc-env=TTB_INSIDE_PREFIX={prefix}\ncargo::rustc-env=TTB_INSIDE_SUFFIX={suffix}");
}
