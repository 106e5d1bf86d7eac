//! Products of dense vectors, written so that the compiler vectorises them; the order of summation is fixed.

const LANES: usize = 8;

/// The inner product aᵀ b, in eight partial sums.
pub fn dot(a: &[f64], b: &[f64]) -> f64 {
    let (mut lanes, (a, b)) = ([0.0; LANES], (a.chunks_exact(LANES), b.chunks_exact(LANES)));
    let rest: f64 = a.remainder().iter().zip(b.remainder()).map(|(a, b)| a * b).sum();
    for (a, b) in a.zip(b) {
        for (lane, (a, b)) in lanes.iter_mut().zip(a.iter().zip(b)) {
            *lane += a * b;
        }
    }
    lanes.iter().sum::<f64>() + rest
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
