//! The sum of many waves at all points of a period at once, by halves (Cooley & Tukey, Math. Comp. 19, 1965):
//!
//! ```text
//! y_n = Σ_k z_k e^{2πi kn/N},   n = 0 … N − 1,   N a power of two
//! ```
//!
//! It is written out here because libraries take their sines from the operating system, and so differ between systems in
//! the last digit. With the sines of the crate libm, and additions in a fixed order, the sum has the same bits everywhere.

use std::f64::consts::TAU;

/// Real and imaginary part.
pub type Complex = [f64; 2];

/// y from z, in its place; the length must be a power of two.
pub fn sum(z: &mut [Complex]) {
    let n = z.len();
    if n < 2 {
        return;
    }
    let unused = usize::BITS - n.trailing_zeros();
    for i in 0..n {
        let j = i.reverse_bits() >> unused;
        if i < j {
            z.swap(i, j);
        }
    }
    let root = |j: usize| {
        let (sin, cos) = libm::sincos(TAU * j as f64 / n as f64);
        [cos, sin]
    };
    let roots: Vec<Complex> = (0..n / 2).map(root).collect();
    let mut half = 1;
    while half < n {
        for block in z.chunks_exact_mut(2 * half) {
            let (even, odd) = block.split_at_mut(half);
            for ((a, b), w) in even.iter_mut().zip(odd).zip(roots.iter().step_by(n / 2 / half)) {
                let turned = [w[0] * b[0] - w[1] * b[1], w[0] * b[1] + w[1] * b[0]];
                (*a, *b) = ([a[0] + turned[0], a[1] + turned[1]], [a[0] - turned[0], a[1] - turned[1]]);
            }
        }
        half *= 2;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_length_has_the_sum_that_is_written_out() {
        for n in [1, 2, 4, 64] {
            let z: Vec<Complex> = (0..n).map(|k| [(k as f64 + 0.3).sin(), (2.0 * k as f64).cos()]).collect();
            let mut y = z.clone();
            sum(&mut y);
            for (at, y) in y.iter().enumerate() {
                let expected = z.iter().enumerate().fold([0.0, 0.0], |sum, (k, z)| {
                    let (sin, cos) = (TAU * (at * k % n) as f64 / n as f64).sin_cos();
                    [sum[0] + z[0] * cos - z[1] * sin, sum[1] + z[0] * sin + z[1] * cos]
                });
                assert!((0..2).all(|i| (y[i] - expected[i]).abs() < 1e-13), "{n}, {at}: {y:?}, {expected:?}");
            }
        }
    }
}
