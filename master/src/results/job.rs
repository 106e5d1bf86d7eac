//! What a run needs to know beside its two FMUs, whether it comes from a scenario or from a system structure.

use ttb_scenario::Checked;
use ttb_scenario::spec::Profile;
use ttb_scenario::types::Output;

use super::choice::Choice;
use super::scene::Scene;

/// A run to be done.
pub struct Job {
    /// One line for people.
    pub title: String,
    /// Where it comes from.
    pub origin: Origin,
    /// Seed of a random irregularity, where it is known.
    pub irregularity_seed: Option<u64>,
    /// Macro step, s.
    pub step: f64,
    /// Internal steps of train and track in each of them.
    pub substeps: usize,
    /// Why they are these, if they were left to the program.
    pub choice: Option<Choice>,
    /// End, s.
    pub end: f64,
    /// What is recorded.
    pub output: Output,
    /// What a picture needs to know.
    pub scene: Scene,
}

/// Fingerprint (SHA-256) of a run's origin.
pub enum Origin {
    /// Of what decides a scenario's result.
    Scenario(String),
    /// Of a system structure's file.
    System(String),
}

impl Job {
    /// Of a scenario whose steps are known.
    pub fn new(checked: &Checked, choice: Option<Choice>) -> Self {
        Self {
            title: checked.scenario.title.clone(),
            origin: Origin::Scenario(checked.hash.clone()),
            irregularity_seed: match checked.train_track.irregularity {
                Profile::Spectrum { seed, .. } => Some(seed),
                _ => None,
            },
            step: checked.steps().step,
            substeps: checked.steps().substeps,
            choice,
            end: checked.train_track.end,
            output: checked.scenario.output,
            scene: Scene::new(checked),
        }
    }
}
