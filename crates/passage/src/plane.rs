//! Beams and plane frames under a force that moves along the deck.
//!
//! A force at s on an element acts at its nodes through the element's shapes N(ξ), so nodal displacements are exact. What an
//! element does not show is its own clamped beam under the force:
//!
//! ```text
//! M(x; s) = m_e · K⁻¹ r_s + M_c(x; s)      M_c = −N₂ + N₁x − ⟨x − s⟩ in the element of the force, else 0
//! V(x; s) = dM/dx
//! R_b(s)  = r_s · u_b                      u_b: displacements when bearing b yields by 1
//! ```
//!
//! At a joint the moment is read in the element on that side where the force is not. By reciprocity a static solution
//! K⁻¹m_e is the influence line of the moment. Elements with hinges have no M_c: their neighbours are finer than a force
//! can tell.

use ttb_bridge::deck::{Deck, Row};
use ttb_bridge::mesh::Mesh;
use ttb_contract::ModelError;
use ttb_dynamics::frame::Row6;
use ttb_scenario::spec::{BridgeSpec, Span, StructureSpec};
use ttb_scenario::types::{Direction, Point};
use ttb_sparse::{Factor, Pencil};

use crate::lines::Lines;
use crate::place::{Output, Place, PlaceKind, Quantity};
use crate::source::{NEAR, Source, stations};

/// Elements of a beam's span at least: its third frequency is then within 1e-5.
const ELEMENTS: usize = 40;

/// A beam bridge or a plane frame.
pub struct Plane {
    mesh: Mesh,
    pencil: Pencil,
    /// Elements of the path.
    pieces: Vec<Piece>,
    members: usize,
    spans: Vec<[f64; 2]>,
    outputs: Vec<Output>,
    seen: Vec<Seen>,
}

/// An element of the path.
#[derive(Clone, Copy)]
struct Piece {
    element: usize,
    from: f64,
    to: f64,
    backward: bool,
}

impl Piece {
    /// ξ of an abscissa on it, from the element's first node.
    fn xi(&self, x: f64) -> f64 {
        let xi = ((x - self.from) / (self.to - self.from)).clamp(0.0, 1.0);
        if self.backward { 1.0 - xi } else { xi }
    }
}

/// How an output is read.
enum Seen {
    /// Weights on displacements.
    Motion(Row),
    /// Bending moment or shear at x, in the elements before and behind it.
    Section { x: f64, shear: bool, sides: [Piece; 2] },
    /// Force on the bearing under a node.
    Bearing(usize),
}

impl Plane {
    /// The structure with `per_span` parts of a span looked at; `forces`: also moments, shears and reactions.
    ///
    /// # Errors
    /// Anything in the specification that cannot be.
    pub fn new(spec: &BridgeSpec, per_span: usize, forces: bool) -> Result<Self, ModelError> {
        let (mesh, members) = match &spec.structure {
            StructureSpec::Beams { spans, continuous } => {
                let finer = |span: &Span| Span { elements: span.elements.max(ELEMENTS), ..span.clone() };
                let finer: Vec<Span> = spans.iter().map(finer).collect();
                (ttb_bridge::beams::mesh(&finer, *continuous)?, if *continuous { 1 } else { spans.len() })
            }
            StructureSpec::Frame(frame) => (ttb_bridge::frame::mesh(frame)?, 1),
            _ => return Err(ModelError("bridge: this structure is not plane".into())),
        };
        let deck = Deck::new(&mesh)?;
        let pieces = deck.elements().map(|(element, [from, to], backward)| Piece { element, from, to, backward });
        let pieces: Vec<Piece> = pieces.collect();
        let pencil = mesh.assembly().finish().map_err(|e| ModelError(format!("bridge: {e}")))?;
        let mut bearings: Vec<f64> = pieces
            .iter()
            .flat_map(|p| mesh.elements[p.element].nodes)
            .filter(|n| mesh.nodes[*n].fixed[1])
            .map(|n| mesh.nodes[n].x)
            .collect();
        bearings.extend(deck.extent());
        bearings.sort_by(f64::total_cmp);
        bearings.dedup_by(|a, b| (*a - *b).abs() < NEAR);
        let spans: Vec<[f64; 2]> = bearings.windows(2).map(|pair| [pair[0], pair[1]]).collect();
        let mut plane = Self { mesh, pencil, pieces, members, spans, outputs: Vec::new(), seen: Vec::new() };
        plane.look(&deck, &spec.points, per_span, forces)?;
        Ok(plane)
    }

