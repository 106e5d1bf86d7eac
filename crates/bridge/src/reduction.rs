//! A reduced model of a large bridge, with an error figure measured against all degrees of freedom.
//!
//! ```text
//! modes up to f ─▶ + static and single-step answers ─▶ probe: both models under the same forces ─▶ error ≤ asked?
//!      ▲                                                                                          │ no: f ← 1.4 f
//!      └──────────────────────────────────────────────────────────────────────────────────────────┘
//! ```
//!
//! It also ends, with a remark, when the space of vectors is full or closed or f is more than a step can show.
//!
//! The probe is a train of axle loads that runs over the supports and trembles by ± 15 % with frequencies from 1 to
//! 100 Hz, harder than a train on a track, whose rail spreads and whose springs hold back what is fast.

use std::sync::Arc;

use serde::{Deserialize, Serialize};
use ttb_contract::ModelError;
use ttb_contract::finite::largest;
use ttb_dynamics::newmark::{Motion, Newmark};
use ttb_dynamics::reduction::{Answers, Shifted, reduce};
use ttb_scenario::types::Reduction;
use ttb_sparse::Pencil;
use ttb_sparse::excited::Excited;
use ttb_sparse::{Factor, FactorError};

use crate::deck::Row;
use crate::full::Full;
use crate::law::Law;
use crate::reduced::Reduced;
use crate::rows::Rows;
use crate::system::{Base, Step, System, Work};

/// First highest frequency that is tried, Hz, and the factor to the next.
const FIRST: f64 = 30.0;
const NEXT: f64 = 1.4;
/// No basis grows beyond so many vectors.
const MOST: usize = 1600;
/// Pseudo-modes with a smaller share in every compliance are left out.
const NEGLIGIBLE: f64 = 1e-6;
/// Steps of the probe.
const PROBE: usize = 160;

/// What a reduction kept and how wrong it is.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Accuracy {
    /// Number of natural modes kept.
    pub modes: usize,
    /// Number of pseudo-modes kept.
    pub pseudo_modes: usize,
    /// Highest frequency of the modes, Hz.
    pub highest_frequency: f64,
    /// Greatest difference of displacements under the probe load, relative to the greatest displacement.
    pub displacement: f64,
    /// The same of accelerations.
    pub acceleration: f64,
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
    let [c_k, c_m] = law.effective(&newmark);
    let mut hertz = wish.highest_frequency.unwrap_or(FIRST);
    // Between statics and a step, on a logarithmic scale.
    let between = std::f64::consts::TAU * hertz * (c_m / c_k).sqrt();
    let mut answers = Answers::default();
    answers.add(pencil, Shifted { factor: stiffness, stiffness: 1.0, mass: 0.0 }, rows, ports);
    for [stiffness, mass] in [[1.0, between], [c_k, c_m]] {
        let factor = pencil.factor(stiffness, mass, 0.0).map_err(failed)?;
        answers.add(pencil, Shifted { factor: &factor, stiffness, mass }, rows, ports);
    }
    let mut excited = Excited::new(pencil, stiffness, &rows[..ports]);
    loop {
        let ritz = excited.modes(std::f64::consts::TAU * hertz, MOST);
        let basis = reduce(&answers, &excited, &ritz, rows, NEGLIGIBLE);
        let modes = basis.modes;
        let pseudo_modes = basis.omega2.len() - modes;
        let rows = Rows::Single(basis.shapes.single());
        let system = Arc::new(Reduced::new(basis.omega2));
        let shared = Arc::new(rows);
        let stepper = Arc::clone(&system).prepare(law, newmark, &shared, ports).map_err(failed)?;
        let seen = probe(&*stepper, &shared, supports, system.unknowns(), newmark.h);
        drop(stepper);
        let [displacement, acceleration] = [0, 1].map(|i| supports.difference(&seen[i], &truth[i], shared.len()));
        let accuracy = Accuracy { modes, pseudo_modes, highest_frequency: hertz, displacement, acceleration };
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

/// Displacements and accelerations of all rows under the probe load, step by step.
fn probe(step: &dyn Step, rows: &Rows, supports: Supports, unknowns: usize, h: f64) -> [Vec<f64>; 2] {
    let (mut base, mut next, mut work) = (Base::default(), Motion::default(), Work::default());
    base.motion = Motion::rest(unknowns);
    let (mut displacements, mut accelerations) = (Vec::new(), Vec::new());
    let mut forces = vec![0.0; supports.ports];
    let mut seen = vec![0.0; rows.len()];
    for n in 1..=PROBE {
        supports.load(n as f64 * h, &mut forces);
        step.begin(&mut base, &mut work);
        step.finish(&base, &forces, &mut next, &mut work);
        for (values, kept) in [(&next.u, &mut displacements), (&next.a, &mut accelerations)] {
            rows.multiply(values, &mut seen);
            kept.extend_from_slice(&seen);
        }
        std::mem::swap(&mut base.motion, &mut next);
    }
    [displacements, accelerations]
}

impl Supports<'_> {
    /// Forces of the probe at a time; in space a fifth of them across, and their moment about the track with a lever of 0.2 m.
    fn load(self, t: f64, forces: &mut [f64]) {
        let (down, others) = forces.split_at_mut(self.stations.len());
        load(self.stations, t, down);
        for (block, share) in others.chunks_mut(self.stations.len().max(1)).zip([0.2, 0.2]) {
            block.iter_mut().zip(&*down).for_each(|(force, down)| *force = share * down);
        }
    }

    /// Greatest difference relative to the greatest value, the worst of: down and monitored points, across, about the track.
    fn difference(self, a: &[f64], b: &[f64], rows: usize) -> f64 {
        let stations = self.stations.len();
        if self.ports == stations {
            return difference(a, b);
        }
        let block = |row: usize| if row < self.ports { row / stations.max(1) } else { 0 };
        let of = |values: &[f64], wanted: usize| -> Vec<f64> {
            let kept = values.iter().enumerate().filter(|(i, _)| block(i % rows) == wanted);
            kept.map(|(_, value)| *value).collect()
        };
        largest((0..3).map(|i| difference(&of(a, i), &of(b, i))))
    }
}

