//! From the specification to equations, and to the rows that lead in and out of them: all that no parameter touches.

use std::sync::Arc;

use ttb_coupling::ModelError;
use ttb_dynamics::damping::rayleigh;
use ttb_dynamics::factor::{Factor, FactorError, Layout};
use ttb_dynamics::modes::{Modes, lowest};
use ttb_dynamics::sparse::Pencil;
use ttb_scenario::spec::{BridgeSpec, StructureSpec};
use ttb_scenario::types::{Damping, RayleighAt};

use crate::assembled::{Assembled, Monitor, Names};
use crate::deck::Row;
use crate::full::Full;
use crate::plane;
use crate::reduced::Reduced;
use crate::rows::Rows;
use crate::space;
use crate::system::{Law, System};

/// The structure.
pub struct Structure {
    /// Degrees of freedom of the finite-element model.
    pub ndof: usize,
    /// Mass, kg, without a factor.
    pub mass: f64,
    pencil: Arc<Pencil>,
    /// ω² of the modes that damping or reduction need, lowest first.
    omega2: Vec<f64>,
    damping: Damping,
    /// Its equations.
    pub system: Arc<dyn System>,
    /// R: one row per support, then those of the monitored points.
    pub rows: Arc<Rows>,
    /// Number of supports.
    pub supports: usize,
    /// The monitored points; they read [`Structure::rows`].
    pub points: Vec<Monitor>,
}

impl Structure {
    /// Meshes, assembles, factorises K, finds modes where they are needed.
    ///
    /// # Errors
    /// Anything in the specification that cannot be: the message names it.
    pub fn new(spec: &BridgeSpec) -> Result<Self, ModelError> {
        let assembled = match &spec.structure {
            StructureSpec::Beams { .. } | StructureSpec::Frame(_) => plane::assemble(spec)?,
            StructureSpec::FiniteElements(model) => space::assemble(model, &spec.supports, &spec.points)?,
        };
        Self::from_assembled(assembled, spec)
    }

    fn from_assembled(assembled: Assembled, spec: &BridgeSpec) -> Result<Self, ModelError> {
        let Assembled { equations, nodes, node_of, names, supports, monitors, mut points, mass } = assembled;
        let ndof = equations.ndof();
        let layout = Layout { node_of, place: nodes, last: eliminated_last(&supports, ndof), order: Vec::new() };
        let pencil = Arc::new(equations.finish_with(&layout).map_err(in_bridge)?);
        let statics = Arc::new(pencil.factor(1.0, 0.0, 0.0).map_err(|e| explain(&names, e))?);
        let needed = modes_needed(spec);
        let modes =
            if needed == 0 { Modes::default() } else { lowest(&pencil, &statics, needed).map_err(in_bridge)? };
        let first_monitor = supports.len();
        for point in &mut points {
            point.motion += first_monitor;
            point.moment.iter_mut().for_each(|row| *row += first_monitor);
        }
        let rows = Rows::new(&[supports, monitors].concat());
        let omega2 = modes.omega2.clone();
        let (system, rows) = solver(spec, &pencil, statics, modes, rows);
        let damping = spec.damping.clone();
        let rows = Arc::new(rows);
        Ok(Self { ndof, mass, pencil, omega2, damping, system, rows, supports: first_monitor, points })
    }

    /// The damping ratio of the specification.
    pub fn damping_ratio(&self) -> f64 {
        match self.damping {
            Damping::None => 0.0,
            Damping::Rayleigh { ratio, .. } | Damping::Modal { ratio, .. } => ratio,
        }
    }

