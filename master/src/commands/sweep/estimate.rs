//! `--dry-run`: how many runs, about how long, how much disk; known from one run.

use std::sync::atomic::AtomicBool;

use ttb_campaign::plan::Plan;
use ttb_campaign::{Compute, Computed, Runner, Shard};

use super::progress::duration;
use crate::cli::Common;
use crate::error::Error;

/// Bytes on disk for one in the journal: its share of the tables.
const TABLES: f64 = 2.0;

/// Prints it; the run in the middle of the plan is computed for it and not kept.
pub fn estimate(plan: &Plan, runner: &Runner, common: &Common, workers: usize) -> Result<(), Error> {
    let runs = plan.runs();
    let shard = common.shard.unwrap_or(Shard::WHOLE);
    let count = (0..runs.len()).filter(|i| shard.has(*i)).count();
    say!(
        "{count} runs: {} trains, {} speeds, {} variants, {} rails; way {}",
        plan.trains.len(),
        plan.speeds_km_h.len().max(1),
        plan.variants.len(),
        plan.rails.len(),
        plan.way
    );
    let middle = &runs[runs.len() / 2..=runs.len() / 2];
    for computed in runner.compute(middle, &AtomicBool::new(false)) {
        let Computed::Done(record) = computed else { continue };
        if let Some(error) = record.error {
            return Err(Error::Input(format!("the run in the middle of the plan fails: {error}")));
        }
        let seconds = record.seconds * count as f64;
        let bytes = serde_json::to_vec(&record).map_or(0, |bytes| bytes.len());
        let megabytes = 1e-6 * TABLES * bytes as f64 * count as f64;
        say!(
            "about {} of processor time, {} with {workers} workers; about {megabytes:.1} MB of disk",
            duration(seconds),
            duration(seconds / workers as f64)
        );
    }
    if plan.refine {
        say!("the refinement adds about 20 runs a train, variant and rail");
    }
    Ok(())
}
