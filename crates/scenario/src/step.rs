//! What a run's step has to resolve: the frequencies that train and track bring in, and steps that fit them.

use std::f64::consts::TAU;

use crate::limits::MOST_CHOSEN_SUBSTEPS;
use crate::spec::{Profile, TrainTrackSpec, Vehicle};
use crate::types::Support;

/// Macro steps a period of the highest frequency that comes onto the bridge, sub-steps a period of the wheel–rail resonance:
/// Newmark's trapezoidal rule then makes a period 9 %, 5 % too long.
const A_PERIOD: f64 = 6.0;
const A_RESONANCE: f64 = 8.0;
/// Shortest macro step by frequencies alone, s.
const SHORTEST: f64 = 1e-5;
/// Longest macro step by frequencies alone, s.
pub const LONGEST: f64 = 2e-3;

/// Frequencies in Hz.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Excited {
    /// Speed over the shortest wavelength of the irregularity; 0 on a smooth rail.
    pub irregularity: f64,
    /// Speed over the spacing of the supports.
    pub supports: f64,
    /// Wheelset against rail on the contact's stiffness.
    pub wheel_rail: f64,
}

/// A macro step and its sub-steps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Steps {
    /// Macro step H, s.
    pub step: f64,
    /// Sub-steps m of each.
    pub substeps: usize,
}

impl Excited {
    /// Of a train on its track, at its greatest speed. The rail counts as a beam on a foundation of the springs of one
    /// support a bay in series, k a metre, with the mass that moves with a point of it:
    ///
    /// ```text
    /// b = (k/4EI)^{1/4},  m_r = 3m/(2b);   f = √(k_H (1/M_w + 1/m_r)) / 2π,   k_H = 1.5 (n²P0)^{1/3}/G
    /// ```
    #[must_use]
    pub fn of(spec: &TrainTrackSpec) -> Self {
        let speed = spec.speed.iter().map(|point| point[1]).fold(0.0, f64::max);
        let shortest = match &spec.irregularity {
            Profile::None => f64::INFINITY,
            Profile::Waves { waves, .. } => waves.iter().map(|wave| wave.wavelength).fold(f64::INFINITY, f64::min),
            Profile::Spectrum { wavelengths, .. } => wavelengths[0],
            // No shorter wave can be told from the samples.
            Profile::Samples { x, .. } => match x.as_slice() {
                [first, .., last] => 2.0 * (last - first) / (x.len() - 1) as f64,
                _ => f64::INFINITY,
            },
        };
        let stiffness = match &spec.track.support {
            Support::SingleLayer { fastener } => vec![fastener],
            Support::TwoLayer { pad, ballast, .. } => vec![pad, ballast],
            Support::ThreeLayer { pad, ballast, sub_ballast, .. } => vec![pad, ballast, sub_ballast],
        };
        let flexibility: f64 = stiffness.iter().map(|spring| 1.0 / spring.stiffness).sum();
        let rail = &spec.track.rail;
        let b = (1.0 / (4.0 * rail.bending_stiffness * flexibility * spec.track.spacing)).sqrt().sqrt();
        let moving = 1.5 * rail.mass / b;
        let n = f64::from(spec.contact.wheels_per_axle);
        let of_axle = |[load, mass]: [f64; 2]| {
            let g = spec.contact.constant();
            let contact = 1.5 * libm::cbrt(n * n * load) / g;
            // A force alone has no contact.
            if mass > 0.0 { (contact * (1.0 / mass + 1.0 / moving)).sqrt() / TAU } else { 0.0 }
        };
        Self {
            irregularity: speed / shortest,
            supports: speed / spec.track.spacing,
            wheel_rail: spec.consist().iter().flat_map(Vehicle::axles).map(of_axle).fold(0.0, f64::max),
        }
    }

    /// What the bridge's steps have to resolve, Hz.
    #[must_use]
    pub fn on_the_bridge(&self) -> f64 {
        self.irregularity.max(self.supports)
    }

    /// Steps that resolve them: macro steps what comes onto the bridge, sub-steps the wheel–rail resonance.
    #[must_use]
    pub fn steps(&self, substeps: Option<usize>) -> Steps {
        let resolved = 1.0 / (A_PERIOD * self.on_the_bridge());
        let step = round_down(resolved.clamp(SHORTEST, LONGEST));
        let parts = (step * A_RESONANCE * self.wheel_rail).ceil().clamp(1.0, MOST_CHOSEN_SUBSTEPS as f64);
        Steps { step, substeps: substeps.unwrap_or((parts as usize).max(1)) }
    }
}

/// The next of 5, 2, 1 in its decade, downwards.
fn round_down(x: f64) -> f64 {
    let decade = libm::log10(x).floor();
    let lead = x / libm::pow(10.0, decade);
    let lead = [5.0, 2.0].into_iter().find(|round| lead >= round * (1.0 - 1e-9)).unwrap_or(1.0);
    // Through a decimal text, so that 1 ms is the number that a user would write.
    format!("{lead}e{decade}").parse().unwrap_or(x)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_are_round_and_resolve_what_comes() {
        let excited = Excited { irregularity: 23.0, supports: 107.0, wheel_rail: 900.0 };
        assert_eq!(excited.steps(None), Steps { step: 1e-3, substeps: 8 });
        assert_eq!(excited.steps(Some(1)), Steps { step: 1e-3, substeps: 1 });
        let slow = Excited { irregularity: 0.0, supports: 0.0, wheel_rail: 900.0 };
        assert_eq!(slow.steps(None), Steps { step: 2e-3, substeps: 15 });
        for (x, down) in [(1e-3, 1e-3), (0.99e-3, 5e-4), (2.1e-3, 2e-3), (5e-4, 5e-4), (0.000_049_9, 2e-5)] {
            assert_eq!(round_down(x), down, "{x}");
        }
    }
}
