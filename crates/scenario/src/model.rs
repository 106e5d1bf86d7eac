//! Reads a finite-element model from a file of its own.
//!
//! ```text
//! text ─ types ─▶ model, its short parts walked ─ check ─▶ model
//!    └─ does not fit ─▶ json ─▶ value ─ walk ─▶ every problem
//! ```
//!
//! A large model is a few long lists of numbers. Those fit the schema once they fit the types, so that only a file with
//! problems is read into a generic value and walked as a whole.

use std::collections::HashSet;
use std::path::Path;

use crate::check::model::check;
use crate::problem::{MUST_FIT, Problems, Report};
use crate::types::{Beams, Model, Shells, Springs, Trusses};
use crate::{json, schema, walk};

/// Reads and checks a model file.
///
/// # Errors
/// All problems of the model; a file that cannot be read is one.
pub fn load(path: &Path) -> Result<Model, Problems> {
    let mut report = Report::new(&path.display().to_string());
    match ttb_import::text(path) {
        Ok(text) => from_str(text, &mut report),
        Err(error) => {
            report.problem("", "the model file cannot be read", error);
            None
        }
    }
    .filter(|_| report.problems.is_empty())
    .ok_or_else(|| report.into_problems())
}

/// Reads the model that a scenario names; its problems are told of its own file, even if the rest of it can be used.
pub(crate) fn read(path: &Path, report: &mut Report) -> Option<Model> {
    match ttb_import::text_of_file(path) {
        Ok(text) => {
            let mut inside = Report::new(&path.display().to_string());
            let model = from_str(text, &mut inside);
            report.absorb(inside);
            model
        }
        Err(error) => {
            let found = format!("{}: {error}", path.display());
            report.problem("$.bridge.structure.model", "the model file cannot be read", found);
            None
        }
    }
}

/// Checks a model given as text; `None` if it does not even fit the types. The text is dropped as soon as it can be.
pub(crate) fn from_str(text: String, report: &mut Report) -> Option<Model> {
    let typed: Result<Model, _> = serde_json::from_str(text.strip_prefix('\u{feff}').unwrap_or(&text));
    match typed {
        Ok(mut model) => {
            drop(text);
            // an editor's business, not part of the bridge
            model.schema = None;
            // what has been read can be written
            let short = serde_json::to_value(skeleton(&model)).unwrap_or_default();
            walk::walk(&schema::MODEL, &short, &HashSet::new(), report);
            check(&model, "$", report);
            Some(model)
        }
        Err(error) => {
            let document = json::read(&text, report)?;
            walk::walk(&schema::MODEL, &document.value, &document.reported, report);
            if report.problems.is_empty() {
                // what fits the schema fits the types; should that ever fail, it is a problem like any other
                report.problem("$", MUST_FIT, error);
            }
            None
        }
    }
}

/// The model without the long lists, on whose entries the schema sets no limits but types.
fn skeleton(model: &Model) -> Model {
    Model {
        nodes: model.nodes.iter().take(1).copied().collect(),
        beams: model.beams.iter().map(|list| Beams { elements: Vec::new(), ..list.clone() }).collect(),
        trusses: model.trusses.iter().map(|list| Trusses { elements: Vec::new(), ..list.clone() }).collect(),
        shells: model.shells.iter().map(|list| Shells { elements: Vec::new(), ..list.clone() }).collect(),
        springs: model.springs.iter().map(|list| Springs { elements: Vec::new(), ..list.clone() }).collect(),
        ..model.clone()
    }
}
