//! Values, steps and derivatives behind the C interface.
#![allow(clippy::undocumented_unsafe_blocks)] // a test calls C functions on instances it has just made

mod harness;

use harness::oscillator::vr;
use harness::*;
use std::ptr;
use ttb_fmi2::types::*;

#[test]
fn outputs_answer_with_equilibrium_during_initialization() {
    let s = Slave::new();
    assert_eq!(s.get(vr::DISPLACEMENT), 0.0);
    assert_eq!(unsafe { fmi2::fmi2EnterInitializationMode(s.c) }, OK);
    for force in [10.0, 20.0] {
        assert_eq!(s.set(vr::FORCE, force), OK);
        assert_eq!((s.get(vr::DISPLACEMENT), s.get(vr::FORCE)), (force / 100.0, force));
    }
    assert_eq!(s.set(vr::STIFFNESS, 200.0), OK); // parameters may still change here
    assert_eq!(s.get(vr::DISPLACEMENT), 0.1);
    assert_eq!(unsafe { fmi2::fmi2ExitInitializationMode(s.c) }, OK);
    assert_eq!(s.get(vr::DISPLACEMENT), 0.1);
}

#[test]
fn parameters_are_refused_late_and_when_impossible() {
    let s = Slave::stepping();
    assert_eq!(s.set(vr::STIFFNESS, 1.0), ERROR);
    assert!(s.log.text().contains("parameter stiffness can only be set before the end of initialization"));
    let s = Slave::new();
    assert_eq!(s.set(vr::STIFFNESS, -1.0), OK);
    assert_eq!(unsafe { fmi2::fmi2EnterInitializationMode(s.c) }, ERROR);
    assert!(s.log.text().contains("stiffness must be positive, not -1"));
    assert_eq!(s.set_integer(vr::SEED, 10), ERROR);
    assert!(s.log.text().contains("parameter seed cannot be 10"));
    assert_eq!(s.set_integer(vr::MISBEHAVIOUR, 5), ERROR);
    assert_eq!(s.set(vr::STIFFNESS, 1.0), OK);
    assert_eq!(unsafe { fmi2::fmi2EnterInitializationMode(s.c) }, OK);
}

#[test]
fn outputs_cannot_be_set() {
    let s = Slave::new();
    assert_eq!(s.set(vr::DISPLACEMENT, 1.0), ERROR);
    assert!(s.log.text().contains("is an output"));
    s.initialize(1.0);
    assert_eq!(s.set(vr::DISPLACEMENT, 0.0), ERROR);
}

#[test]
fn types_and_references_are_checked() {
    let s = Slave::new();
    let (mut i, mut b, mut text) = (0, 0, ptr::null());
    unsafe {
        assert_eq!((fmi2::fmi2GetInteger(s.c, &vr::SEED, 1, &mut i), i), (OK, 3));
        assert_eq!((fmi2::fmi2GetInteger(s.c, &vr::MISBEHAVIOUR, 1, &mut i), i), (OK, 1));
        assert_eq!((fmi2::fmi2GetBoolean(s.c, &vr::DAMPED, 1, &mut b), b), (OK, 1));
        assert_eq!(fmi2::fmi2SetBoolean(s.c, &vr::DAMPED, 1, &0), OK);
        assert_eq!((fmi2::fmi2GetBoolean(s.c, &vr::DAMPED, 1, &mut b), b), (OK, 0));
        assert_eq!(fmi2::fmi2SetBoolean(s.c, &vr::DAMPED, 1, &-7), OK);
        assert_eq!((fmi2::fmi2GetBoolean(s.c, &vr::DAMPED, 1, &mut b), b), (OK, 1));

        assert_eq!(fmi2::fmi2SetInteger(s.c, &vr::STIFFNESS, 1, &1), ERROR);
        assert!(s.log.text().contains("fmi2SetInteger: stiffness is a Real"));
        assert_eq!(s.set(vr::SEED, 1.0), ERROR);
        assert!(s.log.text().contains("seed is an Integer"));
        assert_eq!(fmi2::fmi2GetBoolean(s.c, &vr::SEED, 1, &mut b), ERROR);
        assert_eq!(fmi2::fmi2GetString(s.c, &vr::SEED, 1, &mut text), ERROR);
        assert_eq!(fmi2::fmi2GetString(s.c, ptr::null(), 0, ptr::null_mut()), OK);
        assert_eq!(fmi2::fmi2SetString(s.c, &vr::SEED, 1, &c"".as_ptr()), ERROR);
    }
    for unknown in [vr::COUNT, u32::MAX] {
        s.log.take();
        assert_eq!(s.get_status(unknown).0, ERROR);
        assert!(s.log.text().contains(&format!("no value reference {unknown}; they run from 0 to 6")));
        assert_eq!(s.set(unknown, 0.0), ERROR);
    }
}

