//! The strongly coupled method with constant matrices: contacts by a small time-dependent Schur complement.
//!
//! ```text
//! Y = B K̂_c⁻¹ Bᵀ + N K̂⁻¹ Nᵀ + diag c_loc        K̂: track and bridge, K̂_c: the cars; both factorised once
//! δ + Y F(δ) = B q_free − N u_free − r            Newton on the axles' approaches δ, as in the product
//! ```
//!
//! N K̂⁻¹ Nᵀ = (L⁻¹Nᵀ)ᵀ (L⁻¹Nᵀ) costs one short forward sweep an axle, since the rail is eliminated last.

use ttb_train_track::car::wheel;
use ttb_train_track::contact::Contacts;

use crate::trial::Trial;
use crate::wheels::Wheels;

/// Contacts of all axles.
pub struct Schur {
    contacts: Contacts,
    delta: Vec<f64>,
    free: Vec<f64>,
    compliance: Vec<f64>,
}

impl Schur {
    /// For these wheels.
    pub fn new(wheels: &Wheels) -> Self {
        let n = wheels.len();
        Self {
            contacts: Contacts::new(wheels.laws.clone()),
            delta: wheels.laws.iter().map(ttb_train_track::law::Law::static_approach).collect(),
            free: vec![0.0; n],
            compliance: vec![0.0; n * n],
        }
    }

    /// The forces at the end of a step; returns Newton's iterations.
    ///
    /// # Errors
    /// Newton's method does not converge.
    pub fn solve(&mut self, trial: &mut Trial, forces: &mut [f64]) -> Result<usize, String> {
        trial.compliance(&mut self.compliance);
        trial.look(&[]);
        for axle in 0..forces.len() {
            self.free[axle] = trial.cars_free[wheel(axle)] - trial.rail(axle) - trial.wheels.roughness[axle];
            self.compliance[axle * forces.len() + axle] += trial.wheels.points[axle].local_compliance;
        }
        let solved = self.contacts.solve(&self.compliance, &self.free, &mut self.delta, forces);
        solved.map_err(|n| format!("the contacts did not converge in {n} iterations"))
    }
}
