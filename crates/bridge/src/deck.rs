//! The deck's path: from a station x to an element, and from there to weights on degrees of freedom.
//!
//! ```text
//! u_z(x) = Σ_j N_j(ξ) q_j,     f_j = N_j(ξ) F
//! ```
//!
//! The same weights interpolate motions and distribute forces, so Σ F u̇ is the power that enters the structure.

use ttb_contract::ModelError;
use ttb_dynamics::frame::Row6;

use crate::mesh::Mesh;

/// Weights on degrees of freedom.
pub type Row = Vec<(u32, f64)>;

/// Stations closer than this to a joint or to the deck's ends are on them, m.
const NEAR: f64 = 1e-6;
/// Steepest member that carries track, |dz/dl|.
const STEEPEST: f64 = 0.5;

/// An element of the path, from its lower to its higher abscissa.
#[derive(Clone, Debug)]
struct Piece {
    element: usize,
    from: f64,
    to: f64,
    /// The element's first node is the far one.
    backward: bool,
}

/// Elements that carry the track, in track order, end to end.
#[derive(Clone, Debug)]
pub struct Deck {
    pieces: Vec<Piece>,
}

impl Deck {
    /// Orders the elements marked as deck.
    ///
    /// # Errors
    /// None is, they are too steep, they leave a gap or overlap.
    pub fn new(mesh: &Mesh) -> Result<Self, ModelError> {
        let mut pieces = Vec::new();
        for (index, element) in mesh.elements.iter().enumerate().filter(|(_, e)| e.deck) {
            let [a, b] = element.nodes.map(|node| &mesh.nodes[node]);
            if element.frame.direction()[1].abs() > STEEPEST {
                return Err(ModelError(format!(
                    "bridge: the deck between nodes {} and {} is too steep",
                    a.name, b.name
                )));
            }
            let piece = Piece { element: index, from: a.x.min(b.x), to: a.x.max(b.x), backward: b.x < a.x };
            pieces.push(piece);
        }
        pieces.sort_by(|a, b| a.from.total_cmp(&b.from));
        if pieces.is_empty() {
            return Err(ModelError("bridge: no member is marked as deck, nothing carries the track".into()));
        }
        if let Some(pair) = pieces.windows(2).find(|pair| (pair[0].to - pair[1].from).abs() > NEAR) {
            let what = if pair[0].to < pair[1].from { "has a gap" } else { "overlaps itself" };
            let (a, b) = (pair[0].to, pair[1].from);
            return Err(ModelError(format!("bridge: the deck {what} between x = {a} m and x = {b} m")));
        }
        Ok(Self { pieces })
    }

    /// Begin and end, m.
    pub fn extent(&self) -> [f64; 2] {
        // At least one piece: checked in `new`.
        [self.pieces[0].from, self.pieces[self.pieces.len() - 1].to]
    }

    /// The elements of the path in track order: position in the mesh, begin and end, m, and whether its first node is the
    /// far one.
    pub fn elements(&self) -> impl Iterator<Item = (usize, [f64; 2], bool)> {
        self.pieces.iter().map(|piece| (piece.element, [piece.from, piece.to], piece.backward))
    }

    /// The elements at x with their own ξ: one, two at a joint, none off the deck.
    fn at(&self, x: f64) -> impl Iterator<Item = (usize, f64)> {
        let first = self.pieces.partition_point(|p| p.to < x - NEAR);
        self.pieces[first..].iter().take_while(move |p| p.from <= x + NEAR).map(move |p| {
            let xi = match x {
                x if x <= p.from + NEAR => 0.0,
                x if x >= p.to - NEAR => 1.0,
                x => (x - p.from) / (p.to - p.from),
            };
            (p.element, if p.backward { 1.0 - xi } else { xi })
        })
    }

    /// Weights of the displacement along (x, z) = `along` at station x; `None` off the deck.
    pub fn displacement(&self, mesh: &Mesh, x: f64, along: [f64; 2]) -> Option<Row> {
        let (element, xi) = self.at(x).next()?;
        Some(row(mesh, element, mesh.elements[element].frame.displacement(xi, along)))
    }

    /// Weights of the bending moment at station x (N m, sagging positive), the mean of both sides at a joint.
    pub fn moment(&self, mesh: &Mesh, x: f64) -> Option<Row> {
        let sides: Vec<_> = self.at(x).collect();
        let share = 1.0 / sides.len() as f64;
        let rows =
            sides.iter().flat_map(|&(element, xi)| row(mesh, element, share * mesh.elements[element].frame.moment(xi)));
        let rows: Row = rows.collect();
        (!sides.is_empty()).then_some(rows)
    }
}

fn row(mesh: &Mesh, element: usize, weights: Row6) -> Row {
    let dofs = mesh.element_dofs(&mesh.elements[element]);
    let present = dofs.into_iter().zip(weights.iter()).filter_map(|(dof, &weight)| Some((dof?, weight)));
    present.filter(|(_, weight)| *weight != 0.0).collect()
}
