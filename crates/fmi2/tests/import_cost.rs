//! What the import layer adds to an FMU's own time, at 1,000 couplings each way: no allocation, and microseconds.
#![cfg(feature = "import")]

mod counting;
mod foreign;

use counting::allocations;
use foreign::*;
use std::time::Instant;
use ttb_contract::Subsystem;
use ttb_fmi::FmuSubsystem;
use ttb_model_description::package::{LIBRARY_EXTENSION, PLATFORM};

const N: usize = 1000;

#[test]
fn a_sweep_over_1000_couplings_allocates_nothing_and_costs_microseconds() {
    let binary = format!("binaries/{PLATFORM}/Foreign.{LIBRARY_EXTENSION}");
    let made = fmu(&[("modelDescription.xml", description(N, CAPABLE).as_bytes()), (&binary, &compile(N, false))]);
    let names = |what: &str| (1..=N).map(|i| format!("{what}[{i}]")).collect::<Vec<_>>();
    let mut instance = ttb_fmi2::import::open(&made.path).unwrap().instantiate("f", false).unwrap();
    instance.enter_initialization().unwrap();
    let mut s = FmuSubsystem::new(instance, &names("in"), &names("out")).unwrap();
    s.exit_initialization().unwrap();
    let (values, rates, mut out) = (vec![1.0; N], vec![2.0; N], vec![0.0; N]);
    let mut sweep = |s: &mut FmuSubsystem| {
        s.restore().unwrap();
        s.set_inputs(&values, Some(&rates)).unwrap();
        s.step(0.0, 0.001, true).unwrap();
        s.get_outputs(&mut out).unwrap();
    };
    s.save().unwrap();
    sweep(&mut s);
    // The best of ten batches: the machine may be busy with something else meanwhile.
    let sweeps = 1000;
    let (mut best_total, mut best_outside) = (f64::INFINITY, f64::INFINITY);
    let before = allocations();
    for _ in 0..10 {
        let (begin, inside) = (Instant::now(), s.instance().tally().time);
        for _ in 0..sweeps {
            sweep(&mut s);
        }
        let total = begin.elapsed();
        let outside = total - (s.instance().tally().time - inside);
        let micro = |time: std::time::Duration| 1e6 * time.as_secs_f64() / f64::from(sweeps);
        (best_total, best_outside) = (best_total.min(micro(total)), best_outside.min(micro(outside)));
    }
    assert_eq!(allocations() - before, 0);
    println!("{N} couplings each way: {best_total:.2} µs a sweep, {best_outside:.2} µs of it outside the FMU");
    assert!(best_outside < 5.0, "the import layer is too slow: {best_outside:.2} µs a sweep");
}
