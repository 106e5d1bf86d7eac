//! A bridge as points and cells, for viewers, and what moves them: sag under its own weight, natural modes, any motion of
//! its degrees of freedom.
//!
//! ```text
//! K u = g M r                   the sag; r: every translation down is 1
//! K φ = ω² M φ                  the modes, each scaled so that its greatest displacement is 1
//! d_i = R_i u                   displacement of point i
//! ```
//!
//! Viewers have z up: a model of ours is drawn with (x, −y, −z), turned about its length. Imported matrices keep the axes of
//! the program that wrote them.

use ttb_contract::ModelError;
use ttb_scenario::GRAVITY;
use ttb_scenario::spec::{BridgeSpec, StructureSpec};
use ttb_sparse::modes::lowest;
use ttb_sparse::{Factor, Layout, Pencil};

use crate::assembled::Assembled;
use crate::deck::Row;
use crate::mesh::Mesh;
use crate::outline::{Outline, Weight};
use crate::rows::Rows;
use crate::{beams, frame, imported, plane, space};

/// A displacement along x, y and z, m.
pub type Displacement = [f64; 3];

/// A bridge, ready to be drawn.
pub struct Drawing {
    /// Where the points are, m.
    pub points: Vec<[f64; 3]>,
    /// Points of every cell by position: one is a node, two a line, three or four a plate.
    pub cells: Vec<Vec<u32>>,
    /// Where the track rests on it, one place a support, m.
    pub track: Vec<[f64; 3]>,
    rows: Rows,
    weight: Weight,
    /// Signs of the axes.
    signs: [f64; 3],
    pencil: Pencil,
    factor: Factor,
}

/// A natural mode.
pub struct Shape {
    /// Hz.
    pub frequency: f64,
    /// Of every point; the greatest is 1.
    pub displacements: Vec<Displacement>,
}

impl Drawing {
    /// Of a scenario's bridge.
    ///
    /// # Errors
    /// It cannot be assembled or factorised; imported matrices without coordinates; a stored bridge.
    pub fn new(spec: &BridgeSpec) -> Result<Self, ModelError> {
        let (assembled, outline) = match &spec.structure {
            StructureSpec::Beams { spans, continuous } => {
                (plane::assemble(spec)?, of_mesh(&beams::mesh(spans, *continuous)?))
            }
            StructureSpec::Frame(frame) => (plane::assemble(spec)?, of_mesh(&frame::mesh(frame)?)),
            StructureSpec::FiniteElements(model) => {
                (space::assemble(model, &spec.supports, &[])?, space::outline(model)?)
            }
            StructureSpec::Matrices { files, folder, .. } => {
                let imported = files.read(folder).map_err(|problems| ModelError(problems.to_string()))?;
                let outline = imported::outline(&imported)?;
                (imported::from(imported, &spec.supports)?, outline)
            }
            StructureSpec::Stored => {
                return Err(ModelError("bridge: a stored bridge has no points that could be drawn".into()));
            }
        };
        let Assembled { equations, nodes, node_of, supports, .. } = assembled;
        let under = |row: &Row| under(row, &nodes, &node_of);
        let track: Vec<_> = supports.iter().map(under).zip(&spec.supports).map(|([_, y, z], x)| [*x, y, z]).collect();
        let failed = |e: &dyn std::fmt::Display| ModelError(format!("bridge: {e}"));
        let pencil =
            equations.finish_with(&Layout { node_of, place: nodes, ..Layout::default() }).map_err(|e| failed(&e))?;
        let factor = pencil.factor(1.0, 0.0, 0.0).map_err(|e| failed(&e))?;
        let Outline { points, cells, rows, weight } = outline;
        let signs = if matches!(weight, Weight::Loads(_)) { [1.0, -1.0, -1.0] } else { [1.0; 3] };
        // Adding 0 makes 0 of −0.
        let drawn = |points: &[[f64; 3]]| -> Vec<[f64; 3]> {
            points.iter().map(|point| [0, 1, 2].map(|axis| signs[axis] * point[axis] + 0.0)).collect()
        };
        let (points, track) = (drawn(&points), drawn(&track));
        Ok(Self { points, cells, track, rows: Rows::new(&rows.concat()), weight, signs, pencil, factor })
    }

