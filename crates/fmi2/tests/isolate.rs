//! Isolated FMUs: the same answers as in this process, and an error where that would have come to an end.
#![cfg(all(feature = "import", target_os = "linux"))]

mod foreign;

use foreign::*;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};
use ttb_contract::Subsystem;
use ttb_fmi::isolate::Isolation;
use ttb_fmi::{Fmu, FmuError, FmuInstance, FmuSubsystem};

type Lines = Arc<Mutex<Vec<String>>>;

/// Isolation with a timeout in s, and what its FMUs print.
fn isolation(timeout: f64) -> (Isolation, Lines) {
    let (lines, kept) = (Lines::default(), Lines::default());
    let test = std::env::current_exe().unwrap();
    let program = test.ancestors().nth(2).unwrap().join("examples/host");
    assert!(program.is_file(), "{} is missing: cargo build -p ttb-fmi2 --examples", program.display());
    let into = Arc::clone(&lines);
    let listener = Arc::new(move |name: &str, line: &str| into.lock().unwrap().push(format!("{name}: {line}")));
    drop(kept);
    let timeout = Duration::from_secs_f64(timeout);
    (Isolation { program, arguments: Vec::new(), timeout, listener }, lines)
}

fn begin(fmu: &Fmu, name: &str) -> Result<FmuInstance, FmuError> {
    let mut instance = fmu.instantiate(name, false)?;
    instance.setup_experiment(0.0, Some(1.0))?;
    instance.enter_initialization()?;
    instance.exit_initialization()?;
    Ok(instance)
}

/// Steps of 0.1 s until something goes wrong.
fn run(instance: &mut FmuInstance) -> String {
    let steps = (0..10).map(|i| instance.do_step(f64::from(i) / 10.0, 0.1, true));
    steps.filter_map(Result::err).next().expect("a failure").to_string()
}

/// Process IDs of the children of this process and of theirs that are called like the test's host.
fn hosts() -> Vec<PathBuf> {
    let processes = std::fs::read_dir("/proc").unwrap().flatten().map(|entry| entry.path());
    let ours = format!("({})", "host");
    let parent = std::process::id().to_string();
    let is_ours = |path: &PathBuf| {
        let stat = std::fs::read_to_string(path.join("stat")).unwrap_or_default();
        stat.contains(&ours) && stat.split(") ").nth(1).is_some_and(|rest| rest.split(' ').nth(1) == Some(&parent))
    };
    processes.filter(is_ours).collect()
}

fn isolated(made: &Made, timeout: f64) -> (Fmu, Lines) {
    let (isolation, lines) = isolation(timeout);
    (ttb_fmi2::import::open_isolated(&made.path, &isolation).unwrap(), lines)
}

/// `foreign.c` compiled once for all tests.
fn capable() -> Made {
    static BINARY: std::sync::OnceLock<Vec<u8>> = std::sync::OnceLock::new();
    let xml = description(3, &format!("{CAPABLE} providesDirectionalDerivative=\"true\""));
    let binary = BINARY.get_or_init(|| compile(3, false));
    fmu(&[("modelDescription.xml", xml.as_bytes()), ("binaries/linux64/Foreign.so", binary)])
}

