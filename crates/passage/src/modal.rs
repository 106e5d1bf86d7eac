//! A bridge in its natural modes, seen from a force that moves along its deck.
//!
//! ```text
//! q̈_j + c_j q̇_j + ω_j² q_j = Σ_i P_i φ_j(x_i)         φᵀMφ = 1 kg;  c_j = α + βω_j²  or  2ζω_j
//! y_k(t) = Σ_j Y_kj q_j(t) + Σ_i P_i [I_k(x_i) − Σ_j Y_kj φ_j(x_i)/ω_j²]
//! ẅ_k(t) = Σ_j φ_kj q̈_j(t)
//! ```
//!
//! y is displacement, moment, shear or reaction at place k with static influence line I_k: the bracket is what the modes
//! that are left out add as if they followed at once (static correction, residual flexibility). Modes are those up to
//! 1.2 · max(30 Hz, 1.5 f₁, f₃), three a member at least, or as many as the specification says.

use std::f64::consts::TAU;

use ttb_bridge::law::{law, modes_needed, ratio};
use ttb_contract::ModelError;
use ttb_scenario::spec::{BridgeSpec, StructureSpec};
use ttb_scenario::types::Damping;
use ttb_sparse::modes::{Modes, ModesError, lowest};
use ttb_sparse::{Factor, Pencil};

use crate::extreme::WIDE;
use crate::lines::Lines;
use crate::place::{Output, Quantity};
use crate::plane::Plane;
use crate::recursion::Oscillator;
use crate::sampled::Sampled;
use crate::source::Source;

/// What may be chosen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// Highest frequency of the modes, Hz; `None`: by the rule of the module comment.
    pub highest_frequency: Option<f64>,
    /// Parts that a span is looked at in; at least 20.
    pub points_per_span: usize,
    /// Also moments, shears and reactions (beams and frames).
    pub forces: bool,
    /// Factor on the stiffness.
    pub stiffness: f64,
    /// Factor on the mass.
    pub mass: f64,
    /// Added to the damping ratio of every mode, of 1 (Δζ of EN 1991-2, 6.4.6.4, for forces without vehicles).
    pub additional_damping: f64,
}

impl Default for Settings {
    fn default() -> Self {
        let (highest_frequency, additional_damping) = (None, 0.0);
        Self { highest_frequency, points_per_span: 20, forces: false, stiffness: 1.0, mass: 1.0, additional_damping }
    }
}

/// Why there is no modal bridge.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Refused {
    /// Dashpots or a damping matrix: it takes the way of one axle, [`crate::one_axle`].
    NotDiagonal,
    /// Anything else.
    Model(ModelError),
}

impl std::fmt::Display for Refused {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::NotDiagonal => f.write_str("bridge: dashpots or a damping matrix couple its modes"),
            Self::Model(error) => error.fmt(f),
        }
    }
}
impl std::error::Error for Refused {}

impl From<ModelError> for Refused {
    fn from(error: ModelError) -> Self {
        Self::Model(error)
    }
}

/// A bridge in its modes.
#[derive(Clone, Debug)]
pub struct ModalBridge {
    modes: Vec<Oscillator>,
    outputs: Vec<Output>,
    /// The first so many outputs follow the displacements; accelerations come after them.
    positions: usize,
    /// Y by group of [`WIDE`] outputs, mode, output.
    position_rows: Vec<[f64; WIDE]>,
    acceleration_rows: Vec<[f64; WIDE]>,
    lines: Lines,
    spans: Vec<[f64; 2]>,
    remarks: Vec<String>,
    /// Its steps are this share of the usual ones.
    share: f64,
}

/// Frequencies from which modes are left out are above these, Hz, times the margin.
const FREQUENCY: f64 = 30.0;
const MARGIN: f64 = 1.2;
/// Modes at most.
const MOST: usize = 1000;
/// A mode whose path moves less than this share of the liveliest is not excited.
const SILENT: f64 = 1e-9;
/// Samples of the shortest period.
const SAMPLES: f64 = 20.0;
/// The grid of places is a step at this speed, m/s.
const GRID_SPEED: f64 = 5.0;

