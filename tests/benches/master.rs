//! The master's own cost with two trivial C FMUs and 1,000 couplings each way: a step's time without that inside the FMU
//! calls. `cargo bench -p ttb-tests --bench master`; needs a C compiler (`cc`).

use std::path::Path;
use std::process::Command;
use std::time::Instant;

use ttb_coupling::iteration::{OnFailure, Settings};
use ttb_coupling::predictor::Predictor;
use ttb_coupling::{Coupling, Method};
use ttb_fmi2::import::{Fmu, FmuSubsystem};

const N: usize = 1000;
const STEPS: usize = 20_000;
const ROUNDS: usize = 7;

fn main() {
    let folder = tempfile::tempdir().expect("temporary folder");
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("benches/trivial.c");
    let names = |kind: &str| (1..=N).map(|i| format!("{kind}[{i}]")).collect::<Vec<_>>();
    let (forces, motions) = (names("f"), names("d"));
    let make = |name: &str, inputs: &[String], outputs: &[String], gain: &str| {
        let fmu = pack(folder.path(), &source, name, inputs, outputs, gain);
        let mut instance = Fmu::open(&fmu).and_then(|fmu| fmu.instantiate(name, false)).expect("trivial FMU");
        instance.setup_experiment(0.0, None).and_then(|()| instance.enter_initialization()).expect("initialization");
        FmuSubsystem::new(instance, inputs, outputs).expect("names")
    };
    for (what, limit, method) in [
        ("explicit, 1 sweep a step", 1, Method::FixedPoint),
        ("implicit, 1e-10", 30, Method::FixedPoint),
        ("implicit, 1e-10, default method", 30, Method::Auto),
    ] {
        let mut train_track = make("Front", &motions, &forces, "0.03");
        let mut bridge = make("Back", &forces, &motions, "1.0");
        let mut coupling = Coupling::new(N, N, settings(limit, method));
        coupling.initialise(&mut train_track, &mut bridge, 0.0).expect("equilibrium");
        let (mut best, mut best_inside, mut sweeps) = (f64::INFINITY, 0.0, 0);
        let mut n = 0;
        for _ in 0..ROUNDS {
            let inside = |a: &mut FmuSubsystem, b: &mut FmuSubsystem| {
                (a.instance().tally().time + b.instance().tally().time).as_secs_f64()
            };
            let (before, begin) = (inside(&mut train_track, &mut bridge), Instant::now());
            sweeps = 0;
            for _ in 0..STEPS {
                let info = coupling.step(&mut train_track, &mut bridge, n as f64 * 1e-3, 1e-3).expect("step");
                sweeps += info.iterations;
                n += 1;
            }
            let spent = begin.elapsed().as_secs_f64();
            if spent < best {
                (best, best_inside) = (spent, inside(&mut train_track, &mut bridge) - before);
            }
        }
        let per_sweep = 1e6 / sweeps as f64;
        println!(
            "{what}: {:.2} sweeps a step; {:.2} µs a step; per sweep {:.2} µs, of it {:.2} µs inside FMU calls and {:.2} µs the master's own",
            sweeps as f64 / STEPS as f64,
            1e6 * best / STEPS as f64,
            best * per_sweep,
            best_inside * per_sweep,
            (best - best_inside) * per_sweep
        );
    }
}

fn settings(limit: usize, method: Method) -> Settings {
    Settings {
        method,
        reuse: 2,
        predictor: Predictor::Constant,
        tolerance: 1e-10,
        force_scale: 1e-3,
        max_iterations: limit,
        hold_forces: false,
        on_failure: OnFailure::Accept,
    }
}

/// Compiles the C source and packs it as an FMU.
fn pack(
    folder: &Path,
    source: &Path,
    name: &str,
    inputs: &[String],
    outputs: &[String],
    gain: &str,
) -> std::path::PathBuf {
    use std::io::Write;
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
