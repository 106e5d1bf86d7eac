//! Plane frame element: bending from [`Beam`], axial force, any orientation, hinged ends.
//!
//! A node moves by [u_x, u_z, θ], x forward, z down, θ lowering what lies ahead. The element's own axes are e₁ = (c, s)
//! from its first to its second node and e₂ = (−s, c); its own degrees of freedom are p = [u₁, w₁, θ₁, u₂, w₂, θ₂].
//!
//! ```text
//! p = T R q,   R: nodal → own axes,   u = c u_x + s u_z,   w = −s u_x + c u_z
//! K = (TR)ᵀ K_p (TR)      M = (TR)ᵀ M_p (TR)      u_z(ξ) = [s N_u(ξ) + c N_w(ξ)] T R q
//! ```
//!
//! T condenses the rotation at a hinge statically: it takes the value at which the end moment vanishes, e.g. for a hinge
//! at the first end, with φ of the shear deformation, θ₁ = [6 (w₂ − w₁)/l − (2 − φ) θ₂]/(4 + φ), and for hinges at both
//! ends θ₁ = θ₂ = (w₂ − w₁)/l. The same T serves K, M and the interpolation, so they stay consistent. A truss is an
//! element with two hinges and no bending stiffness.

use nalgebra::{SMatrix, SVector};
use ttb_contract::GRAVITY;

use crate::beam::Beam;

/// A matrix over both nodes' degrees of freedom [u_x, u_z, θ]₁, [u_x, u_z, θ]₂.
pub type Matrix6 = SMatrix<f64, 6, 6>;
/// A row over the same degrees of freedom.
pub type Row6 = SVector<f64, 6>;

/// A straight element.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrameElement {
    /// Cross-section in bending; its mass also moves axially.
    pub beam: Beam,
    /// Axial stiffness EA, N.
    pub axial_stiffness: f64,
    /// Components (x, z) of the distance from the first to the second node, m.
    pub span: [f64; 2],
    /// Hinges at the first and second end.
    pub hinged: [bool; 2],
}

impl FrameElement {
    /// A truss: axial force only; the mass moves with it in both directions.
    pub fn truss(axial_stiffness: f64, mass: f64, span: [f64; 2]) -> Self {
        let beam = Beam { bending_stiffness: 0.0, mass, shear_stiffness: None, rotary_inertia: 0.0 };
        Self { beam, axial_stiffness, span, hinged: [true; 2] }
    }

    /// Length l, m.
    pub fn length(&self) -> f64 {
        libm::hypot(self.span[0], self.span[1])
    }

    /// (c, s).
    pub fn direction(&self) -> [f64; 2] {
        self.span.map(|component| component / self.length())
    }

    /// K, N/m and N m.
    pub fn stiffness(&self) -> Matrix6 {
        let axial = self.axial_stiffness / self.length();
        self.in_nodes([axial, -axial], &self.beam.stiffness(self.length()))
    }

    /// Consistent M, kg and kg m².
    pub fn mass_matrix(&self) -> Matrix6 {
        let third = self.beam.mass * self.length() / 3.0;
        self.in_nodes([third, 0.5 * third], &self.beam.mass_matrix(self.length()))
    }

    /// (TR)ᵀ P (TR) for an axial part [[a, b], [b, a]] and a bending part.
    fn in_nodes(&self, [a, b]: [f64; 2], bending: &[[f64; 4]; 4]) -> Matrix6 {
        let mut own = Matrix6::zeros();
        (own[(0, 0)], own[(0, 3)], own[(3, 0)], own[(3, 3)]) = (a, b, b, a);
        for (i, row) in BENDING.into_iter().zip(bending) {
            BENDING.into_iter().zip(row).for_each(|(j, value)| own[(i, j)] = *value);
        }
        let tr = self.transformation();
        tr.transpose() * own * tr
    }

    /// TR.
    fn transformation(&self) -> Matrix6 {
        let [c, s] = self.direction();
        let mut r = Matrix6::zeros();
        for node in [0, 3] {
            (r[(node, node)], r[(node, node + 1)]) = (c, s);
            (r[(node + 1, node)], r[(node + 1, node + 1)]) = (-s, c);
            r[(node + 2, node + 2)] = 1.0;
        }
        let l = self.length();
        let phi = self.beam.shear_stiffness.map_or(0.0, |ga| 12.0 * self.beam.bending_stiffness / (ga * l * l));
        let mut t = Matrix6::identity();
        match self.hinged {
            [false, false] => {}
            [true, true] => {
                t.set_row(2, &Row6::from([0.0, -1.0 / l, 0.0, 0.0, 1.0 / l, 0.0]).transpose());
                t.set_row(5, &Row6::from([0.0, -1.0 / l, 0.0, 0.0, 1.0 / l, 0.0]).transpose());
            }
            [first, _] => {
                let (chord, other) = (6.0 / (l * (4.0 + phi)), -(2.0 - phi) / (4.0 + phi));
                let (hinge, far) = if first { (2, 5) } else { (5, 2) };
                let mut row = Row6::from([0.0, -chord, 0.0, 0.0, chord, 0.0]);
                row[far] = other;
                t.set_row(hinge, &row.transpose());
            }
        }
        t * r
    }

    /// Row that gives the displacement along (x, z) = `along` at ξ from the nodal motion.
    pub fn displacement(&self, xi: f64, along: [f64; 2]) -> Row6 {
        let ([c, s], n) = (self.direction(), self.beam.shape(xi, self.length()));
        let (axial, across) = (c * along[0] + s * along[1], c * along[1] - s * along[0]);
        let own = [axial * (1.0 - xi), across * n[0], across * n[1], axial * xi, across * n[2], across * n[3]];
        self.transformation().transpose() * Row6::from(own)
    }

