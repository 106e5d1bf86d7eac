//! Runs of a plan, from the request or the stored plan to the tables.

use std::path::Path;

use ttb_campaign::expand::{self, Expanded};
use ttb_campaign::history::History;
use ttb_campaign::plan::Plan;
use ttb_campaign::request::Request;
use ttb_campaign::status::Status;
use ttb_campaign::{Folder, Limits, Runner, Shard, facts};

use super::estimate::estimate;
use super::outcome;
use super::over_fmu::Bridges;
use super::progress::Told;
use crate::assess::limits;
use crate::cli::{Common, Keep};
use crate::error::Error;
use crate::results::folder::Folder as Claimed;
use crate::signals::Stop;

/// Version that decides results.
const VERSION: &str = env!("CARGO_PKG_VERSION");

/// Resolves and computes a request.
pub fn request(request: &Request, common: &Common, stop: &Stop) -> Result<(), Error> {
    let expanded = expand(request, &common.output)?;
    if !common.quiet {
        expanded.chosen.iter().for_each(|chosen| note!("ttb: {chosen}"));
    }
    compute(expanded, common, stop)
}

/// Resolves a request; the plan names its scenario from the folder `beside`.
pub fn expand(request: &Request, beside: &Path) -> Result<Expanded, Error> {
    let texts = if request.limits.is_empty() { Vec::new() } else { limits::texts(&request.limits)? };
    let limits = Limits { texts };
    limits.criteria()?;
    Ok(expand::expand(request, VERSION, beside, limits)?)
}

/// A stored plan with its scenario, which must mean what it meant; its files are named from the folder `beside`.
pub fn stored(file: &Path, beside: &Path) -> Result<Expanded, Error> {
    let text = ttb_scenario::read_text(file).map_err(Error::io(file))?;
    let plan = Plan::parse(&text, &file.display().to_string())?;
    let folder = file.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let scenario = folder.join(&plan.scenario);
    let source = expand::source(&scenario, plan.set.iter().cloned())?;
    let checked = source.checked().map_err(Error::Scenario)?;
    if checked.hash != plan.scenario_sha256 {
        return Err(Error::Input(format!(
            "{}: {} has changed since the plan was made. Either put it back as it was, or make the plan anew, with another \
             folder or with --restart",
            file.display(),
            scenario.display()
        )));
    }
    let facts = facts::of_plan(&checked, !plan.bridges.is_empty());
    let plan = expand::moved(plan, folder, beside);
    Ok(Expanded { plan, source, checked, facts, chosen: Vec::new() })
}

/// Computes what is missing, then makes the tables.
pub fn compute(expanded: Expanded, common: &Common, stop: &Stop) -> Result<(), Error> {
    let count = expanded.plan.runs().len();
    if count == 0 {
        return Err(Error::Input("no run is asked for: every train's greatest speed is below the first speed".into()));
    }
    let workers = common.jobs.unwrap_or_else(processors).max(1);
    let bridges = Bridges::open(&expanded.plan, &common.output, common.timeout, &common.preload)?;
    if let Some(bridges) = &bridges {
        let first = expanded.source.of_run(&expanded.plan, &expanded.plan.runs()[0]).map_err(Error::Scenario)?;
        bridges.fit(&first)?;
    }
    let runner = over(Runner::new(&expanded)?, bridges.as_ref());
    if common.dry_run {
        return estimate(&expanded.plan, &runner, common, workers);
    }
    let all = common.keep_histories == Keep::All;
    let runner = if all { runner.keeping(&common.output) } else { runner };
    let shard = common.shard.unwrap_or(Shard::WHOLE);
    // Shards of one campaign write into one folder at the same time, each its own files.
    let claimed = if shard == Shard::WHOLE { Some(Claimed::claim(&common.output, stop)?) } else { None };
    if common.restart {
        Folder::discard(&common.output)?;
    }
    let folder = Folder::open(&common.output, expanded.plan.clone())?;
    if claimed.is_some() {
        folder.journal.clear_parts();
    }
    if common.retry {
        retry(&folder, shard)?;
    }
    if all {
        without_history(&folder, shard)?;
    }
    stop.gently();
    let told = Told::new(common.quiet);
    let refined = runner.refined();
    let tell = |count, progress| told.tell(count, progress);
    let computed = folder.compute(&runner, workers, shard, &refined, stop.flag(), &tell);
    told.end();
    computed?;
    if let Some(signal) = stop.asked() {
        if !common.quiet {
            note!("ttb: the runs that were done are kept; the same command computes the rest");
        }
        return Err(Error::Interrupted(signal));
    }
    if shard != Shard::WHOLE {
        return outcome::of_shard(&folder, shard, common.quiet);
    }
    outcome::finish(&folder, &runner, &expanded, (common.quiet, common.keep_histories, workers), stop)
}

/// With the FMUs of its plan, if there are any.
fn over<'a>(runner: Runner<'a>, bridges: Option<&'a Bridges>) -> Runner<'a> {
    match bridges {
        Some(bridges) => runner.over(bridges),
        None => runner,
    }
}

fn processors() -> usize {
    std::thread::available_parallelism().map_or(1, usize::from)
}

/// Removes the files of runs that were done when no histories were asked for.
fn without_history(folder: &Folder, shard: Shard) -> Result<(), Error> {
    for (_, run) in folder.plan.runs().iter().enumerate().filter(|(i, _)| shard.has(*i)) {
        if !History::is_kept(folder.path(), &run.id) {
            folder.journal.remove(&run.id)?;
        }
    }
    Ok(())
}

/// Removes the files of failed runs.
fn retry(folder: &Folder, shard: Shard) -> Result<(), Error> {
    let runs = folder.plan.runs();
    let of_shard: Vec<_> = runs.iter().enumerate().filter(|(i, _)| shard.has(*i)).map(|(_, run)| run.clone()).collect();
    for (id, _) in Status::of(&of_shard, &folder.journal)?.failed {
        folder.journal.remove(&id)?;
    }
    Ok(())
}

/// Makes the tables of a folder as it is.
pub fn merge(path: &Path, stop: &Stop) -> Result<(), Error> {
    let expanded = stored(&path.join(ttb_campaign::plan::FILE), path)?;
    let _claimed = Claimed::claim(path, stop)?;
    stop.gently();
    let folder = Folder::read(path)?;
    let bridges = Bridges::open(&expanded.plan, path, None, &[])?;
    let runner = over(Runner::new(&expanded)?, bridges.as_ref());
    outcome::finish(&folder, &runner, &expanded, (false, Keep::Worst, processors()), stop)
}