    fn look(&mut self, deck: &Deck, points: &[Point], per_span: usize, forces: bool) -> Result<(), ModelError> {
        /// A long span without bearings (cables) has a point at least so often, m.
        const SPACING: f64 = 2.5;
        let places = stations(&self.spans, |length| per_span.max((length / SPACING).ceil() as usize));
        let off = |x: f64| ModelError(format!("bridge: x = {x} m is off the deck"));
        for x in &places {
            let row = deck.displacement(&self.mesh, *x, [0.0, 1.0]).ok_or_else(|| off(*x))?;
            self.push(Quantity::Displacement, Place::on_deck(*x, ""), Seen::Motion(row));
        }
        for point in points {
            let row = self.point(deck, point)?;
            self.push(Quantity::Displacement, of_point(point), Seen::Motion(row));
        }
        if !forces {
            return Ok(());
        }
        let moment = |plane: &mut Self, place: Place, x: f64| {
            let sides = plane.sides(x);
            plane.push(Quantity::Moment, place, Seen::Section { x, shear: false, sides });
        };
        places.iter().for_each(|x| moment(self, Place::on_deck(*x, ""), *x));
        for point in points {
            if let Some(x) = point.x {
                moment(self, of_point(point), x);
            }
        }
        for x in &places {
            let sides = self.sides(*x);
            let bearing =
                self.spans.iter().any(|span| (span[0] - x).abs() < NEAR) && sides[0].element != sides[1].element;
            if bearing {
                // The bearing's force is the jump between both sides.
                for (side, mark) in sides.into_iter().zip(["-", "+"]) {
                    let seen = Seen::Section { x: *x, shear: true, sides: [side; 2] };
                    self.push(Quantity::Shear, Place::on_deck(*x, mark), seen);
                }
            } else {
                self.push(Quantity::Shear, Place::on_deck(*x, ""), Seen::Section { x: *x, shear: true, sides });
            }
        }
        let held: Vec<usize> = (0..self.mesh.nodes.len()).filter(|node| self.mesh.nodes[*node].fixed[1]).collect();
        for node in &held {
            let (x, name) = (self.mesh.nodes[*node].x, self.mesh.nodes[*node].name.clone());
            let here: Vec<&usize> = held.iter().filter(|other| (self.mesh.nodes[**other].x - x).abs() < NEAR).collect();
            // Nodes of beams have no names of their own.
            let mark = if here.len() < 2 {
                ""
            } else if here[0] == node {
                "-"
            } else {
                "+"
            };
            let name = if name.starts_with("at x") { Place::on_deck(x, mark).name } else { name };
            let place = Place { kind: PlaceKind::Bearing, name, x: Some(x) };
            self.push(Quantity::Reaction, place, Seen::Bearing(*node));
        }
        Ok(())
    }

    fn push(&mut self, quantity: Quantity, place: Place, seen: Seen) {
        self.outputs.push(Output { quantity, place });
        self.seen.push(seen);
    }

    /// Weights of a monitored point.
    fn point(&self, deck: &Deck, point: &Point) -> Result<Row, ModelError> {
        let wrong = |what: String| ModelError(format!("bridge: point {}: {what}", point.name));
        let along = match point.direction {
            Direction::X => [1.0, 0.0],
            Direction::Y => [0.0, 0.0],
            Direction::Z => [0.0, 1.0],
        };
        if let Some(x) = point.x {
            let row = deck.displacement(&self.mesh, x, along);
            return row.ok_or_else(|| wrong(format!("x = {x} m is off the deck")));
        }
        let name = point.node.as_deref().unwrap_or_default();
        let node = self.mesh.nodes.iter().position(|node| node.name == name);
        let node = node.ok_or_else(|| wrong(format!("there is no node named {name}")))?;
        let dofs = self.mesh.dofs[node];
        Ok(dofs.into_iter().zip(along).filter_map(|(dof, w)| Some((dof?, w))).filter(|(_, w)| *w != 0.0).collect())
    }

