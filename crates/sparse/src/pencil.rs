//! K, M and C of a finite-element model on one common pattern.
//!
//! Only the lower triangle is stored, by columns, the diagonal first. Because they share the pattern, every
//! combination c_K K + c_M M + c_C C that a time integrator or an eigenvalue solver factorises has it too: the ordering and the
//! symbolic factorisation are made once, see [`Pencil::factor`].

use std::collections::HashMap;

use faer::sparse::{SparseColMatRef, SymbolicSparseColMat};

use crate::entries::{Entry, merged};
use crate::error::FactorError;
use crate::factor::Factor;
use crate::symbolic::Symbolic;
use crate::symmetric::{Product, Symmetric, add_product};

/// K, M and the dashpots' C on one pattern.
#[derive(Clone, Debug)]
pub struct Pencil {
    pub(crate) pattern: SymbolicSparseColMat<u32>,
    pub(crate) k: Vec<f64>,
    pub(crate) m: Vec<f64>,
    pub(crate) mass: Symmetric,
    pub(crate) damping: Symmetric,
    pub(crate) symbolic: Symbolic,
}

impl Pencil {
    /// Number of degrees of freedom.
    pub fn ndof(&self) -> usize {
        self.pattern.ncols()
    }
    /// Entries of the common pattern, lower triangle.
    pub fn entries(&self) -> usize {
        self.k.len()
    }
    /// y ← y + K x.
    pub fn add_stiffness(&self, x: &[f64], y: &mut [f64]) {
        add_product(self.pattern.col_ptr(), self.pattern.row_idx(), &self.k, x, y);
    }
    /// y ← y + M x.
    pub fn add_mass(&self, x: &[f64], y: &mut [f64]) {
        self.mass.add_product(x, y);
    }
    /// The product M x.
    pub(crate) fn mass_times(&self, x: &[f64]) -> Vec<f64> {
        let mut y = vec![0.0; x.len()];
        self.add_mass(x, &mut y);
        y
    }
    /// f − K x, every sum carried in twice the precision.
    pub fn residual(&self, load: &[f64], x: &[f64]) -> Vec<f64> {
        let mut sums: Vec<[f64; 2]> = load.iter().map(|f| [*f, 0.0]).collect();
        for (i, j, k) in self.stiffness_entries() {
            take_product(&mut sums[i], k, x[j]);
            if i != j {
                take_product(&mut sums[j], k, x[i]);
            }
        }
        sums.into_iter().map(|[sum, rest]| sum + rest).collect()
    }
    /// The sum |x|ᵀ|K||x| of the magnitudes of all terms of the strain energy, twice.
    pub fn stiffness_of_magnitudes(&self, x: &[f64]) -> f64 {
        let term = |(i, j, k): (usize, usize, f64)| if i == j { 1.0 } else { 2.0 } * (k * x[i] * x[j]).abs();
        self.stiffness_entries().map(term).sum()
    }
    /// What errors of K's entries make of twice the strain energy, root of the sum of squares.
    ///
    /// ```text
    /// √(Σ_g (f(|g|) Σ_ij ±x_i x_j)²)     over all numbers g, and all entries K_ij = ±g
    /// ```
    ///
    /// f is the error's standard deviation. Entries of the same amount have the same error: elements that are alike were
    /// rounded alike.
    pub fn stiffness_errors(&self, x: &[f64], f: impl Fn(f64) -> f64) -> f64 {
        let mut groups: HashMap<u64, f64> = HashMap::new();
        for (i, j, k) in self.stiffness_entries() {
            let term = if i == j { 1.0 } else { 2.0 } * x[i] * x[j];
            *groups.entry(k.abs().to_bits()).or_default() += term * k.signum();
        }
        // In a fixed order, so that the sum does not depend on that of the map.
        let mut groups: Vec<(u64, f64)> = groups.into_iter().collect();
        groups.sort_unstable_by_key(|(bits, _)| *bits);
        groups.into_iter().map(|(bits, sum)| (f(f64::from_bits(bits)) * sum).powi(2)).sum::<f64>().sqrt()
    }
    /// Row, column and number of every entry of K's lower triangle.
    fn stiffness_entries(&self) -> impl Iterator<Item = (usize, usize, f64)> {
        let (starts, rows) = (self.pattern.col_ptr(), self.pattern.row_idx());
        (0..self.ndof()).flat_map(move |j| {
            let column = starts[j] as usize..starts[j + 1] as usize;
            rows[column.clone()].iter().zip(&self.k[column]).map(move |(&i, &k)| (i as usize, j, k))
        })
    }
    /// Whether there are dashpots.
    pub fn has_dashpots(&self) -> bool {
        !self.damping.is_empty()
    }
    /// y ← y + C x, C of the dashpots alone.
    pub fn add_damping(&self, x: &[f64], y: &mut [f64]) {
        self.damping.add_product(x, y);
    }
    /// M over degrees of freedom in another order, number i becoming `position[i]`, for several vectors at once.
    pub fn mass_in(&self, position: &[u32]) -> Product {
        let moved = self.mass.entries().map(|(i, j, m)| {
            let [i, j] = [i, j].map(|dof| position[dof as usize]);
            Entry { column: i.min(j), row: i.max(j), k: m, m: 0.0 }
        });
        let entries = merged(moved.collect());
        Product(Symmetric::new(self.ndof(), entries.into_iter()))
    }
    /// The order of elimination, once found, for `Layout::order`; `None` where a small model makes its own.
    pub fn order(&self) -> Option<&[u32]> {
        self.symbolic.order()
    }

    /// Factorises c_K K + c_M M + c_C C.
    ///
    /// # Errors
    /// It is not positive definite.
    pub fn factor(&self, c_k: f64, c_m: f64, c_c: f64) -> Result<Factor, FactorError> {
        let mut values = self.combine(c_k, c_m);
        if c_c != 0.0 {
            self.add_to_pattern(c_c, &mut values);
        }
        Factor::positive(&self.symbolic, SparseColMatRef::new(self.pattern.as_ref(), &values))
    }

    /// How many eigenvalues ω² of K φ = ω² M φ lie below `sigma`: the negative pivots of K − σM (Sylvester's law of
    /// inertia; Parlett, The Symmetric Eigenvalue Problem, 1998, section 3.3). `None` when σ hits one exactly.
    pub fn count_below(&self, sigma: f64) -> Option<usize> {
        let values = self.combine(1.0, -sigma);
        self.symbolic.count_negative(SparseColMatRef::new(self.pattern.as_ref(), &values)).ok()
    }

    fn combine(&self, c_k: f64, c_m: f64) -> Vec<f64> {
        self.k.iter().zip(&self.m).map(|(k, m)| c_k * k + c_m * m).collect()
    }

    /// values ← values + factor C.
    fn add_to_pattern(&self, factor: f64, values: &mut [f64]) {
        let (starts, rows) = (self.pattern.col_ptr(), self.pattern.row_idx());
        for (i, j, c) in self.damping.entries() {
            let column = starts[j as usize] as usize..starts[j as usize + 1] as usize;
            if let Ok(at) = rows[column.clone()].binary_search(&i) {
                values[column.start + at] += factor * c;
            }
        }
    }
}

/// sum ← sum − a x with its rounding errors (two-product by fused multiplication, two-sum of Knuth).
fn take_product([sum, rest]: &mut [f64; 2], a: f64, x: f64) {
    let product = -(a * x);
    let lost = (-a).mul_add(x, -product);
    let total = *sum + product;
    let part = total - *sum;
    *rest += (*sum - (total - part)) + (product - part) + lost;
    *sum = total;
}
