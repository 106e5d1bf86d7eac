//! The cost of isolating FMUs, with two trivial C FMUs and 1,000 coupled values in each direction: a trial of the iteration
//! and single calls, in this process and isolated. `cargo bench -p ttb-tests --bench isolate`; needs a C compiler (`cc`).

mod trivial;

use std::sync::Arc;
use std::time::{Duration, Instant};

use trivial::{N, pack};
use ttb_contract::Subsystem;
use ttb_fmi::FmuSubsystem;
use ttb_fmi::isolate::Isolation;
use ttb_fmi2::import::host;

const SWEEPS: usize = 5_000;
const ROUNDS: usize = 9;

fn main() {
    if std::env::args().any(|argument| argument == "host") {
        return host().expect("started by this benchmark");
    }
    let folder = tempfile::tempdir().expect("temporary folder");
    let isolation = Isolation {
        program: std::env::current_exe().expect("path of the benchmark"),
        arguments: vec!["host".into()],
        timeout: Duration::from_secs(60),
        listener: Arc::new(|name, line| eprintln!("{name}: {line}")),
    };
    let names = |kind: &str| (1..=N).map(|i| format!("{kind}[{i}]")).collect::<Vec<_>>();
    let (forces, motions) = (names("f"), names("d"));
    let make = |name: &str, inputs: &[String], outputs: &[String], gain: &str, isolated: bool| {
        let fmu = pack(folder.path(), name, inputs, outputs, gain);
        let fmu =
            if isolated { ttb_fmi2::import::open_isolated(&fmu, &isolation) } else { ttb_fmi2::import::open(&fmu) };
        let mut instance = fmu.and_then(|fmu| fmu.instantiate(name, false)).expect("trivial FMU");
        instance.setup_experiment(0.0, None).and_then(|()| instance.enter_initialization()).expect("initialization");
        let mut fmu = FmuSubsystem::new(instance, inputs, outputs).expect("names");
        fmu.exit_initialization().and_then(|()| fmu.save()).expect("start");
        fmu
    };
    for (what, isolated) in
        [("both here", [false; 2]), ("bridge isolated", [false, true]), ("both isolated", [true; 2])]
    {
        let mut train_track = make("Front", &motions, &forces, "0.03", isolated[0]);
        let mut bridge = make("Back", &forces, &motions, "1.0", isolated[1]);
        let (mut values, rates) = (vec![1.0; N], vec![0.5; N]);
        let mut sweep = |train_track: &mut FmuSubsystem, bridge: &mut FmuSubsystem| {
            for fmu in [bridge, train_track] {
                fmu.restore().and_then(|()| fmu.set_inputs(&values, Some(&rates))).expect("inputs");
                fmu.step(0.0, 1e-3, true).and_then(|()| fmu.get_outputs(&mut values)).expect("outputs");
            }
        };
        let inside = |fmu: &mut FmuSubsystem| fmu.instance().tally().time.as_secs_f64();
        let rounds = (0..ROUNDS).map(|_| {
            let before = inside(&mut train_track) + inside(&mut bridge);
            let begin = Instant::now();
            (0..SWEEPS).for_each(|_| sweep(&mut train_track, &mut bridge));
            let spent = begin.elapsed().as_secs_f64();
            (spent, inside(&mut train_track) + inside(&mut bridge) - before)
        });
        let mut rounds: Vec<_> = rounds.collect();
        rounds.sort_by(|a, b| a.0.total_cmp(&b.0));
        let micro = |(spent, inside): (f64, f64)| (1e6 * spent / SWEEPS as f64, 1e6 * inside / SWEEPS as f64);
        let (best, median) = (micro(rounds[0]), micro(rounds[ROUNDS / 2]));
        println!(
            "{what}: {:.2} µs a sweep of 10 calls, of it {:.2} µs inside the FMUs (median {:.2}, {:.2})",
            best.0, best.1, median.0, median.1
        );
        if isolated[1] {
            calls(&mut bridge);
        }
    }
}

/// Single calls that do almost nothing: one after the other, and after pauses in which the host goes to sleep.
fn calls(bridge: &mut FmuSubsystem) {
    for pause in [0, 10, 50, 500].map(Duration::from_micros) {
        let calls = if pause.is_zero() { 50_000 } else { 2_000 };
        let mut costs = Vec::with_capacity(calls);
        for _ in 0..calls {
            let idle = Instant::now();
            while idle.elapsed() < pause {
                std::hint::spin_loop();
            }
            let begin = Instant::now();
            bridge.instance().get_real(&[0], &mut [0.0]).expect("a value");
            costs.push(begin.elapsed());
        }
        costs.sort();
        let at = |share: f64| 1e6 * costs[(share * (calls - 1) as f64) as usize].as_secs_f64();
        println!(
            "  a call {} µs after the last: median {:.2} µs, least {:.2}, 95 % below {:.2}",
            pause.as_micros(),
            at(0.5),
            at(0.0),
            at(0.95)
        );
    }
}
