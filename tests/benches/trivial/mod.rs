//! FMUs of trivial.c, for the benchmarks.

use std::io::Write;
use std::path::Path;
use std::process::Command;

/// Inputs and outputs of each.
pub const N: usize = 1000;

/// Compiles the C source and packs it as an FMU.
pub fn pack(folder: &Path, name: &str, inputs: &[String], outputs: &[String], gain: &str) -> std::path::PathBuf {
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("benches/trivial.c");
    let library = folder.join(format!("{name}.so"));
    let compiled = Command::new("cc")
        .args(["-O2", "-shared", "-fPIC", "-o"])
        .arg(&library)
        .arg(source)
        .arg(format!("-DGAIN={gain}"))
        .status();
    assert!(compiled.expect("a C compiler").success());
    let variable = |(i, (name, causality)): (usize, (&String, &str))| {
        let start = if causality == "input" { " start=\"0\"" } else { "" };
        format!(
            "<ScalarVariable name=\"{name}\" valueReference=\"{i}\" causality=\"{causality}\"><Real{start}/></ScalarVariable>"
        )
    };
    let all = inputs.iter().map(|n| (n, "input")).chain(outputs.iter().map(|n| (n, "output")));
    let variables: String = all.enumerate().map(variable).collect();
    let xml = format!(
        "<?xml version=\"1.0\"?><fmiModelDescription fmiVersion=\"2.0\" modelName=\"{name}\" guid=\"g\"><CoSimulation modelIdentifier=\"{name}\" \
         canHandleVariableCommunicationStepSize=\"true\" canInterpolateInputs=\"true\" canGetAndSetFMUstate=\"true\"/>\
         <ModelVariables>{variables}</ModelVariables><ModelStructure/></fmiModelDescription>"
    );
    let path = folder.join(format!("{name}.fmu"));
    let mut zip = zip::ZipWriter::new(std::fs::File::create(&path).expect("FMU file"));
    let options = zip::write::SimpleFileOptions::default();
    zip.start_file("modelDescription.xml", options).and_then(|()| Ok(zip.write_all(xml.as_bytes())?)).expect("XML");
    let binary = std::fs::read(&library).expect("library");
    zip.start_file(format!("binaries/linux64/{name}.so"), options)
        .and_then(|()| Ok(zip.write_all(&binary)?))
        .expect("binary");
    zip.finish().expect("archive");
    path
}
