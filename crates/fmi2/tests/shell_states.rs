//! FMU states behind the C interface: exact, reusable, serializable, never trusted.
#![allow(clippy::undocumented_unsafe_blocks)] // a test calls C functions on instances it has just made

mod harness;

use harness::oscillator::vr;
use harness::*;
use std::ptr;
use ttb_fmi2::types::*;

fn free(s: &Slave, state: &mut fmi2FMUstate) -> fmi2Status {
    unsafe { fmi2::fmi2FreeFMUstate(s.c, state) }
}

fn serialize(s: &Slave, state: fmi2FMUstate) -> Vec<u8> {
    let mut size = 0;
    assert_eq!(unsafe { fmi2::fmi2SerializedFMUstateSize(s.c, state, &mut size) }, OK);
    let mut bytes = vec![0_u8; size];
    assert_eq!(unsafe { fmi2::fmi2SerializeFMUstate(s.c, state, bytes.as_mut_ptr().cast(), size - 1) }, ERROR);
    assert_eq!(unsafe { fmi2::fmi2SerializeFMUstate(s.c, state, bytes.as_mut_ptr().cast(), size) }, OK);
    bytes
}

fn deserialize(s: &Slave, bytes: &[u8], state: &mut fmi2FMUstate) -> fmi2Status {
    unsafe { fmi2::fmi2DeSerializeFMUstate(s.c, bytes.as_ptr().cast(), bytes.len(), state) }
}

#[test]
fn restored_steps_repeat_bit_for_bit_inputs_included() {
    let s = Slave::stepping();
    s.run(0, 7);
    assert_eq!((s.set(vr::FORCE, 5.0), s.rate(1, 77.0)), (OK, OK));
    let mut state = ptr::null_mut();
    assert_eq!(s.save(&mut state), OK);
    assert_eq!(s.step(0.07, 0.01), OK);
    let first = (s.bits(), s.run(8, 20));
    assert_eq!(s.restore(state), OK);
    assert_eq!(s.get(vr::FORCE), 5.0);
    assert_eq!(s.step(0.07, 0.01), OK); // the derivative came back with the state
    assert_eq!((s.bits(), s.run(8, 20)), first);
}

#[test]
fn a_state_is_overwritten_when_its_handle_is_passed_again() {
    let s = Slave::stepping();
    let mut state = ptr::null_mut();
    assert_eq!(s.save(&mut state), OK);
    let handle = state;
    s.run(0, 3);
    assert_eq!((s.save(&mut state), state), (OK, handle));
    let later = s.bits();
    s.run(3, 6);
    assert_eq!(s.restore(state), OK);
    assert_eq!(s.bits(), later);
    assert_eq!((free(&s, &mut state), state), (OK, ptr::null_mut()));
    assert_eq!(free(&s, &mut state), OK);
}

#[test]
fn stale_and_foreign_handles_are_refused_not_followed() {
    let (s, other) = (Slave::stepping(), Slave::stepping());
    let mut state = ptr::null_mut();
    assert_eq!(s.save(&mut state), OK);
    let mut stale = state;
    assert_eq!(other.restore(state), ERROR);
    assert!(other.log.text().contains("not saved by this instance"));
    assert_eq!(free(&s, &mut state), OK);
    assert_eq!(s.restore(stale), ERROR);
    assert_eq!(s.restore(ptr::null_mut()), ERROR);
    assert_eq!(free(&s, &mut stale), ERROR);
    assert_eq!(s.save(&mut stale), ERROR);
    s.run(0, 2); // none of it hurt
}

#[test]
fn states_of_every_stage_come_back() {
    let s = Slave::new();
    let mut fresh = ptr::null_mut();
    assert_eq!(s.save(&mut fresh), OK);
    s.initialize(10.0);
    let first = s.run(0, 5);
    let mut ended = ptr::null_mut();
    assert_eq!(unsafe { fmi2::fmi2Terminate(s.c) }, OK);
    assert_eq!(s.save(&mut ended), OK);
    assert_eq!(s.restore(fresh), OK);
    s.initialize(10.0);
    assert_eq!(s.run(0, 5), first);
    assert_eq!(s.restore(ended), OK);
    assert_eq!(s.step(0.05, 0.01), ERROR);
    assert!(s.log.text().contains("after fmi2Terminate"));
}

#[test]
fn a_serialized_state_carries_a_run_into_another_instance() {
    let s = Slave::stepping_with(|s| assert_eq!(s.set(vr::STIFFNESS, 50.0), OK));
    s.run(0, 4);
    let mut state = ptr::null_mut();
    assert_eq!(s.save(&mut state), OK);
    let bytes = serialize(&s, state);
    let end = s.run(4, 12);
    let other = Slave::new();
    let mut arrived = ptr::null_mut();
    assert_eq!(deserialize(&other, &bytes, &mut arrived), OK, "{}", other.log.text());
    assert_eq!(serialize(&other, arrived), bytes);
    assert_eq!(other.restore(arrived), OK);
    assert_eq!(other.get(vr::STIFFNESS), 50.0);
    assert_eq!(other.run(4, 12), end);
    let handle = arrived;
    assert_eq!((deserialize(&other, &bytes, &mut arrived), arrived), (OK, handle));
}

#[test]
fn damaged_bytes_are_refused() {
    let s = Slave::stepping();
    let mut state = ptr::null_mut();
    assert_eq!(s.save(&mut state), OK);
    let bytes = serialize(&s, state);
    let mut out = ptr::null_mut();
    for cut in 0..bytes.len() {
        assert_eq!(deserialize(&s, &bytes[..cut], &mut out), ERROR, "{cut}");
    }
    let longer = [&bytes[..], &[0]].concat();
    assert_eq!(deserialize(&s, &longer, &mut out), ERROR);
    assert!(s.log.text().contains("bytes, not the"));
    let mut foreign = bytes.clone();
    foreign[20] ^= 1;
    assert_eq!(deserialize(&s, &foreign, &mut out), ERROR);
    assert!(s.log.text().contains("another GUID"));
    assert!(out.is_null());
    s.run(0, 2);
}

#[test]
fn a_single_wrong_bit_is_refused_wherever_it_is_and_the_instance_goes_on_as_if_nothing_had_been() {
    let (s, untouched) = (Slave::stepping(), Slave::stepping());
    s.run(0, 4);
    untouched.run(0, 4);
    let mut state = ptr::null_mut();
    assert_eq!(s.save(&mut state), OK);
    let bytes = serialize(&s, state);
    for bit in 0..8 * bytes.len() {
        let (mut damaged, mut out) = (bytes.clone(), ptr::null_mut());
        damaged[bit / 8] ^= 1 << (bit % 8);
        assert_eq!((deserialize(&s, &damaged, &mut out), out), (ERROR, ptr::null_mut()), "bit {bit}");
        assert!(s.log.text().contains("cannot be read"));
    }
    assert_eq!(s.bits(), untouched.bits());
    assert_eq!(s.run(4, 9), untouched.run(4, 9));
}

#[test]
fn a_state_brings_an_instance_back_from_a_panic() {
    let s = Slave::new();
    let mut fresh = ptr::null_mut();
    assert_eq!(s.save(&mut fresh), OK);
    assert_eq!(s.set_integer(vr::MISBEHAVIOUR, 2), OK);
    s.initialize(10.0);
    assert_eq!(s.step(0.0, 0.01), ERROR);
    assert_eq!(s.restore(fresh), OK);
    s.initialize(10.0);
    assert_eq!(s.run(0, 5), Slave::stepping().run(0, 5));
    assert_eq!(free(&s, &mut fresh), OK);
}