    /// Stiffness, mass and damping for a ratio and factors.
    ///
    /// # Errors
    /// A ratio on a bridge without damping, or frequencies that are not positive.
    pub fn law(&self, ratio: f64, stiffness: f64, mass: f64) -> Result<Law, ModelError> {
        let omega: Vec<f64> = self.omega2.iter().map(|w2| (w2 * stiffness / mass).sqrt()).collect();
        let mode = |number: usize| {
            let omega = number.checked_sub(1).and_then(|j| omega.get(j)).copied();
            omega.ok_or_else(|| {
                ModelError(format!("bridge: Rayleigh damping at mode {number}; modes are counted from 1"))
            })
        };
        let (mut alpha, mut beta, mut rates) = (0.0, 0.0, Vec::new());
        match &self.damping {
            Damping::None if ratio != 0.0 => {
                return Err(ModelError(format!(
                    "damping_ratio is {ratio}; on a bridge of damping type none it must be 0"
                )));
            }
            Damping::None => {}
            Damping::Rayleigh { at, .. } => {
                let pair = match at {
                    RayleighAt::Hz(pair) => pair.map(|hz| std::f64::consts::TAU * hz),
                    RayleighAt::Modes([i, j]) => [mode(*i)?, mode(*j)?],
                    RayleighAt::FirstTimes(multiple) => [mode(1)?, multiple * mode(1)?],
                };
                if !pair.iter().all(|omega| *omega > 0.0 && omega.is_finite()) {
                    return Err(ModelError("bridge: the two frequencies of Rayleigh damping must be positive".into()));
                }
                (alpha, beta) = rayleigh(ratio, pair);
            }
            Damping::Modal { modes, .. } => {
                rates = omega.iter().take(*modes).map(|omega| 2.0 * ratio * omega).collect()
            }
        }
        Ok(Law { stiffness, mass, alpha, beta, rates })
    }

    /// The lowest natural frequencies, Hz, without factors.
    ///
    /// # Errors
    /// More are asked for than there are.
    pub fn natural_frequencies(&self, count: usize) -> Result<Vec<f64>, ModelError> {
        let statics = self.pencil.factor(1.0, 0.0, 0.0).map_err(in_bridge)?;
        let modes = lowest(&self.pencil, &statics, count).map_err(in_bridge)?;
        Ok(modes.frequencies().collect())
    }
}

/// All degrees of freedom, or the lowest modes.
fn solver(
    spec: &BridgeSpec,
    pencil: &Arc<Pencil>,
    statics: Arc<Factor>,
    mut modes: Modes,
    rows: Rows,
) -> (Arc<dyn System>, Rows) {
    if let Some(count) = spec.modes {
        modes.shapes.truncate(count);
        modes.omega2.truncate(count);
        let rows = rows.project(&modes.shapes);
        return (Arc::new(Reduced::new(modes.omega2)), rows);
    }
    let damped = if matches!(spec.damping, Damping::Modal { .. }) { modes } else { Modes::default() };
    (Arc::new(Full::new(Arc::clone(pencil), Some(statics), damped)), rows)
}

/// The supports' degrees of freedom, if eliminating them last adds little to the factor.
fn eliminated_last(supports: &[Row], ndof: usize) -> Vec<u32> {
    let mut dofs: Vec<u32> = supports.iter().flatten().map(|(dof, _)| *dof).collect();
    dofs.sort_unstable();
    dofs.dedup();
    // They fill a triangle; a factor has some hundred numbers a column.
    if dofs.len() * dofs.len() / 2 <= 20 * ndof { dofs } else { Vec::new() }
}

fn in_bridge(error: impl std::fmt::Display) -> ModelError {
    ModelError(format!("bridge: {error}"))
}

fn explain(names: &Names, error: FactorError) -> ModelError {
    match error {
        FactorError::NotPositive { dof } => {
            let place = names(dof);
            ModelError(format!("bridge: mechanism: nothing holds the {place} (or its mesh is far too fine)"))
        }
        other @ FactorError::Symbolic(_) => in_bridge(other),
    }
}

/// How many modes damping and reduction need.
fn modes_needed(spec: &BridgeSpec) -> usize {
    let damping = match &spec.damping {
        Damping::Rayleigh { at: RayleighAt::Modes(pair), .. } => pair[0].max(pair[1]),
        Damping::Rayleigh { at: RayleighAt::FirstTimes(_), .. } => 1,
        Damping::Modal { modes, .. } if spec.modes.is_none() => *modes,
        _ => 0,
    };
    damping.max(spec.modes.unwrap_or(0))
}
