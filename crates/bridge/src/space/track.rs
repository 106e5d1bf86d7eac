//! The track's line over the model: from a station x to weights on the motions of nodes.
//!
//! ```text
//! shells   u(x) = Σ_j N_j(ξ, η) z_j                     in the shell over or under (x, y)
//! beams    u(x) = w(ξ) + r_x(ξ) (y − y_axis)            on the beam at x nearest to y
//! nodes    u(x) = z_j + r_x,j (y − y_j) − r_y,j (x − x_j)     at the node nearest along x, then along y
//! ```
//!
//! In space the reference point (x, y_d, z_d) of a support also moves across and turns about x:
//!
//! ```text
//! d_y(x) = v(ξ) + r_z-part − r_x (z_d − z)        d_φ(x) = r_x(ξ)
//! ```
//!
//! The same weights distribute a force, so that its power enters the model and an eccentric track twists the deck.

use ttb_contract::{Component, ModelError};
use ttb_scenario::space::{Index, motion};
use ttb_scenario::types::{Freedom, Model};

use super::carriers::{Carrier, EDGE, Of, axis, carriers};
use super::elements::coordinates;
use super::freedoms::Weights;
use super::kind::Kind;
use super::solids::{self, Sections};

/// Down, and to the right.
const DOWN: [f64; 3] = [0.0, 0.0, 1.0];
const RIGHT: [f64; 3] = [0.0, 1.0, 0.0];

/// What carries the track, sorted into strips along x.
pub(super) struct Track<'a> {
    model: &'a Model,
    sections: Sections<'a>,
    carriers: Vec<Carrier<'a>>,
    /// Begin and width of the strips, m.
    begin: f64,
    width: f64,
    strips: Vec<Vec<u32>>,
    what: &'static str,
}

impl<'a> Track<'a> {
    pub fn new(model: &'a Model, index: &Index) -> Result<Self, ModelError> {
        let (carriers, what) = carriers(model, index)?;
        let begin = carriers.iter().map(|carrier| carrier.x[0]).fold(f64::INFINITY, f64::min);
        let end = carriers.iter().map(|carrier| carrier.x[1]).fold(f64::NEG_INFINITY, f64::max);
        let count = (carriers.len() / 4).clamp(1, 100_000);
        let width = (end - begin) / count as f64;
        let mut track = Self {
            model,
            sections: Sections::new(model),
            carriers,
            begin,
            width,
            strips: vec![Vec::new(); count],
            what,
        };
        for (number, carrier) in track.carriers.iter().enumerate() {
            let [first, last] = carrier.x.map(|x| strip(x, begin, width, count));
            track.strips[first..=last].iter_mut().for_each(|strip| strip.push(number as u32));
        }
        Ok(track)
    }

    /// Weights of a component of the reference point's motion at station x.
    pub fn at(&self, x: f64, component: Component, asked: &str) -> Result<Weights, ModelError> {
        let strip = &self.strips[strip(x, self.begin, self.width, self.strips.len())];
        let over = strip.iter().map(|number| &self.carriers[*number as usize]);
        let here: Vec<&Carrier> = over.filter(|c| x >= c.x[0] - EDGE && x <= c.x[1] + EDGE).collect();
        let found = match self.what {
            "shell" => self.on_shell(x, component, &here),
            "beam" => self.on_beam(x, component, &here),
            _ => self.on_node(x, component, &here),
        };
        found?.ok_or_else(|| self.off(x, asked, &here))
    }

    /// The highest of the shells over or under the track.
    fn on_shell(&self, x: f64, component: Component, here: &[&Carrier]) -> Result<Option<Weights>, ModelError> {
        let y = self.model.deck.y;
        let mut best: Option<(f64, Weights)> = None;
        for carrier in here.iter().filter(|c| y >= c.y[0] - EDGE && y <= c.y[1] + EDGE) {
            let Of::Shell(section) = carrier.of else { continue };
            let corners: Vec<[f64; 3]> = carrier.nodes.iter().map(|node| coordinates(self.model, *node)).collect();
            let why = |why| ModelError(format!("bridge: shell of section {section}: {why}"));
            let plate = self.sections.plate(section).map_err(why)?;
            // How far the reference point is below the middle surface.
            let arm = |z: f64| {
                let top = -0.5 * plate.thickness;
                [0.0, 0.0, self.model.deck.z.map_or(top, |level| level - z)]
            };
            let found = match solids::shell(&corners, plate).map_err(why)? {
                Kind::Shell4(shell) => shell.contains_in_plan(x, y, EDGE).map(|place| {
                    let z = shell.point(place)[2];
                    (z, of(component, arm(z), |direction, arm| shell.interpolate(place, direction, arm)))
                }),
                Kind::Shell3(shell) => shell.contains_in_plan(x, y, EDGE).map(|place| {
                    let z = shell.point(place)[2];
                    (z, of(component, arm(z), |direction, arm| shell.interpolate(place, direction, arm)))
                }),
                _ => None,
            };
            if let Some((z, weights)) = found
                && best.as_ref().is_none_or(|(highest, _)| z < highest - EDGE)
            {
                best = Some((z, in_model(&carrier.nodes, weights)));
            }
        }
        Ok(best.map(|(_, weights)| weights))
    }

