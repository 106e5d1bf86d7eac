//! `ttb inspect-bridge`: a bridge's account of itself.

use std::path::Path;

use ttb_bridge::inspect::{inspect as inspect_spec, of_model};

use crate::cli::Set;
use crate::error::Error;
use crate::prepare::fmus;

/// The command: of a scenario's bridge, or of a model file.
pub fn inspect(file: &Path, set: &Set) -> Result<(), Error> {
    let failed = |e: ttb_contract::ModelError| Error::Input(e.to_string());
    let report = if is_model(file) {
        if !set.set.is_empty() {
            return Err(Error::Input(format!("--set: {} is a model file and no scenario", file.display())));
        }
        let model = ttb_scenario::model::load(file).map_err(Error::Scenario)?;
        of_model(&model, &[]).map_err(failed)?
    } else {
        inspect_spec(&fmus::scenario(Some(file), set)?.bridge).map_err(failed)?
    };
    say!("{report}");
    if report.is_sound() { Ok(()) } else { Err(Error::Input(format!("{}: the bridge is not sound", file.display()))) }
}

/// A scenario has a train, a model has nodes. What is neither is read as a scenario, whose checks say what is missing.
pub(super) fn is_model(file: &Path) -> bool {
    #[derive(serde::Deserialize)]
    struct Either {
        train: Option<serde::de::IgnoredAny>,
        nodes: Option<serde::de::IgnoredAny>,
    }
    let text = ttb_scenario::read_text(file).unwrap_or_default();
    serde_json::from_str::<Either>(&text).is_ok_and(|e| e.train.is_none() && e.nodes.is_some())
}
