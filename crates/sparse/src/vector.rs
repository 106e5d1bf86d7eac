//! Products of dense vectors, written so that the compiler vectorises them; the order of summation is fixed.

/// a · x in so many partial sums, which are added in their order: one order of summation on every processor.
#[inline(always)]
pub fn dot_in<const SUMS: usize, T: Copy + Into<f64>>(a: &[T], x: &[f64]) -> f64 {
    let ((chunks, rest), (x, x_rest)) = (a.as_chunks::<SUMS>(), x.as_chunks::<SUMS>());
    let mut sums = [0.0; SUMS];
    for (a, x) in chunks.iter().zip(x) {
        (0..SUMS).for_each(|k| sums[k] += a[k].into() * x[k]);
    }
    sums.iter().sum::<f64>() + rest.iter().zip(x_rest).map(|(a, x)| (*a).into() * x).sum::<f64>()
}

/// The inner product aᵀ b, in eight partial sums.
pub fn dot(a: &[f64], b: &[f64]) -> f64 {
    dot_in::<8, f64>(a, b)
}

/// y ← y + factor x.
pub fn add_scaled(factor: f64, x: &[f64], y: &mut [f64]) {
    y.iter_mut().zip(x).for_each(|(y, x)| *y += factor * x);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_length_is_summed() {
        for n in 0..40 {
            let x: Vec<f64> = (1..=n).map(f64::from).collect();
            let mut y = x.clone();
            assert_eq!(dot(&x, &y), f64::from(n * (n + 1) * (2 * n + 1)) / 6.0);
            add_scaled(2.0, &x, &mut y);
            assert!(y.iter().zip(&x).all(|(y, x)| *y == 3.0 * x));
        }
    }
}
