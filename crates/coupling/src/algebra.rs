//! Sums over vectors, and a dense matrix with its factors: all the linear algebra the iteration and an interface Jacobian
//! need.

use pulp::{Arch, Simd, WithSimd};

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

/// Numbers added side by side: a sum alone waits for itself. As many whatever the CPU, so that results do not depend on it.
const LANES: usize = 16;

/// Σ term(a_i, b_i, …) over the length of the shortest, in the instructions of the CPU at hand.
pub fn sum<const K: usize>(of: [&[f64]; K], term: impl Fn([f64; K]) -> f64) -> f64 {
    Arch::new().dispatch(Sum { of, term })
}

struct Sum<'a, F, const K: usize> {
    of: [&'a [f64]; K],
    term: F,
}

impl<F: Fn([f64; K]) -> f64, const K: usize> WithSimd for Sum<'_, F, K> {
    type Output = f64;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> f64 {
        let n = self.of.iter().map(|a| a.len()).min().unwrap_or(0);
        let of = self.of.map(|a| a[..n].as_chunks::<LANES>());
        let mut sums = [0.0; LANES];
        for i in 0..n / LANES {
            let of = of.map(|(chunks, _)| &chunks[i]);
            for (lane, sum) in sums.iter_mut().enumerate() {
                *sum += (self.term)(of.map(|a| a[lane]));
            }
        }
        let rest = (0..n % LANES).map(|i| (self.term)(of.map(|(_, rest)| rest[i])));
        sums.iter().sum::<f64>() + rest.sum::<f64>()
    }
}

/// out_i = term(a_i, b_i, …) over the length of the shortest, in the instructions of the CPU at hand.
pub fn each<const K: usize>(out: &mut [f64], of: [&[f64]; K], term: impl Fn([f64; K]) -> f64) {
    Arch::new().dispatch(Each { out, of, term });
}

struct Each<'a, F, const K: usize> {
    out: &'a mut [f64],
    of: [&'a [f64]; K],
    term: F,
}

impl<F: Fn([f64; K]) -> f64, const K: usize> WithSimd for Each<'_, F, K> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let n = self.of.iter().map(|a| a.len()).fold(self.out.len(), usize::min);
        let (out, of) = (&mut self.out[..n], self.of.map(|a| &a[..n]));
        for (i, out) in out.iter_mut().enumerate() {
            *out = (self.term)(of.map(|a| a[i]));
        }
    }
}

/// a · b.
pub fn dot(a: &[f64], b: &[f64]) -> f64 {
    sum([a, b], |[x, y]| x * y)
}

/// The first number that is NaN or infinite.
pub fn not_finite(a: &[f64]) -> Option<usize> {
    // 0 · x is zero for all others.
    if sum([a], |[x]| 0.0 * x) == 0.0 { None } else { a.iter().position(|x| !x.is_finite()) }
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
    fn the_one_number_that_is_not_finite_is_found() {
        for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            for at in 0..21 {
                let mut a = vec![f64::MAX; 21];
                assert_eq!(not_finite(&a), None);
                a[at] = bad;
                assert_eq!(not_finite(&a), Some(at));
            }
        }
    }

    #[test]
    fn a_singular_matrix_is_refused() {
        assert!(Lu::new(2, vec![1.0, 2.0, 2.0, 4.0]).is_none());
        assert!(Lu::new(1, vec![f64::NAN]).is_none());
    }
}
