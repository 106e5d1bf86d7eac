//! The track's way over the model: from a station x to weights on the motions of nodes.
//!
//! ```text
//! shells   u(x) = Σ_j N_j(ξ, η) z_j                     in the shell over or under (x, y)
//! beams    u(x) = w(ξ) + r_x(ξ) (y − y_axis)            on the beam at x nearest to y
//! nodes    u(x) = z_j + r_x,j (y − y_j) − r_y,j (x − x_j)     at the node nearest along x, then along y
//! ```
//!
//! The same weights distribute a force, so that its power enters the model and an eccentric track twists the deck.

use std::collections::HashSet;

use ttb_coupling::ModelError;
use ttb_scenario::space::{Index, motion};
use ttb_scenario::types::{DeckCarrier, Freedom, Model};

use super::elements::{Kind, coordinates};
use super::freedoms::{Weights, position};
use super::solids::{self, Sections};

/// Down.
const DOWN: [f64; 3] = [0.0, 0.0, 1.0];
/// In an element's own coordinates, or m: on its edge.
const EDGE: f64 = 1e-6;
/// A beam that leads along the track by less than this of its length does not carry it.
const ACROSS: f64 = 0.1;

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

/// An element or a node that may carry the track.
struct Carrier<'a> {
    nodes: Vec<usize>,
    of: Of<'a>,
    /// Extent in plan, m.
    x: [f64; 2],
    y: [f64; 2],
}

