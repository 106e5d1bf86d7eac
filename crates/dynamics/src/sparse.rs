//! Sparse symmetric matrices of a finite-element model: K, M and C assembled on one common pattern.
//!
//! Only the lower triangle is stored, by columns, the diagonal first. Because they share the pattern, every
//! combination c_K K + c_M M + c_C C that a time integrator or an eigenvalue solver factorises has it too: the ordering and the
//! symbolic factorisation are made once, see [`Pencil::factor`].

use faer::sparse::{SparseColMatRef, SymbolicSparseColMat};

use crate::factor::{Factor, FactorError, Layout, Symbolic};
use crate::sweeps::{LANES, add};

/// Collects element matrices.
#[derive(Clone, Debug, Default)]
pub struct Assembly {
    n: usize,
    entries: Vec<Entry>,
    /// Of C, its numbers in `k`.
    damping: Vec<Entry>,
}

#[derive(Clone, Copy, Debug)]
struct Entry {
    column: u32,
    row: u32,
    k: f64,
    m: f64,
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

/// Sorted by columns, one entry a place.
fn merged(mut entries: Vec<Entry>) -> Vec<Entry> {
    entries.sort_by_key(|e| (e.column, e.row));
    entries.dedup_by(|next, kept| {
        let same = (next.column, next.row) == (kept.column, kept.row);
        if same {
            kept.k += next.k;
            kept.m += next.m;
        }
        same
    });
    entries.shrink_to_fit();
    entries
}

/// Starts of the columns, and rows, of sorted entries.
fn columns_of(n: usize, entries: &[Entry]) -> (Vec<u32>, Vec<u32>) {
    let mut starts = vec![0_u32; n + 1];
    entries.iter().for_each(|e| starts[e.column as usize + 1] += 1);
    (0..n).for_each(|j| starts[j + 1] += starts[j]);
    (starts, entries.iter().map(|e| e.row).collect())
}

/// A sparse symmetric matrix to multiply with: lower triangle by columns, without zeros.
#[derive(Clone, Debug)]
struct Symmetric {
    starts: Vec<u32>,
    rows: Vec<u32>,
    values: Vec<f64>,
}

impl Symmetric {
    /// From sorted entries, their numbers in `k`.
    fn new(n: usize, entries: impl Iterator<Item = Entry>) -> Self {
        let mut this = Self { starts: vec![0; n + 1], rows: Vec::new(), values: Vec::new() };
        for e in entries.filter(|e| e.k != 0.0) {
            this.starts[e.column as usize + 1] += 1;
            this.rows.push(e.row);
            this.values.push(e.k);
        }
        (0..n).for_each(|j| this.starts[j + 1] += this.starts[j]);
        this
    }

    /// Row, column, number of every entry, by columns.
    fn entries(&self) -> impl Iterator<Item = (u32, u32, f64)> {
        let Self { starts, rows, values } = self;
        let columns = starts.windows(2).zip(0..);
        columns.flat_map(move |(ends, j)| {
            let column = ends[0] as usize..ends[1] as usize;
            rows[column.clone()].iter().zip(&values[column]).map(move |(&i, &value)| (i, j, value))
        })
    }

    /// y ← y + A x.
    fn add_product(&self, x: &[f64], y: &mut [f64]) {
        add_product(&self.starts, &self.rows, &self.values, x, y);
    }
}

/// A symmetric matrix to multiply several vectors with.
#[derive(Clone, Debug)]
pub struct Product(Symmetric);

impl Product {
    /// Y ← Y + A X for groups of [`LANES`] vectors side by side, one group after the other.
    pub fn add_many(&self, x: &[f64], y: &mut [f64]) {
        let n = self.0.starts.len() - 1;
        let groups = x.as_chunks().0.chunks_exact(n).zip(y.as_chunks_mut().0.chunks_exact_mut(n));
        groups.for_each(|(x, y)| pulp::Arch::new().dispatch(Many { matrix: &self.0, x, y }));
    }
}

struct Many<'a> {
    matrix: &'a Symmetric,
    x: &'a [[f64; LANES]],
    y: &'a mut [[f64; LANES]],
}

impl pulp::WithSimd for Many<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, simd: S) {
        let Self { matrix: Symmetric { starts, rows, values }, x, y } = self;
        for (j, xj) in x.iter().enumerate() {
            let column = starts[j] as usize..starts[j + 1] as usize;
            let mut yj = y[j];
            for (&i, a) in rows[column.clone()].iter().zip(&values[column]) {
                if i as usize != j {
                    add(simd, &mut y[i as usize], *a, xj);
                }
                add(simd, &mut yj, *a, &x[i as usize]);
            }
            y[j] = yj;
        }
    }
}

