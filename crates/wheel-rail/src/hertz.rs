//! Hertz' contact of two bodies of the same material.
//!
//! ```text
//! A₂, B₂   sums of the curvatures along and across the track, 1/m;   S = (A₂ + B₂)/2;   E* = E/(2(1 − ν²))
//! k = minor/major:   (E(e)/k² − K(e))/(K(e) − E(e)) = larger/smaller curvature,   e² = 1 − k²
//! major₁ = (3E(e)/(2πk²))^{1/3};   major = major₁ (N/(E*S))^{1/3},  along the smaller curvature;   minor = k major
//! δ_n = G N^{2/3},   G = 3K(e)/(2π major₁) (S/E*²)^{1/3};   a = a₁ N^{1/3} along x,  b = b₁ N^{1/3} across
//! ```
//!
//! Johnson, Contact Mechanics, 1985, chapter 4.

use std::f64::consts::PI;

use crate::elliptic::{Integrals, integrals};

/// An elastic material.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Material {
    /// Young's modulus, N/m².
    pub young: f64,
    /// Poisson's ratio.
    pub poisson: f64,
}

impl Material {
    /// Steel: 2.1e11 N/m², 0.28.
    pub const STEEL: Self = Self { young: 2.1e11, poisson: 0.28 };

    /// Shear modulus, N/m².
    #[must_use]
    pub fn shear(&self) -> f64 {
        0.5 * self.young / (1.0 + self.poisson)
    }
}

/// Constants of one contact.
#[derive(Clone, Copy, Debug)]
pub struct Hertz {
    /// G, m/N^{2/3}.
    pub constant: f64,
    /// a₁, m/N^{1/3}.
    pub along: f64,
    /// b₁, m/N^{1/3}.
    pub across: f64,
}

impl Hertz {
    /// For the sums of curvatures A₂ (`along`) and B₂ (`across`), both above 0, 1/m.
    #[must_use]
    pub fn new(along: f64, across: f64, material: &Material) -> Self {
        let (larger, smaller) = if along > across { (along, across) } else { (across, along) };
        let k = axes_ratio(larger / smaller);
        let of = integrals(k);
        let (sum, modulus) = (0.5 * (along + across), 0.5 * material.young / (1.0 - material.poisson.powi(2)));
        let unit = libm::cbrt(1.5 * of.e / (PI * k * k));
        let major = unit / libm::cbrt(modulus * sum);
        let constant = 1.5 * of.k / (PI * unit) * libm::cbrt(sum / (modulus * modulus));
        let (along, across) = if along > across { (k * major, major) } else { (major, k * major) };
        Self { constant, along, across }
    }
}

/// k = minor/major of the ellipse for the ratio of the larger to the smaller curvature, which is at least 1.
fn axes_ratio(curvatures: f64) -> f64 {
    // The equation is nearly a power law: ln(ratio) against ln(k) is nearly straight, so that the secant ends in a few steps.
    let wanted = libm::log(curvatures);
    let (mut x, mut old) = (-0.636 * wanted, -0.7 * wanted - 1e-3);
    let mut miss_old = libm::log(curvature_ratio(old)) - wanted;
    for _ in 0..40 {
        let miss = libm::log(curvature_ratio(x)) - wanted;
        if miss == miss_old || miss.abs() < 1e-14 {
            break;
        }
        let next = (x - miss * (x - old) / (miss - miss_old)).min(0.0);
        (old, miss_old, x) = (x, miss, next);
    }
    libm::exp(x)
}

/// (E/k² − K)/(K − E) for k = eˣ; without differences of nearly equal numbers.
fn curvature_ratio(x: f64) -> f64 {
    let k = libm::exp(x);
    let Integrals { deficit, .. } = integrals(k);
    if deficit == 0.0 {
        return 1.0;
    }
    ((1.0 - k) * (1.0 + k) - deficit) / (k * k * deficit)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sphere_on_a_plane_has_its_closed_form() {
        let (r, n) = (0.46, 53.5e3_f64);
        let hertz = Hertz::new(1.0 / r, 1.0 / r, &Material::STEEL);
        // δ³ = 9N²/(16 E*² R) with E* of two equal bodies.
        let modulus = 2.1e11 / (2.0 * (1.0 - 0.28_f64.powi(2)));
        let closed = (9.0 / (16.0 * modulus * modulus * r)).cbrt();
        assert!((hertz.constant / closed - 1.0).abs() < 1e-10, "{hertz:?}");
        assert!((hertz.constant - 4.5501e-8).abs() < 5e-13);
        let radius = (3.0 * n * r / (4.0 * modulus)).cbrt();
        for axis in [hertz.along, hertz.across] {
            assert!((axis * n.cbrt() / radius - 1.0).abs() < 1e-8, "{hertz:?}");
        }
    }

    /// With scipy's `ellipk` and `ellipe` and `brentq`: r 0.46 m, N 53.5 kN; G, a and b in mm.
    #[test]
    fn ellipses_are_those_of_an_independent_program() {
        let n = 53.5e3_f64;
        for (b2, g, a, b) in [
            (3.333, 4.873_680_860_5e-8, 5.838_387_859_8, 4.392_057_331_7),
            (2.0, 4.486_899_910_3e-8, 5.375_659_834_3, 5.682_931_887_5),
            (1.23, 4.119_581_842_5e-8, 4.937_065_934_8, 7.213_000_928_7),
        ] {
            let hertz = Hertz::new(1.0 / 0.46, b2, &Material::STEEL);
            for (own, expected) in
                [hertz.constant, hertz.along * n.cbrt() * 1e3, hertz.across * n.cbrt() * 1e3].into_iter().zip([g, a, b])
            {
                assert!((own / expected - 1.0).abs() < 1e-9, "{b2}: {own} instead of {expected}");
            }
        }
    }

    #[test]
    fn exchanged_curvatures_exchange_the_axes() {
        let (one, other) = (Hertz::new(2.0, 40.0, &Material::STEEL), Hertz::new(40.0, 2.0, &Material::STEEL));
        assert_eq!((one.constant, one.along, one.across), (other.constant, other.across, other.along));
        // Nearly round and very slender ellipses are found as well.
        for ratio in [1.0 + 1e-9, 1.0001, 1e4] {
            let k = axes_ratio(ratio);
            assert!((curvature_ratio(k.ln()) / ratio - 1.0).abs() < 1e-7, "{ratio}: {k}");
        }
    }
}
