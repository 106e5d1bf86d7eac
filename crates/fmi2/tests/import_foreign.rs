//! Foreign FMUs with faults: every one of them becomes a clear error, and nothing leaks.
#![cfg(feature = "import")]
#![allow(clippy::undocumented_unsafe_blocks)] // a test reads a counter of a library it has just made

mod foreign;

use foreign::*;
use std::path::PathBuf;
use ttb_contract::Subsystem;
use ttb_fmi::{Fmu, FmuError, FmuInstance, FmuSubsystem};
use ttb_fmi2::types::Status;

fn stepping(fmu: &Fmu, name: &str) -> FmuInstance {
    let mut instance = fmu.instantiate(name, false).unwrap();
    instance.setup_experiment(0.0, Some(1.0)).unwrap();
    instance.enter_initialization().unwrap();
    instance.exit_initialization().unwrap();
    instance
}

/// Coupled with all three Reals.
fn coupled(instance: FmuInstance) -> FmuSubsystem {
    FmuSubsystem::new(instance, &["in[1]", "in[2]", "in[3]"], &["out[1]", "out[2]", "out[3]"]).unwrap()
}

#[test]
fn a_well_behaved_fmu_is_coupled_saved_and_restored() {
    let made = foreign(CAPABLE, false);
    let fmu = ttb_fmi2::import::open(&made.path).unwrap();
    let mut s = coupled(fmu.instantiate("good", false).unwrap());
    s.instance().enter_initialization().unwrap();
    assert!(s.can_interpolate() && s.instance().can_restore() && !s.instance().can_derive());
    s.exit_initialization().unwrap();
    s.save().unwrap();
    let mut out = [0.0; 3];
    s.set_inputs(&[1.0, 2.0, 3.0], Some(&[10.0, 0.0, -10.0])).unwrap();
    s.step(0.0, 0.1, true).unwrap();
    s.get_outputs(&mut out).unwrap();
    assert_eq!(out, [1.5, 2.0, 2.5]);
    s.restore().unwrap();
    s.get_outputs(&mut out).unwrap();
    assert_eq!(out, [0.0; 3]);
    let recorded = s.record(&|signal| signal.name == "out[2]");
    assert_eq!((recorded.len(), recorded[0].name.as_str()), (1, "out[2]"));
    s.read(&mut out[..1]).unwrap();
    let tally = s.instance().tally();
    assert_eq!((tally.steps, tally.saves, tally.restores, tally.warnings), (1, 1, 1, 0));
    assert!(tally.time.as_nanos() > 0);
}

#[test]
fn the_first_answer_of_every_failure_names_instance_call_time_and_log() {
    let made = foreign(CAPABLE, false);
    let fmu = ttb_fmi2::import::open(&made.path).unwrap();
    for (name, status, log) in [
        ("error", "fmi2Error", "; it logged: cannot step by 0.25"),
        ("discard", "fmi2Discard", " and logged nothing"),
        ("pending", "fmi2Pending", " and logged nothing"),
        ("nonsense", "fmi2Fatal", " and logged nothing"),
    ] {
        let error = stepping(&fmu, name).do_step(0.5, 0.25, true).unwrap_err().to_string();
        assert_eq!(error, format!("{name}: fmi2DoStep from t = 0.5 s by 0.25 s answered {status}{log}"));
    }
    std::fs::remove_dir_all(fmu.folder()).unwrap(); // after fmi2Fatal it would stay to the end of a program
    let error = fmu.instantiate("none", false).err().unwrap().to_string();
    assert!(
        error.starts_with("none: fmi2Instantiate gave no instance; it logged: no licence for g in file:///"),
        "{error}"
    );
}

#[test]
fn a_failure_of_a_coupled_fmu_names_it_once() {
    let made = foreign(CAPABLE, false);
    let fmu = ttb_fmi2::import::open(&made.path).unwrap();
    let failure = coupled(stepping(&fmu, "discard")).step(0.0, 0.1, true).unwrap_err();
    assert_eq!((failure.subsystem.as_str(), failure.message.matches("discard:").count()), ("discard", 0));
}

#[test]
fn a_failed_step_can_be_undone_and_nothing_else_is_called_before() {
    let made = foreign(CAPABLE, false);
    let fmu = ttb_fmi2::import::open(&made.path).unwrap();
    let mut s = coupled(stepping(&fmu, "error"));
    s.save().unwrap();
    s.step(0.0, 0.1, true).unwrap_err();
    let message = s.get_outputs(&mut [0.0; 3]).unwrap_err().message;
    assert!(message.contains("an earlier call failed"), "{message}");
    s.restore().unwrap();
    let mut out = [7.0; 3];
    s.get_outputs(&mut out).unwrap();
    assert_eq!(out, [0.0; 3]);
}

