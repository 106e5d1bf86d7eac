//! A large system's solve, split so that it is done once a step.
//!
//! ```text
//! begin    y = L⁻¹P p                     one sweep over L
//!          r⁰ = R (K̂⁻¹p + g)              a sweep over the reach of R, a small part of L
//! trial    r₁ = r⁰ + S f₁                 a dense product, as often as wanted
//! solve    u₁ = Pᵀ L⁻ᵀ (y + L⁻¹P Bᵀf₁) + g   a sweep over the reach of B, one over L
//! ```
//!
//! The reach of a row are the panels of its degrees of freedom and those above them in the elimination tree. It is smallest
//! when these degrees of freedom are eliminated last (`ttb_sparse::Layout::last`).

use ttb_dynamics::dense::Dense;
use ttb_sparse::Factor;
use ttb_sparse::supernodal::{Numbers, Pattern};
use ttb_sparse::sweeps::{LANES, Which};

use crate::compliance::Compliance;
use crate::rows::Rows;
use crate::system::{Base, Work};

/// The reaches, the rows in the order of elimination, and S.
pub struct Lazy {
    /// R Pᵀ.
    rows: Rows,
    supports: usize,
    /// Panels that R reaches.
    of_rows: Vec<u32>,
    /// Panels that B reaches.
    of_supports: Vec<u32>,
    compliance: Compliance,
    /// RΦ diag(correction), with modal damping.
    corrected: Vec<Vec<f64>>,
}

impl Lazy {
    /// For a factor by panels; `None` for a small one. `shapes` and `corrections` are those of modal damping.
    pub fn new(
        factor: &Factor,
        rows: &Rows,
        supports: usize,
        shapes: &[Vec<f64>],
        corrections: &[f64],
    ) -> Option<Self> {
        let (pattern, numbers) = factor.panels()?;
        let seen = |shape: &Vec<f64>| (0..rows.len()).map(|i| rows.dot(i, shape)).collect::<Vec<f64>>();
        let seen: Vec<Vec<f64>> = shapes.iter().map(seen).collect();
        let permuted = rows.renumbered(&pattern.position);
        let reach = |range: std::ops::Range<usize>| pattern.reach(range.flat_map(|i| rows.columns(i)).copied());
        let (of_rows, of_supports) = (reach(0..rows.len()), reach(0..supports));
        let mut compliance = compliance(pattern, numbers, &permuted, supports, &of_rows);
        for (seen, correction) in seen.iter().zip(corrections) {
            for (i, r) in seen.iter().enumerate() {
                let row = compliance.row_mut(i);
                row.iter_mut().zip(seen).for_each(|(s, b)| *s -= correction * r * b);
            }
        }
        let corrected = seen.iter().zip(corrections).map(|(r, c)| r.iter().map(|r| c * r).collect()).collect();
        Some(Self {
            rows: permuted,
            supports,
            of_rows,
            of_supports,
            compliance: Compliance::Dense(compliance),
            corrected,
        })
    }

    /// Rows of B.
    pub fn supports(&self) -> usize {
        self.supports
    }

    /// Panels that R reaches.
    pub fn reach(&self) -> &[u32] {
        &self.of_rows
    }

    /// Panels that B reaches.
    pub fn support_reach(&self) -> &[u32] {
        &self.of_supports
    }

    /// R x of [`LANES`] vectors side by side in the order of elimination.
    pub fn see_many(&self, x: &[f64], r: &mut [f64]) {
        for (i, r) in r.chunks_exact_mut(LANES).enumerate() {
            r.fill(0.0);
            for (&c, w) in self.rows.columns(i).iter().zip(self.rows.weights(i)) {
                let x = &x[c as usize * LANES..][..LANES];
                r.iter_mut().zip(x).for_each(|(r, x)| *r += w * x);
            }
        }
    }

    /// x ← x + Bᵀ f of [`LANES`] runs.
    pub fn load_many(&self, forces: &[&[f64]; LANES], x: &mut [f64]) {
        for i in 0..self.supports {
            for (&c, w) in self.rows.columns(i).iter().zip(self.rows.weights(i)) {
                let x = &mut x[c as usize * LANES..][..LANES];
                x.iter_mut().zip(forces).for_each(|(x, f)| *x += w * f[i]);
            }
        }
    }

