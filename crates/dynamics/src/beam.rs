//! Beam element in bending: Euler–Bernoulli, or Timoshenko when a shear stiffness is given.
//!
//! Degrees of freedom q = [w₁, θ₁, w₂, θ₂] with θ = dw/dx (minus the shear angle for Timoshenko), ξ = x/l.
//! One parameter tells the two theories apart, φ = 12 EI/(κGA l²), zero for Euler–Bernoulli:
//!
//! ```text
//! w(ξ) = N(ξ) q    N₁ = [1 − 3ξ² + 2ξ³ + φ(1 − ξ)]/(1+φ)     N₂ = l [ξ − 2ξ² + ξ³ + φ(ξ − ξ²)/2]/(1+φ)
//!                  N₃ = [3ξ² − 2ξ³ + φξ]/(1+φ)               N₄ = l [ξ³ − ξ² − φ(ξ − ξ²)/2]/(1+φ)
//! θ(ξ) = T(ξ) q    T₁ = −T₃ = 6(ξ² − ξ)/(l(1+φ))             T₂ = [1 − 4ξ + 3ξ² + φ(1 − ξ)]/(1+φ)
//!                                                            T₄ = [3ξ² − 2ξ + φξ]/(1+φ)
//! M = ∫ (m NᵀN + ρI TᵀT) dx
//! ```
//!
//! The shapes are the exact static ones (Friedman & Kosmatka, Computers & Structures 47, 1993, 473–481), so that nodal
//! displacements under static nodal loads are exact.

/// A 4 × 4 element matrix.
pub type Matrix4 = [[f64; 4]; 4];

/// Cross-section of a beam in bending.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Beam {
    /// Bending stiffness EI, N m².
    pub bending_stiffness: f64,
    /// Mass per length m, kg/m.
    pub mass: f64,
    /// κGA, N; `None`: Euler–Bernoulli.
    pub shear_stiffness: Option<f64>,
    /// Rotary inertia per length ρI, kg m.
    pub rotary_inertia: f64,
}

/// Four-point Gauss rule on [0, 1]: exact to degree 7, the mass matrix needs 6.
const GAUSS: [(f64, f64); 4] = [
    (0.069_431_844_202_973_71, 0.173_927_422_568_726_93),
    (0.330_009_478_207_571_87, 0.326_072_577_431_273_07),
    (0.669_990_521_792_428_1, 0.326_072_577_431_273_07),
    (0.930_568_155_797_026_3, 0.173_927_422_568_726_93),
];

impl Beam {
    fn phi(&self, l: f64) -> f64 {
        self.shear_stiffness.map_or(0.0, |ga| 12.0 * self.bending_stiffness / (ga * l * l))
    }

    /// N(ξ): deflection from the nodal values of an element of length `l` (m).
    pub fn shape(&self, xi: f64, l: f64) -> [f64; 4] {
        let phi = self.phi(l);
        let (x2, x3, s) = (xi * xi, xi * xi * xi, 1.0 / (1.0 + phi));
        let bubble = 0.5 * phi * (xi - x2);
        [
            s * (1.0 - 3.0 * x2 + 2.0 * x3 + phi * (1.0 - xi)),
            s * l * (xi - 2.0 * x2 + x3 + bubble),
            s * (3.0 * x2 - 2.0 * x3 + phi * xi),
            s * l * (x3 - x2 - bubble),
        ]
    }

    /// T(ξ): rotation from the nodal values.
    pub fn rotation(&self, xi: f64, l: f64) -> [f64; 4] {
        let phi = self.phi(l);
        let (x2, s) = (xi * xi, 1.0 / (1.0 + phi));
        let t1 = 6.0 * s * (x2 - xi) / l;
        [t1, s * (1.0 - 4.0 * xi + 3.0 * x2 + phi * (1.0 - xi)), -t1, s * (3.0 * x2 - 2.0 * xi + phi * xi)]
    }

    /// Row that gives the bending moment −EI dθ/dx (N m, sagging positive) from the nodal values.
    pub fn moment(&self, xi: f64, l: f64) -> [f64; 4] {
        let phi = self.phi(l);
        let s = -self.bending_stiffness / (1.0 + phi) / l;
        let t1 = (12.0 * xi - 6.0) / l;
        [s * t1, s * (6.0 * xi - 4.0 - phi), -s * t1, s * (6.0 * xi - 2.0 + phi)]
    }

