//! After the last run: tables, the governing runs once more, curves, a summary, the next command.

use std::collections::BTreeMap;
use std::path::Path;

use ttb_assessment::filter::RAW;
use ttb_assessment::peak::quantity::{DECK_ACCELERATION, DECK_DISPLACEMENT};
use ttb_campaign::expand::Expanded;
use ttb_campaign::governing::{self, Compared, Governing};
use ttb_campaign::plan::{Load, Plan};
use ttb_campaign::slurm::quoted;
use ttb_campaign::status::Status;
use ttb_campaign::{Folder, Run, Runner, Shard, Way};
use ttb_dossier::folder::FILE;
use ttb_dossier::noticed::noticed;
use ttb_scenario::spec::Profile;

use crate::cli::Keep;
use crate::error::Error;
use crate::files::write_json;
use crate::pictures::speeds::{Line, Speeds};
use crate::signals::Stop;

/// Failed runs that are listed.
const LISTED: usize = 5;

/// Ends a shard: nothing is made of it yet.
pub fn of_shard(folder: &Folder, shard: Shard, quiet: bool) -> Result<(), Error> {
    let runs = folder.plan.runs();
    let own: Vec<Run> = runs.iter().enumerate().filter(|(i, _)| shard.has(*i)).map(|(_, run)| run.clone()).collect();
    let status = Status::of(&own, &folder.journal)?;
    if !quiet {
        say!("shard {shard}: {} of {} runs", status.done, status.runs);
        say!("next: ttb campaign merge {}", shown(folder.path()));
    }
    failed(&status)
}

/// Ends a campaign.
pub fn finish(
    folder: &Folder,
    runner: &Runner,
    expanded: &Expanded,
    (quiet, keep, workers): (bool, Keep, usize),
    stop: &Stop,
) -> Result<(), Error> {
    let runs = folder.runs(&runner.refined())?;
    let status = Status::of(&runs, &folder.journal)?;
    let governing = governing::of(&runs, &runner.refined().keys, &folder.journal)?;
    let compared = again(folder, runner, &governing, (keep, workers), stop)?;
    let own_is_smooth = matches!(expanded.checked.train_track.irregularity, Profile::None);
    folder.tables(&runs, own_is_smooth)?;
    let noticed = noticed(expanded, &runs, &folder.journal)?;
    if let Some(noticed) = &noticed {
        write_json(&folder.path().join(FILE), noticed)?;
    }
    curves(folder, &runs, &expanded.checked.scenario.title)?;
    if !quiet {
        say!(
            "{} runs in {}: {} done, {} failed",
            runs.len(),
            shown(folder.path()),
            status.done - status.failed.len(),
            status.failed.len()
        );
        governing.iter().for_each(|one| say!("{}", sentence(&folder.plan, one)));
        compared.iter().for_each(|one| say!("{}", of_compared(one)));
        noticed.iter().flat_map(|noticed| &noticed.warnings).for_each(|text| note!("ttb: warning: {text}"));
        for (id, error) in status.failed.iter().take(LISTED) {
            say!("failed: {id}: {}", error.lines().next().unwrap_or_default());
        }
        if status.failed.len() > LISTED {
            say!("failed: {} more, all in runs.csv", status.failed.len() - LISTED);
        }
        say!("tables and curves.svg are in {}; {}", shown(folder.path()), next(folder, &status));
    }
    failed(&status)
}

/// The next command to type.
fn next(folder: &Folder, status: &Status) -> String {
    let path = quoted(&shown(folder.path()));
    if status.failed.is_empty() {
        format!("next: ttb report {path}")
    } else {
        format!("next, once more what failed: ttb campaign {path}/plan.json -o {path} --retry")
    }
}

fn failed(status: &Status) -> Result<(), Error> {
    match status.failed.len() {
        0 => Ok(()),
        count => Err(Error::RunsFailed { count, of: status.runs }),
    }
}