/// Matrices and path of a bridge.
fn source(spec: &BridgeSpec, settings: &Settings) -> Result<Box<dyn Source>, ModelError> {
    let per_span = settings.points_per_span.max(20);
    Ok(match &spec.structure {
        StructureSpec::Beams { .. } | StructureSpec::Frame(_) => Box::new(Plane::new(spec, per_span, settings.forces)?),
        StructureSpec::FiniteElements(_) | StructureSpec::Matrices { .. } => Box::new(Sampled::new(spec, per_span)?),
        StructureSpec::Stored => return Err(ModelError("bridge: a stored bridge has no path".into())),
    })
}

/// Whether [`ModalBridge::new`] would not refuse the bridge as [`Refused::NotDiagonal`]; the matrices tell, no mode is sought. A
/// bridge that cannot be built passes: why not is told by whoever builds it.
#[must_use]
pub fn is_diagonal(spec: &BridgeSpec) -> bool {
    source(spec, &Settings::default()).map_or(true, |source| !source.pencil().has_dashpots())
}

impl ModalBridge {
    /// Of a specification; its supports, step and end do not matter.
    ///
    /// # Errors
    /// Its modes are coupled by dashpots; anything in it that cannot be.
    pub fn new(spec: &BridgeSpec, settings: &Settings) -> Result<Self, Refused> {
        Self::of(&*source(spec, settings)?, spec, settings)
    }

    /// Influence lines alone, without any mode: for static answers of every bridge, also of one with dashpots. Passages over
    /// it have static answers, too, and nothing else.
    ///
    /// # Errors
    /// Anything in the specification that cannot be.
    pub fn of_statics(spec: &BridgeSpec, settings: &Settings) -> Result<Self, ModelError> {
        Self::made(&*source(spec, settings)?, Vec::new(), Vec::new(), settings)
    }

    fn of(source: &dyn Source, spec: &BridgeSpec, settings: &Settings) -> Result<Self, Refused> {
        let pencil = source.pencil();
        if pencil.has_dashpots() {
            return Err(Refused::NotDiagonal);
        }
        let failed = |e: &dyn std::fmt::Display| Refused::Model(ModelError(format!("bridge: {e}")));
        let Settings { stiffness, mass, .. } = *settings;
        if !(stiffness > 0.0 && mass > 0.0 && stiffness.is_finite() && mass.is_finite()) {
            return Err(failed(&format!("factors on stiffness and mass must be positive: {stiffness}, {mass}")));
        }
        let statics = pencil.factor(1.0, 0.0, 0.0).map_err(|e| failed(&e))?;
        let mut modes = modes(pencil, &statics, source.members(), spec, settings)?;
        let law = law(&spec.damping, &modes.omega2, ratio(&spec.damping), stiffness, mass)?;
        // Damping may have asked for more modes than are to be kept.
        let kept = spec.modes.unwrap_or(modes.omega2.len());
        modes.omega2.truncate(kept);
        modes.shapes.truncate(kept);
        let mut remarks = Vec::new();
        if !law.rates.is_empty() && law.rates.len() < modes.omega2.len() {
            let (damped, all) = (law.rates.len(), modes.omega2.len());
            remarks.push(format!("damping acts on the lowest {damped} of {all} modes, as the scenario says"));
        }
        let frequency = stiffness / mass;
        let mode = |(j, w2): (usize, &f64)| {
            let omega = (frequency * w2).sqrt();
            let rate = law.rates.get(j).copied().unwrap_or(0.0) + law.alpha + law.beta * frequency * w2;
            Oscillator { omega, rate: rate + 2.0 * settings.additional_damping * omega }
        };
        let oscillators: Vec<Oscillator> = modes.omega2.iter().enumerate().map(mode).collect();
        // Under the factors φ is φ/√m.
        let scale = 1.0 / mass.sqrt();
        let shapes: Vec<Vec<f64>> =
            modes.shapes.iter().map(|shape| shape.iter().map(|u| scale * u).collect()).collect();
        let (oscillators, shapes) = excited(source, oscillators, shapes);
        let mut bridge = Self::made(source, oscillators, shapes, settings)?;
        bridge.remarks = remarks;
        Ok(bridge)
    }

