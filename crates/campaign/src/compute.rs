//! What computes runs: the seam behind which the ways are.

use std::sync::atomic::AtomicBool;

use crate::plan::Run;
use crate::record::Record;

/// How the computing of a run ended.
#[derive(Clone, Debug, PartialEq)]
pub enum Computed {
    /// With results, or with a failure that would come again.
    Done(Record),
    /// It was asked to stop before the end; the run is as if it had never begun.
    Stopped,
}

/// Something that computes runs of a plan. The result of a run must not depend on which others are computed with it.
pub trait Compute: Sync {
    /// How many runs a call takes best, of so many that a number of workers share.
    fn batch(&self, _runs: usize, _workers: usize) -> usize {
        1
    }

    /// Whether two runs, one behind the other, share something that a call makes for itself.
    fn share(&self, _a: &Run, _b: &Run) -> bool {
        false
    }

    /// Puts runs into the order in which they cost least together; the results do not depend on it.
    fn arrange(&self, _runs: &mut [Run]) {}

    /// Computes runs: one answer each, in their order. `stop` asks to leave off; whoever looks at it does so between steps.
    fn compute(&self, runs: &[Run], stop: &AtomicBool) -> Vec<Computed>;
}

/// At most so many runs a batch, and so few that all workers end at about the same time.
pub fn small(most: usize, runs: usize, workers: usize) -> usize {
    most.min(runs.div_ceil(4 * workers))
}

/// Runs in parts of at most `most`, a call each, cut where runs share nothing as far as that can be.
pub fn parts<'a>(with: &(impl Compute + ?Sized), runs: &'a [Run], most: usize) -> Vec<&'a [Run]> {
    let (most, mut lengths) = (most.max(1), Vec::<usize>::new());
    for alike in runs.chunk_by(|a, b| with.share(a, b)) {
        match lengths.last_mut() {
            Some(last) if *last + alike.len() <= most => *last += alike.len(),
            _ => {
                let part = alike.len().div_ceil(alike.len().div_ceil(most));
                lengths.extend(alike.chunks(part).map(<[Run]>::len));
            }
        }
    }
    let mut rest = runs;
    let mut next = |length: usize| {
        let (part, behind) = rest.split_at(length);
        rest = behind;
        part
    };
    lengths.into_iter().map(&mut next).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan::Rail;

    /// Shares what is made for a train.
    struct OfTrains;

    impl Compute for OfTrains {
        fn share(&self, a: &Run, b: &Run) -> bool {
            a.train == b.train
        }

        fn compute(&self, _runs: &[Run], _stop: &AtomicBool) -> Vec<Computed> {
            Vec::new()
        }
    }

    #[test]
    fn parts_end_where_nothing_is_shared_and_are_equal_where_one_is_too_long() {
        let lengths = |of_trains: &[usize], most: usize| -> Vec<usize> {
            let runs = of_trains.iter().enumerate().flat_map(|(train, count)| vec![run(train); *count]);
            let runs: Vec<Run> = runs.collect();
            let parts = parts(&OfTrains, &runs, most);
            assert_eq!(parts.concat(), runs);
            parts.into_iter().map(<[Run]>::len).collect()
        };
        assert_eq!(lengths(&[57, 57, 57], 64), [57, 57, 57]);
        assert_eq!(lengths(&[57, 3, 4], 20), [19, 19, 19, 7]);
        assert_eq!(lengths(&[1, 1, 1, 1, 1], 2), [2, 2, 1]);
        assert_eq!(lengths(&[5], 0), [1, 1, 1, 1, 1]);
        assert!(lengths(&[], 5).is_empty());
    }

    fn run(train: usize) -> Run {
        Run { id: train.to_string(), train, variant: 0, rail: Rail::Scenario, speed_km_h: None, refined: false }
    }
}
