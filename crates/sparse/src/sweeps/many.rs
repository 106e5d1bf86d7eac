//! Both sweeps over one panel for a group of [`LANES`] right-hand sides, row i of all its members in `y[i]`; the buffer holds
//! LANES times as much.

use pulp::Simd;

use super::kernels::{LANES, subtract};
use super::panels::{Panels, below};

impl Panels<'_> {
    #[inline(always)]
    pub(super) fn forward_panel_many<S: Simd>(&self, simd: S, s: usize, y: &mut [[f64; LANES]], buffer: &mut [f64]) {
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
    pub(super) fn backward_panel_many<S: Simd>(&self, simd: S, s: usize, y: &mut [[f64; LANES]], buffer: &mut [f64]) {
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
