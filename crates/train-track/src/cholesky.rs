//! Cholesky's method on a small dense matrix with an envelope, in place: Newton's matrix of the contacts.

/// b ← A⁻¹ b by Cholesky; row i of A's lower triangle, which is overwritten, begins with column `begin[i]`. A is I plus a
/// positive semidefinite matrix.
pub fn solve_positive_definite(a: &mut [f64], begin: &[usize], b: &mut [f64]) {
    let n = b.len();
    for i in 0..n {
        let first = begin[i];
        let (above, row) = a.split_at_mut(i * n);
        for j in first..i {
            let from = first.max(begin[j]);
            let pivot_row = &above[j * n..j * n + j + 1];
            let sum: f64 = row[from..j].iter().zip(&pivot_row[from..]).map(|(x, y)| x * y).sum();
            row[j] = (row[j] - sum) * pivot_row[j];
        }
        let sum: f64 = row[first..i].iter().map(|x| x * x).sum();
        // The diagonal holds 1/l_ii.
        row[i] = 1.0 / (row[i] - sum).sqrt();
        let sum: f64 = row[first..i].iter().zip(&b[first..]).map(|(x, y)| x * y).sum();
        b[i] = (b[i] - sum) * row[i];
    }
    for i in (0..n).rev() {
        b[i] *= a[i * n + i];
        let (bi, first) = (b[i], begin[i]);
        b[first..i].iter_mut().zip(&a[i * n + first..i * n + i]).for_each(|(b, l)| *b -= l * bi);
    }
}
