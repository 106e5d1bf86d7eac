//! What a run needs to know beside its two FMUs, whether it comes from a scenario or from a system structure.

use sha2::{Digest, Sha256};
use ttb_scenario::spec::Profile;
use ttb_scenario::{Checked, Chosen};
use ttb_session::Case;

use super::belief::Scale;
use super::choice::Choice;
use super::provenance::{Options, Provenance};
use super::scene::Scene;
use crate::files::hexadecimal;

/// A run to be done.
pub struct Job {
    /// What is coupled, how and how long.
    pub case: Case,
    /// Where it comes from.
    pub origin: Origin,
    /// Seed of a random irregularity, where it is known.
    pub irregularity_seed: Option<u64>,
    /// What the scenario leaves out and was chosen.
    pub chosen: Vec<Chosen>,
    /// Why the steps are as they are, if they were left to the program.
    pub choice: Option<Choice>,
    /// What results are compared with to be believed.
    pub scale: Scale,
    /// What a picture needs to know.
    pub scene: Scene,
    /// Command and files.
    pub provenance: Provenance,
}

/// Fingerprint (SHA-256) of a run's origin.
pub enum Origin {
    /// Of what decides a scenario's result.
    Scenario(String),
    /// Of a system structure's file.
    System(String),
}

impl Origin {
    /// The fingerprint.
    pub fn hash(&self) -> &str {
        match self {
            Self::Scenario(hash) | Self::System(hash) => hash,
        }
    }
}

impl Job {
    /// Of a scenario whose steps are known.
    pub fn new(checked: &Checked, choice: Option<Choice>, provenance: Provenance) -> Self {
        Self {
            case: Case::of(checked),
            origin: Origin::Scenario(checked.hash.clone()),
            irregularity_seed: match checked.train_track.irregularity {
                Profile::Spectrum { seed, .. } => Some(seed),
                _ => None,
            },
            chosen: checked.chosen.clone(),
            choice,
            scale: Scale::new(checked),
            scene: Scene::new(checked),
            provenance,
        }
    }

    /// One hash over all that decides the results.
    ///
    /// ```text
    /// run_sha256 = SHA-256 of version, resolved scenario (or system structure), output settings, steps and why they are
    ///              these, every file read by what it was read as and its SHA-256, and the options that may change a result
    /// ```
    ///
    /// Not in it: paths, the title, `--isolate` and `--timeout` (an FMU gives the same bits in a process of its own),
    /// `--quiet` and `--output`.
    pub fn hash(&self) -> String {
        let Provenance { inputs, options, .. } = &self.provenance;
        // The scenario counts by what it means, which the origin's hash tells, not by how it is written.
        let inputs = inputs.iter().filter(|input| input.role != "scenario");
        let inputs: Vec<[&str; 2]> = inputs.map(|input| [input.role.as_str(), input.sha256.as_str()]).collect();
        let Options { preload, probe, .. } = options;
        let run =
            (self.case.step, self.case.substeps, self.case.end, &self.choice, self.case.every, self.case.supports);
        let run = (run, self.case.peaks);
        let all = (env!("CARGO_PKG_VERSION"), self.origin.hash(), run, inputs, preload, probe);
        // Numbers, texts and lists: there is nothing that cannot be written as JSON.
        hexadecimal(&Sha256::digest(serde_json::to_vec(&all).unwrap_or_default()))
    }
}
