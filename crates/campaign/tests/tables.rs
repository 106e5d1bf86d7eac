//! The tables have the same bytes however the runs were computed.

mod common;

use std::fs;
use std::path::Path;
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, Ordering};

use common::{plan, record};
use ttb_campaign::status::Status;
use ttb_campaign::{Compute, Computed, Journal, Plan, Record, Run, Shard, hdf5, pool, tables};

/// Counts what it computes; a run at a speed of `failing` km/h fails.
#[derive(Default)]
struct Fake {
    computed: Mutex<Vec<String>>,
    failing: Option<f64>,
    /// Stops after so many runs.
    ends_after: Option<usize>,
    batch: usize,
}

impl Compute for Fake {
    fn batch(&self, runs: usize, workers: usize) -> usize {
        self.batch.max(1).min(runs.div_ceil(4 * workers))
    }

    fn compute(&self, runs: &[Run], stop: &AtomicBool) -> Vec<Computed> {
        runs.iter().map(|run| self.one(run, stop)).collect()
    }
}

impl Fake {
    fn one(&self, run: &Run, stop: &AtomicBool) -> Computed {
        let mut computed = self.computed.lock().expect("no panic");
        if self.ends_after.is_some_and(|n| computed.len() >= n) {
            stop.store(true, Ordering::Relaxed);
            return Computed::Stopped;
        }
        computed.push(run.id.clone());
        let speed = run.speed_km_h.unwrap_or(0.0);
        if self.failing == Some(speed) {
            return Computed::Done(Record::failed(&run.id, "did not converge, \"twice\"", 0.1));
        }
        Computed::Done(record(&run.id, speed + run.train as f64))
    }
}

fn compute(with: &dyn Compute, runs: &[Run], workers: usize, folder: &Path) -> pool::Progress {
    let journal = Journal::open(folder).expect("journal");
    pool::compute(with, runs, workers, &journal, &AtomicBool::new(false), &|_| {}).expect("computed")
}

/// The bytes of all tables and of the HDF5 file.
fn made(folder: &Path, plan: &Plan) -> Vec<Vec<u8>> {
    let journal = Journal::open(folder).expect("journal");
    tables::write(folder, plan, &plan.runs(), &journal, true).expect("tables");
    hdf5::write(folder, plan, &plan.runs(), &journal, true).expect("results.h5");
    let read = |name: &str| fs::read(folder.join(name)).expect("table");
    tables::TABLES.into_iter().chain([hdf5::FILE]).map(read).collect()
}

#[test]
fn one_worker_or_four_shards_or_resumed_give_the_same_bytes_and_nothing_is_computed_twice() {
    let (plan, place) = (plan(3, 67), tempfile::tempdir().expect("folder"));
    let runs = plan.runs();
    let one = place.path().join("one");
    let done = compute(&Fake { failing: Some(120.0), ..Fake::default() }, &runs, 1, &one);
    assert_eq!((done.done, done.failed), (201, 3));
    let first = made(&one, &plan);

    let four = place.path().join("four");
    compute(&Fake { failing: Some(120.0), batch: 16, ..Fake::default() }, &runs, 4, &four);
    assert!(made(&four, &plan) == first, "four workers");

    let shards = place.path().join("shards");
    for index in [4, 0, 3, 1, 2] {
        let shard = Shard { index, count: 5 };
        let part: Vec<Run> =
            runs.iter().enumerate().filter(|(i, _)| shard.has(*i)).map(|(_, run)| run.clone()).collect();
        compute(&Fake { failing: Some(120.0), ..Fake::default() }, &part, 2, &shards);
    }
    assert!(made(&shards, &plan) == first, "shards");

    let resumed = place.path().join("resumed");
    let journal = Journal::open(&resumed).expect("journal");
    let mut computed = Vec::new();
    loop {
        let pending = Status::of(&runs, &journal).expect("status").pending(&runs, Shard::WHOLE);
        if pending.is_empty() {
            break;
        }
        let fake = Fake { failing: Some(120.0), ends_after: Some(7), ..Fake::default() };
        pool::compute(&fake, &pending, 2, &journal, &AtomicBool::new(false), &|_| {}).expect("computed");
        computed.extend(fake.computed.into_inner().expect("no panic"));
        // A table that is made in between leaves no trace.
        made(&resumed, &plan);
    }
    assert!(made(&resumed, &plan) == first, "resumed");
    assert_eq!(computed.len(), runs.len());
    computed.sort();
    computed.dedup();
    assert_eq!(computed.len(), runs.len(), "a run was computed twice");
}

#[test]
fn more_speeds_and_other_names_leave_the_ids_of_the_others() {
    let (few, mut more) = (plan(2, 5), plan(2, 9));
    more.trains[1].name = "another name".into();
    let ids = |plan: &Plan| plan.runs().into_iter().map(|run| run.id).collect::<Vec<_>>();
    assert!(ids(&few).iter().all(|id| ids(&more).contains(id)));
    more.variants[0].mass_factor = 0.9;
    assert!(ids(&few).iter().all(|id| !ids(&more).contains(id)));
    let mut unique = ids(&more);
    unique.sort();
    unique.dedup();
    assert_eq!(unique.len(), 18);
}

#[test]
fn a_train_ends_at_its_own_greatest_speed() {
    let mut plan = plan(2, 9);
    plan.trains[0].max_speed_km_h = Some(103.5);
    assert_eq!(plan.speeds(0).collect::<Vec<_>>(), [100.0, 101.0, 102.0, 103.0, 103.5]);
    assert_eq!(plan.speeds(1).count(), 9);
    plan.trains[0].max_speed_km_h = Some(90.0);
    assert_eq!(plan.speeds(0).count(), 0);
}

#[test]
fn a_value_that_is_not_finite_is_a_failed_run() {
    let mut record = common::record("0", 1.0);
    record.peaks[0].value = f64::NAN;
    assert!(record.finite().error.is_some_and(|error| error.contains("deck.acceleration")));
    let mut record = common::record("0", 1.0);
    record.envelopes[1].max[3] = f64::INFINITY;
    assert!(record.finite().error.is_some_and(|error| error.contains("deck.displacement")));
    assert!(common::record("0", 1.0).finite().error.is_none());
}

/// 5,000 runs: what is held at a time is one run and one block. The most memory this process ever had, before and after.
#[test]
fn five_thousand_runs_take_no_more_memory_than_five_hundred() {
    let place = tempfile::tempdir().expect("folder");
    let mut most = Vec::new();
    for speeds in [50, 500] {
        let (plan, folder) = (plan(10, speeds), place.path().join(speeds.to_string()));
        compute(&Fake { batch: 8, ..Fake::default() }, &plan.runs(), 2, &folder);
        made(&folder, &plan);
        let status = fs::read_to_string("/proc/self/status").expect("status");
        let line = status.lines().find(|line| line.starts_with("VmHWM")).expect("memory");
        most.push(line.split_whitespace().nth(1).and_then(|kb| kb.parse::<u64>().ok()).expect("number"));
    }
    assert!(most[1] < most[0] + 24_000, "{most:?} kB");
}
