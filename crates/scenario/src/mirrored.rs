//! A rail as a train meets it that runs against the bridge's abscissa.
//!
//! ```text
//! r′(x) = r(2c − x)
//! sin(2π(2c − x − o)/λ + φ) = sin(2π(x − o′)/λ + φ′)        o′ = 2c − o,  φ′ = π − φ
//! ```

use std::f64::consts::PI;

use crate::spec::Profile;
use crate::types::Wave;

impl Profile {
    /// Mirrored about `c`, m. A random rail stays as it is: its phases have no direction. A ramp stays, too: it begins before
    /// the train, wherever that comes from.
    #[must_use]
    pub(crate) fn mirrored(self, c: f64) -> Self {
        match self {
            Self::None | Self::Spectrum { .. } => self,
            Self::Waves { waves, origin, ramp } => {
                let turned = |wave: Wave| Wave { phase: PI - wave.phase, ..wave };
                Self::Waves { waves: waves.into_iter().map(turned).collect(), origin: 2.0 * c - origin, ramp }
            }
            Self::Samples { x, r, ramp } => {
                let x = x.iter().rev().map(|x| 2.0 * c - x).collect();
                Self::Samples { x, r: r.into_iter().rev().collect(), ramp }
            }
        }
    }
}