#[test]
fn inputs_that_are_not_finite_are_refused_and_leave_the_instance_usable() {
    let s = Slave::stepping();
    for bad in [f64::NAN, f64::INFINITY] {
        assert_eq!(s.set(vr::FORCE, bad), ERROR);
        assert!(s.log.text().contains("support[1].force"));
        assert_eq!(s.rate(1, bad), ERROR);
    }
    s.run(0, 2);
}

#[test]
fn tiny_steps_succeed_and_do_nothing_and_impossible_ones_fail() {
    let s = Slave::stepping();
    s.run(0, 3);
    let before = s.bits();
    for h in [0.0, 1.4e-17, 1e-13] {
        assert_eq!(s.step(0.03, h), OK);
        assert_eq!(s.bits(), before);
    }
    for (t, h) in [(0.03, -0.01), (0.03, f64::NAN), (f64::NAN, 0.01), (0.03, f64::INFINITY)] {
        assert_eq!(s.step(t, h), ERROR);
        assert!(s.log.text().contains("impossible"));
    }
    assert_eq!(s.step(0.03, 0.01), OK);
}

#[test]
fn a_step_at_another_time_than_the_end_of_the_last_one_is_refused_with_both_numbers() {
    let s = Slave::stepping();
    assert_eq!(s.step(0.01, 0.01), ERROR);
    assert!(s.log.text().contains("a step from t = 0.01 s is impossible: the simulation has reached 0 s"));
    s.run(0, 3);
    let mut state = ptr::null_mut();
    assert_eq!(s.save(&mut state), OK);
    let before = s.bits();
    for t in [0.02, 0.04, 0.0, 0.035, 1e9] {
        assert_eq!(s.step(t, 0.01), ERROR);
        assert!(s.log.text().contains(&format!("t = {t} s is impossible: the simulation has reached 0.03 s")));
    }
    // None of it was a step, and a restored state brings its time back.
    assert_eq!(s.bits(), before);
    s.run(3, 6);
    assert_eq!((s.restore(state), s.step(0.06, 0.01)), (OK, ERROR));
    s.run(3, 4);
    assert_eq!((s.reset(), s.initialize(10.0)), (OK, ()));
    assert_eq!((s.step(0.04, 0.01), s.step(0.0, 0.01)), (ERROR, OK));
}

#[test]
fn times_may_be_added_up_or_multiplied() {
    let s = Slave::stepping();
    let (h, mut added) = (1e-3, 0.0);
    for n in 0..100_000 {
        let t = if n % 7 == 0 { added } else { f64::from(n) * h };
        assert_eq!(s.step(t, h), OK, "{n}: {}", s.log.text());
        added += h;
    }
}

#[test]
fn steps_end_at_the_stop_time_up_to_rounding() {
    let s = Slave::new();
    assert_eq!(unsafe { fmi2::fmi2SetupExperiment(s.c, 0, 0.0, 0.0, 1, -1.0) }, ERROR);
    assert_eq!(unsafe { fmi2::fmi2SetupExperiment(s.c, 0, 0.0, 0.0, 1, 0.3) }, OK);
    assert_eq!(unsafe { fmi2::fmi2EnterInitializationMode(s.c) }, OK);
    assert_eq!(unsafe { fmi2::fmi2ExitInitializationMode(s.c) }, OK);
    assert_eq!((s.step(0.0, 0.1), s.step(0.1, 0.1)), (OK, OK));
    assert_eq!(s.step(0.1 + 0.1, 0.1), OK); // 0.30000000000000004
    assert_eq!(s.step(0.3, 0.01), ERROR);
    assert!(s.log.text().contains("stop time 0.3 s"));
}

