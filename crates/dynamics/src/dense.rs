//! A dense matrix to multiply with, by rows; the instruction set is chosen at run time (crate pulp). The order of summation
//! is fixed, so that results do not depend on it.

use pulp::Arch;

/// A matrix.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Dense {
    columns: usize,
    /// By rows.
    data: Vec<f64>,
}

const WIDE: usize = 8;

impl Dense {
    /// Zeros.
    pub fn zeros(rows: usize, columns: usize) -> Self {
        Self { columns, data: vec![0.0; rows * columns] }
    }

    /// From its numbers by rows.
    pub fn new(columns: usize, data: Vec<f64>) -> Self {
        Self { columns, data }
    }

    /// Number of rows.
    pub fn rows(&self) -> usize {
        self.data.len().checked_div(self.columns).unwrap_or(0)
    }

    /// Number of columns.
    pub fn columns(&self) -> usize {
        self.columns
    }

    /// All numbers by rows.
    pub fn data(&self) -> &[f64] {
        &self.data
    }

    /// A row.
    pub fn row(&self, i: usize) -> &[f64] {
        &self.data[i * self.columns..(i + 1) * self.columns]
    }

    /// A row, writable.
    pub fn row_mut(&mut self, i: usize) -> &mut [f64] {
        &mut self.data[i * self.columns..(i + 1) * self.columns]
    }

    /// y ← A x for several x at once; A is read once.
    pub fn multiply<const N: usize>(&self, x: [&[f64]; N], y: [&mut [f64]; N]) {
        let x = x.map(|x| &x[..self.columns]);
        let mut y = y;
        Arch::new().dispatch(|| {
            for (i, row) in self.data.chunks_exact(self.columns.max(1)).enumerate() {
                let sums = dots(row, x);
                y.iter_mut().zip(sums).for_each(|(y, sum)| y[i] = sum);
            }
        });
    }

    /// y ← y + Aᵀ x over the first rows, as many as `x` has numbers.
    pub fn add_transposed(&self, x: &[f64], y: &mut [f64]) {
        Arch::new().dispatch(|| {
            let y = &mut y[..self.columns];
            let mut rows = self.data.chunks_exact((4 * self.columns).max(1));
            let (fours, rest) = x.as_chunks::<4>();
            for x in fours {
                let Some(four) = rows.next() else { return };
                let (ab, cd) = four.split_at(2 * self.columns);
                let ((a, b), (c, d)) = (ab.split_at(self.columns), cd.split_at(self.columns));
                for ((((y, a), b), c), d) in y.iter_mut().zip(a).zip(b).zip(c).zip(d) {
                    *y += (a * x[0] + b * x[1]) + (c * x[2] + d * x[3]);
                }
            }
            for (k, x) in rest.iter().enumerate() {
                let row = self.row(4 * fours.len() + k);
                y.iter_mut().zip(row).for_each(|(y, a)| *y += a * x);
            }
        });
    }
}

#[inline(always)]
fn dots<const N: usize>(row: &[f64], x: [&[f64]; N]) -> [f64; N] {
    let mut lanes = [[0.0; WIDE]; N];
    let (chunks, rest) = row.as_chunks::<WIDE>();
    for (i, a) in chunks.iter().enumerate() {
        for (lanes, x) in lanes.iter_mut().zip(&x) {
            let x = &x[i * WIDE..(i + 1) * WIDE];
            (0..WIDE).for_each(|k| lanes[k] += a[k] * x[k]);
        }
    }
    let whole = WIDE * chunks.len();
    std::array::from_fn(|n| {
        let tail: f64 = rest.iter().zip(&x[n][whole..]).map(|(a, x)| a * x).sum();
        lanes[n].iter().sum::<f64>() + tail
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn products_of_every_shape() {
        for (rows, columns) in [(1, 1), (3, 8), (9, 21), (6, 40)] {
            let data: Vec<f64> = (0..rows * columns).map(|i| ((i * 7) % 13) as f64 - 6.0).collect();
            let a = Dense::new(columns, data.clone());
            let x: Vec<f64> = (0..columns).map(|j| j as f64 - 2.0).collect();
            let minus: Vec<f64> = x.iter().map(|x| -x).collect();
            let (mut y, mut z) = (vec![0.0; rows], vec![0.0; rows]);
            a.multiply([&x, &minus], [&mut y, &mut z]);
            for i in 0..rows {
                let expected: f64 = (0..columns).map(|j| data[i * columns + j] * x[j]).sum();
                assert_eq!((y[i], z[i]), (expected, -expected));
            }
            let mut back = vec![1.0; columns];
            a.add_transposed(&y, &mut back);
            for j in 0..columns {
                let expected: f64 = (0..rows).map(|i| data[i * columns + j] * y[i]).sum();
                assert_eq!(back[j], 1.0 + expected);
            }
        }
    }
}
