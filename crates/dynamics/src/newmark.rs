//! Newmark's method for M ü + C u̇ + K u = f, one step t → t + h (Newmark, J. Eng. Mech. Div. 85, 1959):
//!
//! ```text
//! K̂ u₁ = f₁ + M (a₀u + a₂u̇ + a₃ü) + C (a₁u + a₄u̇ + a₅ü),     K̂ = K + a₀M + a₁C
//! ü₁ = a₀(u₁ − u) − a₂u̇ − a₃ü
//! u̇₁ = u̇ + h[(1−γ)ü + γü₁]
//! a₀ = 1/(βh²)  a₁ = γ/(βh)  a₂ = 1/(βh)  a₃ = 1/(2β) − 1  a₄ = γ/β − 1  a₅ = h/2 (γ/β − 2)
//! ```
//!
//! γ = 1/2, β = 1/4 (the trapezoidal rule) is second order and keeps energy.

/// The constants of one step size.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Newmark {
    /// Newmark's γ: 1/2 without numerical damping.
    pub gamma: f64,
    /// Newmark's β: 1/4 for the trapezoidal rule.
    pub beta: f64,
    /// Step h, s.
    pub h: f64,
    /// The constants a₀ … a₅.
    pub a: [f64; 6],
}

impl Newmark {
    /// Constants for a step of `h` seconds.
    pub fn new(gamma: f64, beta: f64, h: f64) -> Self {
        let a = [
            1.0 / (beta * h * h),
            gamma / (beta * h),
            1.0 / (beta * h),
            0.5 / beta - 1.0,
            gamma / beta - 1.0,
            0.5 * h * (gamma / beta - 2.0),
        ];
        Self { gamma, beta, h, a }
    }

    /// a₀u + a₂u̇ + a₃ü: what M multiplies.
    pub fn inertia(&self, u: f64, v: f64, a: f64) -> f64 {
        self.a[0] * u + self.a[2] * v + self.a[3] * a
    }

    /// a₁u + a₄u̇ + a₅ü: what C multiplies.
    pub fn damping(&self, u: f64, v: f64, a: f64) -> f64 {
        self.a[1] * u + self.a[4] * v + self.a[5] * a
    }

    /// (u̇₁, ü₁) from u₁ and the old u, u̇, ü.
    pub fn finish(&self, u1: f64, u: f64, v: f64, a: f64) -> (f64, f64) {
        let a1 = self.a[0] * (u1 - u) - self.a[2] * v - self.a[3] * a;
        (v + self.h * ((1.0 - self.gamma) * a + self.gamma * a1), a1)
    }

    /// Finishes whole vectors: from the old motion and `new.u` computes `new.v` and `new.a`.
    pub fn finish_all(&self, old: &Motion, new: &mut Motion) {
        let old = old.u.iter().zip(&old.v).zip(&old.a);
        for (((u1, v1), a1), ((u, v), a)) in new.u.iter().zip(&mut new.v).zip(&mut new.a).zip(old) {
            (*v1, *a1) = self.finish(*u1, *u, *v, *a);
        }
    }
}

/// Displacements, velocities and accelerations of a system.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Motion {
    /// Displacements u, m or rad.
    pub u: Vec<f64>,
    /// Velocities u̇, m/s or rad/s.
    pub v: Vec<f64>,
    /// Accelerations ü, m/s² or rad/s².
    pub a: Vec<f64>,
}

impl Motion {
    /// At rest, `n` degrees of freedom.
    pub fn rest(n: usize) -> Self {
        Self { u: vec![0.0; n], v: vec![0.0; n], a: vec![0.0; n] }
    }

    /// All numbers, u then u̇ then ü.
    pub fn numbers(&self) -> impl Iterator<Item = &f64> {
        self.u.iter().chain(&self.v).chain(&self.a)
    }

    /// All numbers, writable, in the same order.
    pub fn numbers_mut(&mut self) -> impl Iterator<Item = &mut f64> {
        self.u.iter_mut().chain(&mut self.v).chain(&mut self.a)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// One degree of freedom, u(t) = cos ωt, to t = 1 s.
    fn error(h: f64) -> f64 {
        let (omega, n) = (7.0_f64, (1.0 / h).round() as usize);
        let newmark = Newmark::new(0.5, 0.25, h);
        let (mut u, mut v, mut a) = (1.0, 0.0, -omega * omega);
        for _ in 0..n {
            let u1 = newmark.inertia(u, v, a) / (omega * omega + newmark.a[0]);
            (v, a) = newmark.finish(u1, u, v, a);
            u = u1;
        }
        (u - omega.cos()).abs()
    }

    #[test]
    fn the_trapezoidal_rule_is_second_order() {
        let order = (error(0.002) / error(0.001)).log2();
        assert!((order - 2.0).abs() < 0.01, "order {order}");
    }
}