enum Of<'a> {
    Shell(&'a str),
    Beam(&'a ttb_scenario::types::Beams),
    Node,
}

impl<'a> Track<'a> {
    pub fn new(model: &'a Model, index: &Index) -> Result<Self, ModelError> {
        let (mut carriers, what) = match &model.deck.on {
            DeckCarrier::Shells(names) => (shells(model, index, names)?, "shell"),
            DeckCarrier::Beams(names) => (beams(model, index, names)?, "beam"),
            DeckCarrier::Nodes(numbers) => (nodes(model, index, numbers)?, "node"),
        };
        if carriers.is_empty() {
            return Err(ModelError(format!("bridge: no {what} of the model carries the track")));
        }
        if what == "node" {
            spread(&mut carriers);
        }
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

    /// Weights of the displacement down at station x.
    pub fn at(&self, x: f64, asked: &str) -> Result<Weights, ModelError> {
        let strip = &self.strips[strip(x, self.begin, self.width, self.strips.len())];
        let over = strip.iter().map(|number| &self.carriers[*number as usize]);
        let here: Vec<&Carrier> = over.filter(|c| x >= c.x[0] - EDGE && x <= c.x[1] + EDGE).collect();
        let found = match self.what {
            "shell" => self.on_shell(x, &here),
            "beam" => self.on_beam(x, &here),
            _ => self.on_node(x, &here),
        };
        found?.ok_or_else(|| self.off(x, asked, &here))
    }

    /// The highest of the shells over or under the track.
    fn on_shell(&self, x: f64, here: &[&Carrier]) -> Result<Option<Weights>, ModelError> {
        let y = self.model.deck.y;
        let mut best: Option<(f64, Weights)> = None;
        for carrier in here.iter().filter(|c| y >= c.y[0] - EDGE && y <= c.y[1] + EDGE) {
            let Of::Shell(section) = carrier.of else { continue };
            let corners: Vec<[f64; 3]> = carrier.nodes.iter().map(|node| coordinates(self.model, *node)).collect();
            let kind = self.sections.plate(section).and_then(|plate| solids::shell(&corners, plate));
            let found = match kind.map_err(|why| ModelError(format!("bridge: shell of section {section}: {why}")))? {
                Kind::Shell4(shell) => shell.contains_in_plan(x, y, EDGE).map(|place| {
                    let weights = shell.interpolate(place, DOWN, [0.0; 3]);
                    (shell.point(place)[2], weights)
                }),
                Kind::Shell3(shell) => shell.contains_in_plan(x, y, EDGE).map(|place| {
                    let weights = shell.interpolate(place, DOWN, [0.0; 3]);
                    (shell.point(place)[2], weights)
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
    fn on_beam(&self, x: f64, here: &[&Carrier]) -> Result<Option<Weights>, ModelError> {
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
                let weights = beam.interpolate(xi, DOWN, [0.0, arm, 0.0]);
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
    fn on_node(&self, x: f64, here: &[&Carrier]) -> Result<Option<Weights>, ModelError> {
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
            let [from_x, from_y, _] = coordinates(self.model, node);
            let arm = [x - from_x, y - from_y];
            vec![
                (motion(node, Freedom::Z), 1.0),
                (motion(node, Freedom::Rx), arm[1]),
                (motion(node, Freedom::Ry), -arm[0]),
            ]
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

/// From an element's places to motions of the model.
fn in_model(nodes: &[usize], weights: ttb_elements::Weights) -> Weights {
    weights.into_iter().map(|(place, weight)| (motion(nodes[place / 6], Freedom::ALL[place % 6]), weight)).collect()
}

fn range(values: impl Iterator<Item = f64>) -> [f64; 2] {
    values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], value| [low.min(value), high.max(value)])
}

fn shells<'a>(model: &'a Model, index: &Index, names: &[String]) -> Result<Vec<Carrier<'a>>, ModelError> {
    let mut carriers = Vec::new();
    for list in model.shells.iter().filter(|list| names.contains(&list.section)) {
        for element in &list.elements {
            let nodes: Vec<usize> =
                element.iter().map(|number| position(index, *number, "shells")).collect::<Result<_, _>>()?;
            let [x, y] = [0, 1].map(|axis| range(nodes.iter().map(|node| coordinates(model, *node)[axis])));
            carriers.push(Carrier { nodes, of: Of::Shell(&list.section), x, y });
        }
    }
    Ok(carriers)
}

fn beams<'a>(model: &'a Model, index: &Index, names: &[String]) -> Result<Vec<Carrier<'a>>, ModelError> {
    let mut carriers = Vec::new();
    for list in model.beams.iter().filter(|list| names.contains(&list.section)) {
        for element in &list.elements {
            let [first, last] = element.map(|number| position(index, number, "beams"));
            let nodes = [first?, last?];
            let [a, b] = axis(model, list, nodes);
            let length = (b[0] - a[0]).hypot(b[1] - a[1]).hypot(b[2] - a[2]);
            if (b[0] - a[0]).abs() > ACROSS * length {
                let [x, y] = [0, 1].map(|axis| range([a[axis], b[axis]].into_iter()));
                carriers.push(Carrier { nodes: nodes.to_vec(), of: Of::Beam(list), x, y });
            }
        }
    }
    Ok(carriers)
}

/// Ends of a beam's axis.
fn axis(model: &Model, list: &ttb_scenario::types::Beams, nodes: [usize; 2]) -> [[f64; 3]; 2] {
    let arms = list.offsets.unwrap_or_default();
    [0, 1].map(|end| {
        let node = coordinates(model, nodes[end]);
        [0, 1, 2].map(|axis| node[axis] + arms[end][axis])
    })
}

fn nodes<'a>(model: &'a Model, index: &Index, numbers: &[u32]) -> Result<Vec<Carrier<'a>>, ModelError> {
    let positions: Vec<usize> = if numbers.is_empty() {
        (0..model.nodes.len()).collect()
    } else {
        let named = numbers.iter().map(|number| position(index, *number, "deck.on.nodes"));
        named.collect::<Result<_, _>>()?
    };
    let mut seen = HashSet::new();
    let once = positions.into_iter().filter(|node| seen.insert(*node));
    let carrier = |node| {
        let [x, y, _] = coordinates(model, node);
        Carrier { nodes: vec![node], of: Of::Node, x: [x; 2], y: [y; 2] }
    };
    Ok(once.map(carrier).collect())
}

/// Every node carries halfway to the next one along x, the outermost half of the greatest gap outwards.
fn spread(carriers: &mut [Carrier]) {
    carriers.sort_by(|a, b| a.x[0].total_cmp(&b.x[0]));
    let mut places: Vec<f64> = carriers.iter().map(|carrier| carrier.x[0]).collect();
    places.dedup_by(|b, a| *b - *a <= EDGE);
    let outwards = 0.5 * places.windows(2).map(|pair| pair[1] - pair[0]).fold(2.0 * EDGE, f64::max);
    for carrier in carriers {
        let x = carrier.x[0];
        let next = places.partition_point(|place| *place < x - EDGE);
        let before = next.checked_sub(1).map_or(x - outwards, |i| 0.5 * (places[i] + x));
        let after = places[next..].iter().find(|place| **place > x + EDGE).map_or(x + outwards, |p| 0.5 * (p + x));
        carrier.x = [before, after];
    }
}