    /// Displacements of all points for a motion u of all degrees of freedom.
    pub fn displacements(&self, u: &[f64]) -> Vec<Displacement> {
        let along = |point: usize, axis: usize| self.signs[axis] * self.rows.dot(3 * point + axis, u) + 0.0;
        (0..self.points.len()).map(|point| [0, 1, 2].map(|axis| along(point, axis))).collect()
    }

    /// The sag under the own weight, m. Where only M is known, what M couples to held motions is left out.
    pub fn sag(&self) -> Vec<Displacement> {
        let mut u = match &self.weight {
            Weight::Loads(loads) => loads.clone(),
            Weight::Down(axis, sign) => self.weight_of_rows(*axis, *sign),
        };
        self.factor.solve_in_place(&mut u, &mut vec![0.0; self.pencil.ndof()]);
        self.displacements(&u)
    }

    /// g M r.
    fn weight_of_rows(&self, axis: usize, sign: f64) -> Vec<f64> {
        let mut r = vec![0.0; self.pencil.ndof()];
        for point in 0..self.points.len() {
            self.rows.columns(3 * point + axis).iter().for_each(|dof| r[*dof as usize] = sign * GRAVITY);
        }
        let mut load = vec![0.0; r.len()];
        self.pencil.add_mass(&r, &mut load);
        load
    }

    /// The lowest modes.
    ///
    /// # Errors
    /// They are not found.
    pub fn modes(&self, count: usize) -> Result<Vec<Shape>, ModelError> {
        let modes = lowest(&self.pencil, &self.factor, count.min(self.pencil.ndof()));
        let modes = modes.map_err(|e| ModelError(format!("bridge: {e}")))?;
        let shape = |(frequency, shape): (f64, &Vec<f64>)| {
            let mut displacements = self.displacements(shape);
            let greatest = displacements.iter().map(|d| d.iter().map(|x| x * x).sum::<f64>()).fold(0.0, f64::max);
            // A mode that moves no point (a rotation alone) stays as it is.
            let scale = if greatest > 0.0 { greatest.sqrt().recip() } else { 1.0 };
            displacements.iter_mut().flatten().for_each(|x| *x *= scale);
            Shape { frequency, displacements }
        };
        Ok(modes.frequencies().zip(&modes.shapes).map(shape).collect())
    }
}

/// The place of a support: the mean of its nodes, weighted.
fn under(row: &Row, nodes: &[[f64; 3]], node_of: &[u32]) -> [f64; 3] {
    let whole: f64 = row.iter().map(|(_, weight)| weight.abs()).sum();
    let place = |(dof, weight): &(u32, f64)| {
        let node = node_of.get(*dof as usize).and_then(|node| nodes.get(*node as usize)).copied().unwrap_or_default();
        node.map(|x| x * weight.abs() / whole)
    };
    row.iter().map(place).fold([0.0; 3], |sum, part| [sum[0] + part[0], sum[1] + part[1], sum[2] + part[2]])
}

/// A plane structure: lines between nodes.
fn of_mesh(mesh: &Mesh) -> Outline {
    let mut weight = vec![0.0; mesh.ndof];
    for element in &mesh.elements {
        let mass = element.frame.mass_matrix();
        // Both ends move down by one.
        let load = |row: usize| GRAVITY * (mass[(row, 1)] + mass[(row, 4)]);
        let dofs = mesh.element_dofs(element);
        dofs.iter().enumerate().filter_map(|(row, dof)| Some((row, (*dof)?))).for_each(|(row, dof)| {
            weight[dof as usize] += load(row);
        });
    }
    let row = |dof: Option<u32>| dof.map(|dof| (dof, 1.0)).into_iter().collect::<Row>();
    Outline {
        points: mesh.nodes.iter().map(|node| [node.x, 0.0, node.z]).collect(),
        cells: mesh.elements.iter().map(|element| element.nodes.map(|node| node as u32).to_vec()).collect(),
        rows: mesh.dofs.iter().map(|[x, z, _]| [row(*x), Row::new(), row(*z)]).collect(),
        weight: Weight::Loads(weight),
    }
}
