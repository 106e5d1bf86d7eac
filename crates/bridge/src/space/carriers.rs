//! Which shells, beams or nodes may carry the track, and how far each reaches in plan.

use std::collections::HashSet;

use ttb_contract::ModelError;
use ttb_scenario::space::Index;
use ttb_scenario::types::{Beams, DeckCarrier, Model};

use super::elements::coordinates;
use super::freedoms::position;

/// In an element's own coordinates, or m: on its edge.
pub(super) const EDGE: f64 = 1e-6;
/// A beam that leads along the track by less than this of its length does not carry it.
const ACROSS: f64 = 0.1;

/// An element or a node that may carry the track.
pub(super) struct Carrier<'a> {
    /// Positions of its nodes.
    pub nodes: Vec<usize>,
    pub of: Of<'a>,
    /// Extent in plan, m.
    pub x: [f64; 2],
    pub y: [f64; 2],
}

/// What a carrier is; a shell knows its section.
pub(super) enum Of<'a> {
    Shell(&'a str),
    Beam(&'a Beams),
    Node,
}

/// What carries the track, and what that is called.
pub(super) fn carriers<'a>(model: &'a Model, index: &Index) -> Result<(Vec<Carrier<'a>>, &'static str), ModelError> {
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
    Ok((carriers, what))
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
pub(super) fn axis(model: &Model, list: &Beams, nodes: [usize; 2]) -> [[f64; 3]; 2] {
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
