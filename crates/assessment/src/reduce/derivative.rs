//! Accelerations of points whose velocities alone are known.
//!
//! ```text
//! d_{i+1/2} = (v_{i+1} − v_i)/h = (a_i + a_{i+1})/2        Newmark's method, γ = 1/2: the mean of two accelerations
//! a_i ≈ 5/8 (d_{i−1/2} + d_{i+1/2}) − 1/8 (d_{i−3/2} + d_{i+3/2})
//! ```
//!
//! The sum undoes the mean up to (ωh/2)⁴: at 30 Hz and 1 ms by 8e-5.

/// a of velocities at equal steps of `h` s; as many values.
pub fn acceleration(velocity: &[f64], h: f64) -> Vec<f64> {
    let n = velocity.len();
    let d: Vec<f64> = velocity.windows(2).map(|pair| (pair[1] - pair[0]) / h).collect();
    let (Some(first), Some(last)) = (d.first(), d.last()) else { return vec![0.0; n] };
    // Beyond the ends the first and the last difference go on.
    let at = |k: isize| match usize::try_from(k) {
        Err(_) => *first,
        Ok(k) => d.get(k).copied().unwrap_or(*last),
    };
    let value = |i: isize| 0.625 * (at(i - 1) + at(i)) - 0.125 * (at(i - 2) + at(i + 1));
    (0..n as isize).map(value).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn velocities_of_newmarks_method_give_its_accelerations() {
        let (h, w) = (1e-3, 2.0 * std::f64::consts::PI * 30.0);
        let a: Vec<f64> = (0..2000).map(|i| (w * h * f64::from(i)).sin()).collect();
        let mut v = vec![0.0];
        a.windows(2).for_each(|pair| v.push(v[v.len() - 1] + 0.5 * h * (pair[0] + pair[1])));
        let found = acceleration(&v, h);
        let worst = (2..1998).map(|i| (found[i] - a[i]).abs()).fold(0.0, f64::max);
        assert!(worst < 1e-4, "{worst}");
        assert_eq!((found.len(), acceleration(&[1.0], h)), (2000, vec![0.0]));
    }
}
