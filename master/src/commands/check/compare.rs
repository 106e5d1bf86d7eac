//! Runs compared, output by output.

use super::plan::Plan;

/// The largest difference between two runs beyond rounding: which output, and both values. `rounding` is relative to the output's
/// largest value in either.
pub fn differ(plan: &Plan, a: &[Vec<f64>], b: &[Vec<f64>], rounding: f64) -> Option<String> {
    let random = plan.random.borrow();
    let outputs = (0..plan.outputs.len()).filter(|i| !random[*i]);
    let all = outputs.filter_map(|i| off(a, b, i, rounding).map(|found| (i, found)));
    let worst = all.max_by(|(_, (a, _)), (_, (b, _))| a.total_cmp(b));
    worst.map(|(i, (_, k))| format!("{} is {:e} and {:e} after step {}", plan.name(i), a[k][i], b[k][i], k + 1))
}

/// By how much output i of two runs differs beyond rounding, relative to its largest value, and where. Equal numbers of
/// different bits do not differ, and neither do numbers that are next to nothing.
fn off(a: &[Vec<f64>], b: &[Vec<f64>], i: usize, rounding: f64) -> Option<(f64, usize)> {
    let size = |run: &[Vec<f64>]| run.iter().map(|y| y[i].abs()).fold(0.0, f64::max);
    let scale = size(a).max(size(b)).max(f64::MIN_POSITIVE / rounding);
    let mut worst: Option<(f64, usize)> = None;
    for (k, (x, y)) in a.iter().zip(b).enumerate() {
        let (x, y) = (x[i], y[i]);
        let error = if x == y || (x.is_nan() && y.is_nan()) { 0.0 } else { (x - y).abs() / scale };
        let error = if error.is_nan() { f64::INFINITY } else { error };
        if error > rounding && worst.is_none_or(|(most, _)| error > most) {
            worst = Some((error, k));
        }
    }
    worst
}

/// Leaves outputs out of all comparisons that differ between two runs which should be equal.
pub fn leave_out(plan: &Plan, a: &[Vec<f64>], b: &[Vec<f64>]) {
    let mut random = plan.random.borrow_mut();
    random.iter_mut().enumerate().for_each(|(i, random)| *random |= off(a, b, i, 1e-12).is_some());
}

#[cfg(test)]
mod tests {
    use super::off;

    #[test]
    fn equal_numbers_do_not_differ_whatever_their_bits() {
        let run = |x: f64| vec![vec![x, 1.0]];
        let other_nan = f64::from_bits(f64::NAN.to_bits() | 1);
        for (x, y) in
            [(0.0, -0.0), (f64::NAN, other_nan), (0.0, 5e-324), (1.0, 1.0 + 1e-15), (f64::INFINITY, f64::INFINITY)]
        {
            assert_eq!(off(&run(x), &run(y), 0, 1e-12), None, "{x:e} {y:e}");
        }
        for (x, y) in [
            (0.0, 1e-300),
            (1.0, 1.0 + 1e-9),
            (f64::NAN, 1.0),
            (f64::INFINITY, 1.0),
            (f64::INFINITY, f64::NEG_INFINITY),
        ] {
            assert!(off(&run(x), &run(y), 0, 1e-12).is_some(), "{x:e} {y:e}");
        }
    }
}
