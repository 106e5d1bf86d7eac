//! A dense matrix and its factors: all the linear algebra an interface Jacobian needs.

/// P A = L U of a square matrix, rows contiguous.
#[derive(Debug)]
pub struct Lu {
    n: usize,
    /// L below the diagonal (ones on it left out), U on and above.
    a: Vec<f64>,
    /// Row i was exchanged with row `pivots[i]`, in the order of i.
    pivots: Vec<usize>,
}

impl Lu {
    /// Factors `a` (n × n, row by row) with partial pivoting; `None` if it is singular or not finite.
    pub fn new(n: usize, mut a: Vec<f64>) -> Option<Self> {
        let mut pivots = vec![0; n];
        for k in 0..n {
            let size = |i: usize| a[i * n + k].abs();
            let pivot = (k..n).max_by(|i, j| size(*i).total_cmp(&size(*j)))?;
            if !(size(pivot) > 0.0 && size(pivot).is_finite()) {
                return None;
            }
            pivots[k] = pivot;
            if pivot != k {
                let (upper, lower) = a.split_at_mut(pivot * n);
                upper[k * n..(k + 1) * n].swap_with_slice(&mut lower[..n]);
            }
            let (upper, lower) = a.split_at_mut((k + 1) * n);
            let top = &upper[k * n..];
            for row in lower.chunks_exact_mut(n) {
                let factor = row[k] / top[k];
                row[k] = factor;
                if factor != 0.0 {
                    row[k + 1..].iter_mut().zip(&top[k + 1..]).for_each(|(x, t)| *x -= factor * t);
                }
            }
        }
        Some(Self { n, a, pivots })
    }

    /// x ← A⁻¹ x.
    pub fn solve(&self, x: &mut [f64]) {
        let n = self.n;
        self.pivots.iter().enumerate().for_each(|(i, p)| x.swap(i, *p));
        for i in 1..n {
            let (known, rest) = x.split_at_mut(i);
            rest[0] -= dot(&self.a[i * n..i * n + i], known);
        }
        for i in (0..n).rev() {
            let (head, known) = x.split_at_mut(i + 1);
            head[i] = (head[i] - dot(&self.a[i * n + i + 1..(i + 1) * n], known)) / self.a[i * n + i];
        }
    }
}

/// a · b, in four sums that a processor adds side by side.
pub fn dot(a: &[f64], b: &[f64]) -> f64 {
    let mut sums = [0.0; 4];
    let (a4, b4) = (a.chunks_exact(4), b.chunks_exact(4));
    let rest: f64 = a4.remainder().iter().zip(b4.remainder()).map(|(x, y)| x * y).sum();
    for (x, y) in a4.zip(b4) {
        for i in 0..4 {
            sums[i] += x[i] * y[i];
        }
    }
    sums.iter().sum::<f64>() + rest
}

/// |a|₂.
pub fn norm(a: &[f64]) -> f64 {
    dot(a, a).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_matrix_that_needs_pivoting_is_solved() {
        let a = vec![0.0, 2.0, 1.0, 1.0, 1.0, 0.0, 4.0, 0.0, 3.0];
        let x = [1.0, -2.0, 3.0];
        let mut b: Vec<f64> = a.chunks_exact(3).map(|row| dot(row, &x)).collect();
        Lu::new(3, a).expect("regular").solve(&mut b);
        assert!(b.iter().zip(x).all(|(b, x)| (b - x).abs() < 1e-14), "{b:?}");
    }

    #[test]
    fn a_singular_matrix_is_refused() {
        assert!(Lu::new(2, vec![1.0, 2.0, 2.0, 4.0]).is_none());
        assert!(Lu::new(1, vec![f64::NAN]).is_none());
    }
}