#[test]
fn every_call_answers_as_in_this_process() {
    let made = capable();
    let apart = isolated(&made, 10.0).0;
    let here = ttb_fmi2::import::open(&made.path).unwrap();
    let answers = [&here, &apart].map(|fmu| {
        let mut i = begin(fmu, "warning").unwrap();
        let mut said = vec![format!("{} {} {}", i.can_restore(), i.can_interpolate(), i.can_derive())];
        i.set_integer(7, -42).unwrap();
        i.set_boolean(8, true).unwrap();
        said.push(format!("{} {} {}", i.get_integer(7).unwrap(), i.get_boolean(8).unwrap(), i.get_string(9).unwrap()));
        i.set_string(9, &"lang ß ".repeat(20_000)).unwrap(); // more than there is room for at first
        said.push(i.get_string(9).unwrap());
        said.push(i.get_string(1).unwrap_err().to_string());
        i.reset().unwrap();
        let slot = i.new_slot();
        i.set_real(&[0, 1, 2], &[1.0, f64::NAN, -0.0]).unwrap();
        i.set_input_derivatives(&[2, 0], &[1, 1], &[3.0, 4.0]).unwrap();
        i.save(&slot).unwrap();
        let bytes = i.serialize(&slot).unwrap();
        i.do_step(0.0, 0.1, true).unwrap();
        let mut values = [0.0; 6];
        i.get_real(&[5, 4, 3, 2, 1, 0], &mut values).unwrap();
        said.push(format!("{:?} {}", values.map(f64::to_bits), i.get_real(&[6], &mut values[..1]).unwrap_err()));
        i.restore(&slot).unwrap();
        i.free(&slot).unwrap();
        said.push(i.restore(&slot).unwrap_err().to_string());
        i.deserialize(&bytes, &slot).unwrap();
        i.restore(&slot).unwrap();
        i.get_real(&[3, 4, 5, 0, 1, 2], &mut values).unwrap();
        let mut change = [0.0; 3];
        i.directional_derivative(&[3, 4, 5], &[0, 2], &[1.5, 2.5], &mut change).unwrap();
        said.push(format!("{:?} {change:?} {}", values.map(f64::to_bits), bytes.len()));
        said.push(format!("{:?} {:?}", i.take_messages(), (i.tally().steps, i.tally().warnings)));
        said.push(fmu.instantiate("none", false).err().unwrap().to_string().split("file:").next().unwrap().into());
        for name in ["error", "discard", "fatal", "nonsense"] {
            said.push(run(&mut begin(fmu, name).unwrap()));
        }
        let mut chatty = begin(fmu, "chatty").unwrap();
        chatty.do_step(0.0, 0.1, true).unwrap();
        said.push(format!("{:?}", chatty.take_messages()));
        said
    });
    for (here, apart) in answers[0].iter().zip(&answers[1]) {
        assert_eq!(here, apart);
    }
    // After fmi2Fatal it would stay to the end of a program.
    std::fs::remove_dir_all(here.folder()).unwrap();
}

#[test]
fn the_end_of_the_process_is_an_error_that_names_call_time_and_signal() {
    let made = capable();
    let (fmu, lines) = isolated(&made, 0.5);
    for (name, end) in [
        ("crash", "was killed by signal 11 (SIGSEGV)"),
        ("abort", "was killed by signal 6 (SIGABRT); it printed: giving up; it logged: matrix is singular"),
        ("exit", "ended with exit code 0"),
        ("hang", "gave no answer within 0.5 s and was killed"),
        ("spin", "gave no answer within 0.5 s and was killed"),
    ] {
        let mut instance = begin(&fmu, name).unwrap();
        let began = Instant::now();
        let error = run(&mut instance);
        assert_eq!(error, format!("{name}: fmi2DoStep from t = 0.2 s by 0.1 s: its process {end}"));
        assert!(began.elapsed() < Duration::from_secs(5));
        let after = instance.get_real(&[0], &mut [0.0]).unwrap_err().to_string();
        assert_eq!(after, format!("{name}: fmi2GetReal was not made: the FMU's process is gone"));
    }
    assert_eq!(*lines.lock().unwrap(), ["abort: giving up"]);
    let error = begin(&fmu, "crash-at-wanted").err().unwrap().to_string();
    assert_eq!(error, "crash-at-wanted: fmi2Instantiate: its process was killed by signal 11 (SIGSEGV)");
}

#[test]
fn a_process_killed_from_outside_is_noticed_at_the_next_call() {
    let (fmu, _) = isolated(&capable(), 10.0);
    let mut instance = begin(&fmu, "killed").unwrap();
    instance.do_step(0.0, 0.25, true).unwrap();
    // The host of this test is the one whose program has the folder of this FMU open.
    let library = fmu.folder().join("binaries/linux64/Foreign.so");
    let maps = |process: &Path| std::fs::read_to_string(process.join("maps")).unwrap_or_default();
    let host = hosts().into_iter().find(|process| maps(process).contains(library.to_str().unwrap())).expect("host");
    let pid = host.file_name().unwrap().to_str().unwrap();
    assert!(std::process::Command::new("kill").args(["-KILL", pid]).status().unwrap().success());
    let error = instance.get_real(&[0], &mut [0.0]).unwrap_err().to_string();
    assert_eq!(error, "killed: fmi2GetReal at t = 0.25 s: its process was killed by signal 9 (SIGKILL)");
    drop(instance);
    assert!(!host.exists(), "a zombie is left");
}

