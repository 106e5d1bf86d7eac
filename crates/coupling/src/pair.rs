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
    /// motions in that of the train–track side's. `sent` names the output that feeds an input of the bridge, where that is
    /// another.
    ///
    /// # Errors
    /// A model cannot be initialized.
    pub fn new(train_track: T, bridge: B, sent: impl Fn(&str) -> String) -> Result<Self, ModelError> {
        let (t, b) = (train_track.interface(), bridge.interface());
        let coupled = (b.inputs().len(), t.inputs().len());
        let own = |of: &Interface| of.inputs().map(|r| r as u32).collect::<Vec<u32>>();
        let references = |of: &Interface, names: Vec<String>| -> Vec<u32> {
            names.iter().filter_map(|name| of.find(name)).map(|r| r as u32).collect()
        };
        let inputs = |of: &Interface, to: &dyn Fn(&str) -> String| -> Vec<String> {
            of.inputs().map(|r| to(&of.variables()[r].name)).collect()
        };
        let forces = references(t, inputs(b, &sent));
        let motions = references(b, inputs(t, &str::to_string));
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
