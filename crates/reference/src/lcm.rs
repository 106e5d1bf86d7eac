//! The loosely coupled method: cars on one side, track and bridge on the other, iterated on the forces of the wheels.
//!
//! ```text
//! u = K̂⁻¹ (p + Nᵀ F),   q = q_free − K̂_c⁻¹ Bᵀ F           both sides under the forces of the last trial
//! F̃ = F(B q − N u − r),   F ← F + ω (F̃ − F)                the contacts between them
//! ```
//!
//! A change of F comes back as −D Y of it, D the contacts' stiffness and Y their compliance as in [`crate::schur`]. All
//! eigenvalues of D Y are real and positive; with greatest ρ the plain iteration (ω = 1) converges for ρ < 1 only: k_H (Y_w +
//! Y_r) = 1 of a single wheel. With eigenvalues from μ to ρ the iteration contracts by max |1 − ω (1 + μ)|, |1 − ω (1 + ρ)|,
//! least for ω = 2/(2 + μ + ρ).

use ttb_train_track::car::wheel;

use crate::trial::Trial;

/// Trials of a step at most.
const MOST: usize = 500;

/// The iteration.
pub struct Lcm {
    /// ω.
    pub omega: f64,
    tolerance: f64,
    axle_load: f64,
    last: Vec<f64>,
    answer: Vec<f64>,
}

impl Lcm {
    /// With relaxation ω, ended at ‖F̃ − F‖₂ ≤ tolerance · max(‖F̃‖₂, one axle load).
    pub fn new(omega: f64, tolerance: f64, axle_load: f64, forces: &[f64]) -> Self {
        Self { omega, tolerance, axle_load, last: forces.to_vec(), answer: forces.to_vec() }
    }

    /// The forces at the end of a step, from those at its begin; returns the number of trials.
    ///
    /// # Errors
    /// It does not converge.
    pub fn solve(&mut self, trial: &mut Trial, forces: &mut [f64]) -> Result<usize, String> {
        // First trial: a straight line on.
        for (force, last) in forces.iter_mut().zip(&mut self.last) {
            (*force, *last) = (2.0 * *force - *last, *force);
        }
        let mut first: Option<f64> = None;
        for n in 1..=MOST {
            trial.press(forces);
            let (mut missing, mut size) = (0.0, 0.0);
            for ((axle, answer), force) in self.answer.iter_mut().enumerate().zip(&*forces) {
                let s = trial.car(wheel(axle)) - trial.rail(axle) - trial.wheels.roughness[axle];
                *answer = trial.wheels.force(axle, s).0;
                missing += (*answer - force).powi(2);
                size += answer.powi(2);
            }
            let residual = missing.sqrt() / size.sqrt().max(self.axle_load);
            let lost = residual > 1e3 * *first.get_or_insert(residual.max(1e-3));
            if !residual.is_finite() || lost {
                return Err(format!(
                    "the iteration on the wheels' forces diverges: residual {residual:.1e} after {n} trials"
                ));
            }
            if residual <= self.tolerance {
                forces.copy_from_slice(&self.answer);
                return Ok(n);
            }
            forces.iter_mut().zip(&self.answer).for_each(|(f, answer)| *f += self.omega * (answer - *f));
        }
        Err(format!("the iteration on the wheels' forces does not converge in {MOST} trials"))
    }
}
