//! A matrix whose numbers fade away from some columns on: of every row only runs of neighbouring columns are kept.
//!
//! Products are those of [`crate::dense::Dense`], in one pass and in a fixed order.

use pulp::{Arch, Simd, WithSimd};
use serde::{Deserialize, Serialize};

use crate::dense::dot;

/// A matrix by runs of columns; in single precision half as much is read from memory.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Near<T = f64> {
    columns: usize,
    /// Row i begins with these run and number, and ends where row i + 1 begins.
    rows: Vec<[u32; 2]>,
    /// First column and number of columns.
    runs: Vec<[u32; 2]>,
    /// Numbers, run by run.
    data: Vec<T>,
}

/// Shorter gaps between runs are filled.
const GAP: usize = 8;

impl Near {
    /// No rows yet, of so many columns.
    pub fn new(columns: usize) -> Self {
        Self { columns, rows: vec![[0; 2]], runs: Vec::new(), data: Vec::new() }
    }

    /// Adds a row; keeps the numbers of the columns that matter, and those in short gaps between them.
    pub fn push(&mut self, row: &[f64], mut matters: impl FnMut(usize) -> bool) {
        let mut run: Option<[usize; 2]> = None;
        for j in (0..row.len()).filter(|j| matters(*j)) {
            run = match run {
                Some([first, last]) if j - last <= GAP => Some([first, j]),
                other => {
                    self.keep(row, other);
                    Some([j, j])
                }
            };
        }
        self.keep(row, run);
        self.rows.push([self.runs.len() as u32, self.data.len() as u32]);
    }

    fn keep(&mut self, row: &[f64], run: Option<[usize; 2]>) {
        let Some([first, last]) = run else { return };
        self.runs.push([first as u32, (last + 1 - first) as u32]);
        self.data.extend_from_slice(&row[first..=last]);
    }

    /// The same matrix, rounded to single precision.
    pub fn single(&self) -> Near<f32> {
        let Self { columns, rows, runs, data } = self.clone();
        Near { columns, rows, runs, data: data.iter().map(|x| *x as f32).collect() }
    }
}

impl<T: Copy + Into<f64>> Near<T> {
    /// Number of rows.
    pub fn rows(&self) -> usize {
        self.rows.len().saturating_sub(1)
    }

    /// Number of columns.
    pub fn columns(&self) -> usize {
        self.columns
    }

    /// Number of numbers kept.
    pub fn kept(&self) -> usize {
        self.data.len()
    }

    /// Whether it has so many rows and columns, and its runs lie within them: true of all but damaged files.
    pub fn is_whole(&self, rows: usize, columns: usize) -> bool {
        let inside = self.runs.iter().all(|[first, length]| *first as usize + *length as usize <= columns);
        let follows = |pair: &[[u32; 2]]| {
            let runs = self.runs.get(pair[0][0] as usize..pair[1][0] as usize);
            runs.is_some_and(|runs| {
                runs.iter().map(|run| u64::from(run[1])).sum::<u64>() + u64::from(pair[0][1]) == u64::from(pair[1][1])
            })
        };
        let ends = [self.rows.first(), self.rows.last()].map(|end| end.map(|end| end.map(|at| at as usize)));
        let all = ends == [Some([0; 2]), Some([self.runs.len(), self.data.len()])];
        (self.rows(), self.columns) == (rows, columns) && inside && all && self.rows.windows(2).all(follows)
    }

    /// The numbers of a row that are kept, each with its column.
    pub fn row(&self, i: usize) -> impl Iterator<Item = (usize, f64)> {
        let [[first, number], [last, _]] = [self.rows[i], self.rows[i + 1]].map(|row| row.map(|at| at as usize));
        let columns =
            self.runs[first..last].iter().flat_map(|&[first, length]| first as usize..(first + length) as usize);
        columns.zip(self.data[number..].iter().map(|x| (*x).into()))
    }

    /// y ← A x.
    pub fn multiply(&self, x: &[f64], y: &mut [f64]) {
        let store = |i: usize, p: f64| {
            y[i] = p;
            []
        };
        self.fold(x, store, []);
    }