    /// Row that gives the bending moment at ξ, N m, positive when the lower side (z > 0) is stretched in an element that
    /// runs forward.
    pub fn moment(&self, xi: f64) -> Row6 {
        let m = self.beam.moment(xi, self.length());
        let forward = if self.span[0] < 0.0 { -1.0 } else { 1.0 };
        self.transformation().transpose() * (forward * Row6::from([0.0, m[0], m[1], 0.0, m[2], m[3]]))
    }
}

/// Places of w₁, θ₁, w₂, θ₂ among the six.
const BENDING: [usize; 4] = [1, 2, 4, 5];

/// Equivalent modulus of a sagging cable, N/m² (Ernst, Der Bauingenieur 40, 1965, 52–55):
///
/// ```text
/// E_eq = E / (1 + (γ L_h)² E / (12 σ³)),   γ = m g/A,   σ = T/A
/// ```
///
/// from E (N/m²), A (m²), mass per length (kg/m), tension T (N) and horizontal length L_h (m).
pub fn ernst_modulus(modulus: f64, area: f64, mass: f64, tension: f64, horizontal: f64) -> f64 {
    let (gamma, sigma) = (mass * GRAVITY / area, tension / area);
    modulus / (1.0 + (gamma * horizontal).powi(2) * modulus / (12.0 * sigma.powi(3)))
}

#[cfg(test)]
mod tests {
    use super::*;

    const BEAM: Beam = Beam { bending_stiffness: 3e7, mass: 400.0, shear_stiffness: Some(2e8), rotary_inertia: 5.0 };

    fn element(hinged: [bool; 2]) -> FrameElement {
        FrameElement { beam: BEAM, axial_stiffness: 2e9, span: [3.0, -1.5], hinged }
    }

    #[test]
    fn rigid_motions_carry_no_force_and_the_whole_mass() {
        let (dx, dz) = (3.0, -1.5);
        let motions = [[1.0, 0.0, 0.0, 1.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 1.0, -dz, dx, 1.0]];
        for hinged in [[false, false], [true, false], [false, true], [true, true]] {
            let e = element(hinged);
            for motion in motions {
                assert!((e.stiffness() * Row6::from(motion)).amax() < 1e-4 * 1e-3, "{hinged:?} {motion:?}");
            }
            for motion in &motions[..2] {
                let q = Row6::from(*motion);
                assert!((q.dot(&(e.mass_matrix() * q)) / (400.0 * e.length()) - 1.0).abs() < 1e-12);
            }
        }
    }

    #[test]
    fn a_hinge_is_the_static_condensation() {
        let (free, hinged) = (element([false, false]), element([true, false]));
        // K_rr − K_rh K_hr / K_hh with h the first rotation.
        let k = free.stiffness();
        let condensed = k - k.column(2) * k.row(2) / k[(2, 2)];
        assert!((condensed - hinged.stiffness()).amax() < 1e-9 * k.amax());
        assert!(hinged.moment(0.0).amax() < 1e-6 && free.moment(0.0).amax() > 1.0);
    }

    #[test]
    fn a_truss_has_the_textbook_matrices() {
        let truss = FrameElement::truss(1e6, 12.0, [0.0, 2.0]);
        let (k, m) = (truss.stiffness(), truss.mass_matrix());
        assert!((k[(1, 1)] - 5e5).abs() < 1e-6 && k[(0, 0)].abs() < 1e-9 && (k[(1, 4)] + 5e5).abs() < 1e-6);
        for i in [0, 1] {
            assert!((m[(i, i)] - 8.0).abs() < 1e-12 && (m[(i, i + 3)] - 4.0).abs() < 1e-12);
        }
        assert_eq!(m.column(2).amax(), 0.0);
    }

    #[test]
    fn an_element_laid_backwards_is_the_same() {
        let (there, back) = (element([true, false]), FrameElement { span: [-3.0, 1.5], ..element([false, true]) });
        let swap = |row: Row6| Row6::from([row[3], row[4], row[5], row[0], row[1], row[2]]);
        let differs = |a: Row6, b: Row6| (a - swap(b)).amax() / a.amax();
        assert!(differs(there.displacement(0.3, [0.0, 1.0]), back.displacement(0.7, [0.0, 1.0])) < 1e-12);
        assert!(differs(there.displacement(0.3, [1.0, 0.0]), back.displacement(0.7, [1.0, 0.0])) < 1e-12);
        assert!(differs(there.moment(0.3), back.moment(0.7)) < 1e-12);
        assert!(differs(there.stiffness().column(1).into(), back.stiffness().column(4).into()) < 1e-12);
    }

    #[test]
    fn ernst_lowers_a_slack_cable_and_leaves_a_tight_one() {
        // γ = 7.85e4 N/m³, L_h = 200 m, σ = 400 MPa: (γ L)² E/(12 σ³) = 0.06419…
        let (e, a) = (2e11, 0.01);
        let mass = 7.85e4 * a / GRAVITY;
        let expected = e / (1.0 + (7.85e4_f64 * 200.0).powi(2) * e / (12.0 * 4e8_f64.powi(3)));
        assert!((ernst_modulus(e, a, mass, 4e8 * a, 200.0) / expected - 1.0).abs() < 1e-12);
        assert!(ernst_modulus(e, a, mass, 4e9 * a, 20.0) > 0.999_99 * e);
    }
}