/// The numbers of a [`Pencil`], to be stored.
#[derive(Clone, Debug, serde::Serialize, serde::Deserialize)]
pub struct Raw {
    /// Starts of the columns of the lower triangle, and its end.
    pub starts: Vec<u32>,
    /// Rows, the diagonal first in each column.
    pub rows: Vec<u32>,
    /// K.
    pub k: Vec<f64>,
    /// M.
    pub m: Vec<f64>,
    /// Entries (row, column, number) of C by columns.
    pub damping: Vec<(u32, u32, f64)>,
    /// Order of elimination; empty for small models.
    pub order: Vec<u32>,
}

/// K, M and the dashpots' C on one pattern.
#[derive(Clone, Debug)]
pub struct Pencil {
    pattern: SymbolicSparseColMat<u32>,
    k: Vec<f64>,
    m: Vec<f64>,
    mass: Symmetric,
    damping: Symmetric,
    symbolic: Symbolic,
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
    /// Whether there are dashpots.
    pub fn has_dashpots(&self) -> bool {
        !self.damping.values.is_empty()
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
    /// The order of elimination, once found, for [`Layout::order`]; `None` where a small model makes its own.
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

    /// Everything, to be stored.
    pub fn raw(&self) -> Raw {
        let order = self.order().unwrap_or_default().to_vec();
        let (starts, rows) = (self.pattern.col_ptr().to_vec(), self.pattern.row_idx().to_vec());
        Raw { starts, rows, k: self.k.clone(), m: self.m.clone(), damping: self.damping.entries().collect(), order }
    }

    /// From what was stored.
    ///
    /// # Errors
    /// [`FactorError::Symbolic`]: the numbers are no lower triangle with its diagonal.
    pub fn from_raw(raw: Raw) -> Result<Self, FactorError> {
        let Raw { starts, rows, k, m, damping, order } = raw;
        let n = starts.len().saturating_sub(1);
        let broken = |why: &str| FactorError::Symbolic(format!("stored matrices: {why}"));
        if starts.first() != Some(&0) || starts[n] as usize != rows.len() || [k.len(), m.len()] != [rows.len(); 2] {
            return Err(broken("lengths differ"));
        }
        let column = |j: usize| rows.get(starts[j] as usize..starts[j + 1] as usize);
        let sound = |j: usize| {
            column(j).is_some_and(|c| {
                c.first() == Some(&(j as u32)) && c.is_sorted_by(|a, b| a < b) && c.iter().all(|i| (*i as usize) < n)
            })
        };
        if !(0..n).all(sound) {
            return Err(broken("a column is no column of a lower triangle"));
        }
        let mut known = vec![false; n];
        for dof in &order {
            known.get_mut(*dof as usize).into_iter().for_each(|known| *known = true);
        }
        if !order.is_empty() && (order.len() != n || !known.iter().all(|known| *known)) {
            return Err(broken("the order is no permutation"));
        }
        let entry = |(row, column, k): (u32, u32, f64)| Entry { column, row, k, m: 0.0 };
        if damping.iter().any(|&(i, j, _)| (j as usize) >= n || !column(j as usize).is_some_and(|c| c.contains(&i))) {
            return Err(broken("an entry of C is off the pattern"));
        }
        let damping = Symmetric::new(n, damping.into_iter().map(entry));
        let by_columns = (0..n).flat_map(|j| (starts[j] as usize..starts[j + 1] as usize).map(move |at| (at, j)));
        let masses = by_columns.map(|(at, j)| Entry { column: j as u32, row: rows[at], k: m[at], m: 0.0 });
        let mass = Symmetric::new(n, masses);
        let pattern = SymbolicSparseColMat::new_checked(n, n, starts, None, rows);
        let symbolic = Symbolic::new(pattern.as_ref(), &Layout { order, ..Layout::default() })?;
        Ok(Self { pattern, k, m, mass, damping, symbolic })
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

fn add_product(starts: &[u32], rows: &[u32], values: &[f64], x: &[f64], y: &mut [f64]) {
    for (j, &xj) in x.iter().enumerate() {
        let column = starts[j] as usize..starts[j + 1] as usize;
        let mut yj = 0.0;
        for (&i, a) in rows[column.clone()].iter().zip(&values[column]) {
            if i as usize == j {
                y[j] += a * xj;
            } else {
                y[i as usize] += a * xj;
                yj += a * x[i as usize];
            }
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
