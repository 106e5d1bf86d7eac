//! What static load models do to a bridge.

use crate::peak::Peak;

/// Effects of one static load model wherever it acts worst, without any factor.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LoadCase {
    /// For people: `LM71`.
    pub name: String,
    /// Greatest (`max`) and least (`min`) displacements, moments, shears along the deck, reactions, rotations of ends.
    pub rows: Vec<Peak>,
}

/// All load models, or why there are none.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Statics {
    /// Load models; LM71 first.
    pub cases: Vec<LoadCase>,
    /// Why there are none.
    pub reason: Option<String>,
}
