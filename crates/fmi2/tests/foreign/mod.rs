//! Makes FMUs for the import tests: of C code compiled on the spot, and of the example library.
#![allow(dead_code)] // each test file uses its part

use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::Command;
use ttb_model_description::package::{LIBRARY_EXTENSION, PLATFORM};
use zip::write::{SimpleFileOptions, ZipWriter};

/// An FMU in a temporary folder.
pub struct Made {
    pub folder: tempfile::TempDir,
    pub path: PathBuf,
}

/// Zips (name, bytes) entries.
pub fn fmu(entries: &[(&str, &[u8])]) -> Made {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("made.fmu");
    let mut zip = ZipWriter::new(std::fs::File::create(&path).unwrap());
    for (name, bytes) in entries {
        zip.start_file(*name, SimpleFileOptions::default()).unwrap();
        zip.write_all(bytes).unwrap();
    }
    zip.finish().unwrap();
    Made { folder, path }
}

/// Compiles foreign.c for `n` Reals each way.
pub fn compile(n: usize, poor: bool) -> Vec<u8> {
    let folder = tempfile::tempdir().unwrap();
    let (source, library) =
        (Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/models/foreign.c"), folder.path().join("x.so"));
    let mut cc = Command::new(std::env::var("CC").unwrap_or("cc".into()));
    cc.args(["-O2", "-shared", "-fPIC", "-o"]).arg(&library).arg(source).arg(format!("-DN={n}"));
    if poor {
        cc.arg("-DPOOR");
    }
    assert!(cc.status().unwrap().success());
    std::fs::read(library).unwrap()
}

/// The description of foreign.c; `attributes` go into its CoSimulation element.
pub fn description(n: usize, attributes: &str) -> String {
    let variable = |i: usize| {
        let (name, causality) =
            if i < n { (format!("in[{}]", i + 1), "input") } else { (format!("out[{}]", i + 1 - n), "output") };
        format!(
            "<ScalarVariable name=\"{name}\" valueReference=\"{i}\" causality=\"{causality}\"><Real start=\"0\"/></ScalarVariable>"
        )
    };
    let variables: String = (0..2 * n).map(variable).collect();
    format!(
        "<?xml version=\"1.0\"?><fmiModelDescription fmiVersion=\"2.0\" modelName=\"Foreign\" guid=\"g\">\
         <CoSimulation modelIdentifier=\"Foreign\" {attributes}/><ModelVariables>{variables}</ModelVariables></fmiModelDescription>"
    )
}

/// All that foreign.c can do.
pub const CAPABLE: &str = "canInterpolateInputs=\"true\" canGetAndSetFMUstate=\"true\"";

/// foreign.c with three Reals each way.
pub fn foreign(attributes: &str, poor: bool) -> Made {
    let binary = format!("binaries/{PLATFORM}/Foreign.{LIBRARY_EXTENSION}");
    fmu(&[("modelDescription.xml", description(3, attributes).as_bytes()), (&binary, &compile(3, poor))])
}

/// The example library `oscillator`, which `cargo test` builds before the tests.
pub fn example_library() -> PathBuf {
    let test = std::env::current_exe().unwrap();
    let name = format!("examples/liboscillator.{LIBRARY_EXTENSION}");
    let library = test.ancestors().nth(2).unwrap().join(name);
    assert!(library.is_file(), "{} is missing: cargo build -p ttb-fmi2 --examples", library.display());
    library
}