/// Governing runs once more: their histories, and of axle loads what the coupled way says.
fn again(
    folder: &Folder,
    runner: &Runner,
    governing: &[Governing],
    (keep, workers): (Keep, usize),
    stop: &Stop,
) -> Result<Vec<Compared>, Error> {
    // The coupled way compared with itself says nothing.
    let coupled = folder.plan.way == Way::Coupled;
    if coupled && keep != Keep::Worst {
        return Ok(Vec::new());
    }
    let mut repeated = BTreeMap::new();
    for (id, again) in runner.again_each(governing, workers, stop.flag()) {
        match again {
            Ok(Some((record, history))) => {
                if keep == Keep::Worst {
                    history.write(folder.path(), &id)?;
                }
                repeated.extend(record.map(|record| (id, record)));
            }
            Ok(None) => return stop.asked().map_or(Ok(Vec::new()), |signal| Err(Error::Interrupted(signal))),
            Err(error) => note!("ttb: warning: the governing run {id} could not be repeated: {error}"),
        }
    }
    if coupled {
        return Ok(Vec::new());
    }
    let compared = governing::all_compared(&folder.plan, governing, &repeated);
    write_json(&folder.path().join(governing::FILE), &compared)?;
    Ok(compared)
}

fn sentence(plan: &Plan, one: &Governing) -> String {
    let (train, variant) = (&plan.trains[one.run.train].name, &plan.variants[one.run.variant].name);
    let speed = one.run.speed_km_h.map_or_else(|| "its own speed".into(), |speed| format!("{speed} km/h"));
    let mut with = String::new();
    if !variant.is_empty() {
        with += &format!(", {variant}");
    }
    let rail = one.run.rail.to_string();
    if !rail.is_empty() {
        with += &format!(", rail {rail}");
    }
    let (quantity, filter) = &one.key;
    let value = shown_value(quantity, one.value);
    format!("largest {quantity} ({filter}) {value}: train {train} at {speed}{with} (run {})", one.run.id)
}

fn of_compared(one: &Compared) -> String {
    let [sweep, coupled] = [one.sweep, one.coupled].map(|value| shown_value(&one.quantity, value));
    let word = if one.difference.abs() <= one.allowed { "agrees" } else { "DIFFERS" };
    format!(
        "{}, run {}: {sweep} in the sweep, {coupled} step by step on a rigid track: {word} ({:+.3} %, allowed {} %)",
        one.quantity,
        one.run_id,
        100.0 * one.difference,
        100.0 * one.allowed
    )
}

fn shown_value(quantity: &str, value: f64) -> String {
    if quantity == DECK_DISPLACEMENT { format!("{:.3} mm", 1e3 * value) } else { format!("{value:.3} m/s2") }
}

fn shown(path: &Path) -> String {
    path.display().to_string()
}

/// Largest values over speed, a line for every train, variant and rail.
fn curves(folder: &Folder, runs: &[Run], title: &str) -> Result<(), Error> {
    let mut lines: [Vec<Line>; 2] = [Vec::new(), Vec::new()];
    let plan = &folder.plan;
    for train in 0..plan.trains.len() {
        for variant in 0..plan.variants.len() {
            for rail in &plan.rails {
                let mut points: [Vec<(f64, f64)>; 2] = [Vec::new(), Vec::new()];
                for run in runs.iter().filter(|run| (run.train, run.variant, run.rail) == (train, variant, *rail)) {
                    let (Some(speed), Some(record)) = (run.speed_km_h, folder.journal.read(&run.id)?) else { continue };
                    for ((quantity, factor), points) in
                        [(DECK_ACCELERATION, 1.0), (DECK_DISPLACEMENT, 1e3)].into_iter().zip(&mut points)
                    {
                        points.extend(record.amount(quantity, RAW).map(|value| (speed, factor * value)));
                    }
                }
                let name = plan.title(train, variant, *rail);
                for (lines, mut points) in lines.iter_mut().zip(points) {
                    points.sort_by(|a, b| a.0.total_cmp(&b.0));
                    lines.push((name.clone(), points));
                }
            }
        }
    }
    let rigid = plan.trains.iter().all(|train| matches!(train.load, Load::Axles(_)));
    let of = if rigid { "moving axle loads" } else { "vehicles" };
    let [acceleration, deflection] = lines;
    let panels = vec![
        (format!("Largest deck acceleration, m/s² ({of}, raw)"), acceleration),
        (format!("Largest deflection, mm ({of})"), deflection),
    ];
    Speeds::new(title, panels).save(&folder.path().join("curves"))
}
