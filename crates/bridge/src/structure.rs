//! From the specification to equations, and to the rows that lead in and out of them: all that no parameter touches.

use std::path::Path;
use std::sync::Arc;

use ttb_contract::ModelError;
use ttb_dynamics::damping::rayleigh;
use ttb_dynamics::newmark::Newmark;
use ttb_scenario::spec::{BridgeSpec, StructureSpec};
use ttb_scenario::types::{Damping, RayleighAt};
use ttb_sparse::Pencil;
use ttb_sparse::modes::{Modes, lowest};
use ttb_sparse::{Factor, FactorError, Layout};

use crate::assembled::{Assembled, Monitor, Names};
use crate::deck::Row;
use crate::full::Full;
use crate::reduced::Reduced;
use crate::reduction::{self, Accuracy, Built};
use crate::rows::Rows;
use crate::stored::{Restored, Source, Stored};
use crate::system::{Law, System};
use crate::{imported, plane, space};

/// The structure.
pub struct Structure {
    /// Degrees of freedom of the finite-element model.
    pub ndof: usize,
    /// Mass, kg, without a factor.
    pub mass: f64,
    /// The matrices; of a reduced model that was stored nothing is left of them.
    pencil: Option<Arc<Pencil>>,
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
    /// A reduced model's error against all degrees of freedom.
    pub accuracy: Option<Accuracy>,
    /// What its FMU keeps in a file of its own.
    source: Option<Source>,
}

impl Structure {
    /// Meshes, assembles, factorises K, finds modes, reduces; or reads what was stored in `folder`.
    ///
    /// # Errors
    /// Anything in the specification that cannot be: the message names it.
    pub fn new(spec: &BridgeSpec, folder: &Path) -> Result<Self, ModelError> {
        let assembled = match &spec.structure {
            StructureSpec::Beams { .. } | StructureSpec::Frame(_) => plane::assemble(spec)?,
            StructureSpec::FiniteElements(model) => space::assemble(model, &spec.supports, &spec.points)?,
            StructureSpec::Matrices { files, folder, .. } => imported::assemble(files, folder, &spec.supports)?,
            StructureSpec::Stored => return Self::stored(spec, folder),
        };
        Self::from_assembled(assembled, spec)
    }

    fn from_assembled(assembled: Assembled, spec: &BridgeSpec) -> Result<Self, ModelError> {
        let Assembled { equations, nodes, node_of, names, supports, monitors, mut points, mass } = assembled;
        let ndof = equations.ndof();
        let layout = Layout { node_of, place: nodes, last: eliminated_last(&supports, ndof), order: Vec::new() };
        let pencil = Arc::new(equations.finish_with(&layout).map_err(in_bridge)?);
        let statics = Arc::new(pencil.factor(1.0, 0.0, 0.0).map_err(|e| explain(&names, e))?);
        let needed = modes_needed(&spec.damping, spec.modes);
        let modes =
            if needed == 0 { Modes::default() } else { lowest(&pencil, &statics, needed).map_err(in_bridge)? };
        let first_monitor = supports.len();
        for point in &mut points {
            point.motion += first_monitor;
            point.moment.iter_mut().for_each(|row| *row += first_monitor);
        }
        let (omega2, rows, damping) = (modes.omega2.clone(), [supports, monitors].concat(), spec.damping.clone());
        let solver = Solver::new(spec, Arc::clone(&pencil), statics, modes, &rows)?;
        let Solver { system, rows, accuracy, source } = solver;
        let (pencil, supports) = (Some(pencil), first_monitor);
        Ok(Self {
            ndof,
            mass,
            pencil,
            omega2,
            damping,
            system,
            rows: Arc::new(rows),
            supports,
            points,
            accuracy,
            source,
        })
    }

    fn stored(spec: &BridgeSpec, folder: &Path) -> Result<Self, ModelError> {
        let mut stored = Stored::read(folder)?;
        let Restored { system, rows, pencil } = stored.system()?;
        let Stored { ndof, mass, omega2, supports, points, accuracy, .. } = stored;
        let (damping, rows) = (spec.damping.clone(), Arc::new(rows));
        Ok(Self { ndof, mass, pencil, omega2, damping, system, rows, supports, points, accuracy, source: None })
    }

    /// What its FMU keeps in a file of its own, if it does.
    pub fn to_store(&self) -> Option<Stored> {
        let numbers = [self.ndof, self.supports];
        let accuracy = self.accuracy.as_ref();
        let source = self.source.as_ref()?;
        Some(Stored::new(source, &self.rows, numbers, self.mass, &self.omega2, &self.points, accuracy))
    }

    /// The damping ratio of the specification.
    pub fn damping_ratio(&self) -> f64 {
        ratio(&self.damping)
    }

    /// Stiffness, mass and damping for a ratio and factors; see [`law`].
    ///
    /// # Errors
    /// A ratio on a bridge without damping, or frequencies that are not positive.
    pub fn law(&self, ratio: f64, stiffness: f64, mass: f64) -> Result<Law, ModelError> {
        law(&self.damping, &self.omega2, ratio, stiffness, mass)
    }

