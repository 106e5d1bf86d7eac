//! How supports of imported matrices move across and about the track, from the rows of their vertical motion.
//!
//! The table of supports gives w: down = Σ w_j q_j over translations of nodes j along one axis; s_j = ±w_j with the sign that
//! makes their sum positive. In the frame of the track
//!
//! ```text
//! e_d = ± that axis, with that sign        e_x along the track: ± the model's x, by the nodes' coordinates
//! e_y = e_d × e_x  (right = down × ahead)
//! d_y = Σ s_j e_y · u_j
//! d_φ = Σ s_j e_x · r_j    where every node has that rotation, else the slope of down over y:
//!     = Σ a_j s_j (e_d · u_j),   a_j = (y_j − ȳ)/Σ s_k (y_k − ȳ)²,  ȳ = Σ s_j y_j
//! ```
//!
//! The last one needs nodes at different y and their coordinates: solids, or plates without rotations.

use std::collections::HashMap;

use ttb_contract::ModelError;
use ttb_import::{Dof, Dofs, Imported, Row};

/// Weights below this part of the largest do not count.
const NOTHING: f64 = 1e-9;
/// Nodes nearer across than this lie on one line, m.
const LINE: f64 = 1e-3;

/// Rows of a block: place of the support along the track, m, and weights.
pub type Block = Vec<(f64, Row)>;

/// Rows of d_y and d_φ at the supports of the file.
///
/// # Errors
/// No table of degrees of freedom, or a support whose nodes have neither.
pub fn rows(imported: &Imported) -> Result<[Block; 2], ModelError> {
    let dofs = imported.dofs.as_ref();
    let dofs = dofs.ok_or_else(|| refused("a table `dofs` of nodes and freedoms is needed".into()))?;
    let number: HashMap<Dof, u32> = dofs.dofs.iter().zip(0..).map(|(dof, row)| (*dof, row)).collect();
    let frame = Frame::of(imported, dofs).map_err(refused)?;
    let (mut across, mut about) = (Vec::new(), Vec::new());
    for (x, row) in &imported.supports {
        let support = Support { frame: &frame, dofs, number: &number, row };
        across.push((*x, support.across().map_err(|why| refused(format!("the support at x = {x} m: {why}")))?));
        about.push((*x, support.about().map_err(|why| refused(format!("the support at x = {x} m: {why}")))?));
    }
    Ok([across, about])
}

/// Rigid translations across and down over the rows of the matrices.
///
/// # Errors
/// As [`rows`].
pub fn translations(imported: &Imported) -> Result<[Vec<f64>; 2], ModelError> {
    let dofs =
        imported.dofs.as_ref().ok_or_else(|| refused("a table `dofs` of nodes and freedoms is needed".into()))?;
    let frame = Frame::of(imported, dofs).map_err(refused)?;
    let along = |(axis, sign): (usize, f64)| {
        let of = |dof: &Dof| if usize::from(dof.freedom) == axis { sign } else { 0.0 };
        dofs.dofs.iter().map(of).collect()
    };
    Ok([along(frame.axes[1]), along(frame.axes[2])])
}

fn refused(why: String) -> ModelError {
    ModelError(format!(
        "bridge: imported matrices in space: {why}; without the scenario's key `space` the run is plane"
    ))
}

/// The track's directions as axes of the model with signs.
struct Frame {
    /// Axis 0 to 2 and sign: ahead, right, down.
    axes: [(usize, f64); 3],
}