    /// The pieces before and behind an abscissa; the same twice inside a piece and at the deck's ends.
    fn sides(&self, x: f64) -> [Piece; 2] {
        let last = self.pieces.len() - 1;
        let before = self.pieces.partition_point(|p| p.to < x - NEAR).min(last);
        let behind = self.pieces.partition_point(|p| p.to < x + NEAR).min(last);
        [self.pieces[before], self.pieces[behind]]
    }

    /// Displacements [x, z, rotation] of all nodes.
    fn nodal(&self, u: &[f64]) -> Vec<[f64; 3]> {
        let value = |dof: Option<u32>| dof.map_or(0.0, |dof| u[dof as usize]);
        self.mesh.dofs.iter().map(|dofs| dofs.map(value)).collect()
    }

    /// Weights, over the six displacements of a piece's element, of moment or shear at x.
    fn section(&self, piece: &Piece, x: f64, shear: bool) -> Row6 {
        let frame = &self.mesh.elements[piece.element].frame;
        if !shear {
            return frame.moment(piece.xi(x));
        }
        let length = if piece.backward { -frame.length() } else { frame.length() };
        (frame.moment(1.0) - frame.moment(0.0)) / length
    }

    /// M_c or V_c at x under a unit force at s, both on the piece.
    fn clamped(&self, piece: &Piece, x: f64, s: f64, shear: bool) -> f64 {
        let frame = &self.mesh.elements[piece.element].frame;
        if frame.hinged != [false; 2] {
            return 0.0;
        }
        let (length, [at, force]) = (frame.length(), [x, s].map(|x| piece.xi(x)));
        let n = frame.beam.shape(force, length);
        let beyond = at > force;
        // Only the part across the element bends it.
        let across = frame.direction()[0].abs();
        if shear {
            let sign = if piece.backward { -across } else { across };
            sign * (n[0] - if beyond { 1.0 } else { 0.0 })
        } else {
            across * (n[0] * at * length - n[1] - if beyond { (at - force) * length } else { 0.0 })
        }
    }

    fn dot(&self, piece: &Piece, row: &Row6, nodal: &[[f64; 3]]) -> f64 {
        let ends = self.mesh.elements[piece.element].nodes.map(|node| nodal[node]);
        row.iter().zip(ends.iter().flatten()).map(|(w, u)| w * u).sum()
    }

    /// K⁻¹ of weights over an element's displacements.
    fn solved(&self, element: usize, row: &Row6, statics: &Factor) -> Vec<[f64; 3]> {
        let mut u = vec![0.0; self.mesh.ndof];
        let dofs = self.mesh.element_dofs(&self.mesh.elements[element]);
        dofs.iter().zip(row.iter()).for_each(|(dof, w)| {
            if let Some(dof) = dof {
                u[*dof as usize] += w;
            }
        });
        statics.solve_in_place(&mut u, &mut vec![0.0; self.mesh.ndof]);
        self.nodal(&u)
    }

    /// Row of K of a node's vertical direction, element by element: element and its six entries.
    fn held(&self, node: usize) -> impl Iterator<Item = (usize, [f64; 6])> + '_ {
        let with = self.mesh.elements.iter().enumerate().filter(move |(_, e)| e.nodes.contains(&node));
        with.map(move |(number, element)| {
            let at = if element.nodes[0] == node { 1 } else { 4 };
            let k = element.frame.stiffness();
            (number, std::array::from_fn(|j| k[(at, j)]))
        })
    }
}

fn of_point(point: &Point) -> Place {
    Place { kind: PlaceKind::Point, name: point.name.clone(), x: point.x }
}

/// A static influence line.
enum Influence {
    /// Displacements of all nodes.
    Nodal(Vec<[f64; 3]>),
    /// Of moment or shear: read in the element before and behind the section.
    Section { x: f64, shear: bool, sides: [Piece; 2], nodal: [Vec<[f64; 3]>; 2] },
}

impl Source for Plane {
    fn pencil(&self) -> &Pencil {
        &self.pencil
    }

    fn members(&self) -> usize {
        self.members
    }

    fn spans(&self) -> &[[f64; 2]] {
        &self.spans
    }

    fn outputs(&self) -> &[Output] {
        &self.outputs
    }

