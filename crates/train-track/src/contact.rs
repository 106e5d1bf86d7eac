//! Wheel–rail contact: the law of one axle, and all contacts of the train at once through their compliance.
//!
//! ```text
//! nonlinear Hertz   F = n (δ/G)^{3/2} for δ > 0, else 0                    n contacts per axle
//! linear            F = max(0, P0 + n k_H (δ − δ₀))                        k_H = 1.5 (P0/n)^{1/3}/G,  δ₀ = G (P0/n)^{2/3}
//! ```
//!
//! The approaches δ of all axles follow from those without contact forces, δ_free, and the compliance Y of wheels and rail:
//!
//! ```text
//! g(δ) = δ + Y F(δ) − δ_free = 0
//! Newton: (I + Y D) Δ = −g,   D = diag F′(δ);   with S = D^{1/2}:  (I + S Y S) y = −S g,   Δ = −g − Y S y
//! ```
//!
//! I + S Y S is symmetric and positive definite even where wheels have lifted off (D = 0): one dense Cholesky per iteration.

use ttb_scenario::types::{Contact, ContactLaw};

/// Contact law of one axle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Law {
    linear: bool,
    /// n, contacts per axle.
    contacts: f64,
    /// G, m/N^{2/3}.
    g: f64,
    /// P0, N per axle.
    load: f64,
    /// δ₀, m.
    static_approach: f64,
    /// n k_H, N/m per axle.
    static_stiffness: f64,
}

impl Law {
    /// For an axle with static load `load` (N).
    pub fn new(contact: &Contact, load: f64) -> Self {
        let g = contact.constant();
        let contacts = f64::from(contact.wheels_per_axle);
        let root = (load / contacts).cbrt();
        let (static_approach, static_stiffness) = (g * root * root, contacts * 1.5 * root / g);
        Self { linear: contact.law == ContactLaw::Linear, contacts, g, load, static_approach, static_stiffness }
    }

    /// F(δ) and F′(δ), N and N/m.
    pub fn force(&self, delta: f64) -> (f64, f64) {
        if self.linear {
            let force = self.load + self.static_stiffness * (delta - self.static_approach);
            return if force > 0.0 { (force, self.static_stiffness) } else { (0.0, 0.0) };
        }
        if delta <= 0.0 {
            return (0.0, 0.0);
        }
        let s = delta / self.g;
        let root = s.sqrt();
        (self.contacts * s * root, self.contacts * 1.5 * root / self.g)
    }

    /// δ₀ under the static load, m.
    pub fn static_approach(&self) -> f64 {
        self.static_approach
    }
}

/// All contacts of a train; holds the workspace of Newton's method.
#[derive(Clone, Debug)]
pub struct Contacts {
    laws: Vec<Law>,
    root: Vec<f64>,
    g: Vec<f64>,
    y: Vec<f64>,
    trial: Vec<f64>,
    matrix: Vec<f64>,
    /// First and one past the last axle that each axle is coupled with.
    envelope: Vec<(usize, usize)>,
    /// First axle that each axle is coupled with by enough for Newton's matrix.
    near: Vec<usize>,
}

/// Coupling of two axles, relative to the largest compliance, that Newton's matrix can do without: what is left out makes a
/// correction wrong by as much, and the last one is below [`CORRECTION`]. The residual leaves out nothing.
const FAR: f64 = 1e-9;

/// Newton iterations at most; two to four are usual.
const ITERATIONS: usize = 50;
/// Newton stops when the next correction cannot be seen: a correction below this, relative to the largest approach or to
/// 1 µm, leaves an error of its square.
const CORRECTION: f64 = 1e-9;

impl Contacts {
    /// One law per axle.
    pub fn new(laws: Vec<Law>) -> Self {
        let n = laws.len();
        let zeros = || vec![0.0; n];
        Self {
            laws,
            root: zeros(),
            g: zeros(),
            y: zeros(),
            trial: zeros(),
            matrix: vec![0.0; n * n],
            envelope: vec![(0, n); n],
            near: vec![0; n],
        }
    }

    /// The laws.
    pub fn laws(&self) -> &[Law] {
        &self.laws
    }

