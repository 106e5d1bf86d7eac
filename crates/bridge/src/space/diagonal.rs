//! The diagonal of K: what has no stiffness of its own shows there before anything is factorised.

use ttb_elements::Matrices;
use ttb_scenario::space::Motion;

use super::freedoms::Freedoms;

/// Less than this of what its node has in other directions is rounding.
const ROUNDING: f64 = 1e-15;

/// Diagonal of K.
pub(super) struct Diagonal(Vec<f64>);

impl Diagonal {
    pub fn new(freedoms: &Freedoms) -> Self {
        Self(vec![0.0; freedoms.motions.len()])
    }

    /// Adds an element's.
    pub fn add(&mut self, freedoms: &Freedoms, motions: &[Motion], matrices: &Matrices) {
        if let Some(dofs) = freedoms.plain(motions) {
            for (i, dof) in dofs.iter().enumerate().filter_map(|(i, dof)| Some((i, (*dof)?))) {
                self.0[dof as usize] += matrices.k[i * (matrices.n + 1)];
            }
        } else {
            let tied = freedoms.tied(motions);
            let k = tied.transform(&matrices.k);
            tied.dofs.iter().enumerate().for_each(|(i, dof)| self.0[*dof as usize] += k[i][i]);
        }
    }

    /// Degrees of freedom without stiffness.
    pub fn loose(&self, freedoms: &Freedoms) -> Vec<usize> {
        // a node's displacements are compared with each other, and so are its rotations
        let place = |motion: &Motion| (motion / 3) as usize;
        let mut greatest = vec![0.0_f64; 2 * freedoms.nodes];
        for (k, motion) in self.0.iter().zip(&freedoms.motions) {
            greatest[place(motion)] = greatest[place(motion)].max(*k);
        }
        let all = self.0.iter().zip(&freedoms.motions).enumerate();
        all.filter(|(_, (k, motion))| **k <= ROUNDING * greatest[place(motion)]).map(|(dof, _)| dof).collect()
    }
}