impl Frame {
    fn of(imported: &Imported, dofs: &Dofs) -> Result<Self, String> {
        let mut down = [0.0; 3];
        for (dof, weight) in imported.supports.iter().flat_map(|(_, row)| row) {
            if let Some(sum) = down.get_mut(usize::from(dofs.dofs[*dof as usize].freedom)) {
                *sum += weight;
            }
        }
        let vertical = (0..3).max_by(|a, b| down[*a].abs().total_cmp(&down[*b].abs())).unwrap_or(2);
        if down[vertical] == 0.0 || (0..3).any(|i| i != vertical && down[i].abs() > LINE * down[vertical].abs()) {
            return Err("the supports' motion must be that along one axis of the model".into());
        }
        let sign = down[vertical].signum();
        let ahead = if vertical == 0 { (1, 1.0) } else { (0, 1.0) };
        let forward = dofs.coordinates.as_ref().map_or(1.0, |places| {
            // Whether x of the model rises with x of the track.
            let place = |(at, row): &(f64, Row)| {
                let (dof, _) = row.iter().max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()))?;
                Some([*at, places[dofs.node_of[*dof as usize] as usize][ahead.0]])
            };
            let ends = [imported.supports.first(), imported.supports.last()].map(|support| support.and_then(place));
            match ends {
                [Some([a, x]), Some([b, y])] if (b - a) * (y - x) < 0.0 => -1.0,
                _ => 1.0,
            }
        });
        // e_y = e_d × e_x: the third axis, with the sign of the permutation.
        let right = 3 - vertical - ahead.0;
        let cyclic = (vertical + 1) % 3 == ahead.0;
        let turn = if cyclic { 1.0 } else { -1.0 };
        Ok(Self { axes: [(ahead.0, forward), (right, turn * sign * forward), (vertical, sign)] })
    }
}

/// One support of the file.
struct Support<'a> {
    frame: &'a Frame,
    dofs: &'a Dofs,
    number: &'a HashMap<Dof, u32>,
    row: &'a Row,
}

impl Support<'_> {
    /// Rows of the vertical motion with their weights s_j, of sum 1.
    fn shares(&self) -> impl Iterator<Item = (u32, f64)> {
        let (vertical, sign) = self.frame.axes[2];
        let largest = self.row.iter().map(|(_, weight)| weight.abs()).fold(0.0, f64::max);
        let counts = move |(dof, weight): &&(u32, f64)| {
            usize::from(self.dofs.dofs[*dof as usize].freedom) == vertical && weight.abs() > NOTHING * largest
        };
        self.row.iter().filter(counts).map(move |(dof, weight)| (*dof, sign * weight))
    }

    /// Another freedom of the node that a row belongs to.
    fn sibling(&self, row: u32, freedom: usize) -> Option<u32> {
        let Dof { node, .. } = self.dofs.dofs[row as usize];
        self.number.get(&Dof { node, freedom: freedom as u8 }).copied()
    }

    fn across(&self) -> Result<Row, String> {
        let (axis, sign) = self.frame.axes[1];
        // A freedom that is not among the rows is held: it does not move.
        let moved: Row =
            self.shares().filter_map(|(row, share)| Some((self.sibling(row, axis)?, sign * share))).collect();
        if moved.is_empty() && self.shares().next().is_some() {
            return Err(format!("none of its nodes moves along {}", AXES[axis]));
        }
        Ok(moved)
    }

    fn about(&self) -> Result<Row, String> {
        let (axis, sign) = self.frame.axes[0];
        let turned: Option<Row> =
            self.shares().map(|(row, share)| Some((self.sibling(row, 3 + axis)?, sign * share))).collect();
        if let Some(turned) = turned {
            return Ok(turned);
        }
        let missing = || {
            format!(
                "its nodes have no rotation about {}, and it does not stand on nodes at different places across with known \
                 coordinates",
                AXES[axis]
            )
        };
        let places = self.dofs.coordinates.as_ref().ok_or_else(missing)?;
        let (right, to_right) = self.frame.axes[1];
        let y = |row: u32| to_right * places[self.dofs.node_of[row as usize] as usize][right];
        let total: f64 = self.shares().map(|(_, share)| share).sum();
        let mean = self.shares().map(|(row, share)| share * y(row)).sum::<f64>() / total;
        let spread: f64 = self.shares().map(|(row, share)| share * (y(row) - mean).powi(2)).sum();
        if spread.is_nan() || spread < LINE * LINE * total {
            return Err(missing());
        }
        let down = self.frame.axes[2].1;
        Ok(self.shares().map(|(row, share)| (row, down * share * (y(row) - mean) / spread)).collect())
    }
}

const AXES: [&str; 3] = ["x", "y", "z"];
