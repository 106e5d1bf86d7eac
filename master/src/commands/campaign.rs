//! `ttb campaign`: grids over any key of a scenario; shards; what is done and what is missing.

use std::path::Path;

use ttb_campaign::request::Request;
use ttb_campaign::slurm::{Array, quoted};
use ttb_campaign::status::Status;
use ttb_campaign::{Folder, plan};

use super::sweep::compute;
use crate::cli::{Campaign, CampaignVerb};
use crate::error::Error;
use crate::signals::Stop;

/// The command.
pub fn campaign(arguments: &Campaign, stop: &Stop) -> Result<(), Error> {
    match (&arguments.verb, &arguments.plan, &arguments.common) {
        (Some(CampaignVerb::Status { folder, shards }), _, _) => status(folder, *shards),
        (Some(CampaignVerb::Merge { folder, partial }), _, _) => merge(folder, *partial, stop),
        (Some(CampaignVerb::Plan { plan, output, tasks, minutes }), _, _) => {
            script(plan, output.as_deref(), *tasks, *minutes)
        }
        (None, Some(file), Some(common)) if is_stored(file) => {
            compute::compute(compute::stored(file, &common.output)?, common, stop)
        }
        (None, Some(file), Some(common)) => compute::request(&Request::read(file)?, common, stop),
        _ => Err(Error::Input("give the file that says what is varied, and -o; `ttb campaign --help` tells".into())),
    }
}

/// Whether a file is a plan that this program has stored, and not a request.
fn is_stored(file: &Path) -> bool {
    #[derive(serde::Deserialize)]
    struct Stored {
        format: Option<u32>,
    }
    let text = ttb_scenario::read_text(file).unwrap_or_default();
    serde_json::from_str::<Stored>(&text).is_ok_and(|stored| stored.format.is_some())
}

fn status(path: &Path, shards: Option<usize>) -> Result<(), Error> {
    let folder = Folder::read(path)?;
    let runs = folder.plan.runs();
    let status = Status::of(&runs, &folder.journal)?;
    let (missing, failed) = (status.missing.len(), status.failed.len());
    say!("{} runs: {} done, {failed} failed, {missing} missing", status.runs, status.done - failed);
    for (shard, count) in shards.map(|count| status.gaps(count.max(1))).unwrap_or_default() {
        say!("shard {shard}: {count} missing");
    }
    let shown = quoted(&path.display().to_string());
    if missing > 0 {
        say!("next: ttb campaign {shown}/plan.json -o {shown}");
    } else {
        say!("next: ttb campaign merge {shown}");
    }
    Ok(())
}

fn merge(path: &Path, partial: bool, stop: &Stop) -> Result<(), Error> {
    let folder = Folder::read(path)?;
    let status = Status::of(&folder.plan.runs(), &folder.journal)?;
    let shown = quoted(&path.display().to_string());
    if !status.missing.is_empty() && !partial {
        return Err(Error::Input(format!(
            "{}: {} of {} runs are missing, the first is number {} of the plan. Compute them: ttb campaign {shown}/plan.json \
             -o {shown}; or make tables of what is there: ttb campaign merge {shown} --partial",
            path.display(),
            status.missing.len(),
            status.runs,
            status.missing[0]
        )));
    }
    compute::merge(path, stop)
}

fn script(file: &Path, output: Option<&Path>, tasks: usize, minutes: u64) -> Result<(), Error> {
    let folder = match output {
        None => Folder::read(file)?,
        Some(output) => {
            std::fs::create_dir_all(output).map_err(Error::io(output))?;
            Folder::open(output, compute::expand(&Request::read(file)?, output)?.plan)?
        }
    };
    let runs = folder.plan.runs().len();
    if tasks == 0 || tasks > runs {
        return Err(Error::Input(format!("--tasks: it must be from 1 to {runs}, the number of runs: {tasks}")));
    }
    let place = folder.path().canonicalize().map_err(Error::io(folder.path()))?;
    let program = std::env::current_exe().map_err(Error::io(Path::new("ttb")))?;
    let (program, place) = (program.display().to_string(), place.display().to_string());
    let text = Array { program: &program, folder: &place, tasks, minutes }.script();
    say!("{}", text.trim_end());
    note!("ttb: {runs} runs, plan in {place}/{}; next: sbatch with this script", plan::FILE);
    Ok(())
}
