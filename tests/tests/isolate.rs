//! `ttb run --isolate`: results with the same bits as without it, and results, message and exit code when an FMU crashes, ends
//! the process or does not come back.
#![cfg(target_os = "linux")]

use std::io::{Read, Write};
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::time::{Duration, Instant};

use tempfile::TempDir;
use ttb_tests::{examples, ttb};

/// R1 with a short run.
fn scenario(folder: &Path) -> PathBuf {
    let text = std::fs::read_to_string(examples().join("r1.json")).expect("R1");
    let mut scenario: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    scenario["time"]["end"] = 0.25.into();
    let path = folder.join("short.json");
    std::fs::write(&path, scenario.to_string()).expect("scenario");
    path
}

/// Bridge.fmu with a library before it that misbehaves from t = 0.1 s on.
fn spoiled(folder: &Path, scenario: &Path, what: &str) -> PathBuf {
    let built = Command::new(ttb()).args(["build", "-o"]).arg(folder).arg(scenario).output().expect("ttb");
    assert!(built.status.success(), "{}", text(&built.stderr));
    let mut archive = zip::ZipArchive::new(std::fs::File::open(folder.join("Bridge.fmu")).expect("FMU")).expect("ZIP");
    let path = folder.join("Bad.fmu");
    let mut bad = zip::ZipWriter::new(std::fs::File::create(&path).expect("FMU"));
    let options = zip::write::SimpleFileOptions::default();
    let mut add = |name: &str, bytes: &[u8]| {
        bad.start_file(name, options).and_then(|()| Ok(bad.write_all(bytes)?)).expect("entry");
    };
    for i in 0..archive.len() {
        let mut entry = archive.by_index(i).expect("entry");
        let (name, mut bytes) = (entry.name().expect("name").into_owned(), Vec::new());
        entry.read_to_end(&mut bytes).expect("bytes");
        if !name.ends_with(".so") {
            add(&name, &bytes);
            continue;
        }
        // What the library before it lacks, the loader finds in this one.
        let inner = folder.join("libinner.so");
        std::fs::write(&inner, &bytes).expect("library");
        let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/spoil/bad.c");
        let outer = folder.join("outer.so");
        let compiled = Command::new("cc")
            .args(["-shared", "-fPIC", "-Wl,-rpath,$ORIGIN", "-Wl,--no-as-needed", "-o"])
            .args([&outer, &source])
            .arg(format!("-L{}", folder.display()))
            .arg("-linner")
            .arg(format!("-DWHAT={what}"))
            .status();
        assert!(compiled.expect("a C compiler").success());
        add(&name, &std::fs::read(&outer).expect("library"));
        let soname = Path::new(&name).with_file_name("libinner.so");
        add(soname.to_str().expect("name"), &bytes);
    }
    bad.finish().expect("archive");
    path
}