    /// Solves δ + Y F(δ) = δ_free from the given `delta`; `compliance` is Y by rows. Writes `delta` and `forces`.
    ///
    /// # Errors
    /// The number of iterations when Newton's method does not converge or meets a number that is not finite.
    pub fn solve(
        &mut self,
        compliance: &[f64],
        delta_free: &[f64],
        delta: &mut [f64],
        forces: &mut [f64],
    ) -> Result<usize, usize> {
        let n = self.laws.len();
        self.find_envelope(compliance);
        let mut norm = self.residual(compliance, delta_free, delta, forces);
        for iteration in 1..=ITERATIONS {
            for ((root, law), delta) in self.root.iter_mut().zip(&self.laws).zip(&*delta) {
                *root = law.force(*delta).1.sqrt();
            }
            for i in 0..n {
                for j in self.near[i]..=i {
                    self.matrix[i * n + j] = self.root[i] * compliance[i * n + j] * self.root[j];
                }
                self.matrix[i * n + i] += 1.0;
                self.y[i] = -self.root[i] * self.g[i];
            }
            solve_positive_definite(&mut self.matrix, &self.near, &mut self.y);
            self.y.iter_mut().zip(&self.root).for_each(|(y, root)| *y *= root);
            let (mut largest, mut correction) = (1e-6_f64, 0.0_f64);
            for i in 0..n {
                let (first, end) = self.envelope[i];
                let row = &compliance[i * n + first..i * n + end];
                let product: f64 = row.iter().zip(&self.y[first..end]).map(|(c, y)| c * y).sum();
                self.trial[i] = -self.g[i] - product;
                correction = correction.max(self.trial[i].abs());
                largest = largest.max(delta[i].abs());
            }
            // Line search: a full step unless it would make the residual larger (a contact opens or closes).
            let (mut factor, before) = (1.0, norm);
            loop {
                delta.iter_mut().zip(&self.trial).for_each(|(d, c)| *d += factor * c);
                norm = self.residual(compliance, delta_free, delta, forces);
                if norm <= before || factor * correction <= CORRECTION * largest || factor < 1e-3 {
                    break;
                }
                delta.iter_mut().zip(&self.trial).for_each(|(d, c)| *d -= factor * c);
                factor *= 0.5;
            }
            if !norm.is_finite() {
                return Err(iteration);
            }
            if correction <= CORRECTION * largest {
                return Ok(iteration);
            }
        }
        Err(ITERATIONS)
    }

    /// Distant axles do not feel each other: the nonzero part of every row of Y.
    fn find_envelope(&mut self, compliance: &[f64]) {
        let n = self.laws.len();
        let negligible = FAR * (0..n).map(|i| compliance[i * n + i]).fold(0.0, f64::max);
        for (i, ((first, end), near)) in self.envelope.iter_mut().zip(&mut self.near).enumerate() {
            let row = &compliance[i * n..(i + 1) * n];
            *first = row[..i].iter().position(|y| *y != 0.0).unwrap_or(i);
            *end = row.iter().rposition(|y| *y != 0.0).map_or(n, |last| last + 1).max(i + 1);
            *near = row[..i].iter().position(|y| y.abs() > negligible).unwrap_or(i);
        }
    }

    /// g(δ), its largest entry, and F(δ).
    fn residual(&mut self, compliance: &[f64], delta_free: &[f64], delta: &[f64], forces: &mut [f64]) -> f64 {
        for ((force, law), delta) in forces.iter_mut().zip(&self.laws).zip(delta) {
            *force = law.force(*delta).0;
        }
        let n = self.laws.len();
        let mut norm = 0.0_f64;
        for i in 0..n {
            let (first, end) = self.envelope[i];
            let row = &compliance[i * n + first..i * n + end];
            let product: f64 = row.iter().zip(&forces[first..end]).map(|(c, f)| c * f).sum();
            self.g[i] = delta[i] + product - delta_free[i];
            // A NaN must not vanish in max().
            norm = if self.g[i].is_nan() { f64::NAN } else { norm.max(self.g[i].abs()) };
        }
        norm
    }
}