/// Linux: whether the code of an FMU unpacked in a folder is in this process.
fn is_loaded(folder: &std::path::Path) -> bool {
    std::fs::read_to_string("/proc/self/maps").unwrap().contains(folder.to_str().unwrap())
}

#[test]
fn a_library_stays_when_its_last_instance_is_freed_and_its_folder_goes() {
    let made = foreign(CAPABLE, false);
    let fmu = ttb_fmi2::import::open(&made.path).unwrap();
    let folder = fmu.folder().to_path_buf();
    let mut instance = stepping(&fmu, "thread");
    instance.do_step(0.0, 0.1, true).unwrap();
    drop((instance, fmu));
    // The thread calls the logger again and again, and its code is still there.
    std::thread::sleep(std::time::Duration::from_millis(50));
    assert!(is_loaded(&folder) && !folder.exists());
}

#[test]
fn after_fmi2fatal_nothing_is_called_any_more() {
    let made = foreign(CAPABLE, false);
    let fmu = ttb_fmi2::import::open(&made.path).unwrap();
    let mut instance = stepping(&fmu, "fatal");
    let slot = instance.new_slot();
    instance.save(&slot).unwrap();
    instance.do_step(0.0, 0.1, true).unwrap_err();
    let error = instance.restore(&slot).unwrap_err().to_string();
    assert!(error.contains("fmi2Fatal before and must not be called"), "{error}");
    assert!(instance.reset().is_err());
    // Its threads may still run: what they use stays.
    let folder = fmu.folder().to_path_buf();
    drop((instance, fmu));
    assert!(folder.join("binaries/linux64/Foreign.so").exists() && is_loaded(&folder));
    std::fs::remove_dir_all(folder).unwrap();
}

#[test]
fn an_output_that_is_not_a_number_is_handed_on_with_its_name() {
    let made = foreign(CAPABLE, false);
    let fmu = ttb_fmi2::import::open(&made.path).unwrap();
    let mut s = coupled(stepping(&fmu, "nan"));
    let mut out = [0.0; 3];
    s.step(0.0, 0.01, true).unwrap();
    s.get_outputs(&mut out).unwrap();
    s.step(0.02, 0.01, true).unwrap();
    s.get_outputs(&mut out).unwrap();
    let index = ttb_contract::finite::not_finite(&out).expect("a NaN");
    assert_eq!((s.name(), s.output_name(index).as_str()), ("nan", "out[2]"));
}

#[test]
fn warnings_are_counted_and_messages_are_kept_within_bounds() {
    let made = foreign(CAPABLE, false);
    let fmu = ttb_fmi2::import::open(&made.path).unwrap();
    let mut instance = stepping(&fmu, "warning");
    for i in 0..3 {
        instance.do_step(f64::from(i), 1.0, true).unwrap();
    }
    assert_eq!(instance.tally().warnings, 3);
    let messages = instance.take_messages();
    assert_eq!((messages.len(), messages[2].text.as_str(), messages[2].status), (3, "odd at 2", Status::Warning));

    let mut instance = stepping(&fmu, "chatty");
    instance.do_step(0.0, 1.0, true).unwrap();
    let messages = instance.take_messages();
    assert_eq!((messages.len(), messages[199].text.as_str()), (200, "message 999"));

    let mut instance = stepping(&fmu, "long");
    instance.do_step(0.0, 1.0, true).unwrap();
    let lengths: Vec<_> = instance.take_messages().iter().map(|m| m.text.len()).collect();
    assert_eq!(lengths, [4095, 0]);

    let mut instance = fmu.instantiate("formats", true).unwrap();
    assert_eq!(instance.take_messages()[0].text, "42 reals 99.5%");
}

#[test]
fn a_message_with_another_environment_belongs_to_the_instance_that_is_called() {
    let made = foreign(CAPABLE, false);
    let fmu = ttb_fmi2::import::open(&made.path).unwrap();
    let (mut stranger, mut other) = (stepping(&fmu, "stranger"), stepping(&fmu, "chatty"));
    stranger.do_step(0.0, 0.1, true).unwrap();
    other.do_step(0.0, 0.1, true).unwrap();
    let texts: Vec<_> = stranger.take_messages().into_iter().map(|m| m.text).collect();
    assert_eq!(texts, ["stranger 0", "stranger 1", "stranger 2", "stranger 3"]);
    assert_eq!(other.take_messages()[199].text, "message 999");
}

#[test]
fn text_that_is_no_format_is_logged_as_it_is() {
    let made = foreign(CAPABLE, false);
    let mut instance = ttb_fmi2::import::open(&made.path).unwrap().instantiate("odd", false).unwrap();
    let texts: Vec<_> = instance.take_messages().into_iter().map(|m| m.text).collect();
    assert_eq!(texts, ["loaded to 50 % of %n", "cut at %"]);
}

