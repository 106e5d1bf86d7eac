//! What of a plan is there.

use crate::error::Error;
use crate::journal::Journal;
use crate::plan::Run;
use crate::shard::Shard;

/// Counts of runs.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Status {
    /// Runs of the plan.
    pub runs: usize,
    /// Runs whose file is there, failed ones too.
    pub done: usize,
    /// Runs that failed, with their messages; the first of them.
    pub failed: Vec<(String, String)>,
    /// Positions of the runs that are missing.
    pub missing: Vec<usize>,
    /// Seconds of the runs that are done.
    pub seconds: f64,
}

impl Status {
    /// Reads the journal's files of these runs.
    ///
    /// # Errors
    /// A file cannot be read.
    pub fn of(runs: &[Run], journal: &Journal) -> Result<Self, Error> {
        let mut status = Self { runs: runs.len(), ..Self::default() };
        for (i, run) in runs.iter().enumerate() {
            match journal.read(&run.id)? {
                Some(record) => {
                    status.done += 1;
                    status.seconds += record.seconds;
                    status.failed.extend(record.error.map(|error| (run.id.clone(), error)));
                }
                None => status.missing.push(i),
            }
        }
        Ok(status)
    }

    /// The shards of `count` that are not whole, with the number of missing runs of each.
    pub fn gaps(&self, count: usize) -> Vec<(Shard, usize)> {
        let missing = |shard: Shard| self.missing.iter().filter(|i| shard.has(**i)).count();
        (0..count).map(|index| Shard { index, count }).map(|s| (s, missing(s))).filter(|(_, n)| *n > 0).collect()
    }

    /// Runs that are not in the journal, for [`Plan::runs`](crate::Plan::runs) in their order.
    pub fn pending(&self, runs: &[Run], shard: Shard) -> Vec<Run> {
        self.missing.iter().filter(|i| shard.has(**i)).map(|i| runs[*i].clone()).collect()
    }
}
