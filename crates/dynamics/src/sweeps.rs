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

use pulp::Arch;

/// Right-hand sides that [`Panels::forward_many`] and [`Panels::backward_many`] take at once.
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
        Arch::new().dispatch(|| {
            for i in 0..which.len(self.count()) {
                self.forward_panel(which.at(i), y, buffer);
            }
        });
    }

    /// y ← L⁻ᵀ y over `which` panels, from the last to the first.
    pub fn backward(&self, y: &mut [f64], buffer: &mut [f64], which: Which) {
        Arch::new().dispatch(|| {
            for i in (0..which.len(self.count())).rev() {
                self.backward_panel(which.at(i), y, buffer);
            }
        });
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
    fn backward_panel(&self, s: usize, y: &mut [f64], buffer: &mut [f64]) {
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
            let c: [&[f64]; 4] = std::array::from_fn(|k| &values[(j + k) * height + width..(j + k + 1) * height]);
            let sums = dots(c, tail);
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

/// The same for [`LANES`] right-hand sides, row i of all in `y[i * LANES..]`; `buffer` holds LANES times as much.
impl Panels<'_> {
    /// Y ← L⁻¹ Y over `which` panels.
    pub fn forward_many(&self, y: &mut [f64], buffer: &mut [f64], which: Which) {
        Arch::new().dispatch(|| {
            for i in 0..which.len(self.count()) {
                self.forward_panel_many(which.at(i), y, buffer);
            }
        });
    }

    /// Y ← L⁻ᵀ Y over `which` panels, from the last to the first.
    pub fn backward_many(&self, y: &mut [f64], buffer: &mut [f64], which: Which) {
        Arch::new().dispatch(|| {
            for i in (0..which.len(self.count())).rev() {
                self.backward_panel_many(which.at(i), y, buffer);
            }
        });
    }

    #[inline(always)]
    fn forward_panel_many(&self, s: usize, y: &mut [f64], buffer: &mut [f64]) {
        let (begin, width, rows, values) = self.panel(s);
        let height = width + rows.len();
        let (y, _) = y.as_chunks_mut::<LANES>();
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
            below.iter_mut().zip(&column[j + 1..]).for_each(|(t, l)| subtract(t, *l, x));
        }
        // R X by four rows and then one: their sums stay in registers.
        let mut i = 0;
        while i + 4 <= tail.len() {
            let mut sums = [[0.0; LANES]; 4];
            for (j, x) in head.iter().enumerate() {
                let l = &values[j * height + width + i..][..4];
                sums.iter_mut().zip(l).for_each(|(sum, l)| subtract(sum, *l, x));
            }
            tail[i..i + 4].copy_from_slice(&sums);
            i += 4;
        }
        for i in i..tail.len() {
            for (j, x) in head.iter().enumerate() {
                subtract(&mut tail[i], values[j * height + width + i], x);
            }
        }
        y[begin..begin + width].copy_from_slice(head);
        for (&row, t) in rows.iter().zip(&*tail) {
            y[row as usize].iter_mut().zip(t).for_each(|(y, t)| *y += t);
        }
    }

    #[inline(always)]
    fn backward_panel_many(&self, s: usize, y: &mut [f64], buffer: &mut [f64]) {
        let (begin, width, rows, values) = self.panel(s);
        let height = width + rows.len();
        let (y, _) = y.as_chunks_mut::<LANES>();
        let (buffer, _) = buffer.as_chunks_mut::<LANES>();
        let (head, tail) = buffer[..height].split_at_mut(width);
        head.copy_from_slice(&y[begin..begin + width]);
        tail.iter_mut().zip(rows).for_each(|(t, &row)| *t = y[row as usize]);
        let mut j = 0;
        while j + 4 <= width {
            let c: [&[f64]; 4] = std::array::from_fn(|k| &values[(j + k) * height + width..(j + k + 1) * height]);
            let mut sums = [[0.0; LANES]; 4];
            for (i, t) in tail.iter().enumerate() {
                (0..4).for_each(|k| subtract(&mut sums[k], c[k][i], t));
            }
            for (x, sum) in head[j..j + 4].iter_mut().zip(&sums) {
                x.iter_mut().zip(sum).for_each(|(x, sum)| *x += sum);
            }
            j += 4;
        }
        for j in j..width {
            let column = &values[j * height + width..(j + 1) * height];
            tail.iter().zip(column).for_each(|(t, l)| subtract(&mut head[j], *l, t));
        }
        for j in (0..width).rev() {
            let column = &values[j * height..j * height + width];
            let (x, below) = head[j..].split_at_mut(1);
            below.iter().zip(&column[j + 1..]).for_each(|(t, l)| subtract(&mut x[0], *l, t));
            x[0].iter_mut().for_each(|x| *x *= self.inverse_diagonal[begin + j]);
        }
        y[begin..begin + width].copy_from_slice(head);
    }
}

/// y ← y − l x.
#[inline(always)]
fn subtract(y: &mut [f64; LANES], l: f64, x: &[f64; LANES]) {
    (0..LANES).for_each(|k| y[k] -= l * x[k]);
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
fn dots([a, b, c, d]: [&[f64]; 4], t: &[f64]) -> [f64; 4] {
    let mut lanes = [[0.0; WIDE]; 4];
    let (chunks, rest) = t.as_chunks::<WIDE>();
    let [aa, bb, cc, dd] = [a, b, c, d].map(|column| column.as_chunks::<WIDE>().0);
    for ((((t, a), b), c), d) in chunks.iter().zip(aa).zip(bb).zip(cc).zip(dd) {
        for k in 0..WIDE {
            lanes[0][k] += a[k] * t[k];
            lanes[1][k] += b[k] * t[k];
            lanes[2][k] += c[k] * t[k];
            lanes[3][k] += d[k] * t[k];
        }
    }
    let mut sums = lanes.map(|lanes| (lanes[0] + lanes[1]) + (lanes[2] + lanes[3]));
    let whole = t.len() - rest.len();
    for (sum, column) in sums.iter_mut().zip([a, b, c, d]) {
        *sum += column[whole..].iter().zip(rest).map(|(l, t)| l * t).sum::<f64>();
    }
    sums
}
