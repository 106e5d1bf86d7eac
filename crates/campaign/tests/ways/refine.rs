//! Golden section finds resonances between the speeds, and goes on where it was ended.

use std::sync::atomic::{AtomicBool, Ordering};

use crate::common::{self, plan};
use ttb_assessment::Peak;
use ttb_campaign::refine::Refined;
use ttb_campaign::{Compute, Computed, Folder, Record, Run, Shard};

/// Where the resonances of the two trains are, km/h.
const AT: [[f64; 2]; 2] = [[111.37, 133.3], [118.02, 140.9]];

/// Two resonances a train, narrower than the speeds' step.
struct Resonant {
    /// Ends after so many runs.
    ends_after: usize,
    count: std::sync::atomic::AtomicUsize,
}

impl Compute for Resonant {
    fn batch(&self, runs: usize, workers: usize) -> usize {
        ttb_campaign::compute::small(2, runs, workers)
    }

    fn compute(&self, runs: &[Run], stop: &AtomicBool) -> Vec<Computed> {
        let one = |run: &Run| {
            if self.count.fetch_add(1, Ordering::Relaxed) >= self.ends_after {
                stop.store(true, Ordering::Relaxed);
                return Computed::Stopped;
            }
            let (v, record) = (run.speed_km_h.unwrap_or(0.0), common::record(&run.id, 1.0));
            let bell = |at: &f64, height: f64| height / (1.0 + ((v - at) / 4.0).powi(2));
            let value = bell(&AT[run.train][0], 1.0) + bell(&AT[run.train][1], 2.0);
            let peaks = record.peaks.iter().map(|peak| Peak { value, ..peak.clone() }).collect();
            Computed::Done(Record { peaks, ..record })
        };
        runs.iter().map(one).collect()
    }
}

fn refined() -> Refined {
    let keys = vec![("deck.acceleration".to_string(), "raw".to_string())];
    Refined { keys, resonances: vec![vec![133.0], Vec::new()] }
}

/// Computes until nothing is missing, ended every `ends_after` runs; all runs and how many times it took.
fn computed(ends_after: usize) -> (Vec<Run>, usize, tempfile::TempDir) {
    let place = tempfile::tempdir().expect("folder");
    let mut plan = plan(2, 0);
    plan.speeds_km_h = (0..=10).map(|i| 100.0 + 5.0 * f64::from(i)).collect();
    plan.refine = true;
    let folder = Folder::open(place.path(), plan).expect("folder");
    for times in 1.. {
        let (with, stop) = (Resonant { ends_after, count: 0.into() }, AtomicBool::new(false));
        folder.compute(&with, 1, Shard::WHOLE, &refined(), &stop, &|_, _| {}).expect("computed");
        if !stop.load(Ordering::Relaxed) {
            let runs = folder.runs(&refined()).expect("runs");
            folder.tables(&runs, true).expect("tables");
            return (runs, times, place);
        }
    }
    unreachable!("it ends some time");
}

#[test]
fn the_largest_value_is_found_between_the_speeds_and_refined_runs_are_marked() {
    let (runs, times, _place) = computed(usize::MAX);
    assert_eq!(times, 1);
    for (train, resonances) in AT.iter().enumerate() {
        for at in resonances {
            let near = runs.iter().filter(|run| run.train == train && run.refined).filter_map(|run| run.speed_km_h);
            let nearest = near.map(|v| (v - at).abs()).fold(f64::INFINITY, f64::min);
            assert!(nearest < 0.35, "{at} km/h: {nearest}");
        }
    }
    assert_eq!(runs.iter().filter(|run| !run.refined).count(), 22);
    assert!(runs.len() < 22 + 80, "{} runs", runs.len());
    let mut ids: Vec<&str> = runs.iter().map(|run| run.id.as_str()).collect();
    ids.sort_unstable();
    ids.dedup();
    assert_eq!(ids.len(), runs.len());
}

#[test]
fn a_refinement_that_was_ended_many_times_gives_the_same_bytes() {
    let (_, _, whole) = computed(usize::MAX);
    let (_, times, ended) = computed(5);
    assert!(times > 5);
    for name in ["runs.csv", "peaks.csv", "envelope.csv", "results.h5"] {
        let read = |place: &tempfile::TempDir| std::fs::read(place.path().join(name)).expect("table");
        assert!(read(&whole) == read(&ended), "{name}");
    }
}

#[test]
fn a_folder_of_another_scenario_is_refused_with_both_ways_out() {
    let place = tempfile::tempdir().expect("folder");
    let mut plan = plan(1, 3);
    Folder::open(place.path(), plan.clone()).expect("new");
    plan.speeds_km_h.push(500.0);
    Folder::open(place.path(), plan.clone()).expect("more speeds");
    plan.scenario_sha256 = "11".into();
    let error = Folder::open(place.path(), plan.clone()).expect_err("refused").to_string();
    assert!(error.contains("another folder with -o") && error.contains("--restart"), "{error}");
    Folder::discard(place.path()).expect("discarded");
    Folder::open(place.path(), plan).expect("anew");
}
