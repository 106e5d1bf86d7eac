//! Dynamic factors of EN 1991-2 and what belongs to them. All constants are known from secondary sources.
//!
//! ```text
//! φ′_dyn = max|y_dyn|/max|y_stat| − 1
//! Annex C   K = v/(2 L_Φ n₀),   φ′ = K/(1 − K + K⁴) for K < 0.76, else 1.325
//!           φ″ = α/100 [56 e^{−(L_Φ/10)²} + 50 (L_Φ n₀/80 − 1) e^{−(L_Φ/20)²}] ≥ 0,   α = min(v/22, 1)
//! 6.4.5     Φ₂ = 1.44/(√L_Φ − 0.2) + 0.82 in 1 … 1.67,   Φ₃ = 2.16/(√L_Φ − 0.2) + 0.73 in 1 … 2
//! 6.4.4     n₀ ≤ 94.76 L^−0.748,   n₀ ≥ 80/L (4 … 20 m), 23.58 L^−0.592 (20 … 100 m)
//! 6.4.6.4   Δζ = (0.0187 L − 0.00064 L²)/(1 − 0.0441 L − 0.0044 L² + 0.000255 L³) %,   L < 30 m, moving forces only
//!           ζ  = 0.5 + 0.125 (20 − L) % steel and composite, 1.0 + 0.07 (20 − L) prestressed, 1.5 + 0.07 (20 − L) reinforced;
//!                without the second term for L ≥ 20 m
//! ```
//!
//! L_Φ, L in m, n₀ in Hz, v in m/s.

/// φ′_dyn from the greatest amounts with and without dynamics; `None` if nothing moves without.
pub fn phi_dyn(dynamic: f64, statically: f64) -> Option<f64> {
    (statically.abs() > 0.0).then(|| dynamic.abs() / statically.abs() - 1.0)
}

/// K of Annex C.
pub fn k(v: f64, length: f64, n0: f64) -> f64 {
    v / (2.0 * length * n0)
}

/// φ′ of Annex C.
pub fn phi_prime(v: f64, length: f64, n0: f64) -> f64 {
    let k = k(v, length, n0);
    if k < 0.76 { k / (1.0 - k + k.powi(4)) } else { 1.325 }
}

/// φ″ of Annex C, for standard maintenance; half of it for carefully maintained track.
pub fn phi_double_prime(v: f64, length: f64, n0: f64) -> f64 {
    let alpha = (v / 22.0).min(1.0);
    let bell = |l: f64| libm::exp(-(length / l).powi(2));
    (alpha / 100.0 * (56.0 * bell(10.0) + 50.0 * (length * n0 / 80.0 - 1.0) * bell(20.0))).max(0.0)
}

/// Φ₂, carefully maintained track.
pub fn phi_2(length: f64) -> f64 {
    (1.44 / (length.sqrt() - 0.2) + 0.82).clamp(1.0, 1.67)
}

/// Φ₃, standard maintenance.
pub fn phi_3(length: f64) -> f64 {
    (2.16 / (length.sqrt() - 0.2) + 0.73).clamp(1.0, 2.0)
}

/// The upper limit of n₀, Hz.
pub fn n0_upper(length: f64) -> f64 {
    94.76 * libm::pow(length, -0.748)
}

/// The lower limit of n₀, Hz; `None` outside 4 to 100 m.
pub fn n0_lower(length: f64) -> Option<f64> {
    match length {
        l if (4.0..=20.0).contains(&l) => Some(80.0 / l),
        l if l > 20.0 && l <= 100.0 => Some(23.58 * libm::pow(l, -0.592)),
        _ => None,
    }
}

/// Additional damping, as a ratio (not in %); 0 from 30 m.
pub fn additional_damping(length: f64) -> f64 {
    let l = length;
    if l >= 30.0 {
        return 0.0;
    }
    let percent = (0.0187 * l - 0.00064 * l * l) / (1.0 - 0.0441 * l - 0.0044 * l * l + 0.000255 * l.powi(3));
    0.01 * percent.max(0.0)
}

/// Kinds of structure with their own damping.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Material {
    /// Steel and composite.
    Steel,
    /// Prestressed concrete.
    Prestressed,
    /// Reinforced concrete and filler beams.
    Reinforced,
}

/// The lower bound of the code's damping, as a ratio.
pub fn damping(material: Material, length: f64) -> f64 {
    let (bound, slope) = match material {
        Material::Steel => (0.5, 0.125),
        Material::Prestressed => (1.0, 0.07),
        Material::Reinforced => (1.5, 0.07),
    };
    0.01 * (bound + slope * (20.0 - length).max(0.0))
}