/// Forces of the probe at a time: axles of 150 kN in pairs over the whole bridge, each shared by the supports beside it.
fn load(stations: &[f64], t: f64, forces: &mut [f64]) {
    const AXLE: f64 = 150e3;
    const SPEED: f64 = 70.0;
    const PITCH: [f64; 2] = [2.5, 17.4];
    /// Of the axles' grip, s.
    const RISE: f64 = 0.02;
    const HERTZ: [f64; 10] = [1.0, 3.1, 7.7, 13.3, 21.7, 34.9, 48.1, 63.7, 81.3, 99.1];
    forces.fill(0.0);
    let ([first, ..], [.., last]) = (stations, stations) else { return };
    let mut x = first + (SPEED * t) % (PITCH[0] + PITCH[1]);
    let mut axle = 0_usize;
    while x <= *last {
        let phase = |k: usize| (1 + k * 5 + axle * 7) as f64;
        let terms = HERTZ.iter().enumerate().map(|(k, f)| (std::f64::consts::TAU * f * t + phase(k)).sin());
        let tremble = terms.sum::<f64>() / (HERTZ.len() as f64).sqrt();
        let force = AXLE * (t / RISE).min(1.0) * (1.0 + 0.15 * tremble);
        let right = stations.partition_point(|s| *s <= x).min(stations.len() - 1);
        let left = right.saturating_sub(1);
        let gap = stations[right] - stations[left];
        let share = if gap > 0.0 { ((x - stations[left]) / gap).clamp(0.0, 1.0) } else { 1.0 };
        forces[right] += share * force;
        forces[left] += (1.0 - share) * force;
        x += PITCH[axle % 2];
        axle += 1;
    }
}

fn missed_remark(accuracy: &Accuracy, wish: f64, vectors: usize) -> String {
    format!(
        "bridge: the reduced model was to be right to {wish:e} of the greatest acceleration and reaches {:.1e}, with {} modes \
         up to {:.0} Hz and {} pseudo-modes out of {vectors} vectors; a greater `reduction.error`, or no `reduction`, says \
         what is meant",
        accuracy.acceleration, accuracy.modes, accuracy.highest_frequency, accuracy.pseudo_modes
    )
}

/// Greatest difference relative to the greatest value; nothing differs where both are zero.
fn difference(a: &[f64], b: &[f64]) -> f64 {
    let greatest = largest(a.iter().zip(b).map(|(a, b)| (a - b).abs()));
    if greatest == 0.0 { 0.0 } else { greatest / largest(b.iter().map(|x| x.abs())) }
}
