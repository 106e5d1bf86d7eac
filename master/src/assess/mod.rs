//! From runs to verdicts: what is watched during a run, the tables of a folder, limits and facts.

pub mod limits;
pub mod run;
pub mod tables;
pub mod verify;
pub mod watch;
