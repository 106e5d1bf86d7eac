//! What a picture of a run has to know of it beside the columns: where the deck is, and which points move otherwise.

use std::collections::BTreeMap;

use ttb_scenario::Checked;
use ttb_scenario::deck::Deck;
use ttb_scenario::types::Direction;
use ttb_session::Of;

/// Deck and points of a run; of a system structure nothing is known.
#[derive(Clone, Debug, Default)]
pub struct Scene {
    /// Where the deck begins and ends on the track, m.
    pub deck: Option<[f64; 2]>,
    /// Names of points that are given by a node, not by a place on the deck, and the direction of their motion.
    nodes: BTreeMap<String, &'static str>,
}

impl Scene {
    /// Of a scenario.
    pub fn new(checked: &Checked) -> Self {
        let begin = checked.scenario.bridge.at;
        let direction = |direction| match direction {
            Direction::X => "(along)",
            Direction::Y => "(right)",
            Direction::Z => "(down)",
        };
        let nodes = checked.bridge.points.iter().filter(|point| point.node.is_some());
        Self {
            deck: Deck::new(&checked.bridge.structure).map(|deck| [begin, begin + deck.length]),
            nodes: nodes.map(|point| (point.name.clone(), direction(point.direction))).collect(),
        }
    }

    /// The direction of a point that is no vertical point of the deck.
    pub fn direction(&self, of: &Of) -> Option<&'static str> {
        let Of::Point(name) = of else { return None };
        self.nodes.get(name).copied()
    }
}