#[test]
fn what_an_fmu_cannot_do_is_an_error_not_a_crash() {
    let made = foreign("", true);
    let fmu = ttb_fmi2::import::open(&made.path).unwrap();
    let mut instance = stepping(&fmu, "poor");
    assert!(!instance.can_restore() && !instance.can_interpolate() && !instance.can_derive());
    let slot = instance.new_slot();
    for error in [
        instance.save(&slot).unwrap_err(),
        instance.restore(&slot).unwrap_err(),
        instance.free(&slot).unwrap_err(),
        instance.serialize(&slot).unwrap_err(),
        instance.set_input_derivatives(&[0], &[1], &[1.0]).unwrap_err(),
        instance.get_integer(0).unwrap_err(),
        instance.directional_derivative(&[3], &[0], &[1.0], &mut [0.0]).unwrap_err(),
    ] {
        assert!(error.to_string().contains("its library has no fmi2"), "{error}");
    }
    assert!(instance.set_real(&[0, 1], &[1.0]).unwrap_err().to_string().contains("2 variables were given 1 values"));
    let error = instance.set_number("gear", 1.0).unwrap_err().to_string();
    assert_eq!(error, "poor: it has no variable gear");
    // A capability declared but not there does not count.
    let made = foreign(CAPABLE, true);
    let instance = stepping(&ttb_fmi2::import::open(&made.path).unwrap(), "declares");
    assert!(!instance.can_restore() && !instance.can_interpolate());
}

#[test]
fn all_coupling_mistakes_come_in_one_message() {
    let made = foreign(CAPABLE, false);
    let instance = ttb_fmi2::import::open(&made.path).unwrap().instantiate("f", false).unwrap();
    let error = FmuSubsystem::new(instance, &["in[1]", "in[9]", "out[1]"], &["in[2]", "out[2]", "x"])
        .err()
        .unwrap()
        .to_string();
    assert_eq!(
        error,
        "f: it has no variable in[9]; out[1] is no input but a output; in[2] is no output but a input; it has no variable x"
    );
}

#[test]
fn dropping_frees_states_and_instance_while_the_library_is_still_there() {
    let made = foreign(CAPABLE, false);
    let fmu = ttb_fmi2::import::open(&made.path).unwrap();
    // The library's own counter of what is alive; the path is the one the import layer has loaded it from.
    let path = fmu.folder().join("binaries/linux64/Foreign.so");
    let library = unsafe { libloading::Library::new(path) }.unwrap();
    let live = || unsafe { **library.get::<*const i32>("fmi2_live").unwrap() };
    let mut a = stepping(&fmu, "a");
    let slots = [a.new_slot(), a.new_slot(), a.new_slot()];
    slots[..2].iter().for_each(|slot| a.save(slot).unwrap());
    a.save(&slots[0]).unwrap(); // overwrites
    assert_eq!(live(), 3);
    a.free(&slots[0]).unwrap();
    assert_eq!(live(), 2);
    drop(fmu); // the instance keeps the library
    a.do_step(0.0, 0.1, true).unwrap();
    drop(a);
    assert_eq!(live(), 0);
}

#[test]
fn an_fmu_for_another_machine_or_without_functions_says_so() {
    let xml = description(3, CAPABLE);
    let open = |made: &Made| ttb_fmi2::import::open(&made.path).err().unwrap().to_string();
    let error = open(&fmu(&[("modelDescription.xml", xml.as_bytes()), ("binaries/win64/Foreign.dll", b"MZ")]));
    assert!(error.ends_with("has no binaries/linux64/Foreign.so; it has binaries for: win64"), "{error}");
    let error = open(&fmu(&[("modelDescription.xml", xml.as_bytes()), ("binaries/linux64/Foreign.so", b"not ELF")]));
    assert!(error.contains("cannot be loaded") && error.contains("Foreign.so"), "{error}");
    let libc = ["/lib/x86_64-linux-gnu/libm.so.6", "/lib64/libm.so.6"].map(PathBuf::from);
    if let Some(library) = libc.iter().find(|path| path.is_file()) {
        let bytes = std::fs::read(library).unwrap();
        let error = open(&fmu(&[("modelDescription.xml", xml.as_bytes()), ("binaries/linux64/Foreign.so", &bytes)]));
        assert!(error.ends_with("has no function fmi2GetVersion, which FMI 2.0 co-simulation needs"), "{error}");
    }
    let error = open(&fmu(&[("other.xml", b"")]));
    assert!(error.contains("modelDescription.xml: cannot be read"), "{error}");
    assert!(matches!(ttb_fmi2::import::open(&PathBuf::from("/nowhere.fmu")), Err(FmuError::Unpack { .. })));
}