    /// Of modes under the factors in force.
    fn made(
        source: &dyn Source,
        modes: Vec<Oscillator>,
        shapes: Vec<Vec<f64>>,
        settings: &Settings,
    ) -> Result<Self, ModelError> {
        let stiffness = settings.stiffness;
        let statics = source.pencil().factor(1.0, 0.0, 0.0).map_err(|e| ModelError(format!("bridge: {e}")))?;
        let [m, k] = [shapes.len(), source.outputs().len()];
        let pads = [padded(m, 4), padded(k, WIDE)];
        let lines = source.lines(&shapes, pads, &statics)?;
        let internal = |output: &Output| output.quantity != Quantity::Displacement;
        let factors: Vec<f64> = source.outputs().iter().map(|o| if internal(o) { stiffness } else { 1.0 }).collect();
        let rows = shapes.iter().map(|shape| {
            let row = source.rows(shape);
            row.iter().zip(&factors).map(|(y, factor)| factor * y).collect::<Vec<f64>>()
        });
        let rows: Vec<Vec<f64>> = rows.collect();
        let mut outputs = source.outputs().to_vec();
        let moving: Vec<usize> = (0..k).filter(|i| !internal(&outputs[*i])).collect();
        let accelerations = moving.iter().map(|i| Output { quantity: Quantity::Acceleration, ..outputs[*i].clone() });
        let accelerations: Vec<Output> = accelerations.collect();
        outputs.extend(accelerations);
        let all: Vec<usize> = (0..k).collect();
        // A displacement's influence line belongs to the stiffness without factor.
        let own: Vec<f64> = source.outputs().iter().map(|o| if internal(o) { 1.0 } else { 1.0 / stiffness }).collect();
        Ok(Self {
            modes,
            position_rows: grouped(&rows, &all),
            acceleration_rows: grouped(&rows, &moving),
            positions: k,
            outputs,
            lines: lines.scaled(pads[0], &own),
            spans: source.spans().to_vec(),
            remarks: Vec::new(),
            share: 1.0,
        })
    }

    /// The same bridge in steps that are a share of the usual ones, above 0 and at most 1, to see what the step does.
    #[must_use]
    pub fn in_steps(self, share: f64) -> Self {
        Self { share, ..self }
    }

    /// Its modes, lowest first; without those that no force on the deck excites.
    #[must_use]
    pub fn modes(&self) -> &[Oscillator] {
        &self.modes
    }

    /// Natural frequencies, Hz.
    pub fn frequencies(&self) -> impl Iterator<Item = f64> {
        self.modes.iter().map(|mode| mode.omega / TAU)
    }

    /// What passages give: quantities that follow the displacements, then accelerations.
    #[must_use]
    pub fn outputs(&self) -> &[Output] {
        &self.outputs
    }

    /// Number of outputs that are no accelerations.
    #[must_use]
    pub fn positions(&self) -> usize {
        self.positions
    }

    /// Length of the deck, m.
    #[must_use]
    pub fn length(&self) -> f64 {
        let [begin, end] = self.lines.extent();
        end - begin
    }

    /// Begins and ends of the spans, m.
    #[must_use]
    pub fn spans(&self) -> &[[f64; 2]] {
        &self.spans
    }

    /// What the user should know, a sentence each.
    #[must_use]
    pub fn remarks(&self) -> &[String] {
        &self.remarks
    }

    /// Longest step, s: a twentieth of the shortest period, or of 1/30 s.
    #[must_use]
    pub fn longest_step(&self) -> f64 {
        self.share / (SAMPLES * self.frequencies().fold(FREQUENCY, f64::max))
    }

    /// Distance of the places where modal forces are tabulated, m.
    #[must_use]
    pub fn grid(&self) -> f64 {
        GRID_SPEED * self.longest_step()
    }

