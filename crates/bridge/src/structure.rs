//! From the specification to equations, and to the rows that lead in and out of them: all that no parameter touches.

use std::sync::Arc;

use ttb_coupling::ModelError;
use ttb_dynamics::damping::rayleigh;
use ttb_dynamics::factor::{Factor, FactorError};
use ttb_dynamics::modes::{Modes, lowest};
use ttb_dynamics::sparse::Pencil;
use ttb_scenario::spec::{BridgeSpec, StructureSpec};
use ttb_scenario::types::{Damping, Direction, Point, RayleighAt};

use crate::deck::{Deck, Row};
use crate::full::Full;
use crate::mesh::Mesh;
use crate::reduced::Reduced;
use crate::rows::Rows;
use crate::system::{Law, System};

/// A monitored point: its rows in [`Structure::monitors`].
#[derive(Clone, Debug)]
pub struct Monitor {
    /// Name.
    pub name: String,
    /// Displacement.
    pub motion: usize,
    /// Bending moment.
    pub moment: Option<usize>,
}

/// The structure.
pub struct Structure {
    mesh: Mesh,
    pencil: Pencil,
    statics: Factor,
    /// ω² of the modes that damping or reduction need, lowest first.
    omega2: Vec<f64>,
    damping: Damping,
    /// Its equations.
    pub system: Arc<dyn System>,
    /// One row per support.
    pub supports: Rows,
    /// Rows of the monitored points.
    pub monitors: Rows,
    /// The monitored points.
    pub points: Vec<Monitor>,
}

impl Structure {
    /// Meshes, assembles, factorises K, finds modes where they are needed.
    ///
    /// # Errors
    /// Anything in the specification that cannot be: the message names it.
    pub fn new(spec: &BridgeSpec) -> Result<Self, ModelError> {
        let mesh = match &spec.structure {
            StructureSpec::Beams { spans, continuous } => {
                if let Some(point) = spec.points.iter().find(|p| p.direction == Direction::X) {
                    return Err(ModelError(format!("bridge: point {}: beams move only along z", point.name)));
                }
                crate::beams::mesh(spans, *continuous)?
            }
            StructureSpec::Frame(frame) => crate::frame::mesh(frame)?,
            StructureSpec::FiniteElements(_) => {
                return Err(ModelError("bridge: finite elements cannot be solved yet".into()));
            }
        };
        let pencil = mesh.assemble()?;
        let statics = pencil.factor(1.0, 0.0).map_err(|e| explain(&mesh, e))?;
        let needed = modes_needed(spec);
        let modes =
            if needed == 0 { Modes::default() } else { lowest(&pencil, &statics, needed).map_err(in_bridge)? };
        let deck = Deck::new(&mesh)?;
        let mut supports = support_rows(&mesh, &deck, &spec.supports)?;
        let (mut monitors, points) = monitor_rows(&mesh, &deck, &spec.points)?;
        let omega2 = modes.omega2.clone();
        let system: Arc<dyn System> = if let Some(count) = spec.modes {
            let mut kept = modes;
            kept.shapes.truncate(count);
            kept.omega2.truncate(count);
            supports = supports.project(&kept);
            monitors = monitors.project(&kept);
            Arc::new(Reduced::new(kept.omega2))
        } else {
            let damped = if matches!(spec.damping, Damping::Modal { .. }) { modes } else { Modes::default() };
            Arc::new(Full::new(pencil.clone(), statics.clone(), damped))
        };
        let damping = spec.damping.clone();
        Ok(Self { mesh, pencil, statics, omega2, damping, system, supports, monitors, points })
    }

    /// Degrees of freedom of the finite-element model.
    pub fn ndof(&self) -> usize {
        self.mesh.ndof
    }

    /// Mass of all elements, kg, without a factor.
    pub fn mass(&self) -> f64 {
        self.mesh.mass()
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
        let modes = lowest(&self.pencil, &self.statics, count).map_err(in_bridge)?;
        Ok(modes.frequencies().collect())
    }
}

fn in_bridge(error: impl std::fmt::Display) -> ModelError {
    ModelError(format!("bridge: {error}"))
}

fn explain(mesh: &Mesh, error: FactorError) -> ModelError {
    match error {
        FactorError::NotPositive { dof } => {
            let place = mesh.describe(dof);
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

fn support_rows(mesh: &Mesh, deck: &Deck, stations: &[f64]) -> Result<Rows, ModelError> {
    let row = |(number, &x): (usize, &f64)| {
        let row = deck.displacement(mesh, x, [0.0, 1.0]);
        row.ok_or_else(|| off_deck(&format!("support[{number}]"), x, deck))
    };
    let rows: Result<Vec<Row>, ModelError> = (1..).zip(stations).map(row).collect();
    Ok(Rows::new(&rows?))
}

fn monitor_rows(mesh: &Mesh, deck: &Deck, points: &[Point]) -> Result<(Rows, Vec<Monitor>), ModelError> {
    let (mut rows, mut monitors) = (Vec::new(), Vec::new());
    for point in points {
        let name = &point.name;
        let (motion, moment) = match (point.x, &point.node) {
            (Some(x), None) => on_deck(mesh, deck, point, x)?,
            (None, Some(node)) => (at_node(mesh, name, node, point.direction)?, None),
            _ => return Err(ModelError(format!("bridge: point {name} needs either x or node"))),
        };
        rows.push(motion);
        let motion = rows.len() - 1;
        let moment = moment.map(|row| {
            rows.push(row);
            rows.len() - 1
        });
        monitors.push(Monitor { name: name.clone(), motion, moment });
    }
    Ok((Rows::new(&rows), monitors))
}

fn on_deck(mesh: &Mesh, deck: &Deck, point: &Point, x: f64) -> Result<(Row, Option<Row>), ModelError> {
    let along = match point.direction {
        Direction::X => [1.0, 0.0],
        Direction::Y => [0.0, 0.0],
        Direction::Z => [0.0, 1.0],
    };
    let motion = deck.displacement(mesh, x, along);
    let motion = motion.ok_or_else(|| off_deck(&format!("point {}", point.name), x, deck))?;
    Ok((motion, deck.moment(mesh, x)))
}

fn at_node(mesh: &Mesh, point: &str, node: &str, direction: Direction) -> Result<Row, ModelError> {
    let found = mesh.nodes.iter().position(|n| n.name == node);
    let found = found.ok_or_else(|| ModelError(format!("bridge: point {point}: there is no node named {node}")))?;
    let dof = match direction {
        Direction::X => mesh.dofs[found][0],
        Direction::Y => None,
        Direction::Z => mesh.dofs[found][1],
    };
    Ok(dof.map(|dof| (dof, 1.0)).into_iter().collect())
}

fn off_deck(what: &str, x: f64, deck: &Deck) -> ModelError {
    let [begin, end] = deck.extent();
    ModelError(format!("bridge: {what} at x = {x} m is off the deck, which reaches from {begin} m to {end} m"))
}
