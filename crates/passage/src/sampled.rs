//! Finite-element models in space and imported matrices under a force that moves along the deck.
//!
//! The path is known at stations; between them its displacement is the cubic of [`Lines::through`]. A deck point is a
//! station. Where an imported file has no support at an end of the deck, the force reaches the ground there: zero.

use ttb_bridge::assembled::Assembled;
use ttb_bridge::deck::Row;
use ttb_bridge::{imported, space};
use ttb_contract::ModelError;
use ttb_scenario::spec::{BridgeSpec, StructureSpec};
use ttb_sparse::{Factor, Layout, Pencil};

use crate::lines::Lines;
use crate::place::{Output, Place, PlaceKind, Quantity};
use crate::source::{NEAR, Source, stations};

/// Distance of the stations of a model in space at most, m.
const STATIONS: f64 = 0.65;
/// Distance of the deck points at most, m.
const POINTS: f64 = 1.25;

/// A bridge whose path is known at stations.
pub struct Sampled {
    pencil: Pencil,
    spans: Vec<[f64; 2]>,
    stations: Vec<f64>,
    /// Displacement of every station.
    path: Vec<Row>,
    outputs: Vec<Output>,
    seen: Vec<Row>,
}

impl Sampled {
    /// A model in space or imported matrices, with at least `per_span` parts of the deck looked at.
    ///
    /// # Errors
    /// Anything in the specification that cannot be.
    pub fn new(spec: &BridgeSpec, per_span: usize) -> Result<Self, ModelError> {
        let parts = |length: f64, most: f64| per_span.max((length / most).ceil() as usize);
        let (length, stations, assembled) = match &spec.structure {
            StructureSpec::FiniteElements(model) => {
                let length = model.deck.length;
                let points = parts(length, POINTS);
                // Every deck point is a station.
                let between = (length / points as f64 / STATIONS).ceil() as usize;
                let stations = stations(&[[0.0, length]], |_| points * between.max(1));
                let assembled = space::assemble(model, &stations, &spec.points)?;
                (length, stations, assembled)
            }
            StructureSpec::Matrices { files, folder, length } => {
                let read = files.read(folder).map_err(|problems| ModelError(problems.to_string()))?;
                let inside = |x: &f64| *x > -NEAR && *x < length + NEAR;
                let stations: Vec<f64> = read.supports.iter().map(|(x, _)| *x).filter(inside).collect();
                (*length, stations.clone(), imported::from(read, &stations)?)
            }
            _ => return Err(ModelError("bridge: this structure has no stations".into())),
        };
        Self::from(length, stations, assembled, parts(length, POINTS))
    }

    fn from(length: f64, mut at: Vec<f64>, assembled: Assembled, parts: usize) -> Result<Self, ModelError> {
        let Assembled { equations, nodes, node_of, supports, monitors, points, .. } = assembled;
        let layout = Layout { node_of, place: nodes, last: Vec::new(), order: Vec::new() };
        let pencil = equations.finish_with(&layout).map_err(|e| ModelError(format!("bridge: {e}")))?;
        let mut path = supports;
        if at.is_empty() {
            return Err(ModelError("bridge: the file of supports has none on the deck".into()));
        }
        if at[0] > NEAR {
            at.insert(0, 0.0);
            path.insert(0, Row::new());
        }
        if at.last().is_some_and(|last| *last < length - NEAR) {
            at.push(length);
            path.push(Row::new());
        }
        let (mut outputs, mut seen) = (Vec::new(), Vec::new());
        // The stations nearest to equal parts.
        let wanted = stations(&[[0.0, length]], |_| parts);
        let mut chosen: Vec<usize> = wanted.iter().map(|x| nearest(&at, *x)).collect();
        chosen.dedup();
        for i in chosen {
            outputs.push(Output { quantity: Quantity::Displacement, place: Place::on_deck(at[i], "") });
            seen.push(path[i].clone());
        }
        for point in points {
            let place = Place { kind: PlaceKind::Point, name: point.name, x: None };
            outputs.push(Output { quantity: Quantity::Displacement, place });
            seen.push(monitors[point.motion].clone());
        }
        Ok(Self { pencil, spans: vec![[0.0, length]], stations: at, path, outputs, seen })
    }
}

fn nearest(at: &[f64], x: f64) -> usize {
    let after = at.partition_point(|station| *station < x).min(at.len() - 1);
    let before = after.saturating_sub(1);
    if (x - at[before]).abs() < (at[after] - x).abs() { before } else { after }
}

fn dot(row: &Row, u: &[f64]) -> f64 {
    row.iter().map(|(dof, w)| w * u[*dof as usize]).sum()
}

impl Source for Sampled {
    fn pencil(&self) -> &Pencil {
        &self.pencil
    }

    fn members(&self) -> usize {
        1
    }

    fn spans(&self) -> &[[f64; 2]] {
        &self.spans
    }

    fn outputs(&self) -> &[Output] {
        &self.outputs
    }

    fn rows(&self, shape: &[f64]) -> Vec<f64> {
        self.seen.iter().map(|row| dot(row, shape)).collect()
    }

    fn lines(&self, shapes: &[Vec<f64>], pads: [usize; 2], statics: &Factor) -> Result<Lines, ModelError> {
        let n = self.pencil.ndof();
        let along = |u: &[f64]| self.path.iter().map(|row| dot(row, u)).collect::<Vec<f64>>();
        let zero = || vec![0.0; self.stations.len()];
        let mut functions: Vec<Vec<f64>> = shapes.iter().map(|shape| along(shape)).collect();
        functions.resize_with(pads[0], zero);
        let mut scratch = vec![0.0; n];
        for row in &self.seen {
            let mut u = vec![0.0; n];
            row.iter().for_each(|(dof, w)| u[*dof as usize] += w);
            statics.solve_in_place(&mut u, &mut scratch);
            functions.push(along(&u));
        }
        functions.resize_with(pads[0] + pads[1], zero);
        Ok(Lines::through(self.stations.clone(), &functions))
    }

    fn liveliness(&self, shape: &[f64]) -> f64 {
        self.path.iter().map(|row| dot(row, shape).abs()).fold(0.0, f64::max)
    }
}
