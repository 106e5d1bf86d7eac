//! Cross-sections of beams.

/// What a cross-section is for a beam; `along` and `across` are the two axes of its outline.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Profile {
    /// Area, m².
    pub area: f64,
    /// Second moment of area for bending that moves the beam along, m⁴.
    pub inertia_along: f64,
    /// Second moment of area for bending that moves the beam across, m⁴.
    pub inertia_across: f64,
    /// Torsion constant, m⁴.
    pub torsion: f64,
    /// Shear area along, m².
    pub shear_along: f64,
    /// Shear area across, m².
    pub shear_across: f64,
}

/// A rectangle of `along` by `across`, m. Torsion by the customary polynomial (Roark), within 0.5 %.
#[must_use]
pub fn solid(along: f64, across: f64) -> Profile {
    let (long, short) = (along.max(across), along.min(across));
    let slender = short / long;
    Profile {
        area: along * across,
        inertia_along: across * along.powi(3) / 12.0,
        inertia_across: along * across.powi(3) / 12.0,
        torsion: long * short.powi(3) * (1.0 / 3.0 - 0.21 * slender * (1.0 - slender.powi(4) / 12.0)),
        shear_along: along * across / 1.2,
        shear_across: along * across / 1.2,
    }
}

/// A rectangular box of `along` by `across` with walls of `wall`, m. Torsion by Bredt's formula.
#[must_use]
pub fn hollow(along: f64, across: f64, wall: f64) -> Profile {
    let (outer, inner) = (solid(along, across), solid(along - 2.0 * wall, across - 2.0 * wall));
    let (a, b) = (along - wall, across - wall);
    Profile {
        area: outer.area - inner.area,
        inertia_along: outer.inertia_along - inner.inertia_along,
        inertia_across: outer.inertia_across - inner.inertia_across,
        torsion: 2.0 * wall * (a * b).powi(2) / (a + b),
        shear_along: 2.0 * wall * a,
        shear_across: 2.0 * wall * b,
    }
}