#[test]
fn a_bad_end_after_all_is_told_to_the_listener() {
    let made = capable();
    let (fmu, lines) = isolated(&made, 0.3);
    for (name, how) in [
        ("crash-at-end", "was killed by signal 11 (SIGSEGV)"),
        ("hang-at-end", "gave no answer within 0.3 s and was killed"),
    ] {
        drop(begin(&fmu, name).unwrap());
        assert_eq!(lines.lock().unwrap().pop().unwrap(), format!("{name}: fmi2FreeInstance: its process {how}"));
    }
    drop(begin(&fmu, "good").unwrap());
    assert_eq!(lines.lock().unwrap().len(), 0);
}

#[test]
fn what_the_fmu_prints_comes_line_by_line_with_its_name() {
    let made = capable();
    let (fmu, lines) = isolated(&made, 10.0);
    let mut instance = begin(&fmu, "print").unwrap();
    (0..2).for_each(|i| instance.do_step(f64::from(i), 1.0, true).unwrap());
    drop(instance);
    let said = std::mem::take(&mut *lines.lock().unwrap());
    assert_eq!(said, ["print: step to 1", "print: no newlinestep to 2", "print: no newline"]);
    let mut instance = begin(&fmu, "flood").unwrap();
    instance.do_step(0.0, 1.0, true).unwrap();
    drop(instance);
    let lines = lines.lock().unwrap();
    assert_eq!((lines.len(), lines[19_999].as_str()), (20_000, "flood: line 19999 of many"));
}

#[test]
fn nothing_is_left_of_an_instance_its_folder_and_its_offspring() {
    let made = capable();
    let (fmu, _) = isolated(&made, 10.0);
    let folder = fmu.folder().to_path_buf();
    let mut instance = begin(&fmu, "parent").unwrap();
    instance.do_step(0.0, 0.1, true).unwrap(); // forks
    let mut other = begin(&fmu, "daemon").unwrap();
    other.do_step(0.0, 0.1, true).unwrap(); // forks, out of its group
    let library = folder.join("binaries/linux64/Foreign.so");
    let users = || {
        let processes = std::fs::read_dir("/proc").unwrap().flatten();
        let maps = |path: PathBuf| std::fs::read_to_string(path.join("maps")).unwrap_or_default();
        processes.filter(|entry| maps(entry.path()).contains(library.to_str().unwrap())).count()
    };
    // A process that is just ending may hide another one from a look at /proc: what is asserted is what was seen.
    let (begun, mut seen) = (Instant::now(), users());
    while seen != 4 && begun.elapsed() < Duration::from_secs(5) {
        std::thread::sleep(Duration::from_millis(10));
        seen = users();
    }
    assert_eq!(seen, 4);
    drop(fmu); // the instances keep the folder
    assert!(folder.exists());
    drop((instance, other));
    let begin = Instant::now();
    while users() > 0 && begin.elapsed() < Duration::from_secs(5) {
        std::thread::sleep(Duration::from_millis(10)); // the offspring is init's to collect
    }
    assert_eq!((users(), folder.exists()), (0, false));
}

#[test]
fn what_an_fmu_prints_and_closes_is_taken_for_nothing_else() {
    let (fmu, lines) = isolated(&capable(), 10.0);
    for name in ["mark", "closer"] {
        let mut instance = begin(&fmu, name).unwrap();
        (0..3).for_each(|i| instance.do_step(f64::from(i), 1.0, true).unwrap());
    }
    let said = lines.lock().unwrap();
    assert_eq!(said.iter().filter(|line| *line == "mark: after it").count(), 3, "{said:?}");
}

#[test]
fn coupled_it_names_what_fails() {
    let (fmu, _) = isolated(&capable(), 10.0);
    let names = |what: &str| (1..=3).map(|i| format!("{what}[{i}]")).collect::<Vec<_>>();
    let mut s = FmuSubsystem::new(begin(&fmu, "crash").unwrap(), &names("in"), &names("out")).unwrap();
    s.save().unwrap();
    s.set_inputs(&[1.0, 2.0, 3.0], Some(&[10.0, 0.0, -10.0])).unwrap();
    s.step(0.0, 0.1, true).unwrap();
    let mut out = [0.0; 3];
    s.get_outputs(&mut out).unwrap();
    assert_eq!(out, [1.5, 2.0, 2.5]);
    s.restore().unwrap();
    s.get_outputs(&mut out).unwrap();
    assert_eq!(out, [0.0; 3]);
    let failure = s.step(0.2, 0.1, true).unwrap_err();
    assert_eq!((failure.subsystem.as_str(), failure.message.matches("crash:").count()), ("crash", 0));
}

