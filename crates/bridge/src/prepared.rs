//! What a bridge has that knows neither time nor train: mesh, order of elimination, rows, and the factors of the steps
//! asked for. Several bridges, also in several threads, share one.

use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

use ttb_contract::ModelError;
use ttb_dynamics::newmark::Newmark;
use ttb_scenario::spec::BridgeSpec;
use ttb_scenario::types::Damping;

use crate::law::Law;
use crate::structure::Structure;
use crate::system::Step;

/// Factorised steps kept.
const KEPT: usize = 4;

/// A factorised step and what it was made for.
struct Known {
    law: Law,
    newmark: Newmark,
    step: Arc<dyn Step>,
}

/// A bridge without a run.
pub struct Prepared {
    spec: BridgeSpec,
    /// Equations and rows.
    pub structure: Structure,
    /// The last used first. Locked while a step is factorised, never while one is taken: every bridge holds what it uses.
    steps: Mutex<Vec<Known>>,
    factorisations: AtomicUsize,
}

impl Prepared {
    /// Meshes, assembles, factorises K, finds modes where they are needed.
    ///
    /// # Errors
    /// Anything in the specification that cannot be: the message names it.
    pub fn new(spec: &BridgeSpec) -> Result<Arc<Self>, ModelError> {
        Self::from_folder(spec, Path::new(""))
    }

    /// As [`Prepared::new`], with what the specification leaves to a file in `folder`.
    ///
    /// # Errors
    /// As there; a file that is missing or damaged.
    pub fn from_folder(spec: &BridgeSpec, folder: &Path) -> Result<Arc<Self>, ModelError> {
        let structure = Structure::new(spec, folder)?;
        let (steps, factorisations) = (Mutex::default(), AtomicUsize::new(0));
        Ok(Arc::new(Self { spec: spec.clone(), structure, steps, factorisations }))
    }

    /// What the user should know of every bridge over this: see [`crate::Bridge::remarks`].
    pub fn remarks(&self) -> &[String] {
        &self.structure.remarks
    }

    /// The specification it was made from.
    pub fn spec(&self) -> &BridgeSpec {
        &self.spec
    }

    /// Whether a bridge of this specification can be had from here: another step, end, damping ratio or Newmark's method
    /// needs no new mesh. A reduced model belongs to one step and one damping.
    pub fn serves(&self, spec: &BridgeSpec) -> bool {
        let own = &self.spec;
        let shared = own.structure == spec.structure
            && (own.modes, own.reduction) == (spec.modes, spec.reduction)
            && own.supports == spec.supports
            && own.space == spec.space
            && (&own.ground, &own.ground_points) == (&spec.ground, &spec.ground_points)
            && own.points == spec.points
            && same_law(&own.damping, &spec.damping);
        let of_reduction = |spec: &BridgeSpec| (spec.step, spec.newmark, spec.damping.clone());
        shared && (own.reduction.is_none() || of_reduction(own) == of_reduction(spec))
    }

    /// The factorised step for a law and Newmark's constants; made once, whoever asks.
    ///
    /// # Errors
    /// A step so small that K̂ overflows: K and M themselves have passed before.
    pub fn step(&self, law: &Law, newmark: Newmark) -> Result<Arc<dyn Step>, ModelError> {
        // Nothing that happens while the lock is held leaves the list half-done.
        let mut steps = self.steps.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(at) = steps.iter().position(|known| known.newmark == newmark && known.law == *law) {
            steps[..=at].rotate_right(1);
        } else {
            let Structure { system, rows, supports, .. } = &self.structure;
            let step = Arc::clone(system).prepare(law, newmark, rows, *supports);
            let failed = |e| ModelError(format!("bridge: a step of {:?} s cannot be factorised: {e}", newmark.h));
            let step = step.map_err(failed)?;
            self.factorisations.fetch_add(1, Ordering::Relaxed);
            steps.truncate(KEPT - 1);
            steps.insert(0, Known { law: law.clone(), newmark, step });
        }
        Ok(Arc::clone(&steps[0].step))
    }

    /// Steps factorised so far.
    pub fn factorisations(&self) -> usize {
        self.factorisations.load(Ordering::Relaxed)
    }
}

/// The same damping but for its ratio.
fn same_law(a: &Damping, b: &Damping) -> bool {
    match (a, b) {
        (Damping::None, Damping::None) => true,
        (Damping::Rayleigh { at: a, .. }, Damping::Rayleigh { at: b, .. }) => a == b,
        (Damping::Modal { modes: a, .. }, Damping::Modal { modes: b, .. }) => a == b,
        _ => false,
    }
}
