//! The project's own bridges for the way of one axle: in all degrees of freedom, with dashpots.

use std::sync::Arc;

use ttb_bridge::{Bridge, Prepared};
use ttb_contract::names::support;
use ttb_contract::{InProcess, Instance, Model, ModelError, Ports};
use ttb_scenario::deck::Deck;
use ttb_scenario::spec::{BridgeSpec, StructureSpec};
use ttb_scenario::types::{Direction, Point};

use crate::one_axle::Path;
use crate::source::stations;

/// Distance of the stations where the axle acts at most, m.
const STATIONS: f64 = 0.5;
/// Names of deck points among those of the scenario.
const DECK: &str = "ttb-deck-";

/// A bridge that is prepared once for unit axles at many speeds.
pub struct OwnBridge {
    prepared: Arc<Prepared>,
    path: Path,
    supports: usize,
}

impl OwnBridge {
    /// Of a specification, in steps of `step` s; its own supports and end do not matter. Deck points are 20 parts a span.
    ///
    /// # Errors
    /// Anything in it that cannot be.
    pub fn new(spec: &BridgeSpec, step: f64) -> Result<Self, ModelError> {
        let deck =
            Deck::new(&spec.structure).ok_or_else(|| ModelError("bridge: a stored bridge has no path".into()))?;
        let ends = [&[0.0], &deck.inner_bearings[..], &[deck.length]].concat();
        let spans: Vec<[f64; 2]> = ends.windows(2).map(|pair| [pair[0], pair[1]]).collect();
        let mut spec = BridgeSpec { step, space: false, ground: None, ..spec.clone() };
        let mut named = Vec::new();
        let plane = matches!(spec.structure, StructureSpec::Beams { .. } | StructureSpec::Frame(_));
        spec.supports = match &spec.structure {
            StructureSpec::Matrices { files, folder, length } => {
                let read = files.read(folder).map_err(|problems| ModelError(problems.to_string()))?;
                let inside = |x: &f64| *x > 0.0 && *x < *length;
                read.supports.iter().map(|(x, _)| *x).filter(inside).collect()
            }
            _ => {
                let mut all = stations(&spans, |length| 20.max((length / STATIONS).ceil() as usize));
                // On bearings and at the deck's ends a force reaches the ground.
                all.retain(|x| !plane || ends.iter().all(|end| (x - end).abs() > 1e-6));
                all
            }
        };
        if !matches!(spec.structure, StructureSpec::Matrices { .. }) {
            for (i, x) in stations(&spans, |length| 20.max((length / 2.5).ceil() as usize)).into_iter().enumerate() {
                let name = format!("{DECK}{i}");
                spec.points.push(Point { name: name.clone(), x: Some(x), node: None, direction: Direction::Z });
                named.push((name, x));
            }
        }
        let ports = Ports::vertical(spec.supports.len(), 1e5);
        let inner: &[f64] = if plane { &deck.inner_bearings } else { &[] };
        let path =
            Path::new(&ports, &spec.supports, deck.length, inner).map_err(|failure| ModelError(failure.message))?;
        let path = if named.is_empty() { path } else { path.with_deck_points(named) };
        Ok(Self { supports: spec.supports.len(), prepared: Prepared::new(&spec)?, path })
    }

    /// Where its axles run.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// A bridge at rest, in initialization mode.
    ///
    /// # Errors
    /// It cannot be initialized.
    pub fn at_rest(&self) -> Result<InProcess<Bridge>, ModelError> {
        let bridge = Bridge::from_prepared(&self.prepared)?;
        let find = |quantity: &str| -> Result<Vec<u32>, ModelError> {
            let names = (1..=self.supports).map(|number| support(number, quantity));
            let reference = |name: String| {
                let found = bridge.interface().find(&name);
                found.map(|r| r as u32).ok_or_else(|| ModelError(format!("the bridge has no variable {name}")))
            };
            names.map(reference).collect()
        };
        let inputs = find("force")?;
        let outputs = [find("displacement")?, find("velocity")?].concat();
        let mut instance = Instance::new(bridge);
        instance.enter_initialization(0.0)?;
        Ok(InProcess::new("Bridge", instance, inputs, outputs))
    }
}
