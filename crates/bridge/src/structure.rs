//! From the specification to equations, and to the rows that lead in and out of them: all that no parameter touches.

use std::path::Path;
use std::sync::Arc;

use ttb_contract::{Component, ModelError};
use ttb_scenario::spec::{BridgeSpec, StructureSpec};
use ttb_scenario::types::Damping;
use ttb_sparse::modes::{Modes, lowest};
use ttb_sparse::{FactorError, Layout, Pencil};

use crate::assembled::{Assembled, Monitor, Names};
use crate::deck::Row;
use crate::ground::{Ground, Inertia};
use crate::law::{Law, law, modes_needed};
use crate::reduction::Accuracy;
use crate::rounding;
use crate::rows::Rows;
use crate::solver::Solver;
use crate::stored::{Restored, Source, Stored};
use crate::system::System;
use crate::{ground, imported, plane, space};

/// Equations and rows of a bridge.
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
    /// The equations, in the form they are solved in.
    pub system: Arc<dyn System>,
    /// R: one row per port of a support, then those of the monitored points.
    pub rows: Arc<Rows>,
    /// Number of forces: one a support, or, in space, three, in blocks of one component each; then those of the ground.
    pub supports: usize,
    /// Number of supports of the track.
    pub stations: usize,
    /// The monitored points; they read [`Structure::rows`].
    pub points: Vec<Monitor>,
    /// A reduced model's error against all degrees of freedom.
    pub accuracy: Option<Accuracy>,
    /// What its FMU keeps in a file of its own.
    source: Option<Source>,
    /// Motion of the ground, whose accelerations are the last forces.
    pub ground: Option<Ground>,
    /// What its user should know, a sentence each.
    pub remarks: Vec<String>,
}

impl Structure {
    /// Meshes, assembles, factorises K, finds modes, reduces; or reads what was stored in `folder`.
    ///
    /// # Errors
    /// Anything in the specification that cannot be: the message names it.
    pub fn new(spec: &BridgeSpec, folder: &Path) -> Result<Self, ModelError> {
        let assembled = match &spec.structure {
            StructureSpec::Beams { .. } | StructureSpec::Frame(_) => plane::assemble(spec)?,
            StructureSpec::FiniteElements(model) => {
                let components = if spec.space { &Component::ALL[..] } else { &[Component::Vertical] };
                space::assemble_for(model, &spec.supports, components, &spec.points)?
            }
            StructureSpec::Matrices { files, folder, .. } if spec.space => {
                imported::assemble_in_space(files, folder, &spec.supports)?
            }
            StructureSpec::Matrices { files, folder, .. } => imported::assemble(files, folder, &spec.supports)?,
            StructureSpec::Stored => return Self::stored(spec, folder),
        };
        Self::from_assembled(assembled, spec, ground::rows(spec)?)
    }

    fn from_assembled(
        assembled: Assembled,
        spec: &BridgeSpec,
        ground: Option<(Ground, Inertia)>,
    ) -> Result<Self, ModelError> {
        let Assembled { equations, nodes, node_of, names, mut supports, monitors, mut points, mass, digits } =
            assembled;
        let ndof = equations.ndof();
        let layout = Layout { node_of, place: nodes, last: eliminated_last(&supports, ndof), order: Vec::new() };
        let pencil = Arc::new(equations.finish_with(&layout).map_err(in_bridge)?);
        let statics = Arc::new(pencil.factor(1.0, 0.0, 0.0).map_err(|e| explain(&names, e))?);
        let down = &supports[..spec.supports.len()];
        let mut remarks: Vec<String> = rounding::check(&pencil, &statics, down)?.into_iter().collect();
        remarks
            .extend(rounding::of_digits(&pencil, &statics, down, digits).as_ref().and_then(rounding::Digits::remark));
        let needed = modes_needed(&spec.damping, spec.modes);
        let modes =
            if needed == 0 { Modes::default() } else { lowest(&pencil, &statics, needed).map_err(in_bridge)? };
        let ground = ground.map(|(ground, inertia)| {
            supports.extend(inertia);
            ground
        });
        let first_monitor = supports.len();
        for point in &mut points {
            point.motion += first_monitor;
            point.moment.iter_mut().for_each(|row| *row += first_monitor);
        }
        let (omega2, rows, damping) = (modes.omega2.clone(), [supports, monitors].concat(), spec.damping.clone());
        let solver = Solver::new(spec, Arc::clone(&pencil), statics, modes, &rows, first_monitor)?;
        let Solver { system, rows, accuracy, source, remark } = solver;
        remarks.extend(remark);
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
            stations: spec.supports.len(),
            points,
            accuracy,
            source,
            ground,
            remarks,
        })
    }

    fn stored(spec: &BridgeSpec, folder: &Path) -> Result<Self, ModelError> {
        let mut stored = Stored::read(folder)?;
        let Restored { system, rows, pencil } = stored.system()?;
        let Stored { ndof, mass, omega2, supports, points, accuracy, .. } = stored;
        let (damping, rows) = (spec.damping.clone(), Arc::new(rows));
        let (source, remarks) = (None, Vec::new());
        let stations = spec.supports.len();
        let ground = ground::rows(spec)?.map(|(ground, _)| ground);
        let forces = supports - if ground.is_some() { ground::ROWS.min(supports) } else { 0 };
        if ![stations, 3 * stations].contains(&forces) {
            return Err(in_bridge(format_args!("{supports} ports are stored for {stations} supports")));
        }
        Ok(Self {
            ndof,
            mass,
            pencil,
            omega2,
            damping,
            system,
            rows,
            supports,
            stations,
            points,
            accuracy,
            source,
            ground,
            remarks,
        })
    }

    /// Forces that come from the track.
    pub fn ports(&self) -> usize {
        self.supports - if self.ground.is_some() { ground::ROWS.min(self.supports) } else { 0 }
    }

    /// What its FMU keeps in a file of its own, if it does.
    pub fn to_store(&self) -> Option<Stored> {
        let numbers = [self.ndof, self.supports];
        let accuracy = self.accuracy.as_ref();
        let source = self.source.as_ref()?;
        Some(Stored::new(source, &self.rows, numbers, self.mass, &self.omega2, &self.points, accuracy))
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
