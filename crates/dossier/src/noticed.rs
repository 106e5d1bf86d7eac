//! What the runs of a sweep over FMUs tell beside their rows: what could not be made, what was noticed.

use ttb_assessment::Missing;
use ttb_campaign::expand::Expanded;
use ttb_campaign::record::Records;
use ttb_campaign::{Error, Run};

use crate::folder::Assessment;

/// Remarks that are told at most.
const TOLD: usize = 30;

/// For the file beside the tables; `None`: the bridge is the scenario's own.
///
/// # Errors
/// A record cannot be read.
pub fn noticed(expanded: &Expanded, runs: &[Run], records: &dyn Records) -> Result<Option<Assessment>, Error> {
    if expanded.plan.bridges.is_empty() {
        return Ok(None);
    }
    let (mut missing, mut remarks, mut done) = (Vec::<Missing>::new(), Vec::<(String, usize)>::new(), 0);
    for run in runs {
        let Some(record) = records.of(&run.id)?.filter(|record| record.error.is_none()) else { continue };
        done += 1;
        for one in record.missing {
            let same = |known: &Missing| {
                (&known.quantity, &known.filter, &known.statistic) == (&one.quantity, &one.filter, &one.statistic)
            };
            if !missing.iter().any(same) {
                missing.push(one);
            }
        }
        for text in record.remarks {
            match remarks.iter_mut().find(|(known, _)| *known == text) {
                Some((_, count)) => *count += 1,
                None => remarks.push((text, 1)),
            }
        }
    }
    Ok(Some(Assessment {
        title: expanded.checked.scenario.title.clone(),
        facts: expanded.facts.clone(),
        limits: Vec::new(),
        missing,
        losses: Vec::new(),
        warnings: told(&remarks, done),
    }))
}

/// Every remark with the number of its runs, the first [`TOLD`] of them.
fn told(remarks: &[(String, usize)], done: usize) -> Vec<String> {
    let one = |(text, count): &(String, usize)| match *count {
        count if count == done => text.clone(),
        count => format!("{text} ({count} of {done} runs)"),
    };
    let more = remarks.len().saturating_sub(TOLD);
    let more = (more > 0).then(|| format!("{more} more remarks stand in the files of the runs (journal)"));
    remarks.iter().take(TOLD).map(one).chain(more).collect()
}
