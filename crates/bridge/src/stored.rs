//! A large bridge in a binary file: what lies beside an FMU's `bridge.json`, so that an instance starts without meshing,
//! without ordering the elimination, and, when reduced, without any large matrix.

use std::path::Path;
use std::sync::Arc;

use serde::{Deserialize, Serialize};
use ttb_contract::ModelError;
use ttb_dynamics::dense::Dense;
use ttb_sparse::Pencil;
use ttb_sparse::modes::Modes;
use ttb_sparse::raw::Raw;

use crate::assembled::Monitor;
use crate::full::Full;
use crate::local::Local;
use crate::reduced::Reduced;
use crate::reduction::Accuracy;
use crate::rows::Rows;
use crate::system::System;

/// Name of the file.
pub const FILE: &str = "bridge.bin";
/// Changes when the layout does.
const VERSION: u32 = 4;

/// The file's content (postcard's format).
#[derive(Serialize, Deserialize)]
pub struct Stored {
    version: u32,
    /// Degrees of freedom of the finite-element model.
    pub ndof: usize,
    /// Total mass, kg.
    pub mass: f64,
    /// ω² of the modes that damping needs.
    pub omega2: Vec<f64>,
    /// Number of supports.
    pub supports: usize,
    /// The monitored points.
    pub points: Vec<Monitor>,
    /// Reduced models: how wrong they are.
    pub accuracy: Option<Accuracy>,
    equations: Equations,
}

#[derive(Serialize, Deserialize)]
enum Equations {
    Full { raw: Raw, modes: Vec<Vec<f64>>, starts: Vec<u32>, columns: Vec<u32>, weights: Vec<f64> },
    Modes { omega2: Vec<f64>, shapes: Dense },
    Reduced { omega2: Vec<f64>, shapes: Dense<f32> },
    Local { omega2: Vec<f64>, local: Local },
}

impl Equations {
    const NONE: Self = Self::Modes { omega2: Vec::new(), shapes: Dense::EMPTY };
}

/// What a file gives back.
pub struct Restored {
    /// The equations, in the form they are solved in.
    pub system: Arc<dyn System>,
    /// Rows R of supports and monitored points.
    pub rows: Rows,
    /// The matrices, unless the model is reduced.
    pub pencil: Option<Arc<Pencil>>,
}

/// A system to store.
pub enum Source {
    /// All degrees of freedom.
    Full {
        /// The matrices.
        pencil: Arc<Pencil>,
        /// Shapes of the modes that modal damping needs.
        shapes: Vec<Vec<f64>>,
    },
    /// Coordinates that stand alone.
    Reduced {
        /// ω² of the coordinates, (rad/s)².
        omega2: Vec<f64>,
    },
}

impl Stored {
    /// Collects what is to be stored.
    pub fn new(
        source: &Source,
        rows: &Rows,
        [ndof, supports]: [usize; 2],
        mass: f64,
        omega2: &[f64],
        points: &[Monitor],
        accuracy: Option<&Accuracy>,
    ) -> Self {
        let equations = match (source, rows) {
            (Source::Full { pencil, shapes }, Rows::Sparse { starts, columns, weights }) => Equations::Full {
                raw: pencil.raw(),
                modes: shapes.clone(),
                starts: starts.clone(),
                columns: columns.clone(),
                weights: weights.clone(),
            },
            (Source::Reduced { omega2 }, Rows::Modal(shapes)) => {
                Equations::Modes { omega2: omega2.clone(), shapes: shapes.clone() }
            }
            (Source::Reduced { omega2 }, Rows::Single(shapes)) => {
                Equations::Reduced { omega2: omega2.clone(), shapes: shapes.clone() }
            }
            (Source::Reduced { omega2 }, Rows::Local(local)) => {
                Equations::Local { omega2: omega2.clone(), local: local.clone() }
            }
            // Rows are sparse over degrees of freedom, modal over coordinates.
            _ => Equations::NONE,
        };
        let (omega2, points, accuracy) = (omega2.to_vec(), points.to_vec(), accuracy.cloned());
        Self { version: VERSION, ndof, mass, omega2, supports, points, accuracy, equations }
    }

