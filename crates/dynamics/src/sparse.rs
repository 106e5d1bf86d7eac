//! Sparse symmetric matrices of a finite-element model: K and M assembled on one common pattern.
//!
//! Only the lower triangle is stored, by columns, the diagonal first. Because K and M share the pattern, every
//! combination c_K K + c_M M that a time integrator or an eigenvalue solver factorises has it too: the ordering and the
//! symbolic factorisation are made once, see [`Pencil::factor`].

use std::sync::Arc;

use faer::sparse::{SparseColMatRef, SymbolicSparseColMat};

use crate::factor::{Factor, FactorError, Symbolic};

/// Collects element matrices.
#[derive(Clone, Debug, Default)]
pub struct Assembly {
    n: usize,
    entries: Vec<Entry>,
}

#[derive(Clone, Copy, Debug)]
struct Entry {
    column: u32,
    row: u32,
    k: f64,
    m: f64,
    c: f64,
}

impl Assembly {
    /// An empty system of `n` degrees of freedom.
    pub fn new(n: usize) -> Self {
        Self { n, entries: Vec::new() }
    }

    /// Adds an element's K and M (row by row, `dofs.len()` squared); fixed degrees of freedom are `None` and eliminated.
    pub fn add<'a, R: AsRef<[f64]> + 'a>(
        &mut self,
        dofs: &[Option<u32>],
        stiffness: impl IntoIterator<Item = &'a R>,
        mass: impl IntoIterator<Item = &'a R>,
    ) {
        for ((&row, k), m) in dofs.iter().zip(stiffness).zip(mass) {
            let Some(row) = row else { continue };
            for ((&column, &k), &m) in dofs.iter().zip(k.as_ref()).zip(m.as_ref()) {
                if let Some(column) = column.filter(|c| *c <= row) {
                    self.entries.push(Entry { column, row, k, m, c: 0.0 });
                }
            }
        }
    }

    /// Adds a dashpot's C (row by row, `dofs.len()` squared); fixed degrees of freedom are `None` and eliminated.
    pub fn add_damping<'a, R: AsRef<[f64]> + 'a>(
        &mut self,
        dofs: &[Option<u32>],
        damping: impl IntoIterator<Item = &'a R>,
    ) {
        for (&row, c) in dofs.iter().zip(damping) {
            let Some(row) = row else { continue };
            for (&column, &c) in dofs.iter().zip(c.as_ref()) {
                if let Some(column) = column.filter(|c| *c <= row) {
                    self.entries.push(Entry { column, row, k: 0.0, m: 0.0, c });
                }
            }
        }
    }

    /// Sums what fell on the same place, in the order it was added, and analyses the pattern.
    ///
    /// # Errors
    /// [`FactorError::Symbolic`].
    pub fn finish(mut self) -> Result<Pencil, FactorError> {
        let n = self.n;
        // The diagonal is always there, also of a degree of freedom that no element holds: its pivot tells.
        self.entries.extend((0..n as u32).map(|i| Entry { column: i, row: i, k: 0.0, m: 0.0, c: 0.0 }));
        self.entries.sort_by_key(|e| (e.column, e.row));
        let (mut starts, mut rows, mut k, mut m) = (vec![0_u32; n + 1], Vec::new(), Vec::new(), Vec::new());
        let mut last = None;
        for e in self.entries {
            if last == Some((e.column, e.row)) {
                // `last` is set, so both vectors have a last entry.
                k.last_mut().into_iter().for_each(|k| *k += e.k);
                m.last_mut().into_iter().for_each(|m| *m += e.m);
            } else {
                starts[e.column as usize + 1] += 1;
                rows.push(e.row);
                k.push(e.k);
                m.push(e.m);
            }
            last = Some((e.column, e.row));
        }
        (0..n).for_each(|j| starts[j + 1] += starts[j]);
        let pattern = SymbolicSparseColMat::new_checked(n, n, starts, None, rows);
        let symbolic = Arc::new(Symbolic::new(pattern.as_ref())?);
        Ok(Pencil { pattern, k, m, symbolic })
    }
}

/// K and M on one pattern.
#[derive(Clone, Debug)]
pub struct Pencil {
    pattern: SymbolicSparseColMat<u32>,
    k: Vec<f64>,
    m: Vec<f64>,
    symbolic: Arc<Symbolic>,
}

