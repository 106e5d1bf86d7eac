//! What is known of a whole macro step, not of its end only: means, peaks and work over its sub-steps.

use crate::state::State;
use crate::track::{RailPoint, Track};

/// Gathered sub-step by sub-step, τ of m each:
///
/// ```text
/// λ̄ = Σ (λ_{i−1} + λ_i)/2m,   W = Σ (λ_{i−1} + λ_i)/2 · (d_i − d_{i−1})
/// ```
#[derive(Clone, Debug, Default)]
pub struct StepMeans {
    /// λ̄, mean support forces, N.
    pub mean: Vec<f64>,
    /// Monitored points of the rail.
    pub points: Vec<RailPoint>,
    /// Their acceleration of the greatest amount, m/s².
    pub peaks: Vec<f64>,
    /// W, work of the support forces on the deck, J.
    pub work: f64,
}

impl StepMeans {
    /// For so many supports on the bridge, and points of the rail.
    pub fn new(supports: usize, points: Vec<RailPoint>) -> Self {
        Self { mean: vec![0.0; supports], peaks: vec![0.0; points.len()], points, work: 0.0 }
    }

    /// In static equilibrium.
    pub fn rest(&mut self, state: &State) {
        self.mean.copy_from_slice(&state.supports);
        self.peaks.fill(0.0);
        self.work = 0.0;
    }

    /// A macro step begins.
    pub fn begin(&mut self) {
        self.mean.fill(0.0);
        self.peaks.fill(0.0);
        self.work = 0.0;
    }

    /// Takes in one of `parts` sub-steps.
    pub fn add(&mut self, track: &Track, old: &State, new: &State, parts: f64) {
        let ends = old.supports.iter().zip(&new.supports).zip(old.deck.iter().zip(&new.deck));
        for (mean, ((before, after), (from, to))) in self.mean.iter_mut().zip(ends) {
            let force = 0.5 * (before + after);
            *mean += force / parts;
            self.work += force * (to - from);
        }
        self.look(track, &new.track.a);
    }

    /// Takes in the rail's accelerations at the end of a sub-step.
    pub fn look(&mut self, track: &Track, a: &[f64]) {
        for (peak, point) in self.peaks.iter_mut().zip(&self.points) {
            let a = track.deflection(point, a);
            if a.abs() > peak.abs() {
                *peak = a;
            }
        }
    }
}
