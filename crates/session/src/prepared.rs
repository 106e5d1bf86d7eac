//! Both sides of cases without time, speed and train: prepared once, shared by runs.

use std::sync::Arc;

use ttb_contract::{ModelError, Prepare};
use ttb_scenario::Checked;
use ttb_scenario::spec::{BridgeSpec, TrainTrackSpec};

use crate::case::Case;
use crate::sides::Sides;

/// A track and a bridge, ready for runs that differ in train, speed, irregularity, step or end. A clone shares both: a thread
/// that runs has one of its own.
pub struct Prepared<T, B> {
    track: Arc<T>,
    bridge: Arc<B>,
}

impl<T, B> Clone for Prepared<T, B> {
    fn clone(&self) -> Self {
        Self { track: Arc::clone(&self.track), bridge: Arc::clone(&self.bridge) }
    }
}

impl<T: Prepare<Spec = TrainTrackSpec>, B: Prepare<Spec = BridgeSpec>> Prepared<T, B> {
    /// Of a scenario.
    ///
    /// # Errors
    /// Something in it cannot be built.
    pub fn new(checked: &Checked) -> Result<Self, ModelError> {
        Ok(Self { track: T::prepare(&checked.train_track)?, bridge: B::prepare(&checked.bridge)? })
    }

    /// Whether bridge and track serve a scenario as they are. A track costs little; a bridge may cost minutes.
    pub fn serves(&self, checked: &Checked) -> [bool; 2] {
        [self.bridge.serves(&checked.bridge), self.track.serves(&checked.train_track)]
    }

    /// Both sides of a scenario in initialization mode. A side that its track or bridge does not serve is prepared anew,
    /// and kept for the runs to come.
    ///
    /// # Errors
    /// Something in it cannot be built or initialized.
    pub fn sides(&mut self, checked: &Checked) -> Result<Sides<T::Model, B::Model>, ModelError> {
        if !self.track.serves(&checked.train_track) {
            self.track = T::prepare(&checked.train_track)?;
        }
        if !self.bridge.serves(&checked.bridge) {
            self.bridge = B::prepare(&checked.bridge)?;
        }
        let (train_track, bridge) = (self.track.model(&checked.train_track)?, self.bridge.model(&checked.bridge)?);
        Sides::new(train_track, bridge, &Case::of(checked))
    }

    /// The bridge.
    pub fn bridge(&self) -> &Arc<B> {
        &self.bridge
    }
}