    /// The file's bytes.
    ///
    /// # Errors
    /// Not enough memory.
    pub fn bytes(&self) -> Result<Vec<u8>, ModelError> {
        postcard::to_stdvec(self).map_err(|e| ModelError(format!("bridge: {FILE} cannot be made: {e}")))
    }

    /// Reads the file in a folder.
    ///
    /// # Errors
    /// It is missing, damaged, or of another version.
    pub fn read(folder: &Path) -> Result<Self, ModelError> {
        let path = folder.join(FILE);
        let bytes = std::fs::read(&path).map_err(|e| ModelError(format!("cannot read {}: {e}", path.display())))?;
        let damaged = |why: String| ModelError(format!("{} is damaged: {why}", path.display()));
        let stored: Self = postcard::from_bytes(&bytes).map_err(|e| damaged(e.to_string()))?;
        if stored.version != VERSION {
            let (found, path) = (stored.version, path.display());
            return Err(ModelError(format!("{path} is of version {found}, this program reads version {VERSION}")));
        }
        Ok(stored)
    }

    /// The system and its rows.
    ///
    /// # Errors
    /// Numbers that do not fit together.
    pub fn system(&mut self) -> Result<Restored, ModelError> {
        let restored = match std::mem::replace(&mut self.equations, Equations::NONE) {
            Equations::Full { raw, modes, starts, columns, weights } => {
                let pencil = Arc::new(Pencil::from_raw(raw).map_err(|e| damaged(&e.to_string()))?);
                let n = pencil.ndof();
                let rising = starts.windows(2).all(|pair| pair[0] <= pair[1]) && starts.first() == Some(&0);
                let whole = starts.last().is_some_and(|last| *last as usize == columns.len());
                let inside = columns.len() == weights.len() && columns.iter().all(|c| (*c as usize) < n);
                if !(rising && whole && inside && modes.iter().all(|mode| mode.len() == n)) {
                    return Err(damaged("rows do not fit the matrices"));
                }
                let omega2 = self.omega2[..modes.len().min(self.omega2.len())].to_vec();
                let modes = Modes { omega2, shapes: modes };
                let rows = Rows::Sparse { starts, columns, weights };
                let system = Arc::new(Full::new(Arc::clone(&pencil), None, modes));
                Restored { system, rows, pencil: Some(pencil) }
            }
            Equations::Modes { omega2, shapes } => modal(omega2, Rows::Modal(shapes))?,
            Equations::Reduced { omega2, shapes } => modal(omega2, Rows::Single(shapes))?,
            Equations::Local { omega2, local } => modal(omega2, Rows::Local(local))?,
        };
        let seen = self.points.iter().flat_map(|point| [Some(point.motion), point.moment]).flatten();
        let rows = restored.rows.len();
        if self.supports > rows || seen.max().is_some_and(|row| row >= rows) {
            return Err(damaged("there are fewer rows than supports and points"));
        }
        Ok(restored)
    }
}

fn damaged(why: &str) -> ModelError {
    ModelError(format!("{FILE} is damaged: {why}"))
}

/// A system in coordinates that stand alone.
fn modal(omega2: Vec<f64>, rows: Rows) -> Result<Restored, ModelError> {
    let whole = match &rows {
        Rows::Sparse { .. } => false,
        Rows::Modal(shapes) => shapes.is_whole(omega2.len()),
        Rows::Single(shapes) => shapes.is_whole(omega2.len()),
        Rows::Local(local) => local.is_whole(omega2.len()),
    };
    if !whole {
        return Err(damaged("rows do not fit the coordinates"));
    }
    Ok(Restored { system: Arc::new(Reduced::new(omega2)), rows, pencil: None })
}