    fn rows(&self, shape: &[f64]) -> Vec<f64> {
        let nodal = self.nodal(shape);
        let value = |seen: &Seen| match seen {
            Seen::Motion(row) => row.iter().map(|(dof, w)| w * shape[*dof as usize]).sum(),
            Seen::Section { x, shear, sides } => {
                let side = |piece: &Piece| self.dot(piece, &self.section(piece, *x, *shear), &nodal);
                0.5 * (side(&sides[0]) + side(&sides[1]))
            }
            Seen::Bearing(node) => {
                let part = |(element, row): (usize, [f64; 6])| -> f64 {
                    let ends = self.mesh.elements[element].nodes.map(|node| nodal[node]);
                    row.iter().zip(ends.iter().flatten()).map(|(k, u)| k * u).sum()
                };
                -self.held(*node).map(part).sum::<f64>()
            }
        };
        self.seen.iter().map(value).collect()
    }

    fn lines(&self, shapes: &[Vec<f64>], pads: [usize; 2], statics: &Factor) -> Result<Lines, ModelError> {
        let shapes: Vec<Vec<[f64; 3]>> = shapes.iter().map(|shape| self.nodal(shape)).collect();
        let influence = |seen: &Seen| match seen {
            Seen::Motion(row) => {
                let mut u = vec![0.0; self.mesh.ndof];
                row.iter().for_each(|(dof, w)| u[*dof as usize] += w);
                statics.solve_in_place(&mut u, &mut vec![0.0; self.mesh.ndof]);
                Influence::Nodal(self.nodal(&u))
            }
            Seen::Section { x, shear, sides } => {
                let nodal = sides.map(|side| self.solved(side.element, &self.section(&side, *x, *shear), statics));
                Influence::Section { x: *x, shear: *shear, sides: *sides, nodal }
            }
            Seen::Bearing(node) => {
                let mut u = vec![0.0; self.mesh.ndof];
                for (element, row) in self.held(*node) {
                    let dofs = self.mesh.element_dofs(&self.mesh.elements[element]);
                    dofs.iter().zip(row).for_each(|(dof, k)| {
                        if let Some(dof) = dof {
                            u[*dof as usize] -= k;
                        }
                    });
                }
                statics.solve_in_place(&mut u, &mut vec![0.0; self.mesh.ndof]);
                let mut nodal = self.nodal(&u);
                nodal[*node][1] = 1.0;
                Influence::Nodal(nodal)
            }
        };
        let influences: Vec<Influence> = self.seen.iter().map(influence).collect();
        let mut breaks: Vec<f64> = self.pieces.iter().flat_map(|piece| [piece.from, piece.to]).collect();
        breaks.extend(self.seen.iter().filter_map(|seen| match seen {
            Seen::Section { x, .. } => Some(*x),
            _ => None,
        }));
        breaks.sort_by(f64::total_cmp);
        breaks.dedup_by(|a, b| (*a - *b).abs() < NEAR);
        let value = |_: usize, s: f64| {
            let piece = self.sides(s)[0];
            let path = self.mesh.elements[piece.element].frame.displacement(piece.xi(s), [0.0, 1.0]);
            let mut values: Vec<f64> = shapes.iter().map(|shape| self.dot(&piece, &path, shape)).collect();
            values.resize(pads[0], 0.0);
            values.extend(influences.iter().map(|influence| match influence {
                Influence::Nodal(nodal) => self.dot(&piece, &path, nodal),
                Influence::Section { x, shear, sides, nodal } => {
                    // The element on the side where the force is not.
                    let side = usize::from(s < *x);
                    let free = self.dot(&piece, &path, &nodal[side]);
                    let own = sides[side].element == piece.element;
                    free + if own { self.clamped(&piece, *x, s, *shear) } else { 0.0 }
                }
            }));
            values.resize(pads[0] + pads[1], 0.0);
            values
        };
        Ok(Lines::sampled(breaks, pads[0] + pads[1], value))
    }

    fn liveliness(&self, shape: &[f64]) -> f64 {
        let nodal = self.nodal(shape);
        let most = |piece: &Piece| {
            let frame = &self.mesh.elements[piece.element].frame;
            let at = |i: u32| self.dot(piece, &frame.displacement(0.25 * f64::from(i), [0.0, 1.0]), &nodal).abs();
            (0..=4).map(at).fold(0.0, f64::max)
        };
        self.pieces.iter().map(most).fold(0.0, f64::max)
    }
}