    /// K of an element of length `l` (m).
    pub fn stiffness(&self, l: f64) -> Matrix4 {
        let phi = self.phi(l);
        let k = self.bending_stiffness / (l * l * l * (1.0 + phi));
        let (a, b) = (12.0 * k, 6.0 * l * k);
        let (c, d) = ((4.0 + phi) * l * l * k, (2.0 - phi) * l * l * k);
        [[a, b, -a, b], [b, c, -b, d], [-a, -b, a, -b], [b, d, -b, c]]
    }

    /// Consistent M of an element of length `l` (m).
    pub fn mass_matrix(&self, l: f64) -> Matrix4 {
        let mut m = [[0.0; 4]; 4];
        for (xi, weight) in GAUSS {
            let (n, t) = (self.shape(xi, l), self.rotation(xi, l));
            for (i, row) in m.iter_mut().enumerate() {
                for (j, m) in row.iter_mut().enumerate() {
                    *m += weight * l * (self.mass * n[i] * n[j] + self.rotary_inertia * t[i] * t[j]);
                }
            }
        }
        m
    }

    /// c_loc(ξ), m/N: static deflection under a unit force at ξ inside an element clamped at both ends, which the shapes
    /// cannot show; (ξ(1−ξ)l)³/(3EI) for Euler–Bernoulli. In general the two parts a = ξl, b = (1−ξ)l, condensed to the
    /// loaded point:
    ///
    /// ```text
    /// c = K_θθ / (K_ww K_θθ − K_wθ²),   K = sum of both parts' stiffness at the point
    /// ```
    pub fn local_compliance(&self, xi: f64, l: f64) -> f64 {
        let (a, b) = (xi * l, (1.0 - xi) * l);
        // Within 1e-9 of a node the compliance is below 1e-27 of the element's own: zero, and no division by zero.
        if xi <= 1e-9 || xi >= 1.0 - 1e-9 {
            return 0.0;
        }
        let (ka, kb) = (self.stiffness(a), self.stiffness(b));
        let (ww, wt, tt) = (ka[2][2] + kb[0][0], ka[2][3] + kb[0][1], ka[3][3] + kb[1][1]);
        tt / (ww * tt - wt * wt)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const EB: Beam = Beam { bending_stiffness: 6.6e6, mass: 60.64, shear_stiffness: None, rotary_inertia: 0.0 };
    const TIMOSHENKO: Beam = Beam { shear_stiffness: Some(3e8), rotary_inertia: 0.25, ..EB };

    #[test]
    fn mass_matrix_is_the_textbook_one() {
        let (m, l) = (EB.mass_matrix(0.65), 0.65);
        let f = EB.mass * l / 420.0;
        let textbook = [156.0 * f, 22.0 * l * f, 54.0 * f, -13.0 * l * f];
        for (a, b) in m[0].iter().zip(textbook) {
            assert!((a - b).abs() < 1e-13 * 156.0 * f, "{a} {b}");
        }
        assert!((m[1][1] - 4.0 * l * l * f).abs() < 1e-12 * f);
    }

    #[test]
    fn rigid_motions_carry_no_force() {
        for beam in [EB, TIMOSHENKO] {
            let (k, l) = (beam.stiffness(1.3), 1.3);
            for row in k {
                let (translation, rotation) = (row[0] + row[2], row[1] + l * row[2] + row[3]);
                assert!(translation.abs() < 1e-7 && rotation.abs() < 1e-7, "{translation} {rotation}");
            }
        }
    }

    #[test]
    fn euler_bernoulli_local_compliance_has_the_closed_form() {
        for xi in [0.1_f64, 0.5, 0.77] {
            let l = 0.6;
            let closed = (xi * (1.0 - xi) * l).powi(3) / (3.0 * EB.bending_stiffness);
            assert!((EB.local_compliance(xi, l) / closed - 1.0).abs() < 1e-12);
        }
        assert_eq!(EB.local_compliance(0.0, 0.6), 0.0);
    }

    #[test]
    fn timoshenko_cantilever_tip_is_exact() {
        // Tip force on a clamped element: l³/(3EI) + l/(κGA).
        let (k, l) = (TIMOSHENKO.stiffness(0.8), 0.8);
        let det = k[2][2] * k[3][3] - k[2][3] * k[2][3];
        let exact = l * l * l / (3.0 * 6.6e6) + l / 3e8;
        assert!((k[3][3] / det / exact - 1.0).abs() < 1e-12);
    }
}
