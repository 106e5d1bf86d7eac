//! The innermost loops of the sweeps: sums of products over few numbers, and rows of interleaved right-hand sides.

use pulp::Simd;

/// Right-hand sides that stand interleaved.
pub const LANES: usize = 8;

/// y ← y − l x.
#[inline(always)]
pub(super) fn subtract<S: Simd>(simd: S, y: &mut [f64; LANES], l: f64, x: &[f64; LANES]) {
    add(simd, y, -l, x);
}

/// y ← y + a x.
#[inline(always)]
pub(crate) fn add<S: Simd>(simd: S, y: &mut [f64; LANES], a: f64, x: &[f64; LANES]) {
    let ((y, _), (x, _), a) = (S::as_mut_simd_f64s(y), S::as_simd_f64s(x), simd.splat_f64s(a));
    y.iter_mut().zip(x).for_each(|(y, x)| *y = simd.mul_add_e_f64s(a, *x, *y));
}

/// Solves with the lower triangle of four columns at rows j … j + 3.
#[inline(always)]
pub(super) fn lower(c: &[&[f64]; 4], inverse: &[f64], x: &mut [f64], j: usize) -> [f64; 4] {
    for k in 0..4 {
        x[k] *= inverse[k];
        for i in k + 1..4 {
            x[i] -= c[k][j + i] * x[k];
        }
    }
    [x[0], x[1], x[2], x[3]]
}

const WIDE: usize = 4;

/// a · b in four partial sums, which are added in pairs, on every processor.
#[inline(always)]
pub(super) fn dot(a: &[f64], b: &[f64]) -> f64 {
    let (x, x_rest) = a.as_chunks::<WIDE>();
    let (y, y_rest) = b.as_chunks::<WIDE>();
    let mut lanes = [0.0; WIDE];
    for (x, y) in x.iter().zip(y) {
        (0..WIDE).for_each(|k| lanes[k] += x[k] * y[k]);
    }
    let rest: f64 = x_rest.iter().zip(y_rest).map(|(a, b)| a * b).sum();
    (lanes[0] + lanes[1]) + (lanes[2] + lanes[3]) + rest
}

/// Four columns against one vector.
#[inline(always)]
pub(super) fn dots<S: Simd>(simd: S, columns: [&[f64]; 4], t: &[f64]) -> [f64; 4] {
    let (t, t_rest) = S::as_simd_f64s(t);
    let [a, b, c, d] = columns.map(|column| S::as_simd_f64s(column).0);
    let mut lanes = [simd.splat_f64s(0.0); 4];
    for ((((t, a), b), c), d) in t.iter().zip(a).zip(b).zip(c).zip(d) {
        for (lanes, l) in lanes.iter_mut().zip([a, b, c, d]) {
            *lanes = simd.mul_add_e_f64s(*l, *t, *lanes);
        }
    }
    let rests = columns.map(|column| &column[column.len() - t_rest.len()..]);
    std::array::from_fn(|k| {
        let rest: f64 = rests[k].iter().zip(t_rest).map(|(l, t)| l * t).sum();
        simd.reduce_sum_f64s(lanes[k]) + rest
    })
}
