//! All contacts of the train at once, through their compliance.
//!
//! The approaches δ of all axles follow from those without contact forces, δ_free, and the compliance Y of wheels and rail:
//!
//! ```text
//! g(δ) = δ + Y F(δ) − δ_free = 0                  F: module `law`
//! Newton: (I + Y D) Δ = −g,   D = diag F′(δ);   with S = D^{1/2}:  (I + S Y S) y = −S g,   Δ = −g − Y S y
//! ```
//!
//! I + S Y S is symmetric and positive definite even where wheels have lifted off (D = 0): one dense Cholesky per iteration.

use crate::cholesky::solve_positive_definite;
use crate::law::Law;
use ttb_contract::finite::larger;

/// Why the contact forces were not found; axles count from 0 at the front.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ContactError {
    /// The approach of this axle is no finite number.
    NotFinite {
        /// The first such axle.
        axle: usize,
    },
    /// Newton's method did not end.
    NotConverged {
        /// The axle whose equation is furthest from fulfilled.
        axle: usize,
        /// How often the method was tried.
        iterations: usize,
    },
}

impl std::fmt::Display for ContactError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::NotFinite { axle } => {
                write!(f, "the wheel–rail contact of wheel {} is not a finite number", axle + 1)
            }
            Self::NotConverged { axle, iterations } => {
                let wheel = axle + 1;
                write!(f, "the wheel–rail contacts did not converge in {iterations} iterations (wheel {wheel} least)")
            }
        }
    }
}

impl std::error::Error for ContactError {}

/// All contacts of a train, with the workspace of Newton's method.
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
    /// Contacts with one law per axle.
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

    /// The laws of all axles, from the front.
    pub fn laws(&self) -> &[Law] {
        &self.laws
    }

    /// Other laws for the same axles.
    pub fn replace(&mut self, laws: Vec<Law>) {
        if laws.len() == self.laws.len() {
            self.laws = laws;
        }
    }

    /// Solves δ + Y F(δ) = δ_free from the given `delta`; `compliance` is Y by rows. Writes `delta` and `forces`.
    ///
    /// # Errors
    /// Newton's method does not converge or meets a number that is not finite; the axle is named.
    pub fn solve(
        &mut self,
        compliance: &[f64],
        delta_free: &[f64],
        delta: &mut [f64],
        forces: &mut [f64],
    ) -> Result<usize, ContactError> {
        let n = self.laws.len();
        self.find_envelope(compliance);
        let mut norm = self.residual(compliance, delta_free, delta, forces);
        if !norm.is_finite() {
            return Err(self.not_finite());
        }
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
                correction = larger(correction, self.trial[i].abs());
                largest = larger(largest, delta[i].abs());
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
                return Err(self.not_finite());
            }
            if correction <= CORRECTION * largest {
                return Ok(iteration);
            }
        }
        let furthest = (0..n).max_by(|a, b| self.g[*a].abs().total_cmp(&self.g[*b].abs()));
        Err(ContactError::NotConverged { axle: furthest.unwrap_or(0), iterations: ITERATIONS })
    }

    /// The first axle whose equation is no number: the residual has met one.
    fn not_finite(&self) -> ContactError {
        ContactError::NotFinite { axle: self.g.iter().position(|g| !g.is_finite()).unwrap_or(0) }
    }

    /// Distant axles do not feel each other: the nonzero part of every row of Y.
    fn find_envelope(&mut self, compliance: &[f64]) {
        let n = self.laws.len();
        let negligible = FAR * (0..n).map(|i| compliance[i * n + i]).fold(0.0, larger);
        for (i, ((first, end), near)) in self.envelope.iter_mut().zip(&mut self.near).enumerate() {
            let row = &compliance[i * n..(i + 1) * n];
            *first = row[..i].iter().position(|y| *y != 0.0).unwrap_or(i);
            *end = row.iter().rposition(|y| *y != 0.0).map_or(n, |last| last + 1).max(i + 1);
            *near = row[..i].iter().position(|y| y.abs() > negligible).unwrap_or(i);
        }
    }

    /// Fills in g(δ) and F(δ); returns the largest |g|, which is NaN if one of them is.
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
            norm = larger(norm, self.g[i].abs());
        }
        norm
    }
}

#[cfg(test)]
mod tests {
    use ttb_scenario::types::{Contact, ContactLaw};

    use super::*;

    fn hertz(axles: usize) -> Contacts {
        let contact = Contact { law: ContactLaw::Hertz, wheels_per_axle: 2, ..Contact::default() };
        Contacts::new(vec![Law::new(&contact, 1.4e5); axles])
    }

    #[test]
    fn coupled_contacts_close_open_and_satisfy_their_equation() {
        let y = [2e-9, 5e-10, 1e-10, 5e-10, 2e-9, 5e-10, 1e-10, 5e-10, 2e-9];
        let free = [4e-4, -2e-4, 3e-4];
        for start in [1e-4, 0.0, -1e-3, 5e-3] {
            let (mut delta, mut forces) = ([start; 3], [0.0; 3]);
            let iterations = hertz(3).solve(&y, &free, &mut delta, &mut forces).unwrap();
            assert!(iterations <= 12, "{iterations} from {start}");
            assert_eq!(forces[1], 0.0);
            for i in 0..3 {
                let g = delta[i] + (0..3).map(|j| y[3 * i + j] * forces[j]).sum::<f64>() - free[i];
                assert!(g.abs() < 1e-18, "{g:e}");
            }
        }
    }

    /// Two cars that do not feel each other are solved together; a NaN of the first must not be passed over for the second.
    #[test]
    fn a_nan_in_any_axle_is_told_also_where_axles_do_not_feel_each_other() {
        for law in [ContactLaw::Hertz, ContactLaw::Linear] {
            for axle in 0..3 {
                let contact = Contact { law, ..Contact::default() };
                let mut contacts = Contacts::new(vec![Law::new(&contact, 1.4e5); 3]);
                let alone = [2e-9, 0.0, 0.0, 0.0, 2e-9, 0.0, 0.0, 0.0, 2e-9];
                for bad in [f64::NAN, f64::INFINITY] {
                    let mut free = [3e-4; 3];
                    free[axle] = bad;
                    let solved = contacts.solve(&alone, &free, &mut [1e-4; 3], &mut [0.0; 3]);
                    assert_eq!(solved, Err(ContactError::NotFinite { axle }), "{law:?}, free approach {bad}");
                    let mut y = alone;
                    y[4 * axle] = bad;
                    let solved = contacts.solve(&y, &[3e-4; 3], &mut [1e-4; 3], &mut [0.0; 3]);
                    assert_eq!(solved, Err(ContactError::NotFinite { axle }), "{law:?}, compliance {bad}");
                }
            }
        }
    }

    #[test]
    fn contacts_that_do_not_converge_name_the_axle() {
        // A compliance that is no compliance: negative, so that forces pull the wheels into the rail.
        let solved = hertz(2).solve(&[2e-9, 0.0, 0.0, -2e-7], &[3e-4; 2], &mut [1e-4; 2], &mut [0.0; 2]);
        let message = solved.expect_err("no contact").to_string();
        assert!(message.contains("wheel 2"), "{message}");
    }
}
