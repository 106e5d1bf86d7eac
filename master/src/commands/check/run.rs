//! A whole run: numbers, statuses, memory.

use std::time::{Duration, Instant};

use ttb_contract::finite::not_finite;
use ttb_fmi::platform::resident;

use super::context::Context;
use super::drive::{Drive, open};
use super::finding::Finding;

/// Bounds of a run.
const STEPS: usize = 5000;
const TIME: Duration = Duration::from_secs(4);

/// Growth of memory that is taken for a leak: kB in all, and bytes a step.
const GROWTH: f64 = 512.0;
const GROWTH_PER_STEP: f64 = 200.0;

/// Steps to the stop time, or as far as there is time.
pub fn run(context: &Context) -> Result<(), Finding> {
    let (probe, plan) = open(context)?;
    let mut drive = Drive::fresh(&probe, &plan)?;
    let begin = Instant::now();
    let steps = plan.steps(STEPS);
    let mut memory = Vec::with_capacity(steps);
    let mut ended = Ok(());
    for k in 0..steps {
        let values = match drive.step(k, 0.0) {
            Ok(values) => values,
            Err(finding) => {
                ended = Err(finding);
                break;
            }
        };
        if let Some(i) = not_finite(&values) {
            let name = if values[i].is_nan() { "nan" } else { "infinite" };
            let finding = Finding::error(name, "an output is no finite number");
            let at = format!("{}, t = {} s", plan.name(i), plan.time(k + 1));
            context.find(finding.at(at).seen(format!("{}", values[i])));
            break;
        }
        memory.push(resident());
        if begin.elapsed() > TIME {
            break;
        }
    }
    if let Some(seen) = growth(&memory) {
        context.find(Finding::warning("memory-growth", "memory grows with every step").seen(seen));
    }
    let late = drive.warnings;
    if late > 0 {
        let finding = Finding::warning("warnings", "calls answer fmi2Warning in an ordinary run");
        context.find(finding.seen(format!("{late} times in {} steps", memory.len())));
    }
    ended?;
    drive.instance.terminate();
    drive.instance.free();
    Ok(())
}

/// Whether memory grows steadily: in the second and in the third third.
pub fn growth(memory: &[f64]) -> Option<String> {
    let n = memory.len();
    let (early, middle, late) = (*memory.get(n / 3)?, *memory.get(2 * n / 3)?, *memory.last()?);
    let per_step = |kilobytes: f64| kilobytes * 1024.0 / (n as f64 / 3.0);
    let steady = per_step(middle - early) > GROWTH_PER_STEP && per_step(late - middle) > GROWTH_PER_STEP;
    let total = late - early;
    (steady && total > GROWTH).then(|| format!("{total:.0} kB more after {} times", n - n / 3))
}
