//! What the lines of a track need besides trains: matrices and factors for each step size.

use std::sync::{Arc, Mutex, PoisonError};

use ttb_dynamics::newmark::Newmark;
use ttb_scenario::spec::{SpaceContact, SpaceSpec, SpaceTrack, TrainTrackSpec};
use ttb_scenario::types::Creep;
use ttb_wheel_rail::geometry::Geometry;

use super::line::Line;
use super::point::LineFactors;
use super::rails::lines;
use super::spec::geometry;
use crate::track::FastenerFactors;

/// Step sizes kept factorised; the oldest but the first goes when another comes.
const STEP_SIZES: usize = 8;

/// The lines of a track, ready for trains.
#[derive(Debug)]
pub struct Lines {
    /// Each with the rail ports that its own are.
    pub lines: Vec<(Line, Vec<usize>)>,
    /// At rest.
    pub statics: Vec<LineFactors>,
    /// Distance of wheel and rail.
    pub geometry: Geometry,
    /// Whether points inside elements have their local compliance.
    pub local: bool,
    source: (SpaceTrack, SpaceContact),
    steps: Mutex<Vec<(Newmark, Arc<Vec<LineFactors>>)>>,
}

fn factors(lines: &[(Line, Vec<usize>)], mass: f64, damping: f64) -> Result<Vec<LineFactors>, String> {
    let of = |(line, _): &(Line, Vec<usize>)| {
        LineFactors::new(line, mass, damping).map_err(|e| format!("the track's lateral motion: {e}"))
    };
    lines.iter().map(of).collect()
}

/// The contact without what its table does not depend on.
fn same_table(contact: &SpaceContact) -> SpaceContact {
    SpaceContact { friction: 0.0, creep: Creep::None, hertz_constant: None, ..contact.clone() }
}

impl Lines {
    /// Numbers and factorises for rest.
    ///
    /// # Errors
    /// A matrix that is not positive definite, as a message.
    pub fn new(spec: &TrainTrackSpec, space: &SpaceSpec, fasteners: FastenerFactors) -> Result<Self, String> {
        let lines = lines(spec, &space.track, fasteners);
        let statics = factors(&lines, 0.0, 0.0)?;
        Ok(Self {
            lines,
            statics,
            geometry: geometry(&space.contact, &space.track)?,
            local: spec.local_compliance,
            source: (space.track.clone(), same_table(&space.contact)),
            steps: Mutex::default(),
        })
    }

    /// Whether they were made of this.
    pub fn fits(&self, space: &SpaceSpec) -> bool {
        self.source.0 == space.track && self.source.1 == same_table(&space.contact)
    }

    /// The factors of exactly this step size, made where nobody has asked for it before.
    ///
    /// # Errors
    /// As [`Lines::new`].
    pub fn factors(&self, newmark: &Newmark) -> Result<Arc<Vec<LineFactors>>, String> {
        let mut steps = self.steps.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((_, known)) = steps.iter().find(|(known, _)| known == newmark) {
            return Ok(Arc::clone(known));
        }
        let made = Arc::new(factors(&self.lines, newmark.a[0], newmark.a[1])?);
        if steps.len() == STEP_SIZES {
            steps.remove(1);
        }
        steps.push((*newmark, Arc::clone(&made)));
        Ok(made)
    }
}