    /// As [`crate::dense::Dense::fold`]: for every row aᵢ p = aᵢ · x over the first columns, as many as `x` has numbers; then
    /// y ← y + w aᵢ for every w of `weights(i, p)` and its y, over the last columns, as many as that has numbers.
    pub fn fold<const N: usize>(&self, x: &[f64], weights: impl FnMut(usize, f64) -> [f64; N], y: [&mut [f64]; N]) {
        Arch::new().dispatch(Fold { matrix: self, x, weights, y });
    }
}

struct Fold<'a, T, W, const N: usize> {
    matrix: &'a Near<T>,
    x: &'a [f64],
    weights: W,
    y: [&'a mut [f64]; N],
}

impl<T: Copy + Into<f64>, W: FnMut(usize, f64) -> [f64; N], const N: usize> WithSimd for Fold<'_, T, W, N> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { matrix: Near { columns, rows, runs, data }, x, mut weights, mut y } = self;
        let mut rest = &data[..];
        for (i, bounds) in rows.windows(2).enumerate() {
            let runs = &runs[bounds[0][0] as usize..bounds[1][0] as usize];
            let (mut p, mut row) = (0.0, rest);
            for &[first, length] in runs {
                let (first, a) = (first as usize, &row[..length as usize]);
                let x = x.get(first..x.len().min(first + a.len())).unwrap_or(&[]);
                p += dot(a, x);
                row = &row[a.len()..];
            }
            let weights = weights(i, p);
            for &[first, length] in runs {
                let (a, after) = rest.split_at(length as usize);
                for (y, w) in y.iter_mut().zip(weights) {
                    // The column of the first number of y, and how many of the run's columns lie before it.
                    let begin = columns - y.len();
                    let skipped = begin.saturating_sub(first as usize).min(a.len());
                    let y = &mut y[(first as usize + skipped).saturating_sub(begin)..];
                    y.iter_mut().zip(&a[skipped..]).for_each(|(y, a)| *y += w * (*a).into());
                }
                rest = after;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dense::Dense;

    /// Rows with gaps, an empty one, and one that is full, against the dense product of the same numbers.
    #[test]
    fn products_are_those_of_the_dense_matrix() {
        let (rows, columns) = (7, 53);
        let kept = |i: usize, j: usize| i == 5 || (i != 3 && (j + 11 * i) % 29 < 7 && j % 13 != 4);
        let number = |i: usize, j: usize| if kept(i, j) { ((i * 31 + j * 17) % 23) as f64 - 11.0 } else { 0.0 };
        let mut near = Near::new(columns);
        for i in 0..rows {
            near.push(&(0..columns).map(|j| number(i, j)).collect::<Vec<_>>(), |j| kept(i, j));
        }
        assert!(near.is_whole(rows, columns) && !near.is_whole(rows, columns - 1) && near.kept() < rows * columns);
        let data = (0..rows).flat_map(|i| (0..columns).map(move |j| (i, j)));
        let dense = Dense::new(columns, data.map(|(i, j)| number(i, j)).collect());
        let x: Vec<f64> = (0..columns).map(|j| ((j * 7) % 19) as f64 - 9.0).collect();
        for first in [0, 20, columns] {
            for last in [1, 30, columns] {
                let start = || (vec![1.0; columns], vec![2.0; last], Vec::new());
                let (mut found, mut expected) = (start(), start());
                let weights = |seen: &mut Vec<f64>, p: f64| {
                    seen.push(p);
                    [p + 1.0, 2.0]
                };
                let (all, end, seen) = &mut expected;
                dense.fold(&x[..first], |_, p| weights(seen, p), [all, end]);
                let (all, end, seen) = &mut found;
                near.single().fold(&x[..first], |_, p| weights(seen, p), [all, end]);
                assert_eq!(found, expected, "{first} {last}");
            }
        }
        let mut y = vec![0.0; rows];
        near.multiply(&x, &mut y);
        assert_eq!(y, (0..rows).map(|i| near.row(i).map(|(j, a)| a * x[j]).sum::<f64>()).collect::<Vec<_>>());
    }
}