    /// Time in which free vibration after the train is looked at unless somebody says otherwise, s: five periods of the
    /// lowest mode, at least 0.5 s, at most 10 s.
    #[must_use]
    pub fn free_vibration(&self) -> f64 {
        (5.0 / self.frequencies().fold(f64::INFINITY, f64::min)).clamp(0.5, 10.0)
    }

    /// Static influence line of an output over the place of a unit force, m from the deck's begin; zero off the deck. Of an
    /// acceleration there is none.
    #[must_use]
    pub fn influence(&self, output: usize, x: f64) -> f64 {
        if output < self.positions { self.lines.at(x)[self.mode_pad() + output] } else { 0.0 }
    }

    /// Lines over the place of a unit force: φ_j up to a multiple of four, then the influence lines of [`Self::positions`].
    #[must_use]
    pub fn lines(&self) -> &Lines {
        &self.lines
    }

    /// Modes up to a multiple of four.
    #[must_use]
    pub fn mode_pad(&self) -> usize {
        padded(self.modes.len(), 4)
    }

    /// Rows Y of the outputs that follow displacements: by group of outputs, then mode.
    #[must_use]
    pub fn position_rows(&self) -> &[[f64; WIDE]] {
        &self.position_rows
    }

    /// Rows φ of the accelerations, likewise.
    #[must_use]
    pub fn acceleration_rows(&self) -> &[[f64; WIDE]] {
        &self.acceleration_rows
    }
}

fn padded(n: usize, to: usize) -> usize {
    n.div_ceil(to) * to
}

/// Rows of the chosen outputs by group and mode.
fn grouped(rows: &[Vec<f64>], chosen: &[usize]) -> Vec<[f64; WIDE]> {
    let group = |group: &[usize]| -> Vec<[f64; WIDE]> {
        rows.iter().map(|row| std::array::from_fn(|i| group.get(i).map_or(0.0, |output| row[*output]))).collect()
    };
    chosen.chunks(WIDE).flat_map(group).collect()
}

/// The modes that a force on the deck excites.
fn excited(
    source: &dyn Source,
    oscillators: Vec<Oscillator>,
    shapes: Vec<Vec<f64>>,
) -> (Vec<Oscillator>, Vec<Vec<f64>>) {
    let largest: Vec<f64> = shapes.iter().map(|shape| source.liveliness(shape)).collect();
    let most = largest.iter().copied().fold(0.0, f64::max);
    let kept = oscillators.into_iter().zip(shapes).zip(largest);
    kept.filter(|(_, own)| *own > SILENT * most).map(|(pair, _)| pair).unzip()
}

/// The modes that are kept, and those that the damping asks for.
fn modes(
    pencil: &Pencil,
    statics: &Factor,
    members: usize,
    spec: &BridgeSpec,
    settings: &Settings,
) -> Result<Modes, Refused> {
    let failed = |e: ModesError| Refused::Model(ModelError(format!("bridge: {e}")));
    let as_many = |count: usize| match lowest(pencil, statics, count.clamp(1, MOST)) {
        Err(ModesError::TooMany { available, .. }) if available > 0 => lowest(pencil, statics, available),
        other => other,
    };
    let damped = modes_needed(&spec.damping, None);
    // Modal damping of more modes than are kept asks for no more.
    let law = if matches!(spec.damping, Damping::Modal { .. }) { 1 } else { damped.max(1) };
    if let Some(count) = spec.modes {
        return as_many(count.max(law)).map_err(failed);
    }
    let first = as_many(law.max(3 * members)).map_err(failed)?;
    let factor = (settings.stiffness / settings.mass).sqrt();
    let hertz: Vec<f64> = first.frequencies().map(|f| factor * f).collect();
    let third = hertz.get(3 * members - 1).or(hertz.last()).copied().unwrap_or(0.0);
    let rule = MARGIN * FREQUENCY.max(1.5 * hertz[0]).max(third);
    let highest = settings.highest_frequency.unwrap_or(rule);
    let below = (TAU * highest / factor).powi(2);
    let count = pencil.count_below(below).unwrap_or(hertz.len());
    if count <= hertz.len() && settings.highest_frequency.is_none() {
        return Ok(first);
    }
    as_many(count.max(law)).map_err(failed)
}
