//! The six motions of a node.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A direction of a node's motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Freedom {
    /// Along the track.
    X,
    /// To the right.
    Y,
    /// Down.
    Z,
    /// Rotation about x.
    Rx,
    /// Rotation about y.
    Ry,
    /// Rotation about z.
    Rz,
}

impl Freedom {
    /// All six, in order.
    pub const ALL: [Self; 6] = [Self::X, Self::Y, Self::Z, Self::Rx, Self::Ry, Self::Rz];

    /// Its position among the six.
    #[must_use]
    pub fn index(self) -> usize {
        self as usize
    }

    /// As the file writes it.
    #[must_use]
    pub fn name(self) -> &'static str {
        ["x", "y", "z", "rx", "ry", "rz"][self.index()]
    }

    /// In words, for messages.
    #[must_use]
    pub fn describe(self) -> &'static str {
        [
            "displacement along x",
            "displacement along y",
            "displacement along z",
            "rotation about x",
            "rotation about y",
            "rotation about z",
        ][self.index()]
    }
}
