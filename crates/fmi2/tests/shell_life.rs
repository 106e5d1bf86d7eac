//! The life of an instance behind the C interface: wanted, stages, failure, panic, death.
#![allow(clippy::undocumented_unsafe_blocks)] // a test calls C functions on instances it has just made

mod harness;

use harness::oscillator::vr;
use harness::*;
use std::ffi::CString;
use std::ptr;
use ttb_fmi2::types::*;

#[test]
fn a_wrong_guid_is_refused_and_the_message_gives_both() {
    let resources = resources();
    let location = CString::new(format!("file://{}", resources.path().display())).unwrap();
    let (c, log) = instantiate(Some(&location), c"{wrong}");
    let text = log.text();
    assert!(c.is_null());
    assert!(text.contains("{wrong}") && text.contains(guid(resources.path()).to_str().unwrap()), "{text}");
}

#[test]
fn a_missing_or_damaged_resource_is_refused_by_name() {
    let (c, log) = instantiate(Some(c"file:///nowhere/at/all"), c"");
    assert!(c.is_null() && log.text().contains("/nowhere/at/all/mass.txt"));
    let resources = resources();
    std::fs::write(resources.path().join("mass.txt"), "heavy").unwrap();
    let location = CString::new(resources.path().to_str().unwrap()).unwrap();
    let (c, log) = instantiate(Some(&location), c"");
    assert!(c.is_null() && log.text().contains("mass.txt: invalid float"));
}

#[test]
fn every_form_of_a_resource_location_works() {
    let resources = resources();
    let inner = resources.path().join("a b%");
    std::fs::create_dir(&inner).unwrap();
    std::fs::copy(resources.path().join("mass.txt"), inner.join("mass.txt")).unwrap();
    let guid = guid(&inner);
    let (plain, encoded) =
        (inner.display().to_string(), inner.display().to_string().replace(' ', "%20").replace("b%", "b%25"));
    for form in [
        format!("file://{encoded}"),
        format!("file:{encoded}"),
        format!("file:///{encoded}"),
        format!("file://localhost{encoded}"),
        format!("file://{encoded}/"),
        format!("file://{plain}"),
        plain,
    ] {
        let (c, log) = instantiate(Some(&CString::new(form.as_str()).unwrap()), &guid);
        assert!(!c.is_null(), "{form}: {}", log.text());
        unsafe { fmi2::fmi2FreeInstance(c) };
    }
    // NULL and "" mean the folder beside the library, which a test program does not have.
    for location in [None, Some(c"")] {
        let (c, log) = instantiate(location, &guid);
        assert!(c.is_null() && log.text().contains("resources/mass.txt"));
    }
}

#[test]
fn model_exchange_is_refused_everywhere() {
    let c = unsafe { fmi2::fmi2Instantiate(c"x".as_ptr(), 0, c"".as_ptr(), ptr::null(), ptr::null(), 0, 0) };
    assert!(c.is_null());
    let s = Slave::stepping();
    assert_eq!(unsafe { fmi2::fmi2SetTime(s.c, 0.0) }, ERROR);
    assert!(s.log.text().contains("co-simulation only"));
    assert_eq!(unsafe { fmi2::fmi2NewDiscreteStates(s.c, ptr::null_mut()) }, ERROR);
}

#[test]
fn null_pointers_are_survived() {
    unsafe {
        fmi2::fmi2FreeInstance(ptr::null_mut());
        assert_eq!(fmi2::fmi2DoStep(ptr::null_mut(), 0.0, 0.1, 0), ERROR);
        assert_eq!(fmi2::fmi2GetReal(ptr::null_mut(), ptr::null(), 1, ptr::null_mut()), ERROR);
        let s = Slave::new();
        assert_eq!(fmi2::fmi2GetReal(s.c, ptr::null(), 0, ptr::null_mut()), OK);
        assert_eq!(fmi2::fmi2GetReal(s.c, &vr::FORCE, 1, ptr::null_mut()), ERROR);
        assert_eq!(fmi2::fmi2SetReal(s.c, ptr::null(), 1, &0.0), ERROR);
        assert_eq!(fmi2::fmi2GetFMUstate(s.c, ptr::null_mut()), ERROR);
        assert_eq!(fmi2::fmi2FreeFMUstate(s.c, ptr::null_mut()), OK);
        // Neither logger nor callbacks at all.
        let (resources, name) = (resources(), ptr::null());
        let location = CString::new(resources.path().to_str().unwrap()).unwrap();
        let guid = guid(resources.path());
        let mut none = callbacks(&s.log);
        none.logger = None;
        for functions in [ptr::null(), &raw const none] {
            let c = fmi2::fmi2Instantiate(name, FMI2_CO_SIMULATION, guid.as_ptr(), location.as_ptr(), functions, 0, 1);
            assert!(!c.is_null());
            assert_eq!(fmi2::fmi2DoStep(c, 0.0, 0.1, 0), ERROR);
            fmi2::fmi2FreeInstance(c);
        }
    }
}