    /// The beam nearest to the track; halfway between two, both.
    fn on_beam(&self, x: f64, component: Component, here: &[&Carrier]) -> Result<Option<Weights>, ModelError> {
        // nearest to the left and to the right of the track: distance, row
        let mut sides: [Option<(f64, Weights)>; 2] = [None, None];
        for carrier in here {
            let Of::Beam(list) = carrier.of else { continue };
            let ends = [0, 1].map(|end| coordinates(self.model, carrier.nodes[end]));
            let section = self.sections.beam(&list.section);
            let beam = section.and_then(|section| solids::beam(list, section, ends));
            let beam = beam.map_err(|why| ModelError(format!("bridge: beam of section {}: {why}", list.section)))?;
            let [a, b] = axis(self.model, list, [carrier.nodes[0], carrier.nodes[1]]);
            let xi = ((x - a[0]) / (b[0] - a[0])).clamp(0.0, 1.0);
            let arm = self.model.deck.y - (a[1] + xi * (b[1] - a[1]));
            let side = &mut sides[usize::from(arm > EDGE)];
            if side.as_ref().is_none_or(|(distance, _)| arm.abs() < distance - EDGE) {
                let above = self.model.deck.z.map_or(0.0, |level| level - (a[2] + xi * (b[2] - a[2])));
                let weights = of(component, [0.0, arm, above], |direction, arm| beam.interpolate(xi, direction, arm));
                *side = Some((arm.abs(), in_model(&carrier.nodes, weights)));
            }
        }
        let [left, right] = sides;
        Ok(match (left, right) {
            (Some((a, left)), Some((b, right))) if (a - b).abs() <= EDGE => {
                let both = left.into_iter().chain(right);
                Some(both.map(|(motion, weight)| (motion, 0.5 * weight)).collect())
            }
            (Some((a, left)), Some((b, right))) => Some(if a < b { left } else { right }),
            (left, right) => left.or(right).map(|(_, weights)| weights),
        })
    }

    /// The node nearest along x; of several there the nearest along y, and of those the highest.
    fn on_node(&self, x: f64, component: Component, here: &[&Carrier]) -> Result<Option<Weights>, ModelError> {
        let y = self.model.deck.y;
        let order = |carrier: &&&Carrier| {
            let place = coordinates(self.model, carrier.nodes[0]);
            let steps = |distance: f64| (distance.abs() / EDGE).round();
            (steps(place[0] - x), steps(place[1] - y), place[2])
        };
        let nearest = here.iter().min_by(|a, b| {
            let (a, b) = (order(a), order(b));
            a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)).then(a.2.total_cmp(&b.2))
        });
        Ok(nearest.map(|carrier| {
            let node = carrier.nodes[0];
            let [from_x, from_y, from_z] = coordinates(self.model, node);
            let arm = [x - from_x, y - from_y, self.model.deck.z.map_or(0.0, |level| level - from_z)];
            let weights = match component {
                Component::Vertical => vec![(Freedom::Z, 1.0), (Freedom::Rx, arm[1]), (Freedom::Ry, -arm[0])],
                Component::Lateral => vec![(Freedom::Y, 1.0), (Freedom::Rz, arm[0]), (Freedom::Rx, -arm[2])],
                Component::Roll => vec![(Freedom::Rx, 1.0)],
            };
            weights.into_iter().map(|(freedom, weight)| (motion(node, freedom), weight)).collect()
        }))
    }

    /// Nothing carries at a station: what there is.
    fn off(&self, x: f64, asked: &str, here: &[&Carrier]) -> ModelError {
        let extent = |range: fn(&Carrier) -> [f64; 2], carriers: &mut dyn Iterator<Item = &Carrier>| {
            carriers.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], carrier| {
                let [from, to] = range(carrier);
                [low.min(from), high.max(to)]
            })
        };
        let (what, y) = (self.what, self.model.deck.y);
        let there = if here.is_empty() {
            let [from, to] = extent(|carrier| carrier.x, &mut self.carriers.iter());
            format!("what carries the track reaches from x = {from} m to {to} m")
        } else {
            let [from, to] = extent(|carrier| carrier.y, &mut here.iter().copied());
            format!("what carries the track reaches from y = {from} m to {to} m there")
        };
        ModelError(format!("bridge: {asked} at x = {x} m, y = {y} m is off the deck: no {what} is there; {there}"))
    }
}

fn strip(x: f64, begin: f64, width: f64, count: usize) -> usize {
    if width > 0.0 { (((x - begin) / width).max(0.0) as usize).min(count - 1) } else { 0 }
}

/// Weights of a component from the displacement of a point `arm` away from an element's axis or surface.
fn of(
    component: Component,
    arm: [f64; 3],
    displacement: impl Fn([f64; 3], [f64; 3]) -> ttb_elements::Weights,
) -> ttb_elements::Weights {
    match component {
        // How far the point lies above or below does not count here.
        Component::Vertical => displacement(DOWN, [0.0, arm[1], 0.0]),
        Component::Lateral => displacement(RIGHT, [0.0, 0.0, arm[2]]),
        // u_z of a point 1 m to the right less that on the axis.
        Component::Roll => {
            let mut weights = displacement(DOWN, RIGHT);
            weights.extend(displacement(DOWN, [0.0; 3]).into_iter().map(|(place, weight)| (place, -weight)));
            weights
        }
    }
}

/// From an element's places to motions of the model.
fn in_model(nodes: &[usize], weights: ttb_elements::Weights) -> Weights {
    weights.into_iter().map(|(place, weight)| (motion(nodes[place / 6], Freedom::ALL[place % 6]), weight)).collect()
}