/// b ← A⁻¹ b by Cholesky; row i of A's lower triangle, which is overwritten, begins with column `begin[i]`. A is I plus a
/// positive semidefinite matrix.
fn solve_positive_definite(a: &mut [f64], begin: &[usize], b: &mut [f64]) {
    let n = b.len();
    for i in 0..n {
        let first = begin[i];
        let (above, row) = a.split_at_mut(i * n);
        for j in first..i {
            let from = first.max(begin[j]);
            let pivot_row = &above[j * n..j * n + j + 1];
            let sum: f64 = row[from..j].iter().zip(&pivot_row[from..]).map(|(x, y)| x * y).sum();
            row[j] = (row[j] - sum) * pivot_row[j];
        }
        let sum: f64 = row[first..i].iter().map(|x| x * x).sum();
        // The diagonal holds 1/l_ii.
        row[i] = 1.0 / (row[i] - sum).sqrt();
        let sum: f64 = row[first..i].iter().zip(&b[first..]).map(|(x, y)| x * y).sum();
        b[i] = (b[i] - sum) * row[i];
    }
    for i in (0..n).rev() {
        b[i] *= a[i * n + i];
        let (bi, first) = (b[i], begin[i]);
        b[first..i].iter_mut().zip(&a[i * n + first..i * n + i]).for_each(|(b, l)| *b -= l * bi);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn contact(law: ContactLaw, wheels: u32) -> Contact {
        Contact { law, wheels_per_axle: wheels, ..Contact::default() }
    }

    #[test]
    fn hertz_data_of_a_worn_wheel() {
        // docs/theory.md 15: G 4.2206e-8; at 71.6 kN per wheel δ₀ = 72.77 µm, k_H = 1.4758 GN/m.
        let law = Law::new(&contact(ContactLaw::Hertz, 1), 71.6e3);
        assert!((law.g / 4.2206e-8 - 1.0).abs() < 2e-5);
        assert!((law.static_approach() / 72.77e-6 - 1.0).abs() < 1e-4);
        let (force, stiffness) = law.force(law.static_approach());
        assert!((force / 71.6e3 - 1.0).abs() < 1e-12);
        assert!((stiffness / 1.4758e9 - 1.0).abs() < 1e-4);
    }

    #[test]
    fn the_linear_law_touches_the_nonlinear_one_at_the_static_load() {
        let (hertz, linear) =
            (Law::new(&contact(ContactLaw::Hertz, 2), 1.4e5), Law::new(&contact(ContactLaw::Linear, 2), 1.4e5));
        let (a, b) = (hertz.force(hertz.static_approach()), linear.force(linear.static_approach()));
        assert!((a.0 - b.0).abs() < 1e-6 && (a.1 / b.1 - 1.0).abs() < 1e-12);
        assert_eq!(linear.force(-1e-3), (0.0, 0.0));
    }

    #[test]
    fn coupled_contacts_close_open_and_satisfy_their_equation() {
        let laws = vec![Law::new(&contact(ContactLaw::Hertz, 2), 1.4e5); 3];
        let y = [2e-9, 5e-10, 1e-10, 5e-10, 2e-9, 5e-10, 1e-10, 5e-10, 2e-9];
        let free = [4e-4, -2e-4, 3e-4];
        for start in [1e-4, 0.0, -1e-3, 5e-3] {
            let (mut delta, mut forces) = ([start; 3], [0.0; 3]);
            let iterations = Contacts::new(laws.clone()).solve(&y, &free, &mut delta, &mut forces).unwrap();
            assert!(iterations <= 12, "{iterations} from {start}");
            assert_eq!(forces[1], 0.0);
            for i in 0..3 {
                let g = delta[i] + (0..3).map(|j| y[3 * i + j] * forces[j]).sum::<f64>() - free[i];
                assert!(g.abs() < 1e-18, "{g:e}");
            }
        }
        let nan = [f64::NAN, 0.0, 0.0];
        assert!(Contacts::new(laws).solve(&y, &nan, &mut [1e-4; 3], &mut [0.0; 3]).is_err());
    }
}
