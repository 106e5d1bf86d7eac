//! The two triangular sweeps over a supernodal factor, L y = b and Lᵀ x = y, for one right-hand side or several in
//! lockstep.
//!
//! ```text
//! panel of columns a … b:   [ D ]   lower triangle, dense          forward    y_a = D⁻¹ y_a,   y_r −= R y_a
//!                           [ R ]   rows r further down, dense     backward   x_a = D⁻ᵀ (y_a − Rᵀ x_r)
//! ```
//!
//! A step of a large bridge is bound by reading L once in either sweep. So each panel is read front to back, four columns
//! at a time, against a short buffer that stays in the first-level cache; the instruction set is chosen at run time (crate
//! pulp). Several right-hand sides stand interleaved, [`LANES`] numbers to a row, and share the traffic.

use pulp::{Arch, Simd, WithSimd};

/// Right-hand sides in a group of [`Panels::forward_many`] and [`Panels::backward_many`].
pub const LANES: usize = 8;

/// A supernodal factor, lent.
#[derive(Clone, Copy)]
pub struct Panels<'a> {
    /// First column of every panel, and the end of the last.
    pub columns: &'a [u32],
    /// Where every panel's rows R begin in `rows`, and the end.
    pub row_starts: &'a [u32],
    /// Rows R, by panels.
    pub rows: &'a [u32],
    /// Where every panel's numbers begin in `values`, and the end.
    pub value_starts: &'a [usize],
    /// The panels, each by columns, D above R.
    pub values: &'a [f64],
    /// 1/diagonal of L.
    pub inverse_diagonal: &'a [f64],
}

/// Panels in ascending order: all, or some.
#[derive(Clone, Copy)]
pub enum Which<'a> {
    /// All.
    All,
    /// These.
    Some(&'a [u32]),
}

impl Which<'_> {
    fn len(self, all: usize) -> usize {
        match self {
            Self::All => all,
            Self::Some(panels) => panels.len(),
        }
    }

    #[inline(always)]
    fn at(self, i: usize) -> usize {
        match self {
            Self::All => i,
            Self::Some(panels) => panels[i] as usize,
        }
    }
}

/// A sweep as pulp wants it: what is in [`WithSimd::with_simd`] is compiled for the CPU at hand, a closure may not be.
struct Sweep<'a, const FORWARD: bool, const MANY: bool> {
    panels: &'a Panels<'a>,
    y: &'a mut [f64],
    buffer: &'a mut [f64],
    which: Which<'a>,
}

impl<const FORWARD: bool, const MANY: bool> WithSimd for Sweep<'_, FORWARD, MANY> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self { panels, y, buffer, which } = self;
        let (count, n) = (which.len(panels.count()), panels.inverse_diagonal.len());
        for i in 0..count {
            let s = which.at(if FORWARD { i } else { count - 1 - i });
            match (FORWARD, MANY) {
                (true, false) => panels.forward_panel(s, y, buffer),
                (false, false) => panels.backward_panel(simd, s, y, buffer),
                (true, true) => groups(y, n).for_each(|y| panels.forward_panel_many(simd, s, y, buffer)),
                (false, true) => groups(y, n).for_each(|y| panels.backward_panel_many(simd, s, y, buffer)),
            }
        }
    }
}

impl<'a> Panels<'a> {
    fn count(&self) -> usize {
        self.columns.len() - 1
    }

    /// First column, width, rows R, numbers.
    #[inline(always)]
    fn panel(&self, s: usize) -> (usize, usize, &'a [u32], &'a [f64]) {
        let begin = self.columns[s] as usize;
        let rows = &self.rows[self.row_starts[s] as usize..self.row_starts[s + 1] as usize];
        let values = &self.values[self.value_starts[s]..self.value_starts[s + 1]];
        (begin, self.columns[s + 1] as usize - begin, rows, values)
    }

    /// y ← L⁻¹ y over `which` panels; `buffer` holds as much as the highest panel has rows.
    pub fn forward(&self, y: &mut [f64], buffer: &mut [f64], which: Which) {
        Arch::new().dispatch(Sweep::<true, false> { panels: self, y, buffer, which });
    }

    /// y ← L⁻ᵀ y over `which` panels, from the last to the first.
    pub fn backward(&self, y: &mut [f64], buffer: &mut [f64], which: Which) {
        Arch::new().dispatch(Sweep::<false, false> { panels: self, y, buffer, which });
    }