#[test]
fn calls_in_the_wrong_stage_are_refused_with_a_hint() {
    let s = Slave::new();
    let refused = |status, hint: &str| {
        let text = s.log.text();
        assert!(status == ERROR && text.contains(hint), "{status} {text}");
    };
    refused(s.step(0.0, 0.1), "fmi2DoStep is not possible before initialization: call fmi2EnterInitializationMode");
    refused(unsafe { fmi2::fmi2ExitInitializationMode(s.c) }, "before initialization");
    assert_eq!(unsafe { fmi2::fmi2EnterInitializationMode(s.c) }, OK);
    refused(s.step(0.0, 0.1), "call fmi2ExitInitializationMode first");
    refused(unsafe { fmi2::fmi2SetupExperiment(s.c, 0, 0.0, 0.0, 0, 0.0) }, "in initialization mode");
    assert_eq!(unsafe { fmi2::fmi2ExitInitializationMode(s.c) }, OK);
    refused(unsafe { fmi2::fmi2EnterInitializationMode(s.c) }, "fmi2Reset");
    assert_eq!(s.step(0.0, 0.1), OK);
    assert_eq!(unsafe { fmi2::fmi2Terminate(s.c) }, OK);
    refused(s.step(0.1, 0.1), "after fmi2Terminate");
    refused(s.set(vr::FORCE, 1.0), "after fmi2Terminate");
    s.get(vr::DISPLACEMENT);
    assert_eq!(s.reset(), OK);
    s.initialize(1.0);
}

#[test]
fn an_instance_can_be_freed_in_any_stage() {
    drop(Slave::new());
    let s = Slave::new();
    assert_eq!(unsafe { fmi2::fmi2EnterInitializationMode(s.c) }, OK);
    drop(s);
    let s = Slave::stepping();
    assert_eq!(s.save(&mut ptr::null_mut()), OK); // a state left behind goes with the instance
    drop(s);
}

#[test]
fn a_reset_instance_runs_the_same_again() {
    let s = Slave::stepping_with(|s| assert_eq!(s.set(vr::STIFFNESS, 50.0), OK));
    s.run(0, 5);
    assert_eq!(s.reset(), OK);
    assert_eq!((s.get(vr::STIFFNESS), s.get(vr::FORCE)), (100.0, 0.0));
    s.initialize(10.0);
    let fresh = Slave::stepping();
    assert_eq!(s.run(0, 20), fresh.run(0, 20));
}

#[test]
fn a_panic_becomes_an_error_and_only_recovery_is_accepted() {
    let s = Slave::stepping();
    let mut state = ptr::null_mut();
    assert_eq!(s.save(&mut state), OK);
    let good = s.run(0, 3);
    let p = Slave::stepping_with(|s| assert_eq!(s.set_integer(vr::MISBEHAVIOUR, 2), OK));
    assert_eq!(p.step(0.0, 0.01), ERROR);
    let text = p.log.text();
    assert!(text.contains("the oscillator was told to panic") && text.contains("restore an FMU state"), "{text}");
    assert_eq!(p.get_status(vr::FORCE).0, ERROR);
    assert_eq!(p.set(vr::FORCE, 1.0), ERROR);
    assert_eq!(p.step(0.01, 0.01), ERROR);
    assert_eq!(p.save(&mut ptr::null_mut()), ERROR);
    assert_eq!(unsafe { fmi2::fmi2Terminate(p.c) }, ERROR);
    assert!(p.log.text().contains("after a panic"));
    assert_eq!(p.reset(), OK);
    p.initialize(10.0);
    assert_eq!(p.run(0, 3), good);
}

#[test]
fn after_a_failed_step_a_saved_state_puts_things_right() {
    let s = Slave::stepping_with(|s| assert_eq!(s.set_integer(vr::MISBEHAVIOUR, 3), OK));
    let mut state = ptr::null_mut();
    assert_eq!(s.save(&mut state), OK);
    let before = s.bits();
    assert_eq!(s.step(0.0, 0.01), ERROR);
    assert!(s.log.text().contains("fmi2DoStep: the oscillator was told to fail"));
    assert_eq!(s.step(0.0, 0.01), ERROR);
    assert!(s.log.text().contains("after a failed step"));
    assert_eq!(s.save(&mut ptr::null_mut()), ERROR);
    let mut status = -1;
    assert_eq!(unsafe { fmi2::fmi2GetStatus(s.c, status_kind::DO_STEP_STATUS, &mut status) }, OK);
    assert_eq!(status, ERROR);
    assert_eq!(s.restore(state), OK);
    assert_eq!(s.bits(), before);
    assert_eq!(s.save(&mut state), OK);
}

#[test]
fn several_instances_in_several_threads_do_not_know_of_each_other() {
    let alone = Slave::stepping().run(0, 200);
    std::thread::scope(|scope| {
        for _ in 0..4 {
            scope.spawn(|| {
                let (a, b) = (Slave::stepping(), Slave::stepping());
                let (first, other) = (a.run(0, 100), b.run(0, 200));
                assert_eq!(first, alone[..100]);
                assert_eq!(other, alone);
                assert_eq!(a.run(100, 200), alone[100..]);
            });
        }
    });
}

#[test]
fn debug_logging_without_categories_means_all() {
    let s = Slave::new();
    let set = |on, names: &[&std::ffi::CStr]| {
        let names: Vec<_> = names.iter().map(|n| n.as_ptr()).collect();
        unsafe { fmi2::fmi2SetDebugLogging(s.c, on, names.len(), names.as_ptr()) }
    };
    let events = |expected: usize| {
        assert_eq!(s.reset(), OK);
        let messages = s.log.take();
        assert_eq!(messages.iter().filter(|m| m.0 == OK && m.1 == "logEvents").count(), expected, "{messages:?}");
    };
    events(0);
    assert_eq!(set(FMI2_TRUE, &[]), OK);
    events(1);
    assert_eq!(set(FMI2_TRUE, &[c"logStatusError"]), OK);
    events(0);
    assert_eq!(set(FMI2_TRUE, &[c"logStatusError", c"logEvents"]), OK);
    events(1);
    assert_eq!(set(FMI2_TRUE, &[c"logAll"]), OK);
    events(1);
    assert_eq!(set(FMI2_FALSE, &[]), OK);
    events(0);
    assert_eq!(set(FMI2_TRUE, &[c"gossip"]), WARNING);
    assert!(s.log.text().contains("gossip"));
}
