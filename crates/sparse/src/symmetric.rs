//! Sparse symmetric matrices to multiply with.

use crate::entries::Entry;
use crate::sweeps::{LANES, add};

/// A sparse symmetric matrix to multiply with: lower triangle by columns, without zeros.
#[derive(Clone, Debug)]
pub(crate) struct Symmetric {
    starts: Vec<u32>,
    rows: Vec<u32>,
    values: Vec<f64>,
}

impl Symmetric {
    /// From sorted entries, their numbers in `k`.
    pub fn new(n: usize, entries: impl Iterator<Item = Entry>) -> Self {
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
    pub fn entries(&self) -> impl Iterator<Item = (u32, u32, f64)> {
        let Self { starts, rows, values } = self;
        let columns = starts.windows(2).zip(0..);
        columns.flat_map(move |(ends, j)| {
            let column = ends[0] as usize..ends[1] as usize;
            rows[column.clone()].iter().zip(&values[column]).map(move |(&i, &value)| (i, j, value))
        })
    }

    /// No entries.
    pub fn is_empty(&self) -> bool {
        self.values.is_empty()
    }

    /// y ← y + A x.
    pub fn add_product(&self, x: &[f64], y: &mut [f64]) {
        add_product(&self.starts, &self.rows, &self.values, x, y);
    }
}

/// A symmetric matrix to multiply several vectors with.
#[derive(Clone, Debug)]
pub struct Product(pub(crate) Symmetric);

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

/// y ← y + A x of a lower triangle by columns.
pub(crate) fn add_product(starts: &[u32], rows: &[u32], values: &[f64], x: &[f64], y: &mut [f64]) {
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