#[test]
fn setting_goes_with_the_next_call_and_fails_under_its_own_name() {
    let (fmu, _) = isolated(&capable(), 10.0);
    let mut i = begin(&fmu, "good").unwrap();
    i.set_real(&[0, 1], &[1.0, 2.0]).unwrap();
    i.set_real(&[6], &[1.0]).unwrap(); // there is none
    assert_eq!(
        i.do_step(0.0, 0.1, true).unwrap_err().to_string(),
        "good: fmi2SetReal answered fmi2Error and logged nothing"
    );
    assert_eq!(i.tally().steps, 1);
    // More than can be posted, more lists than are kept, and more values than there was room for.
    let mut i = begin(&fmu, "good").unwrap();
    for n in (1..30).chain([30_000]) {
        let references: Vec<u32> = (0..n).map(|k| (k + n) % 3).collect();
        i.set_real(&references, &vec![f64::from(n); n as usize]).unwrap();
        i.set_input_derivatives(&references, &vec![1; n as usize], &vec![2.0 * f64::from(n); n as usize]).unwrap();
    }
    i.do_step(0.0, 1.0, true).unwrap();
    let mut values = [0.0; 6];
    i.get_real(&[0, 1, 2, 3, 4, 5], &mut values).unwrap();
    assert_eq!(values, [30_000.0, 30_000.0, 30_000.0, 60_000.0, 60_000.0, 60_000.0]);
    let mut i = begin(&fmu, "crash-on-set").unwrap();
    i.do_step(0.0, 0.5, true).unwrap();
    i.set_real(&[0], &[1.0]).unwrap();
    i.set_input_derivatives(&[0], &[1], &[1.0]).unwrap();
    let error = i.do_step(0.5, 0.5, true).unwrap_err().to_string();
    let how = "its process was killed by signal 11 (SIGSEGV)";
    assert_eq!(error, format!("crash-on-set: fmi2SetRealInputDerivatives at t = 0.5 s: {how}"));
}

#[test]
fn outputs_that_come_with_a_step_are_those_after_it() {
    let made = capable();
    let run = |fmu: &Fmu| {
        let mut i = begin(fmu, "good").unwrap();
        let slot = i.new_slot();
        let (mut said, mut three, mut one) = (Vec::new(), [0.0; 3], [0.0]);
        for n in 0..20 {
            let t = f64::from(n);
            i.save(&slot).unwrap();
            for trial in 0..3 {
                i.restore(&slot).unwrap();
                i.set_real(&[0, 1, 2], &[t, f64::from(trial), -t]).unwrap();
                i.do_step(t, 1.0, true).unwrap();
                // Mostly the same outputs, sometimes others, or none, or after something else.
                match n % 5 {
                    3 => i.get_real(&[4], &mut one).unwrap(),
                    4 if trial == 1 => i.set_real(&[1], &[9.0]).unwrap(),
                    _ => i.get_real(&[3, 4, 5], &mut three).unwrap(),
                }
                said.extend(three.iter().chain(&one).copied());
            }
            i.get_real(&[3, 4, 5], &mut three).unwrap();
            i.get_real(&[1], &mut one).unwrap();
            said.extend(three.iter().chain(&one).copied());
        }
        said
    };
    assert_eq!(run(&ttb_fmi2::import::open(&made.path).unwrap()), run(&isolated(&made, 10.0).0));
    // A crash while they are read is not the step's.
    let mut i = begin(&isolated(&made, 10.0).0, "crash-on-get").unwrap();
    i.do_step(0.0, 0.25, true).unwrap();
    i.get_real(&[3], &mut [0.0]).unwrap();
    let error = i.do_step(0.25, 0.25, true).unwrap_err().to_string();
    assert_eq!(error, "crash-on-get: fmi2GetReal at t = 0.25 s: its process was killed by signal 11 (SIGSEGV)");
}

#[test]
fn an_fmu_that_cannot_be_loaded_says_why() {
    let xml = description(3, CAPABLE);
    let made = fmu(&[("modelDescription.xml", xml.as_bytes()), ("binaries/linux64/Foreign.so", b"not ELF")]);
    let error = isolated(&made, 10.0).0.instantiate("x", false).err().unwrap().to_string();
    assert!(error.contains("cannot be loaded") && error.contains("made.fmu"), "{error}");
    let (mut isolation, _) = isolation(10.0);
    isolation.program = "/nowhere/host".into();
    let error =
        ttb_fmi2::import::open_isolated(&capable().path, &isolation).unwrap().instantiate("x", false).err().unwrap();
    assert!(error.to_string().starts_with("x: its process cannot be started (/nowhere/host): "), "{error}");
}
