//! Both sweeps over one panel for one right-hand side.

use pulp::Simd;

use super::kernels::{dot, dots, lower};
use super::panels::{Panels, below};

impl Panels<'_> {
    #[inline(always)]
    pub(super) fn forward_panel(&self, s: usize, y: &mut [f64], buffer: &mut [f64]) {
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
    pub(super) fn backward_panel<S: Simd>(&self, simd: S, s: usize, y: &mut [f64], buffer: &mut [f64]) {
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
