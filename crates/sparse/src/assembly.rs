//! Assembly of element matrices.

use faer::sparse::SymbolicSparseColMat;

use crate::entries::{Entry, columns_of, merged};
use crate::error::FactorError;
use crate::order::layout::Layout;
use crate::pencil::Pencil;
use crate::symbolic::Symbolic;
use crate::symmetric::Symmetric;

/// Collects element matrices.
#[derive(Clone, Debug, Default)]
pub struct Assembly {
    n: usize,
    entries: Vec<Entry>,
    /// Of C, its numbers in `k`.
    damping: Vec<Entry>,
}

impl Assembly {
    /// An empty system of `n` degrees of freedom.
    pub fn new(n: usize) -> Self {
        Self { n, ..Self::default() }
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
                    self.entries.push(Entry { column, row, k, m });
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
                    self.add_entry_of_damping(row, column, c);
                }
            }
        }
    }

    /// Adds one entry of K and M in the lower triangle, `row` ≥ `column`.
    pub fn add_entry(&mut self, row: u32, column: u32, k: f64, m: f64) {
        self.entries.push(Entry { column, row, k, m });
    }

    /// Adds one entry of C in the lower triangle, `row` ≥ `column`.
    pub fn add_entry_of_damping(&mut self, row: u32, column: u32, c: f64) {
        self.damping.push(Entry { column, row, k: c, m: 0.0 });
    }

    /// Number of degrees of freedom.
    pub fn ndof(&self) -> usize {
        self.n
    }

    /// Sums what fell on the same place and analyses the pattern; degrees of freedom are ordered one by one.
    ///
    /// # Errors
    /// [`FactorError::Symbolic`].
    pub fn finish(self) -> Result<Pencil, FactorError> {
        self.finish_with(&Layout::default())
    }

    /// Sums what fell on the same place and analyses the pattern.
    ///
    /// # Errors
    /// [`FactorError::Symbolic`].
    pub fn finish_with(mut self, layout: &Layout) -> Result<Pencil, FactorError> {
        let n = self.n as u32;
        let nothing = |column, row| Entry { column, row, k: 0.0, m: 0.0 };
        // C shares the pattern. The diagonal is always there, also of a degree of freedom that no element holds: its
        // pivot tells.
        self.entries.extend(self.damping.iter().map(|e| nothing(e.column, e.row)));
        self.entries.extend((0..n).map(|i| nothing(i, i)));
        let entries = merged(self.entries);
        let damping = merged(self.damping);
        let (starts, rows) = columns_of(self.n, &entries);
        let k = entries.iter().map(|e| e.k).collect();
        let m = entries.iter().map(|e| e.m).collect();
        let mass = Symmetric::new(self.n, entries.into_iter().map(|e| Entry { k: e.m, ..e }));
        let damping = Symmetric::new(self.n, damping.into_iter());
        let pattern = SymbolicSparseColMat::new_checked(self.n, self.n, starts, None, rows);
        let symbolic = Symbolic::new(pattern.as_ref(), layout)?;
        Ok(Pencil { pattern, k, m, mass, damping, symbolic })
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
        let factor = chain.factor(1.0, 1.0, 0.0).unwrap();
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
        let free = assembly.finish().unwrap().factor(1.0, 0.0, 0.0).unwrap_err();
        assert!(matches!(free, FactorError::NotPositive { .. }));
    }
}
