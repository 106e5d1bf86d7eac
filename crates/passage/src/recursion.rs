//! One mode over one step, exact for a force that is linear in the step (Nigam & Jennings, 1969).
//!
//! ```text
//! q̈ + c q̇ + ω²q = p(τ) = p₀ + (p₁ − p₀) τ/h
//! q₁ = a₁₁q₀ + a₁₂q̇₀ + b₁₀p₀ + b₁₁p₁
//! q̇₁ = a₂₁q₀ + a₂₂q̇₀ + b₂₀p₀ + b₂₁p₁
//! ```
//!
//! The particular solution is q_p = (p₀ + rτ)/ω² − c r/ω⁴ with r = (p₁ − p₀)/h; the rest decays freely by
//!
//! ```text
//! E(h) = e^{−σh} [ C + σS    S      ]     σ = c/2, δ² = ω² − σ², C = cos δh, S = sin δh / δ
//!                [ −ω²S      C − σS ]     (cosh and sinh for σ > ω)
//! ```

/// A mode.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Oscillator {
    /// ω, rad/s.
    pub omega: f64,
    /// c = 2ζω, 1/s.
    pub rate: f64,
}

/// Coefficients of a step: of q₀, q̇₀, p₀, p₁.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Coefficients {
    /// For q₁.
    pub position: [f64; 4],
    /// For q̇₁.
    pub velocity: [f64; 4],
}

impl Oscillator {
    /// Coefficients of a step of `h` s.
    #[must_use]
    pub fn step(&self, h: f64) -> Coefficients {
        let (w2, c, sigma) = (self.omega * self.omega, self.rate, 0.5 * self.rate);
        let delta2 = w2 - sigma * sigma;
        let delta = delta2.abs().sqrt();
        let (cos, sin) = match delta * h {
            angle if angle < 1e-8 => (1.0, h),
            angle if delta2 > 0.0 => (libm::cos(angle), libm::sin(angle) / delta),
            angle => (libm::cosh(angle), libm::sinh(angle) / delta),
        };
        let decay = libm::exp(-sigma * h);
        let e = [[cos + sigma * sin, sin], [-w2 * sin, cos - sigma * sin]].map(|row| row.map(|e| decay * e));
        // Free part of minus the particular solution's start, for p₀ = 1 and p₁ = 1.
        let (r, offset) = (1.0 / h, c / (w2 * w2));
        let start = [[1.0 / w2 + offset * r, -r / w2], [-offset * r, r / w2]];
        let end = [[offset * r, -r / w2], [1.0 / w2 - offset * r, r / w2]];
        let load = |i: usize, which: usize| {
            let [q, v] = start[which];
            end[which][i] - (e[i][0] * q + e[i][1] * v)
        };
        Coefficients {
            position: [e[0][0], e[0][1], load(0, 0), load(0, 1)],
            velocity: [e[1][0], e[1][1], load(1, 0), load(1, 1)],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Runge–Kutta of order four in many small steps.
    fn reference(mode: Oscillator, h: f64, [q0, v0, p0, p1]: [f64; 4]) -> [f64; 2] {
        let n = 20_000;
        let dt = h / f64::from(n);
        let slope =
            |t: f64, [q, v]: [f64; 2]| [v, p0 + (p1 - p0) * t / h - mode.rate * v - mode.omega * mode.omega * q];
        let mut y = [q0, v0];
        for i in 0..n {
            let t = f64::from(i) * dt;
            let add = |y: [f64; 2], k: [f64; 2], f: f64| [y[0] + f * k[0], y[1] + f * k[1]];
            let k1 = slope(t, y);
            let k2 = slope(t + 0.5 * dt, add(y, k1, 0.5 * dt));
            let k3 = slope(t + 0.5 * dt, add(y, k2, 0.5 * dt));
            let k4 = slope(t + dt, add(y, k3, dt));
            y = [0, 1].map(|i| y[i] + dt / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]));
        }
        y
    }

    #[test]
    fn a_step_is_exact_under_a_linear_force_whatever_the_damping() {
        for zeta in [0.0, 0.01, 0.3, 1.0, 2.5] {
            let mode = Oscillator { omega: 22.3, rate: 2.0 * zeta * 22.3 };
            for h in [1e-3, 0.05] {
                let Coefficients { position, velocity } = mode.step(h);
                let from = [0.01, -0.3, 2.0, 5.0];
                let dot = |row: [f64; 4]| row.iter().zip(&from).map(|(a, b)| a * b).sum::<f64>();
                let expected = reference(mode, h, from);
                assert!((dot(position) - expected[0]).abs() < 1e-9 * 0.01, "ζ = {zeta}, h = {h}");
                assert!((dot(velocity) - expected[1]).abs() < 1e-8 * 0.3, "ζ = {zeta}, h = {h}");
            }
        }
    }
}