impl Pencil {
    /// Number of degrees of freedom.
    pub fn ndof(&self) -> usize {
        self.pattern.ncols()
    }
    /// y ← y + K x.
    pub fn add_stiffness(&self, x: &[f64], y: &mut [f64]) {
        add_product(&self.pattern, &self.k, x, y);
    }
    /// y ← y + M x.
    pub fn add_mass(&self, x: &[f64], y: &mut [f64]) {
        add_product(&self.pattern, &self.m, x, y);
    }

    /// Factorises c_K K + c_M M.
    ///
    /// # Errors
    /// It is not positive definite.
    pub fn factor(&self, c_k: f64, c_m: f64) -> Result<Factor, FactorError> {
        let values = self.combine(c_k, c_m);
        Factor::positive(&self.symbolic, SparseColMatRef::new(self.pattern.as_ref(), &values))
    }

    /// How many eigenvalues ω² of K φ = ω² M φ lie below `sigma`: the negative pivots of K − σM (Sylvester's law of
    /// inertia; Parlett, The Symmetric Eigenvalue Problem, 1998, section 3.3). `None` when σ hits one exactly.
    pub fn count_below(&self, sigma: f64) -> Option<usize> {
        let values = self.combine(1.0, -sigma);
        let factor = Factor::indefinite(&self.symbolic, SparseColMatRef::new(self.pattern.as_ref(), &values)).ok()?;
        Some(factor.negative_pivots())
    }

    fn combine(&self, c_k: f64, c_m: f64) -> Vec<f64> {
        self.k.iter().zip(&self.m).map(|(k, m)| c_k * k + c_m * m).collect()
    }
}

fn add_product(pattern: &SymbolicSparseColMat<u32>, values: &[f64], x: &[f64], y: &mut [f64]) {
    let (starts, rows) = (pattern.col_ptr(), pattern.row_idx());
    for (j, &xj) in x.iter().enumerate() {
        let column = starts[j] as usize..starts[j + 1] as usize;
        let mut entries = rows[column.clone()].iter().zip(&values[column]);
        let mut yj = entries.next().map_or(0.0, |(_, diagonal)| diagonal * xj);
        for (&i, a) in entries {
            y[i as usize] += a * xj;
            yj += a * x[i as usize];
        }
        y[j] += yj;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A chain of unit springs and masses, fixed at the left.
    fn chain(n: u32) -> Pencil {
        let mut assembly = Assembly::new(n as usize);
        for i in 0..n {
            let dofs = [i.checked_sub(1), Some(i)];
            assembly.add(&dofs, &[[1.0, -1.0], [-1.0, 1.0]], &[[0.0, 0.0], [0.0, 1.0]]);
        }
        assembly.finish().unwrap()
    }

    #[test]
    fn a_solve_undoes_a_product() {
        let chain = chain(7);
        let x: Vec<f64> = (0..7).map(|i| f64::from(i * i) - 3.0).collect();
        let mut y = vec![0.0; 7];
        chain.add_stiffness(&x, &mut y);
        chain.add_mass(&x, &mut y);
        let factor = chain.factor(1.0, 1.0).unwrap();
        factor.solve_in_place(&mut y, &mut [0.0; 7]);
        assert!(x.iter().zip(&y).all(|(x, y)| (x - y).abs() < 1e-12));
    }

    #[test]
    fn inertia_counts_eigenvalues() {
        // ω_j² = 4 sin²((2j − 1)π/(4n + 2)).
        let (chain, n) = (chain(9), 9.0);
        for j in 1..=9 {
            let omega = 2.0 * ((2.0 * f64::from(j) - 1.0) * std::f64::consts::PI / (4.0 * n + 2.0)).sin();
            assert_eq!(chain.count_below(omega * omega * 1.001), Some(j as usize));
            assert_eq!(chain.count_below(omega * omega * 0.999), Some(j as usize - 1));
        }
    }

    #[test]
    fn a_loose_degree_of_freedom_is_found() {
        let mut assembly = Assembly::new(3);
        assembly.add(&[Some(0), Some(2)], &[[1.0, -1.0], [-1.0, 1.0]], &[[1.0, 0.0], [0.0, 1.0]]);
        let free = assembly.finish().unwrap().factor(1.0, 0.0).unwrap_err();
        assert!(matches!(free, FactorError::NotPositive { .. }));
    }
}
