//! Static load models: point forces and line loads that stand where they act worst.

use serde::{Deserialize, Serialize};

/// A line load.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Uniform {
    /// Where it begins, m; absent: as far back as the deck reaches.
    #[serde(default)]
    pub from: Option<f64>,
    /// Where it ends, m; absent: as far on as the deck reaches.
    #[serde(default)]
    pub to: Option<f64>,
    /// Load, kN/m in a file, N/m here.
    pub load: f64,
}

/// A static load model. Line loads stand only where they add to the effect that is sought.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LoadModel {
    /// Name, as on the command line.
    pub name: String,
    /// One line for people.
    pub title: String,
    /// Point forces (x in m from the model's origin, load in N; kN in a file).
    #[serde(default)]
    pub forces: Vec<[f64; 2]>,
    /// Line loads.
    pub uniform: Vec<Uniform>,
    /// Where the data come from.
    #[serde(default)]
    pub source: String,
    /// How sure they are.
    #[serde(default)]
    pub verified: String,
}

#[derive(Deserialize)]
struct File {
    source: String,
    verified: String,
    models: Vec<LoadModel>,
}

impl LoadModel {
    /// All loads times α.
    #[must_use]
    pub fn scaled(mut self, alpha: f64) -> Self {
        self.forces.iter_mut().for_each(|force| force[1] *= alpha);
        self.uniform.iter_mut().for_each(|uniform| uniform.load *= alpha);
        self
    }

    /// The abscissae between which the model has ends, m from its origin.
    #[must_use]
    pub fn extent(&self) -> [f64; 2] {
        let ends = self.uniform.iter().flat_map(|uniform| [uniform.from, uniform.to]).flatten();
        let places = self.forces.iter().map(|force| force[0]).chain(ends);
        places.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| [low.min(x), high.max(x)])
    }
}

fn all() -> Vec<LoadModel> {
    let file: Result<File, _> = serde_json::from_str(include_str!("../data/load-models.json"));
    debug_assert!(file.is_ok());
    let File { source, verified, models } =
        file.unwrap_or(File { source: String::new(), verified: String::new(), models: Vec::new() });
    let complete = |model: LoadModel| LoadModel { source: source.clone(), verified: verified.clone(), ..model };
    models.into_iter().map(|model| complete(model).scaled(1e3)).collect()
}

/// The load model of this name (`lm71`, `sw0`, `sw2`; `sw/0` and `LM71` are understood).
#[must_use]
pub fn load_model(name: &str) -> Option<LoadModel> {
    let name = name.trim().to_lowercase().replace(['/', '-'], "");
    all().into_iter().find(|model| model.name == name)
}

/// Names of the load models.
#[must_use]
pub fn load_model_names() -> Vec<String> {
    all().into_iter().map(|model| model.name).collect()
}
