//! A reduced model of a large bridge, with an error figure measured against all degrees of freedom.
//!
//! ```text
//! modes up to f ─▶ + what lies above (above.rs) ─▶ probe: both models under the same forces ─▶ error ≤ asked?
//!      ▲                                                                                       │ no: f ← 1.4 f
//!      └───────────────────────────────────────────────────────────────────────────────────────┘
//! ```
//!
//! It also ends, with a remark, when the space of vectors is full or closed or f is more than a step can show.

mod above;
mod probe;

use std::sync::Arc;

use serde::{Deserialize, Serialize};
use ttb_contract::ModelError;
use ttb_dynamics::newmark::Newmark;
use ttb_scenario::types::Reduction;
use ttb_sparse::Pencil;
use ttb_sparse::excited::Excited;
use ttb_sparse::{Factor, FactorError};

use self::above::{Above, Coordinates};
use self::probe::probe;
use crate::deck::Row;
use crate::full::Full;
use crate::law::Law;
use crate::reduced::Reduced;
use crate::rows::Rows;
use crate::system::System;

/// First highest frequency that is tried, Hz, and the factor to the next.
const FIRST: f64 = 30.0;
const NEXT: f64 = 1.4;
/// No basis grows beyond so many vectors.
const MOST: usize = 1600;

/// What a reduction kept and how wrong it is.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Accuracy {
    /// Number of natural modes kept.
    pub modes: usize,
    /// Number of pseudo-modes kept.
    pub pseudo_modes: usize,
    /// Number of poles between neighbouring supports, where these stand in the place of pseudo-modes.
    pub local_poles: usize,
    /// Highest frequency of the modes, Hz.
    pub highest_frequency: f64,
    /// Greatest difference of displacements under the probe load, relative to the greatest displacement.
    pub displacement: f64,
    /// The same of accelerations.
    pub acceleration: f64,
}

impl std::fmt::Display for Accuracy {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { modes, pseudo_modes, local_poles, highest_frequency, .. } = self;
        write!(f, "{modes} modes up to {highest_frequency:.0} Hz and ")?;
        match local_poles {
            0 => write!(f, "{pseudo_modes} pseudo-modes"),
            poles => write!(f, "{poles} poles above them between neighbouring supports"),
        }
    }
}

/// A reduced model.
pub struct Built {
    /// The equations in reduced coordinates.
    pub system: Reduced,
    /// Supports and monitored points, seen in these coordinates.
    pub rows: Rows,
    /// The error under the probe load.
    pub accuracy: Accuracy,
    /// What the user should know of it.
    pub remark: Option<String>,
}

/// Where the track's supports stand, and how many rows they have.
#[derive(Clone, Copy)]
pub struct Supports<'a> {
    /// m from the bridge's begin.
    pub stations: &'a [f64],
    /// One a station, or three: down, across and about the track, in blocks.
    pub ports: usize,
}

/// Builds the model from the matrices and the factor of K₀; B are the first of the `rows`, those of the supports.
///
/// # Errors
/// Dashpots, which couple the modes; K̂ is not positive definite.
pub fn build(
    pencil: &Arc<Pencil>,
    stiffness: &Factor,
    law: &Law,
    newmark: Newmark,
    rows: &[Row],
    supports: Supports,
    wish: &Reduction,
) -> Result<Built, ModelError> {
    if pencil.has_dashpots() {
        let rule = "bridge: a reduced model cannot have dashpots or a damping matrix; leave out `reduction`";
        return Err(ModelError(rule.into()));
    }
    if !law.rates.is_empty() {
        let rule = "bridge: a reduced model needs damping of type rayleigh or none; with modal damping give `modes`";
        return Err(ModelError(rule.into()));
    }
    let failed = |e: FactorError| ModelError(format!("bridge: {e}"));
    let Supports { ports, .. } = supports;
    let sparse = Arc::new(Rows::new(rows));
    let full = Arc::new(Full::new(Arc::clone(pencil), None, Default::default()));
    let full = full.prepare(law, newmark, &sparse, ports).map_err(failed)?;
    let truth = probe(&*full, &sparse, supports, pencil.ndof(), newmark.h);
    drop(full);
    let mut hertz = wish.highest_frequency.unwrap_or(FIRST);
    let above = Above::new(pencil, stiffness, rows, supports, (law, &newmark), hertz).map_err(failed)?;
    let mut excited = Excited::new(pencil, stiffness, &rows[..ports]);
    loop {
        let ritz = excited.modes(std::f64::consts::TAU * hertz, MOST);
        let (modes, highest) = (ritz.modes.omega2.len(), std::f64::consts::TAU * hertz);
        let Coordinates { omega2, rows, pseudo_modes, local_poles } = above.coordinates(&excited, &ritz, rows, highest);
        let system = Arc::new(Reduced::new(omega2));
        let shared = Arc::new(rows);
        let stepper = Arc::clone(&system).prepare(law, newmark, &shared, ports).map_err(failed)?;
        let seen = probe(&*stepper, &shared, supports, system.unknowns(), newmark.h);
        drop(stepper);
        let [displacement, acceleration] = [0, 1].map(|i| supports.difference(&seen[i], &truth[i], shared.len()));
        let highest_frequency = hertz;
        let accuracy = Accuracy { modes, pseudo_modes, local_poles, highest_frequency, displacement, acceleration };
        if acceleration.is_nan() {
            return Err(ModelError(
                "bridge: the reduced model answers the probe load with numbers that are none".into(),
            ));
        }
        let chosen = wish.highest_frequency.is_some();
        // A frequency that a step cannot show adds nothing.
        let exhausted = excited.dimension() >= MOST || excited.is_complete() || hertz * newmark.h > 0.5;
        if acceleration <= wish.error || chosen || exhausted {
            let missed = !chosen && acceleration > wish.error;
            let remark = missed.then(|| missed_remark(&accuracy, wish.error, excited.dimension()));
            let rows = Arc::unwrap_or_clone(shared);
            let system = Arc::into_inner(system).ok_or_else(|| ModelError("bridge: a model is held twice".into()))?;
            return Ok(Built { system, rows, accuracy, remark });
        }
        hertz *= NEXT;
    }
}

fn missed_remark(accuracy: &Accuracy, wish: f64, vectors: usize) -> String {
    format!(
        "bridge: the reduced model was to be right to {wish:e} of the greatest acceleration and reaches {:.1e}, with \
         {accuracy} out of {vectors} vectors; a greater `reduction.error`, or no `reduction`, says what is meant",
        accuracy.acceleration
    )
}
