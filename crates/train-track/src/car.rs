//! A railway car with 10 degrees of freedom on linear suspensions.
//!
//! ```text
//! q = [z_c, θ_c, z_b1, θ_b1, z_b2, θ_b2, z_w1, z_w2, z_w3, z_w4],  1 leading; z down, θ > 0 lowers the front
//! M = diag(M_c, J_c, M_b, J_b, M_b, J_b, M_w, M_w, M_w, M_w)
//! K = Σ k v vᵀ,   secondary v = e(z_c) ± L_c e(θ_c) − e(z_b),   primary v = e(z_b) ± L_t e(θ_b) − e(z_w);   C alike
//! ```

use std::borrow::Borrow;

use nalgebra::SMatrix;
use ttb_dynamics::newmark::Newmark;
use ttb_scenario::GRAVITY;
use ttb_scenario::types::Car as CarData;

/// Degrees of freedom of a car.
pub const DOFS: usize = 10;
/// Axles of a car.
pub const AXLES: usize = 4;
/// Position of the first wheelset in q.
pub const FIRST_WHEEL: usize = 6;

/// A 10 × 10 matrix.
pub type Matrix10 = SMatrix<f64, DOFS, DOFS>;
/// q, q̇ or q̈ of a car.
pub type Vector10 = SMatrix<f64, DOFS, 1>;

/// Matrices of one car.
#[derive(Clone, Debug)]
pub struct Car {
    /// Diagonal of M.
    pub mass: Vector10,
    /// C.
    pub damping: Matrix10,
    /// K; singular, the wheels are free.
    pub stiffness: Matrix10,
    /// P0: static load of an axle, N.
    pub axle_load: f64,
}

impl Car {
    /// Assembles the matrices.
    pub fn new(data: &CarData) -> Self {
        let (lc, lt) = (0.5 * data.bogie_distance, 0.5 * data.wheelbase);
        let (mc, mb, mw) = (data.body_mass, data.bogie_mass, data.wheelset_mass);
        let (jc, jb) = (data.body_inertia, data.bogie_inertia);
        let (mut stiffness, mut damping) = (Matrix10::zeros(), Matrix10::zeros());
        let mut link = |upper: usize, arm: f64, lower: usize, k: f64, c: f64| {
            let mut v = Vector10::zeros();
            (v[upper], v[upper + 1], v[lower]) = (1.0, arm, -1.0);
            stiffness += k * v * v.transpose();
            damping += c * v * v.transpose();
        };
        for (bogie, arm) in [(2, lc), (4, -lc)] {
            link(0, arm, bogie, data.secondary_stiffness, data.secondary_damping);
            for (axle, arm) in [(0, lt), (1, -lt)] {
                let wheel = FIRST_WHEEL + (bogie - 2) + axle;
                link(bogie, arm, wheel, data.primary_stiffness, data.primary_damping);
            }
        }
        Self {
            mass: Vector10::from_column_slice(&[mc, jc, mb, jb, mb, jb, mw, mw, mw, mw]),
            damping,
            stiffness,
            axle_load: GRAVITY * (0.25 * mc + 0.5 * mb + mw),
        }
    }

    /// Weight of every degree of freedom, N.
    pub fn weight(&self) -> Vector10 {
        let translation = Vector10::from_column_slice(&[1.0, 0.0, 1.0, 0.0, 1.0, 0.0, 1.0, 1.0, 1.0, 1.0]);
        GRAVITY * self.mass.component_mul(&translation)
    }

    /// K̂⁻¹ = (K + a₀M + a₁C)⁻¹, always regular for masses above zero.
    pub fn effective_inverse(&self, newmark: &Newmark) -> Option<Matrix10> {
        let a = &newmark.a;
        let effective = self.stiffness + a[1] * self.damping + a[0] * Matrix10::from_diagonal(&self.mass);
        effective.cholesky().map(|c| c.inverse())
    }

    /// p of a step from u, u̇ and ü of the car at its begin; weight included, N.
    pub fn history(&self, newmark: &Newmark, u: &[f64], v: &[f64], a: &[f64]) -> Vector10 {
        let [u, v, a] = [u, v, a].map(Vector10::from_column_slice);
        let inertia = u.zip_zip_map(&v, &a, |u, v, a| newmark.inertia(u, v, a));
        let damping = u.zip_zip_map(&v, &a, |u, v, a| newmark.damping(u, v, a));
        self.weight() + self.mass.component_mul(&inertia) + self.damping * damping
    }

