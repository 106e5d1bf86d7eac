//! The high-speed load models of EN 1991-2, 6.4.6.1.1.
//!
//! ```text
//! HSLM-A   power car 0, 3, 14, 17; end coach 20.525 and 20.525 + d; articulated bogies c₀ + iD ± d/2, i = 1 … N + 1,
//!          c₀ = 17 + 3.525/2; the rear is the mirrored front; length c₀ + (N + 2)D + 3.525/2 + 17
//! HSLM-B   N forces of 170 kN at the distance d
//! ```

use serde::Deserialize;

use crate::train::{Axle, ForceTrain};

/// The numbers of a train of HSLM-A.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct HslmA {
    /// Number of intermediate coaches N.
    pub coaches: usize,
    /// Length of a coach D, m.
    pub coach: f64,
    /// Distance of a bogie's axles d, m.
    pub wheelbase: f64,
    /// Load of every axle P, kN.
    pub load: f64,
}

impl HslmA {
    /// Its 2N + 14 axles.
    #[must_use]
    pub fn axles(&self) -> Vec<Axle> {
        let (coach, d) = (self.coach, self.wheelbase);
        let c0 = 17.0 + 0.5 * 3.525;
        let length = c0 + (self.coaches + 2) as f64 * coach + 0.5 * 3.525 + 17.0;
        let front = [0.0, 3.0, 14.0, 17.0, 20.525, 20.525 + d];
        let bogies = (1..=self.coaches + 1).map(|i| c0 + i as f64 * coach);
        let bogies = bogies.flat_map(|centre| [centre - 0.5 * d, centre + 0.5 * d]);
        let rear = front.iter().rev().map(|x| length - x);
        let places = front.iter().copied().chain(bogies).chain(rear);
        places.map(|x| Axle { x, load: 1e3 * self.load }).collect()
    }
}

/// Load of every axle of HSLM-B, N.
const LOAD_B: f64 = 170e3;

/// HSLM-B of `count` forces at the distance `spacing`, m.
#[must_use]
pub fn hslm_b(count: usize, spacing: f64) -> ForceTrain {
    let axles = (0..count).map(|i| Axle { x: i as f64 * spacing, load: LOAD_B });
    ForceTrain {
        name: format!("hslm-b:{count},{spacing}"),
        title: format!("HSLM-B, {count} forces of 170 kN at {spacing} m"),
        max_speed: None,
        axles: axles.collect(),
        buffers: None,
        coach: (count > 1).then_some(spacing),
        source: "EN 1991-2:2003, 6.4.6.1.1: N and d are those that the user has read from figure 6.14; the force of \
                 170 kN is from memory, the text of the standard was not at hand."
            .into(),
        verified: "secondary".into(),
    }
}