/// A command whose temporary files are in `folder`.
fn run(folder: &Path, scenario: &Path, arguments: &[&str]) -> Command {
    let temporary = folder.join("tmp");
    std::fs::create_dir_all(&temporary).expect("folder");
    let mut command = Command::new(ttb());
    command.arg("run").arg(scenario).args(["-q", "-o"]).arg(folder.join("out")).args(arguments);
    command.env("TMPDIR", temporary).stdin(Stdio::null());
    command
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

/// No process has a file below the folder open or mapped, and its folder for temporary files is empty.
fn assert_nothing_is_left(folder: &Path) {
    let users = || {
        let processes = std::fs::read_dir("/proc").expect("/proc").flatten();
        let maps = |path: PathBuf| std::fs::read_to_string(path.join("maps")).unwrap_or_default();
        processes.filter(|p| maps(p.path()).contains(folder.to_str().expect("path"))).count()
    };
    let left = || std::fs::read_dir(folder.join("tmp")).map_or(0, Iterator::count);
    let begin = Instant::now();
    while users() + left() > 0 && begin.elapsed() < Duration::from_secs(5) {
        std::thread::sleep(Duration::from_millis(20));
    }
    assert_eq!((users(), left()), (0, 0));
}

#[test]
fn an_isolated_run_gives_the_bits_of_one_that_is_not() {
    let folder = TempDir::new().expect("folder");
    let scenario = scenario(folder.path());
    let results = |arguments: &[&str]| {
        let done = run(folder.path(), &scenario, arguments).output().expect("ttb");
        assert!(done.status.success(), "{}", text(&done.stderr));
        let out = folder.path().join("out");
        let summary: serde_json::Value =
            serde_json::from_str(&std::fs::read_to_string(out.join("summary.json")).expect("summary")).expect("JSON");
        (std::fs::read(out.join("results.csv")).expect("results"), summary["iterations"].clone())
    };
    let here = results(&[]);
    for side in ["--isolate=bridge", "--isolate=train-track", "--isolate=both"] {
        assert!(here == results(&[side]), "{side}");
    }
    assert_nothing_is_left(folder.path());
}

#[test]
fn the_fmus_of_a_system_structure_can_be_isolated() {
    let folder = TempDir::new().expect("folder");
    let scenario = scenario(folder.path());
    let system = folder.path().join("short.ssp");
    let exported = Command::new(ttb()).arg("export-ssp").arg(&scenario).arg("-o").arg(&system).output().expect("ttb");
    assert!(exported.status.success(), "{}", text(&exported.stderr));
    let results = |arguments: &[&str]| {
        let done = run(folder.path(), &system, arguments).output().expect("ttb");
        assert!(done.status.success(), "{}", text(&done.stderr));
        std::fs::read(folder.path().join("out/results.csv")).expect("results")
    };
    let here = results(&[]);
    for side in ["--isolate", "--isolate=bridge", "--isolate=train-track"] {
        assert!(here == results(&[side]), "{side}");
    }
    assert_nothing_is_left(folder.path());
}

/// A spoiled bridge: exit code 4, the results up to there, and the message.
fn fails(what: &str, arguments: &[&str]) -> (String, Output) {
    let folder = TempDir::new().expect("folder");
    let scenario = scenario(folder.path());
    let bad = spoiled(folder.path(), &scenario, what);
    let given = [&["--bridge", bad.to_str().expect("path")], arguments].concat();
    let done = run(folder.path(), &scenario, &given).output().expect("ttb");
    let said = text(&done.stderr);
    if arguments.is_empty() {
        return (said, done);
    }
    assert_eq!(done.status.code(), Some(4), "{said}");
    assert_eq!(text(&done.stdout), "");
    let out = folder.path().join("out");
    let table = std::fs::read_to_string(out.join("results.csv")).expect("results");
    assert_eq!(table.lines().count(), 1 + 101, "{said}"); // t = 0 … 0.1 s
    let summary = std::fs::read_to_string(out.join("summary.json")).expect("summary");
    assert!(summary.contains("fmu-failed"), "{summary}");
    assert_nothing_is_left(folder.path());
    (said, done)
}

#[test]
fn a_crash_an_end_and_a_hang_keep_the_results() {
    for (what, how) in [
        ("CRASH", "its process was killed by signal 11 (SIGSEGV)"),
        ("ABORT", "its process was killed by signal 6 (SIGABRT); it printed: out of luck"),
        ("EXIT", "its process ended with exit code 0"),
        ("HANG", "its process gave no answer within 1 s and was killed"),
    ] {
        let (said, _) = fails(what, &["--isolate", "--timeout", "1"]);
        assert!(said.contains("ttb: Bridge: fmi2DoStep from t = 0.1 s by 0.001 s: ") && said.contains(how), "{said}");
    }
}

#[test]
fn a_failure_in_this_process_recommends_to_isolate() {
    let (said, done) = fails("ERROR", &[]);
    assert_eq!(done.status.code(), Some(4));
    assert!(said.contains("answered fmi2Error") && said.contains("--isolate runs it in one of its own"), "{said}");
}

#[test]
fn what_an_fmu_prints_never_reaches_standard_output() {
    let folder = TempDir::new().expect("folder");
    let scenario = scenario(folder.path());
    let chatty = spoiled(folder.path(), &scenario, "PRINT");
    let given = ["--isolate", "--bridge", chatty.to_str().expect("path")];
    let done = run(folder.path(), &scenario, &given).output().expect("ttb");
    assert!(done.status.success() && done.stdout.is_empty());
    assert!(text(&done.stderr).lines().any(|line| line == "Bridge: still here"), "{}", text(&done.stderr));
}

#[test]
fn an_interrupt_or_the_end_of_the_program_leaves_nothing_behind() {
    let folder = TempDir::new().expect("folder");
    let scenario = scenario(folder.path());
    let slow = spoiled(folder.path(), &scenario, "SLOW");
    for (signal, code) in [("-INT", Some(130)), ("-KILL", None)] {
        let given = ["--isolate", "--bridge", slow.to_str().expect("path")];
        let mut child = run(folder.path(), &scenario, &given).stderr(Stdio::null()).spawn().expect("ttb");
        let csv = folder.path().join("out/iterations.csv");
        while !csv.is_file() {
            std::thread::sleep(Duration::from_millis(10));
        }
        std::thread::sleep(Duration::from_millis(300));
        let pid = child.id().to_string();
        assert!(Command::new("kill").args([signal, &pid]).status().expect("kill").success());
        assert_eq!(child.wait().expect("ttb").code(), code);
        // A program ended by SIGKILL leaves the folders of FMUs in its own process; that of an isolated FMU is removed.
        if code.is_none() {
            let left: Vec<_> = std::fs::read_dir(folder.path().join("tmp")).expect("folder").flatten().collect();
            left.iter().for_each(|entry| {
                if entry.path().join("binaries").is_dir()
                    && !entry.path().join("binaries/linux64/libinner.so").is_file()
                {
                    std::fs::remove_dir_all(entry.path()).expect("folder of the other FMU");
                }
            });
        }
        assert_nothing_is_left(folder.path());
        std::fs::remove_file(csv).expect("iterations");
    }
}
