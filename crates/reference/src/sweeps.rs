//! A factor whose solution is wanted at a few degrees of freedom many times, under loads there, and everywhere once.
//!
//! ```text
//! begin    y = L⁻¹ p                            a sweep over L
//! look     x = L⁻ᵀ (y + L⁻¹ f) at the rail      sweeps over the reach of the rail, as often as wanted
//! finish   u = L⁻ᵀ (y + L⁻¹ f)                  a sweep over L
//! ```

use ttb_sparse::Factor;
use ttb_sparse::sweeps::{LANES, Which};

/// A force everywhere, N: far from the train all numbers decay, and subnormal ones are a hundred times slower.
const WHISPER: f64 = 1e-100;

/// The factor, the reach of the degrees of freedom looked at, and the workspace.
pub struct Sweeps {
    factor: Factor,
    reach: Vec<u32>,
    y: Vec<f64>,
    x: Vec<f64>,
    work: Vec<f64>,
    buffer: Vec<f64>,
    /// Groups of right-hand sides, interleaved.
    lanes: Vec<Vec<f64>>,
}

impl Sweeps {
    /// To look at and load the degrees of freedom `seen`.
    pub fn new(factor: Factor, seen: impl IntoIterator<Item = u32>) -> Self {
        let reach = factor.panels().map_or_else(Vec::new, |(pattern, _)| pattern.reach(seen));
        let zeros = vec![0.0; factor.dimension()];
        Self { factor, reach, y: zeros.clone(), x: zeros.clone(), work: zeros, buffer: Vec::new(), lanes: Vec::new() }
    }

    /// The factor.
    pub fn factor(&self) -> &Factor {
        &self.factor
    }

    /// The factor, to be replaced by another of the same pattern.
    pub fn factor_mut(&mut self) -> &mut Factor {
        &mut self.factor
    }

    /// Takes in p.
    pub fn begin(&mut self, p: &[f64]) {
        match self.factor.panels() {
            None => self.y.iter_mut().zip(p).for_each(|(y, p)| *y = p + WHISPER),
            Some((pattern, numbers)) => {
                pattern.gather(p, &mut self.y);
                self.y.iter_mut().for_each(|y| *y += WHISPER);
                pattern.forward(numbers, &mut self.y, &mut self.buffer, Which::All);
            }
        }
    }

    /// Solves for p and `load`, where it was asked for; see [`Sweeps::at`].
    pub fn look(&mut self, load: &[(u32, f64)]) {
        self.solve(load, false);
    }

    /// What [`Sweeps::look`] has found.
    pub fn at(&self, dof: usize) -> f64 {
        match self.factor.panels() {
            None => self.x[dof],
            Some((pattern, _)) => self.x[pattern.position[dof] as usize],
        }
    }

    /// Solves for p and `load` everywhere.
    pub fn finish(&mut self, load: &[(u32, f64)], u: &mut [f64]) {
        self.solve(load, true);
        match self.factor.panels() {
            None => u.copy_from_slice(&self.x),
            Some((pattern, _)) => pattern.scatter(&self.x, u),
        }
    }

    fn solve(&mut self, load: &[(u32, f64)], everywhere: bool) {
        let Self { factor, reach, y, x, work, buffer, .. } = self;
        let Some((pattern, numbers)) = factor.panels() else {
            x.copy_from_slice(y);
            load.iter().for_each(|(dof, f)| x[*dof as usize] += f);
            factor.solve_in_place(x, work);
            return;
        };
        x.fill(WHISPER);
        load.iter().for_each(|(dof, f)| x[pattern.position[*dof as usize] as usize] += f);
        pattern.forward(numbers, x, buffer, Which::Some(reach));
        x.iter_mut().zip(&*y).for_each(|(x, y)| *x += y);
        pattern.backward(numbers, x, buffer, if everywhere { Which::All } else { Which::Some(reach) });
    }

    /// V K̂⁻¹ Vᵀ by rows for sparse rows V over the degrees of freedom looked at; p is not touched.
    pub fn compliance(&mut self, rows: &[Vec<(u32, f64)>], compliance: &mut [f64]) {
        let m = rows.len();
        let Some((pattern, numbers)) = self.factor.panels() else {
            for (j, row) in rows.iter().enumerate() {
                self.x.fill(WHISPER);
                row.iter().for_each(|(dof, n)| self.x[*dof as usize] += n);
                self.factor.solve_in_place(&mut self.x, &mut self.work);
                for (i, row) in rows.iter().enumerate() {
                    compliance[i * m + j] = row.iter().map(|(dof, n)| n * self.x[*dof as usize]).sum();
                }
            }
            return;
        };
        // L⁻¹Vᵀ in groups of lanes, each over its own reach; then their products where two reaches meet.
        let groups: Vec<&[Vec<(u32, f64)>]> = rows.chunks(LANES).collect();
        self.lanes.resize_with(groups.len(), || vec![0.0; pattern.order.len() * LANES]);
        let reached = |group: &&[Vec<(u32, f64)>]| pattern.reach(group.iter().flatten().map(|(dof, _)| *dof));
        let reaches: Vec<Vec<u32>> = groups.iter().map(reached).collect();
        for ((rows, reach), lanes) in groups.iter().zip(&reaches).zip(&mut self.lanes) {
            for columns in reach.iter().map(|panel| pattern.columns_of(*panel)) {
                lanes[columns.start * LANES..columns.end * LANES].fill(WHISPER);
            }
            for (lane, row) in rows.iter().enumerate() {
                row.iter().for_each(|(dof, n)| lanes[pattern.position[*dof as usize] as usize * LANES + lane] += n);
            }
            pattern.forward_many(numbers, lanes, &mut self.buffer, Which::Some(reach));
        }
        for a in 0..groups.len() {
            for b in 0..=a {
                let both = reaches[a].iter().filter(|panel| reaches[b].binary_search(panel).is_ok());
                let both = both.flat_map(|panel| pattern.columns_of(*panel));
                let block = product(both, &self.lanes[a], &self.lanes[b]);
                for (i, row) in (a * LANES..m).zip(&block) {
                    for (j, y) in (b * LANES..m).zip(row) {
                        (compliance[i * m + j], compliance[j * m + i]) = (*y, *y);
                    }
                }
            }
        }
    }
}

/// AᵀB over some rows of two matrices of [`LANES`] columns.
fn product(rows: impl Iterator<Item = usize>, a: &[f64], b: &[f64]) -> [[f64; LANES]; LANES] {
    let ((a, _), (b, _)) = (a.as_chunks::<LANES>(), b.as_chunks::<LANES>());
    let mut sum = [[0.0; LANES]; LANES];
    for row in rows {
        for (sum, a) in sum.iter_mut().zip(&a[row]) {
            sum.iter_mut().zip(&b[row]).for_each(|(sum, b)| *sum += a * b);
        }
    }
    sum
}
