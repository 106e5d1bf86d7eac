//! How much a computation may take, so that a page ends with a message and not with its tab.
//!
//! ```text
//! histories of a run    8 B × steps × columns          columns: 3 a point, 2 a wheelset, 2 a car
//! track                 8 B × 40 × nodes of the rail × 2
//! records               RECORD × runs
//! ```

use ttb_campaign::expand::Expanded;
use ttb_campaign::points::deck_points;
use ttb_scenario::Checked;
use ttb_scenario::spec::StructureSpec;

use crate::fault::Fault;

/// Bytes of a record with its envelopes.
const RECORD: f64 = 16e3;
/// Entries of a row of the track's band.
const BAND: f64 = 40.0;

/// What there is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Room {
    /// Bytes that one computation may take.
    pub bytes: f64,
    /// Nodes of a finite-element model.
    pub nodes: usize,
}

impl Room {
    /// Of a page: WebAssembly has 4 GB of addresses, and several workers share the machine.
    pub const PAGE: Self = Self { bytes: 1e9, nodes: 20_000 };
    /// Of a program.
    pub const PROGRAM: Self = Self { bytes: 64e9, nodes: usize::MAX };

    /// Whether a scenario has room.
    ///
    /// # Errors
    /// It has not: what takes how much, and what to do.
    pub fn scenario(&self, checked: &Checked) -> Result<(), Fault> {
        if let StructureSpec::FiniteElements(model) = &checked.bridge.structure
            && model.nodes.len() > self.nodes
        {
            let (nodes, most) = (model.nodes.len(), self.nodes);
            return Err(Fault::new(format!(
                "bridge.structure.model: a page takes finite-element models of at most {most} nodes: {nodes}; `ttb ui` takes larger ones"
            )));
        }
        let spec = &checked.train_track;
        let track = 8.0 * BAND * 2.0 * spec.bays as f64 * spec.elements_per_bay as f64;
        let steps = checked.bridge.end / checked.bridge.step;
        let points = checked.bridge.points.len() + deck_points(&checked.bridge.structure).len();
        let columns = 3 * points + 2 * spec.axle_count() + 2 * spec.consist().len();
        self.holds("the track", track, "shorten track.bays")?;
        self.holds("the histories of a run", 8.0 * steps * columns as f64, "take longer steps or a shorter run")
    }

    /// Whether the records of a plan have room.
    ///
    /// # Errors
    /// As [`Self::scenario`].
    pub fn plan(&self, expanded: &Expanded) -> Result<(), Fault> {
        let plan = &expanded.plan;
        let speeds = plan.speeds_km_h.len().max(1);
        let runs = speeds as f64 * plan.trains.len() as f64 * plan.variants.len() as f64 * plan.rails.len() as f64;
        self.holds("the results of all runs", RECORD * runs, "ask for fewer trains and speeds")
    }

    fn holds(&self, what: &str, bytes: f64, instead: &str) -> Result<(), Fault> {
        if bytes <= self.bytes {
            return Ok(());
        }
        let [bytes, most] = [bytes, self.bytes].map(|bytes| 1e-9 * bytes);
        Err(Fault::new(format!("{what} would take {bytes:.1} GB of memory, there is room for {most:.1} GB: {instead}")))
    }
}
