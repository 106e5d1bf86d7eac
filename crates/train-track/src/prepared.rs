//! What a track needs besides trains: matrices, factors for each step size and compliance tables. They know neither train
//! nor speed nor time, so that any number of runs over the same track, also in several threads, share one.

use std::sync::{Arc, Mutex, PoisonError};

use ttb_dynamics::band::BandFactor;
use ttb_dynamics::newmark::Newmark;
use ttb_dynamics::twisted::TwistedFactor;
use ttb_scenario::spec::TrainTrackSpec;
use ttb_scenario::types::TrackType;

use crate::compliance::RailCompliance;
use crate::space::prepared::Lines;
use crate::track::{FastenerFactors, Track};

/// Step sizes kept factorised; the oldest but the first goes when another comes.
const STEP_SIZES: usize = 8;

/// A track, ready for trains.
#[derive(Debug)]
pub struct Prepared {
    /// Numbering and matrices.
    pub track: Track,
    /// K_t, for rest.
    pub statics: BandFactor,
    /// What it has in space.
    pub lines: Option<Arc<Lines>>,
    /// What all of it follows from.
    source: Source,
    steps: Mutex<Vec<(Newmark, Arc<TrackFactors>)>>,
}

/// The track of one step size.
#[derive(Debug)]
pub struct TrackFactors {
    /// K̂_t.
    pub factor: TwistedFactor,
    /// Its inverse, as far as wheels and supports feel it.
    pub compliance: RailCompliance,
}

/// All of a specification and of the parameters that a track follows from.
#[derive(Clone, Debug, PartialEq)]
struct Source {
    track: TrackType,
    from: f64,
    bays: usize,
    elements_per_bay: usize,
    local_compliance: bool,
    on_bridge: Vec<usize>,
    fasteners: FastenerFactors,
}

impl Source {
    fn of(spec: &TrainTrackSpec, fasteners: FastenerFactors) -> Self {
        Self {
            track: spec.track.clone(),
            from: spec.from,
            bays: spec.bays,
            elements_per_bay: spec.elements_per_bay,
            local_compliance: spec.local_compliance,
            on_bridge: spec.on_bridge.clone(),
            fasteners,
        }
    }
}

impl Prepared {
    /// The track of a specification, factorised for its step.
    ///
    /// # Errors
    /// A matrix that is not positive definite, as a message.
    pub fn new(spec: &TrainTrackSpec) -> Result<Self, String> {
        let prepared = Self::with(spec, FastenerFactors::default())?;
        let step = spec.step / spec.substeps as f64;
        let newmark = Newmark::new(spec.newmark.gamma, spec.newmark.beta, step);
        prepared.factors(&newmark)?;
        if let Some(lines) = &prepared.lines {
            lines.factors(&newmark)?;
        }
        Ok(prepared)
    }

    /// The same with other fasteners, factorised for rest only.
    ///
    /// # Errors
    /// As [`Prepared::new`].
    pub fn with(spec: &TrainTrackSpec, fasteners: FastenerFactors) -> Result<Self, String> {
        let track = Track::new(spec, fasteners);
        let statics = track.effective(0.0, 0.0).factorise().map_err(|e| format!("track at rest: {e}"))?;
        let lines = spec.space.as_ref().map(|space| Lines::new(spec, space, fasteners).map(Arc::new)).transpose()?;
        Ok(Self { track, statics, lines, source: Source::of(spec, fasteners), steps: Mutex::default() })
    }

    /// Whether this is the track of a specification with these fasteners; cars, speed, irregularity and time do not count.
    pub fn fits(&self, spec: &TrainTrackSpec, fasteners: FastenerFactors) -> bool {
        let lines = match (&self.lines, &spec.space) {
            (None, None) => true,
            (Some(lines), Some(space)) => lines.fits(space),
            _ => false,
        };
        lines && self.source == Source::of(spec, fasteners)
    }

    /// The factors of exactly this step size, made where nobody has asked for it before.
    ///
    /// # Errors
    /// As [`Prepared::new`].
    pub fn factors(&self, newmark: &Newmark) -> Result<Arc<TrackFactors>, String> {
        // Held while factorising: whoever asks for the same step meanwhile needs the result anyway.
        let mut steps = self.steps.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((_, factors)) = steps.iter().find(|(known, _)| known == newmark) {
            return Ok(Arc::clone(factors));
        }
        let effective = self.track.effective(newmark.a[0], newmark.a[1]);
        let not_held = |e| format!("track: {e}");
        let compliance = RailCompliance::new(&self.track, &effective.clone().factorise().map_err(not_held)?);
        let factors = Arc::new(TrackFactors { factor: TwistedFactor::new(effective).map_err(not_held)?, compliance });
        if steps.len() == STEP_SIZES {
            steps.remove(1);
        }
        steps.push((*newmark, Arc::clone(&factors)));
        Ok(factors)
    }
}