    /// The lowest natural frequencies, Hz, without factors.
    ///
    /// # Errors
    /// More are asked for than there are.
    pub fn natural_frequencies(&self, count: usize) -> Result<Vec<f64>, ModelError> {
        let pencil = self.pencil.as_ref();
        let pencil = pencil.ok_or_else(|| in_bridge("a stored reduced model has no natural frequencies of its own"))?;
        let statics = pencil.factor(1.0, 0.0, 0.0).map_err(in_bridge)?;
        let modes = lowest(pencil, &statics, count).map_err(in_bridge)?;
        Ok(modes.frequencies().collect())
    }
}

/// How a structure is solved.
struct Solver {
    system: Arc<dyn System>,
    rows: Rows,
    accuracy: Option<Accuracy>,
    source: Option<Source>,
}

impl Solver {
    /// All degrees of freedom, the lowest modes, or a reduced model; `rows` are those of supports and monitors.
    fn new(
        spec: &BridgeSpec,
        pencil: Arc<Pencil>,
        statics: Arc<Factor>,
        mut modes: Modes,
        rows: &[Row],
    ) -> Result<Self, ModelError> {
        // Plane models and lowest modes are made anew from their few numbers.
        let small = matches!(spec.structure, StructureSpec::Beams { .. } | StructureSpec::Frame(_));
        if let Some(wish) = &spec.reduction {
            let law = law(&spec.damping, &modes.omega2, ratio(&spec.damping), 1.0, 1.0)?;
            let newmark = Newmark::new(spec.newmark.gamma, spec.newmark.beta, spec.step);
            let Built { system, rows, accuracy } =
                reduction::build(&pencil, &statics, &law, newmark, rows, &spec.supports, wish)?;
            let source = Some(Source::Reduced { omega2: system.omega2().to_vec() });
            return Ok(Self { system: Arc::new(system), rows, accuracy: Some(accuracy), source });
        }
        let rows = Rows::new(rows);
        if let Some(count) = spec.modes {
            modes.shapes.truncate(count);
            modes.omega2.truncate(count);
            let source = (!small).then(|| Source::Reduced { omega2: modes.omega2.clone() });
            let rows = rows.project(&modes.shapes);
            return Ok(Self { system: Arc::new(Reduced::new(modes.omega2)), rows, accuracy: None, source });
        }
        let damped = if matches!(spec.damping, Damping::Modal { .. }) { modes } else { Modes::default() };
        let shapes = damped.shapes.clone();
        let source = (!small).then(|| Source::Full { pencil: Arc::clone(&pencil), shapes });
        Ok(Self { system: Arc::new(Full::new(pencil, Some(statics), damped)), rows, accuracy: None, source })
    }
}

/// ζ of a specification.
fn ratio(damping: &Damping) -> f64 {
    match damping {
        Damping::None => 0.0,
        Damping::Rayleigh { ratio, .. } | Damping::Modal { ratio, .. } => *ratio,
    }
}

/// Stiffness, mass and damping for a ratio and factors; `omega2` are the ω² of as many modes as [`modes_needed`] says,
/// without factors.
///
/// # Errors
/// A ratio on a bridge without damping, or frequencies that are not positive.
pub fn law(damping: &Damping, omega2: &[f64], ratio: f64, stiffness: f64, mass: f64) -> Result<Law, ModelError> {
    let omega: Vec<f64> = omega2.iter().map(|w2| (w2 * stiffness / mass).sqrt()).collect();
    let mode = |number: usize| {
        let omega = number.checked_sub(1).and_then(|j| omega.get(j)).copied();
        omega.ok_or_else(|| ModelError(format!("bridge: Rayleigh damping at mode {number}; modes are counted from 1")))
    };
    let (mut alpha, mut beta, mut rates) = (0.0, 0.0, Vec::new());
    match damping {
        Damping::None if ratio != 0.0 => {
            return Err(ModelError(format!("damping_ratio is {ratio}; on a bridge of damping type none it must be 0")));
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
        Damping::Modal { modes, .. } => rates = omega.iter().take(*modes).map(|omega| 2.0 * ratio * omega).collect(),
    }
    Ok(Law { stiffness, mass, alpha, beta, rates })
}

/// The supports' degrees of freedom, if eliminating them last adds little to the factor.
pub fn eliminated_last(supports: &[Row], ndof: usize) -> Vec<u32> {
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

/// How many modes are needed: by the damping, and as coordinates if there are to be so many.
pub fn modes_needed(damping: &Damping, coordinates: Option<usize>) -> usize {
    let damping = match damping {
        Damping::Rayleigh { at: RayleighAt::Modes(pair), .. } => pair[0].max(pair[1]),
        Damping::Rayleigh { at: RayleighAt::FirstTimes(_), .. } => 1,
        Damping::Modal { modes, .. } if coordinates.is_none() => *modes,
        _ => 0,
    };
    damping.max(coordinates.unwrap_or(0))
}
