//! Lines of a mesh: coordinates between which elements lie.

/// Two lines closer than this are one, m.
pub(crate) const SAME: f64 = 1e-6;

/// A coordinate as it is written: micrometres.
pub(crate) fn rounded(v: f64) -> f64 {
    (v * 1e6).round() / 1e6 + 0.0 // no negative zero
}

/// Number of elements of about `size` between `a` and `b`.
fn parts(a: f64, b: f64, size: f64) -> usize {
    ((b - a).abs() / size).round().max(1.0) as usize
}

/// Number of lines that [`divide`] gives.
pub(crate) fn count(breaks: &[f64], size: f64) -> usize {
    1 + breaks.windows(2).map(|pair| parts(pair[0], pair[1], size)).sum::<usize>()
}

/// Lines through all `breaks` (ascending or descending), evenly between them, about `size` apart.
pub(crate) fn divide(breaks: &[f64], size: f64) -> Vec<f64> {
    let mut lines: Vec<f64> = breaks.first().map(|first| rounded(*first)).into_iter().collect();
    for pair in breaks.windows(2) {
        let [a, b] = [pair[0], pair[1]];
        let n = parts(a, b, size);
        // weights from both ends: mirrored breaks give mirrored lines
        lines.extend((1..=n).map(|i| rounded((a * (n - i) as f64 + b * i as f64) / n as f64)));
    }
    lines
}

/// Ascending, without those closer than [`SAME`] to the one before.
pub(crate) fn ordered(mut breaks: Vec<f64>) -> Vec<f64> {
    breaks.sort_by(f64::total_cmp);
    breaks.dedup_by(|a, b| (*a - *b).abs() < SAME);
    breaks
}

/// Place of the line nearest to `at`.
pub(crate) fn nearest(lines: &[f64], at: f64) -> usize {
    let distance = |i: &usize| (lines[*i] - at).abs();
    (0..lines.len()).min_by(|i, j| distance(i).total_cmp(&distance(j))).unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_pass_through_all_breaks_and_are_mirrored_with_them() {
        let lines = divide(&[-4.9, -2.2, 0.0, 2.2, 4.9], 0.53);
        assert_eq!(lines.len(), count(&[-4.9, -2.2, 0.0, 2.2, 4.9], 0.53));
        for at in [-4.9, -2.2, 0.0, 2.2, 4.9] {
            assert_eq!(lines[nearest(&lines, at)], at);
        }
        let mirrored: Vec<f64> = lines.iter().rev().map(|y| 0.0 - y).collect();
        assert_eq!(lines, mirrored);
    }
}
