//! What a run needs to know beside its two FMUs, whether it comes from a scenario or from a system structure.

use ttb_scenario::Checked;
use ttb_scenario::spec::Profile;
use ttb_session::Case;

use super::choice::Choice;
use super::provenance::Provenance;
use super::scene::Scene;

/// A run to be done.
pub struct Job {
    /// What is coupled, how and how long.
    pub case: Case,
    /// Where it comes from.
    pub origin: Origin,
    /// Seed of a random irregularity, where it is known.
    pub irregularity_seed: Option<u64>,
    /// Why the steps are as they are, if they were left to the program.
    pub choice: Option<Choice>,
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
            choice,
            scene: Scene::new(checked),
            provenance,
        }
    }
}
