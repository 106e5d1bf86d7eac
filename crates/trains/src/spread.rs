//! An axle load spread over sleepers.
//!
//! ```text
//! three    P/4 at −a, P/2 at 0, P/4 at +a          over three sleepers at the distance a (EN 1991-2, 6.3.6.1)
//! two      P/2 at −a/2 and +a/2
//! triangle p(s) = (2P/W) (1 − 2|s|/W), |s| ≤ W/2   by equal steps of W/2n that keep the sum and the first moment
//! ```
//!
//! The parts run with the axle.

use crate::train::{Axle, ForceTrain};

/// How an axle load reaches the deck.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Spread {
    /// At one point.
    #[default]
    None,
    /// 25, 50 and 25 % over three sleepers.
    Three {
        /// Distance of the sleepers, m.
        spacing: f64,
    },
    /// Half over each of two sleepers.
    Two {
        /// Distance of the sleepers, m.
        spacing: f64,
    },
    /// A triangle.
    Triangle {
        /// Its width W, m.
        width: f64,
    },
}

/// Steps of half a triangle.
const STEPS: i32 = 8;

impl Spread {
    /// Distances from the axle, m, and shares, whose sum is 1.
    #[must_use]
    pub fn parts(self) -> Vec<[f64; 2]> {
        match self {
            Self::None => vec![[0.0, 1.0]],
            Self::Three { spacing } => vec![[-spacing, 0.25], [0.0, 0.5], [spacing, 0.25]],
            Self::Two { spacing } => vec![[-0.5 * spacing, 0.5], [0.5 * spacing, 0.5]],
            Self::Triangle { width } => {
                let n = f64::from(STEPS);
                let part = |i: i32| [0.5 * width * f64::from(i) / n, (n - f64::from(i.abs())) / (n * n)];
                (1 - STEPS..STEPS).map(part).collect()
            }
        }
    }

    /// The train with its loads spread; x counts from the first part.
    #[must_use]
    pub fn of(self, train: &ForceTrain) -> ForceTrain {
        let parts = self.parts();
        let spread = |axle: &Axle| {
            let axle = *axle;
            parts.clone().into_iter().map(move |[s, share]| Axle { x: axle.x + s, load: share * axle.load })
        };
        let mut axles: Vec<Axle> = train.axles.iter().flat_map(spread).collect();
        axles.sort_by(|a, b| a.x.total_cmp(&b.x));
        let first = axles.first().map_or(0.0, |axle| axle.x);
        axles.iter_mut().for_each(|axle| axle.x -= first);
        ForceTrain { axles, ..train.clone() }
    }
}