#[test]
fn derivatives_of_order_one_are_used_for_one_step() {
    let (a, b) = (Slave::stepping(), Slave::stepping());
    // f from 10 to 30 N over the step has the same mean as 20 N held: all that the trapezoidal rule sees.
    assert_eq!(a.rate(1, 2000.0), OK);
    assert_eq!(b.set(vr::FORCE, 20.0), OK);
    assert_eq!((a.step(0.0, 0.01), b.step(0.0, 0.01)), (OK, OK));
    assert_eq!(a.bits(), b.bits());
    // The next step holds the value again.
    assert_eq!((b.set(vr::FORCE, 10.0), a.step(0.01, 0.01), b.step(0.01, 0.01)), (OK, OK, OK));
    assert_eq!(a.bits(), b.bits());
    assert_eq!(a.rate(2, 1.0), ERROR);
    assert!(a.log.text().contains("order 1"));
    let order = 1;
    assert_eq!(unsafe { fmi2::fmi2SetRealInputDerivatives(a.c, &vr::DISPLACEMENT, 1, &order, &1.0) }, ERROR);
    assert_eq!(unsafe { fmi2::fmi2GetRealOutputDerivatives(a.c, &vr::DISPLACEMENT, 1, &order, &mut 0.0) }, ERROR);
    assert!(a.log.text().contains("maxOutputDerivativeOrder"));
}

#[test]
fn directional_derivatives_match_differences_of_steps() {
    let (a, b) = (Slave::stepping(), Slave::stepping());
    let seed = 3.0;
    assert_eq!(b.set(vr::FORCE, 10.0 + seed), OK);
    assert_eq!((a.step(0.0, 0.01), b.step(0.0, 0.01)), (OK, OK));
    let mut derivative = [0.0; 2];
    let unknown = [vr::VELOCITY, vr::DISPLACEMENT];
    let derive = |unknown: *const u32, known: *const u32, out: &mut [f64; 2]| unsafe {
        fmi2::fmi2GetDirectionalDerivative(a.c, unknown, 2, known, 1, &seed, out.as_mut_ptr())
    };
    assert_eq!(derive(unknown.as_ptr(), &vr::FORCE, &mut derivative), OK);
    for (vr, derivative) in unknown.into_iter().zip(derivative) {
        let difference = b.get(vr) - a.get(vr);
        assert!((difference - derivative).abs() < 1e-12 * difference.abs().max(1e-3), "{difference} {derivative}");
    }
    assert_eq!(derive(unknown.as_ptr(), &vr::VELOCITY, &mut derivative), ERROR);
    assert_eq!(derive([vr::FORCE, vr::FORCE].as_ptr(), &vr::FORCE, &mut derivative), ERROR);
}

#[test]
fn questions_about_steps_are_answered() {
    let s = Slave::stepping();
    s.run(0, 3);
    let (mut real, mut flag, mut status, mut text, mut whole) = (0.0, 1, -1, ptr::null(), 0);
    unsafe {
        assert_eq!((fmi2::fmi2GetRealStatus(s.c, status_kind::LAST_SUCCESSFUL_TIME, &mut real), real), (OK, 0.03));
        assert_eq!((fmi2::fmi2GetBooleanStatus(s.c, status_kind::TERMINATED, &mut flag), flag), (OK, FMI2_FALSE));
        assert_eq!((fmi2::fmi2GetStatus(s.c, status_kind::DO_STEP_STATUS, &mut status), status), (OK, OK));
        assert_eq!(fmi2::fmi2GetStringStatus(s.c, status_kind::PENDING_STATUS, &mut text), OK);
        assert_eq!(std::ffi::CStr::from_ptr(text), c"");
        assert_eq!(fmi2::fmi2GetIntegerStatus(s.c, 0, &mut whole), ERROR);
        assert_eq!(fmi2::fmi2GetRealStatus(s.c, 7, &mut real), ERROR);
        assert_eq!(fmi2::fmi2CancelStep(s.c), ERROR);
        assert!(s.log.text().contains("no step is pending"));
        assert_eq!(std::ffi::CStr::from_ptr(fmi2::fmi2GetVersion()), c"2.0");
        assert_eq!(std::ffi::CStr::from_ptr(fmi2::fmi2GetTypesPlatform()), c"default");
    }
}
