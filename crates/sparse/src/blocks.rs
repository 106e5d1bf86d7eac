//! Blocks of vectors, by columns: solutions for several right-hand sides, inner products.

use faer::linalg::matmul::matmul;
use faer::{Accum, Mat, MatRef, Par};

use crate::factor::Factor;
use crate::sweeps::{LANES, Which};

/// Every column x of the block ← A⁻¹ x.
pub fn solve(factor: &Factor, block: &mut [f64]) {
    solve_over(factor, block, None);
}

/// The same for columns that are zero but for the given degrees of freedom: the forward sweep then meets few panels.
pub fn solve_loads(factor: &Factor, block: &mut [f64], loaded: impl Iterator<Item = u32>) {
    let reach = factor.panels().map(|(pattern, _)| pattern.reach(loaded));
    solve_over(factor, block, reach.as_deref());
}

fn solve_over(factor: &Factor, block: &mut [f64], reach: Option<&[u32]>) {
    let Some((pattern, numbers)) = factor.panels() else {
        let n = factor.dimension();
        let mut scratch = vec![0.0; n];
        block.chunks_exact_mut(n).for_each(|x| factor.solve_in_place(x, &mut scratch));
        return;
    };
    let n = pattern.order.len();
    let groups = (block.len() / n).div_ceil(LANES);
    let (mut lanes, mut buffer) = (vec![0.0; groups * n * LANES], Vec::new());
    let member = |lane: usize, dof: u32| lane * n + dof as usize;
    for (group, lanes) in block.chunks(n * LANES).zip(lanes.chunks_exact_mut(n * LANES)) {
        for (y, &dof) in lanes.chunks_exact_mut(LANES).zip(&pattern.order) {
            (0..group.len() / n).for_each(|lane| y[lane] = group[member(lane, dof)]);
        }
    }
    pattern.forward_many(numbers, &mut lanes, &mut buffer, reach.map_or(Which::All, Which::Some));
    pattern.backward_many(numbers, &mut lanes, &mut buffer, Which::All);
    for (group, lanes) in block.chunks_mut(n * LANES).zip(lanes.chunks_exact(n * LANES)) {
        for (y, &dof) in lanes.chunks_exact(LANES).zip(&pattern.order) {
            (0..group.len() / n).for_each(|lane| group[member(lane, dof)] = y[lane]);
        }
    }
}

/// The inner products AᵀB of two blocks.
pub fn inner(a: MatRef<'_, f64>, b: MatRef<'_, f64>) -> Mat<f64> {
    // (BᵀA)ᵀ: half as much again quicker where B is narrow, as it is here.
    let mut product = Mat::zeros(b.ncols(), a.ncols());
    matmul(product.as_mut(), Accum::Replace, b.transpose(), a, 1.0, Par::Seq);
    product.transpose().to_owned()
}
