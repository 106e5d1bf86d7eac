//! Kalker's creepage coefficients C₁₁, C₂₂, C₂₃ of the linear theory.
//!
//! Linear in q = a/b (a ≤ b) or q = 2 − b/a over the table, a parabola through 1/C at ν = 0, ¼, ½ between its columns.
//!
//! Kalker, Three-Dimensional Elastic Bodies in Rolling Contact, 1990, table E.3. One copy in use prints 1.15 for C₂₃ at
//! ν = ¼, a/b = 0.8; the differences of the column say 1.25.

/// The coefficients of one ellipse.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coefficients {
    /// Longitudinal.
    pub c11: f64,
    /// Lateral.
    pub c22: f64,
    /// Lateral force of spin.
    pub c23: f64,
}

#[allow(clippy::approx_constant, reason = "some coefficients happen to begin like π")]
/// C₁₁, C₂₂, C₂₃ at q = 0.1, 0.2 … 1.9, for ν = 0, ¼, ½.
const TABLE: [[[f64; 19]; 3]; 3] = [
    [
        [
            2.51, 2.59, 2.68, 2.78, 2.88, 2.98, 3.09, 3.19, 3.29, 3.40, 3.51, 3.65, 3.82, 4.06, 4.37, 4.84, 5.57, 6.96,
            10.7,
        ],
        [
            2.51, 2.59, 2.68, 2.78, 2.88, 2.98, 3.09, 3.19, 3.29, 3.40, 3.51, 3.65, 3.82, 4.06, 4.37, 4.84, 5.57, 6.96,
            10.7,
        ],
        [
            0.334, 0.483, 0.607, 0.720, 0.827, 0.930, 1.03, 1.13, 1.23, 1.33, 1.44, 1.58, 1.76, 2.01, 2.35, 2.88, 3.79,
            5.72, 12.2,
        ],
    ],
    [
        [
            3.31, 3.37, 3.44, 3.53, 3.62, 3.72, 3.81, 3.91, 4.01, 4.12, 4.22, 4.36, 4.54, 4.78, 5.10, 5.57, 6.34, 7.78,
            11.7,
        ],
        [
            2.52, 2.63, 2.75, 2.88, 3.01, 3.14, 3.28, 3.41, 3.54, 3.67, 3.81, 3.99, 4.21, 4.50, 4.90, 5.48, 6.40, 8.14,
            12.8,
        ],
        [
            0.473, 0.603, 0.715, 0.823, 0.929, 1.03, 1.14, 1.25, 1.36, 1.47, 1.59, 1.75, 1.95, 2.23, 2.62, 3.24, 4.32,
            6.63, 14.6,
        ],
    ],
    [
        [
            4.85, 4.81, 4.80, 4.82, 4.83, 4.91, 4.97, 5.05, 5.12, 5.20, 5.30, 5.42, 5.58, 5.80, 6.11, 6.57, 7.34, 8.82,
            12.9,
        ],
        [
            2.53, 2.66, 2.81, 2.98, 3.14, 3.31, 3.48, 3.65, 3.82, 3.98, 4.16, 4.39, 4.67, 5.04, 5.56, 6.31, 7.51, 9.79,
            16.0,
        ],
        [
            0.731, 0.809, 0.889, 0.977, 1.07, 1.18, 1.29, 1.40, 1.51, 1.63, 1.77, 1.94, 2.18, 2.50, 2.96, 3.70, 5.01,
            7.89, 18.0,
        ],
    ],
];

impl Coefficients {
    /// For the axes' ratio a/b and Poisson's ratio ν in 0…½. Ellipses more slender than 1:10 get the values of 1:10.
    #[must_use]
    pub fn new(a_to_b: f64, poisson: f64) -> Self {
        let q = if a_to_b <= 1.0 { a_to_b } else { 2.0 - 1.0 / a_to_b };
        let position = (10.0 * q - 1.0).clamp(0.0, 18.0);
        let i = (position as usize).min(17);
        let part = position - i as f64;
        let of = |coefficient: usize| {
            let at = |column: usize| {
                let values = &TABLE[column][coefficient];
                1.0 / (values[i] + part * (values[i + 1] - values[i]))
            };
            let [zero, quarter, half] = [at(0), at(1), at(2)];
            let x = 4.0 * poisson;
            1.0 / (zero + x * (quarter - zero) + 0.5 * x * (x - 1.0) * (half - 2.0 * quarter + zero))
        };
        Self { c11: of(0), c22: of(1), c23: of(2) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// An independent program's values for steel, ν = 0.28.
    #[test]
    fn steel_has_the_coefficients_of_an_independent_program() {
        for (ratio, c11, c22, c23) in
            [(1.0, 4.2262, 3.7049, 1.4881), (2.0, 5.2037, 4.9715, 2.6566), (0.5, 3.7335, 3.0256, 0.9435)]
        {
            let c = Coefficients::new(ratio, 0.28);
            assert!((c.c11 - c11).abs() < 6e-5 && (c.c22 - c22).abs() < 6e-5 && (c.c23 - c23).abs() < 6e-5, "{c:?}");
        }
    }

    #[test]
    fn the_table_is_returned_at_its_own_points() {
        assert!((Coefficients::new(0.8, 0.25).c23 - 1.25).abs() < 1e-12);
        assert!((Coefficients::new(1.0 / 0.7, 0.5).c22 - 4.67).abs() < 1e-12);
        assert!((Coefficients::new(0.01, 0.0).c11 - 2.51).abs() < 1e-12);
    }
}