    #[inline(always)]
    fn forward_panel(&self, s: usize, y: &mut [f64], buffer: &mut [f64]) {
        let (begin, width, rows, values) = self.panel(s);
        let height = width + rows.len();
        let buffer = &mut buffer[..height];
        buffer[..width].copy_from_slice(&y[begin..begin + width]);
        buffer[width..].fill(0.0);
        let mut j = 0;
        while j + 4 <= width {
            let c: [&[f64]; 4] = std::array::from_fn(|k| &values[(j + k) * height..(j + k + 1) * height]);
            let x = lower(&c, &self.inverse_diagonal[begin + j..], &mut buffer[j..j + 4], j);
            let tail = &mut buffer[j + 4..];
            let [a, b, c, d] = c.map(|column| &column[j + 4..][..tail.len()]);
            for ((((t, a), b), c), d) in tail.iter_mut().zip(a).zip(b).zip(c).zip(d) {
                *t -= (a * x[0] + b * x[1]) + (c * x[2] + d * x[3]);
            }
            j += 4;
        }
        while j < width {
            let column = &values[j * height..(j + 1) * height];
            let x = buffer[j] * self.inverse_diagonal[begin + j];
            buffer[j] = x;
            let tail = &mut buffer[j + 1..];
            tail.iter_mut().zip(&column[j + 1..]).for_each(|(t, l)| *t -= l * x);
            j += 1;
        }
        y[begin..begin + width].copy_from_slice(&buffer[..width]);
        for (&row, t) in rows.iter().zip(&buffer[width..]) {
            y[row as usize] += t;
        }
    }

    #[inline(always)]
    fn backward_panel<S: Simd>(&self, simd: S, s: usize, y: &mut [f64], buffer: &mut [f64]) {
        let (begin, width, rows, values) = self.panel(s);
        let height = width + rows.len();
        let buffer = &mut buffer[..height];
        buffer[..width].copy_from_slice(&y[begin..begin + width]);
        for (t, &row) in buffer[width..].iter_mut().zip(rows) {
            *t = y[row as usize];
        }
        let (head, tail) = buffer.split_at_mut(width);
        // Rᵀ x_r first, front to back as the memory likes it; D is then still near.
        let mut j = 0;
        while j + 4 <= width {
            let sums = dots(simd, below(values, height, width, j), tail);
            head[j..j + 4].iter_mut().zip(sums).for_each(|(x, sum)| *x -= sum);
            j += 4;
        }
        while j < width {
            head[j] -= dot(&values[j * height + width..(j + 1) * height], tail);
            j += 1;
        }
        while j > 0 {
            j -= 1;
            let (x, below) = head[j..].split_at_mut(1);
            let sum = dot(&values[j * height + j + 1..j * height + width], below);
            x[0] = (x[0] - sum) * self.inverse_diagonal[begin + j];
        }
        y[begin..begin + width].copy_from_slice(&buffer[..width]);
    }
}