    /// S: what the outside sees of unit forces on the supports.
    pub fn compliance(&self) -> &Compliance {
        &self.compliance
    }

    /// S alone.
    pub fn into_compliance(self) -> Compliance {
        self.compliance
    }

    /// From p in `load` to y there, and R K̂⁻¹p.
    pub fn begin(&self, factor: &Factor, base: &mut Base, load: &mut Vec<f64>, work: &mut Work) {
        let Some((pattern, numbers)) = factor.panels() else { return };
        pattern.gather(load, &mut work.y);
        pattern.forward(numbers, &mut work.y, &mut work.buffer, Which::All);
        std::mem::swap(load, &mut work.y);
        // Only the reach is read again: everything else may stay.
        work.y.copy_from_slice(load);
        pattern.backward(numbers, &mut work.y, &mut work.buffer, Which::Some(&self.of_rows));
        let free = &mut base.free.u;
        free.clear();
        free.extend((0..self.rows.len()).map(|i| self.rows.dot(i, &work.y)));
        for (corrected, amplitude) in self.corrected.iter().zip(&base.amplitudes) {
            free.iter_mut().zip(corrected).for_each(|(r, c)| *r -= c * amplitude);
        }
    }

    /// K̂⁻¹(p + Bᵀf) into `u`.
    pub fn solve(&self, factor: &Factor, base: &Base, forces: &[f64], u: &mut [f64], work: &mut Work) {
        let Some((pattern, numbers)) = factor.panels() else { return };
        let Work { x, y, buffer } = work;
        [&mut *x, &mut *y].into_iter().for_each(|v| v.resize(u.len(), 0.0));
        x.fill(0.0);
        self.rows.add_transposed(&forces[..self.supports], x);
        pattern.forward(numbers, x, buffer, Which::Some(&self.of_supports));
        y.iter_mut().zip(&*x).zip(&base.load).for_each(|((y, x), load)| *y = load + x);
        pattern.backward(numbers, y, buffer, Which::All);
        pattern.scatter(y, u);
    }
}

/// S = R K̂⁻¹ Bᵀ by [`LANES`] columns at a time, each over the panels that its supports and R share.
fn compliance(pattern: &Pattern, numbers: &Numbers, rows: &Rows, supports: usize, of_rows: &[u32]) -> Dense {
    let n = pattern.order.len();
    let roots = pattern.roots();
    let part_of = |column: u32| roots[pattern.panel_of(column)];
    let parts_of_rows: Vec<Vec<u32>> =
        (0..rows.len()).map(|i| rows.columns(i).iter().map(|&c| part_of(c)).collect()).collect();
    let mut s = Dense::zeros(rows.len(), supports);
    let (mut y, mut buffer) = (vec![0.0; n * LANES], Vec::new());
    for first in (0..supports).step_by(LANES) {
        let lanes = LANES.min(supports - first);
        let group = first..first + lanes;
        let reach = pattern.reach(group.clone().flat_map(|j| rows.columns(j)).map(|&c| pattern.order[c as usize]));
        let mut parts: Vec<u32> = parts_of_rows[group.clone()].concat();
        parts.sort_unstable();
        parts.dedup();
        let back: Vec<u32> =
            of_rows.iter().copied().filter(|&s| parts.binary_search(&roots[s as usize]).is_ok()).collect();
        y.fill(0.0);
        for (lane, j) in group.clone().enumerate() {
            rows.columns(j).iter().zip(rows.weights(j)).for_each(|(&c, w)| y[c as usize * LANES + lane] += w);
        }
        pattern.forward_many(numbers, &mut y, &mut buffer, Which::Some(&reach));
        pattern.backward_many(numbers, &mut y, &mut buffer, Which::Some(&back));
        for i in (0..rows.len()).filter(|&i| parts_of_rows[i].iter().any(|part| parts.binary_search(part).is_ok())) {
            for lane in 0..lanes {
                let terms = rows.columns(i).iter().zip(rows.weights(i));
                s.row_mut(i)[first + lane] = terms.map(|(&c, w)| w * y[c as usize * LANES + lane]).sum();
            }
        }
    }
    s
}
