//! Blocks of vectors, by columns: solutions for several right-hand sides, inner products.

use faer::linalg::matmul::matmul;
use faer::{Accum, Mat, MatRef, Par};

use crate::factor::Factor;
use crate::sweeps::{LANES, Which};

/// Every column x of the block ← A⁻¹ x.
pub fn solve(factor: &Factor, block: &mut [f64]) {
    let Some((pattern, numbers)) = factor.panels() else {
        let n = factor.dimension();
        let mut scratch = vec![0.0; n];
        block.chunks_exact_mut(n).for_each(|x| factor.solve_in_place(x, &mut scratch));
        return;
    };
    let n = pattern.order.len();
    let (mut lanes, mut buffer) = (vec![0.0; n * LANES], Vec::new());
    for group in block.chunks_mut(n * LANES) {
        let width = group.len() / n;
        for (y, &dof) in lanes.chunks_exact_mut(LANES).zip(&pattern.order) {
            (0..width).for_each(|lane| y[lane] = group[lane * n + dof as usize]);
        }
        pattern.forward_many(numbers, &mut lanes, &mut buffer, Which::All);
        pattern.backward_many(numbers, &mut lanes, &mut buffer, Which::All);
        for (y, &dof) in lanes.chunks_exact(LANES).zip(&pattern.order) {
            (0..width).for_each(|lane| group[lane * n + dof as usize] = y[lane]);
        }
    }
}

/// AᵀB.
pub fn inner(a: MatRef<'_, f64>, b: MatRef<'_, f64>) -> Mat<f64> {
    let mut product = Mat::zeros(a.ncols(), b.ncols());
    matmul(product.as_mut(), Accum::Replace, a.transpose(), b, 1.0, Par::Seq);
    product
}
