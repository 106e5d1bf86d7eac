//! A part of the runs, for a task of a cluster: run i of the plan belongs to shard i mod n.

use std::str::FromStr;

/// Shard `index` of `count`, counted from 0 as the tasks of `--array=0-15` are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shard {
    /// From 0 to `count` − 1.
    pub index: usize,
    /// At least 1.
    pub count: usize,
}

impl Shard {
    /// Everything.
    pub const WHOLE: Self = Self { index: 0, count: 1 };

    /// Whether run `i` of the plan belongs to it.
    pub fn has(self, i: usize) -> bool {
        i % self.count == self.index
    }
}

impl FromStr for Shard {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let parts = text.split_once('/').and_then(|(i, n)| Some((i.parse().ok()?, n.parse().ok()?)));
        match parts {
            Some((index, count)) if index < count => Ok(Self { index, count }),
            Some((index, count @ 1..)) => {
                Err(format!("shard {index} of {count}: shards are counted from 0, the last is {}/{count}", count - 1))
            }
            _ => Err(format!("`{text}` must be i/n with 0 <= i < n, as in 3/16")),
        }
    }
}

impl std::fmt::Display for Shard {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}/{}", self.index, self.count)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_run_belongs_to_one_shard() {
        let shards: Vec<Shard> = (0..8).map(|i| format!("{i}/8").parse().unwrap()).collect();
        for run in 0..200 {
            assert_eq!(shards.iter().filter(|shard| shard.has(run)).count(), 1);
        }
        assert!("8/8".parse::<Shard>().unwrap_err().contains("the last is 7/8"));
        for wrong in ["", "3", "a/4", "0/0", "-1/4"] {
            assert!(wrong.parse::<Shard>().is_err(), "{wrong}");
        }
    }
}
