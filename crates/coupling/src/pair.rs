//! Two models of this process, coupled by equal names.

use crate::in_process::InProcess;
use crate::instance::Instance;
use crate::interface::Interface;
use crate::model::{Model, ModelError};

/// Both in initialization mode, and the numbers of coupled forces and motions.
pub struct Pair<T: Model, B: Model> {
    /// The train–track side.
    pub train_track: InProcess<T>,
    /// The bridge.
    pub bridge: InProcess<B>,
    /// Inputs of the bridge, inputs of the train–track side.
    pub coupled: (usize, usize),
}

impl<T: Model, B: Model> Pair<T, B> {
    /// Connects every input of either to the output of equal name of the other: forces in the order of the bridge's inputs,
    /// motions in that of the train–track side's.
    ///
    /// # Errors
    /// A model cannot be initialized.
    pub fn new(train_track: T, bridge: B) -> Result<Self, ModelError> {
        let (t, b) = (train_track.interface(), bridge.interface());
        let coupled = (b.inputs().len(), t.inputs().len());
        let own = |of: &Interface| of.inputs().map(|r| r as u32).collect::<Vec<u32>>();
        let wanted = |of: &Interface, from: &Interface| -> Vec<u32> {
            let names = of.inputs().map(|r| &of.variables()[r].name);
            names.filter_map(|name| from.find(name)).map(|r| r as u32).collect()
        };
        let (forces, motions) = (wanted(b, t), wanted(t, b));
        let (into_t, into_b) = (own(t), own(b));
        let (mut t, mut b) = (Instance::new(train_track), Instance::new(bridge));
        t.enter_initialization(0.0)?;
        b.enter_initialization(0.0)?;
        Ok(Self {
            train_track: InProcess::new("TrainTrack", t, into_t, forces),
            bridge: InProcess::new("Bridge", b, into_b, motions),
            coupled,
        })
    }
}
