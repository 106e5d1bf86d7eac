//! Broyden's method: what the corrections of a solution have shown of J, added to its factor.
//!
//! ```text
//! d₀ = −J⁻¹ r₀
//! z ← −J⁻¹ r_{n+1};   z ← z + d_{j+1} (d_jᵀz)/|d_j|²  for j = 0 … n−1;   d_{n+1} = z / (1 − d_nᵀz/|d_n|²)
//! ```
//!
//! (Kelley, Iterative Methods for Linear and Nonlinear Equations, 1995, section 7.3.) Corrections have been made in full.

use super::super::car::dot;

/// Corrections that are remembered; with more of them J is renewed anyway.
const MOST: usize = 8;
/// A correction that would be stretched by more than the inverse of this is left as it is.
const LEAST: f64 = 0.2;

/// Corrections since J was made.
#[derive(Clone, Debug)]
pub struct Secants {
    n: usize,
    count: usize,
    /// d, one after the other, and |d|².
    made: Vec<f64>,
    squares: [f64; MOST],
}

impl Secants {
    /// For `n` unknowns.
    pub fn new(n: usize) -> Self {
        Self { n, count: 0, made: vec![0.0; MOST * n], squares: [0.0; MOST] }
    }

    /// Begins anew, with J alone.
    pub fn forget(&mut self) {
        self.count = 0;
    }

    /// Takes a correction that was made in full.
    pub fn remember(&mut self, d: &[f64]) {
        let square = dot(d, d);
        if self.count == MOST || !(square > 0.0 && square.is_finite()) {
            return self.forget();
        }
        self.made[self.count * self.n..(self.count + 1) * self.n].copy_from_slice(d);
        self.squares[self.count] = square;
        self.count += 1;
    }

    /// Makes the correction d of z = −J⁻¹ r.
    pub fn improve(&mut self, z: &mut [f64]) {
        let d = |j: usize| &self.made[j * self.n..(j + 1) * self.n];
        let share = |j: usize, z: &[f64]| dot(d(j), z) / self.squares[j];
        let Some(last) = self.count.checked_sub(1) else { return };
        for j in 0..last {
            let by = share(j, z);
            z.iter_mut().zip(d(j + 1)).for_each(|(z, d)| *z += by * d);
        }
        let rest = 1.0 - share(last, z);
        if rest > LEAST {
            z.iter_mut().for_each(|z| *z /= rest);
        } else {
            // The next ones build on corrections by the formula alone.
            self.forget();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_linear_system_is_solved_in_two_corrections_a_dimension() {
        // A = I + a wrong part, solved with J = I.
        let a = [[1.0, 0.3, 0.0], [-0.2, 1.1, 0.25], [0.1, 0.0, 0.9]];
        let b = [1.0, -2.0, 0.5];
        let (mut secants, mut x) = (Secants::new(3), [0.0; 3]);
        for _ in 0..6 {
            let mut d: Vec<f64> = (0..3).map(|i| b[i] - dot(&a[i], &x)).collect();
            secants.improve(&mut d);
            x.iter_mut().zip(&d).for_each(|(x, d)| *x += d);
            secants.remember(&d);
        }
        let miss = (0..3).map(|i| (b[i] - dot(&a[i], &x)).abs()).fold(0.0, f64::max);
        assert!(miss < 1e-13, "{miss:e}");
    }
}
