//! Material and thickness of a shell.

use crate::error::{ElementError, not_negative, positive};

/// Material and thickness of a shell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plate {
    /// Young's modulus E, N/m².
    pub modulus: f64,
    /// Poisson's ratio ν.
    pub poisson: f64,
    /// Thickness t, m.
    pub thickness: f64,
    /// kg/m², non-structural mass included; the rotary inertia is that of this mass spread over the thickness.
    pub mass: f64,
}

/// Share of the cross-section that carries shear.
pub(super) const SHEAR_FACTOR: f64 = 5.0 / 6.0;

impl Plate {
    pub(super) fn check(&self) -> Result<(), ElementError> {
        positive("modulus", self.modulus)?;
        positive("thickness", self.thickness)?;
        not_negative("mass", self.mass)?;
        let poisson = self.poisson;
        let possible = poisson > -1.0 && poisson <= 0.5;
        if possible { Ok(()) } else { Err(ElementError::Property { property: "Poisson's ratio", value: poisson }) }
    }

    /// Plane stress, E/(1−ν²) and its product with ν, and G.
    pub(super) fn plane_stress(&self) -> [f64; 3] {
        let (e, nu) = (self.modulus, self.poisson);
        let direct = e / (1.0 - nu * nu);
        [direct, nu * direct, self.shear_modulus()]
    }

    /// Shear modulus G, N/m².
    pub(super) fn shear_modulus(&self) -> f64 {
        0.5 * self.modulus / (1.0 + self.poisson)
    }
}