    /// Natural frequencies with the wheels held (on a rigid rail), Hz, increasing.
    pub fn frequencies_on_rigid_rail(&self) -> [f64; FIRST_WHEEL] {
        // Kφ = ω²Mφ of the upper 6 × 6 block, made symmetric with M^{-1/2}.
        let k = self.stiffness.fixed_view::<FIRST_WHEEL, FIRST_WHEEL>(0, 0);
        let scaled =
            SMatrix::<f64, FIRST_WHEEL, FIRST_WHEEL>::from_fn(|i, j| k[(i, j)] / (self.mass[i] * self.mass[j]).sqrt());
        let mut hertz: [f64; FIRST_WHEEL] = scaled.symmetric_eigenvalues().into();
        hertz.iter_mut().for_each(|x| *x = x.max(0.0).sqrt() / std::f64::consts::TAU);
        hertz.sort_by(f64::total_cmp);
        hertz
    }
}

/// Degree of freedom of an axle among those of all cars.
pub fn wheel(axle: usize) -> usize {
    axle / AXLES * DOFS + FIRST_WHEEL + axle % AXLES
}

/// q = q_free − K̂⁻¹ Bᵀ F of all cars, from their K̂⁻¹; B picks the wheels.
pub fn press<M: Borrow<Matrix10>>(inverses: &[M], free: &[f64], forces: &[f64], q: &mut [f64]) {
    for (c, inverse) in inverses.iter().enumerate() {
        let mut pressed = Vector10::zeros();
        pressed.as_mut_slice()[FIRST_WHEEL..].copy_from_slice(&forces[c * AXLES..(c + 1) * AXLES]);
        let moved = inverse.borrow() * pressed;
        for i in 0..DOFS {
            q[c * DOFS + i] = free[c * DOFS + i] - moved[i];
        }
    }
}

/// Y ← Y + B K̂⁻¹ Bᵀ of all cars, Y over all axles by rows.
pub fn add_wheel_compliance(inverses: &[Matrix10], y: &mut [f64]) {
    let n = inverses.len() * AXLES;
    for (c, inverse) in inverses.iter().enumerate() {
        for i in 0..AXLES {
            for j in 0..AXLES {
                y[(c * AXLES + i) * n + c * AXLES + j] += inverse[(FIRST_WHEEL + i, FIRST_WHEEL + j)];
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_rigid_motion_strains_no_suspension() {
        let data = ttb_scenario::bundled::cars("ice3-trailer").unwrap()[0].clone();
        let car = Car::new(&data);
        let heave = Vector10::from_column_slice(&[1.0, 0.0, 1.0, 0.0, 1.0, 0.0, 1.0, 1.0, 1.0, 1.0]);
        let (c, t) = (8.6875, 1.25);
        let pitch = Vector10::from_column_slice(&[0.0, 1.0, c, 1.0, -c, 1.0, c + t, c - t, -c + t, -c - t]);
        assert!((car.stiffness * heave).amax() < 1e-9);
        assert!((car.stiffness * pitch).amax() < 1e-8);
        assert!((car.weight().sum() - 4.0 * car.axle_load).abs() < 1e-9);
    }

    /// The diagonals of K and C, written down from the definition of the suspensions.
    #[test]
    fn every_motion_is_held_by_the_suspensions_it_moves() {
        let data = ttb_scenario::bundled::cars("ice3-motor").unwrap()[0].clone();
        let car = Car::new(&data);
        let (lc, lt) = (0.5 * data.bogie_distance, 0.5 * data.wheelbase);
        let of = |s: f64, p: f64| {
            let bogie = [s + 2.0 * p, 2.0 * p * lt * lt];
            [2.0 * s, 2.0 * s * lc * lc, bogie[0], bogie[1], bogie[0], bogie[1], p, p, p, p]
        };
        let springs = of(data.secondary_stiffness, data.primary_stiffness);
        let dashpots = of(data.secondary_damping, data.primary_damping);
        for i in 0..DOFS {
            assert!((car.stiffness[(i, i)] / springs[i] - 1.0).abs() < 1e-12, "K_{i}");
            assert!((car.damping[(i, i)] / dashpots[i] - 1.0).abs() < 1e-12, "C_{i}");
        }
    }
}