/// The same for groups of [`LANES`] right-hand sides, one group after the other, row i of all its members in
/// `y[i * LANES..]`; `buffer` holds LANES times as much. While a panel is near, it serves all groups.
impl Panels<'_> {
    /// Y ← L⁻¹ Y over `which` panels.
    pub fn forward_many(&self, y: &mut [f64], buffer: &mut [f64], which: Which) {
        Arch::new().dispatch(Sweep::<true, true> { panels: self, y, buffer, which });
    }

    /// Y ← L⁻ᵀ Y over `which` panels, from the last to the first.
    pub fn backward_many(&self, y: &mut [f64], buffer: &mut [f64], which: Which) {
        Arch::new().dispatch(Sweep::<false, true> { panels: self, y, buffer, which });
    }

    #[inline(always)]
    fn forward_panel_many<S: Simd>(&self, simd: S, s: usize, y: &mut [[f64; LANES]], buffer: &mut [f64]) {
        let (begin, width, rows, values) = self.panel(s);
        let height = width + rows.len();
        let (buffer, _) = buffer.as_chunks_mut::<LANES>();
        let buffer = &mut buffer[..height];
        buffer[..width].copy_from_slice(&y[begin..begin + width]);
        buffer[width..].fill([0.0; LANES]);
        let (head, tail) = buffer.split_at_mut(width);
        for j in 0..width {
            let column = &values[j * height..j * height + width];
            let (x, below) = head[j..].split_at_mut(1);
            let x = &mut x[0];
            x.iter_mut().for_each(|x| *x *= self.inverse_diagonal[begin + j]);
            below.iter_mut().zip(&column[j + 1..]).for_each(|(t, l)| subtract(simd, t, *l, x));
        }
        let mut j = 0;
        while j + 4 <= width {
            let [a, b, c, d] = below(values, height, width, j);
            let &[p, q, r, s] = &head[j..j + 4] else { break };
            for ((((t, a), b), c), d) in tail.iter_mut().zip(a).zip(b).zip(c).zip(d) {
                subtract(simd, t, *a, &p);
                subtract(simd, t, *b, &q);
                subtract(simd, t, *c, &r);
                subtract(simd, t, *d, &s);
            }
            j += 4;
        }
        for j in j..width {
            let column = &values[j * height + width..(j + 1) * height];
            tail.iter_mut().zip(column).for_each(|(t, l)| subtract(simd, t, *l, &head[j]));
        }
        y[begin..begin + width].copy_from_slice(head);
        for (&row, t) in rows.iter().zip(&*tail) {
            y[row as usize].iter_mut().zip(t).for_each(|(y, t)| *y += t);
        }
    }

    #[inline(always)]
    fn backward_panel_many<S: Simd>(&self, simd: S, s: usize, y: &mut [[f64; LANES]], buffer: &mut [f64]) {
        let (begin, width, rows, values) = self.panel(s);
        let height = width + rows.len();
        let (buffer, _) = buffer.as_chunks_mut::<LANES>();
        let (head, tail) = buffer[..height].split_at_mut(width);
        head.copy_from_slice(&y[begin..begin + width]);
        tail.iter_mut().zip(rows).for_each(|(t, &row)| *t = y[row as usize]);
        let mut j = 0;
        while j + 4 <= width {
            let [a, b, c, d] = below(values, height, width, j);
            let [mut p, mut q, mut r, mut s] = [[0.0; LANES]; 4];
            for ((((t, a), b), c), d) in tail.iter().zip(a).zip(b).zip(c).zip(d) {
                subtract(simd, &mut p, *a, t);
                subtract(simd, &mut q, *b, t);
                subtract(simd, &mut r, *c, t);
                subtract(simd, &mut s, *d, t);
            }
            for (x, sum) in head[j..j + 4].iter_mut().zip([p, q, r, s]) {
                x.iter_mut().zip(sum).for_each(|(x, sum)| *x += sum);
            }
            j += 4;
        }
        for j in j..width {
            let column = &values[j * height + width..(j + 1) * height];
            tail.iter().zip(column).for_each(|(t, l)| subtract(simd, &mut head[j], *l, t));
        }
        for j in (0..width).rev() {
            let column = &values[j * height..j * height + width];
            let (x, below) = head[j..].split_at_mut(1);
            below.iter().zip(&column[j + 1..]).for_each(|(t, l)| subtract(simd, &mut x[0], *l, t));
            x[0].iter_mut().for_each(|x| *x *= self.inverse_diagonal[begin + j]);
        }
        y[begin..begin + width].copy_from_slice(head);
    }
}

/// Groups of [`LANES`] right-hand sides with n rows.
#[inline(always)]
fn groups(y: &mut [f64], n: usize) -> impl Iterator<Item = &mut [[f64; LANES]]> {
    y.as_chunks_mut().0.chunks_exact_mut(n)
}

/// R of the columns j … j + 3 of a panel.
#[inline(always)]
fn below(values: &[f64], height: usize, width: usize, j: usize) -> [&[f64]; 4] {
    std::array::from_fn(|k| &values[(j + k) * height + width..(j + k + 1) * height])
}

/// y ← y − l x.
#[inline(always)]
fn subtract<S: Simd>(simd: S, y: &mut [f64; LANES], l: f64, x: &[f64; LANES]) {
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
fn lower(c: &[&[f64]; 4], inverse: &[f64], x: &mut [f64], j: usize) -> [f64; 4] {
    for k in 0..4 {
        x[k] *= inverse[k];
        for i in k + 1..4 {
            x[i] -= c[k][j + i] * x[k];
        }
    }
    [x[0], x[1], x[2], x[3]]
}

const WIDE: usize = 4;

#[inline(always)]
fn dot(a: &[f64], b: &[f64]) -> f64 {
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
fn dots<S: Simd>(simd: S, columns: [&[f64]; 4], t: &[f64]) -> [f64; 4] {
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
