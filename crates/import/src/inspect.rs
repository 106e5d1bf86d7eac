//! What can be said of imported matrices without solving anything.
//!
//! ```text
//! mass along d:   m_d = r_dᵀ M r_d,   r_d: the model moved along d by 1
//! held rows:      K r ≠ 0 where a support, or a spring to the ground, holds the model against the motion r
//! ```

use crate::dof::INTERNAL;
use crate::dofs::Dofs;
use crate::files::{FileFacts, Imported};
use crate::matrix::SymmetricMatrix;
use crate::rows::NEAR;

/// |K r| below this part of |K| |r| is rounding.
const ROUNDING: f64 = 1e-7;

/// A rigid motion of the whole model.
#[derive(Clone, Debug, PartialEq)]
pub struct Motion {
    /// 0…5: along or about x, y, z, in the axes of the program that wrote the matrices.
    pub direction: usize,
    /// Translations: the mass that moves, kg. Rotations: the inertia about the origin, kg m².
    pub inertia: f64,
    /// Rows where K r does not vanish: those beside bearings. All rows of a direction: wrong labels or coordinates.
    pub held: usize,
    /// The first of them, from 0.
    pub first_held: Option<usize>,
}

/// Facts about an imported model.
#[derive(Clone, Debug, PartialEq)]
pub struct Inspection {
    /// Degrees of freedom.
    pub n: usize,
    /// Entries in the lower triangles of K, M and, if given, C.
    pub entries: Vec<usize>,
    /// How the files were read, with the asymmetry found.
    pub files: Vec<FileFacts>,
    /// Largest and smallest entry on K's diagonal.
    pub stiffness: (f64, f64),
    /// Largest entry on M's diagonal and smallest above zero.
    pub masses: (f64, f64),
    /// Rows without any mass, from 0.
    pub massless: Vec<usize>,
    /// Rows of K with nothing but the diagonal: springs to the ground or forgotten nodes.
    pub lone: Vec<usize>,
    /// Rigid motions that move anything; none if directions are unknown, translations only if coordinates are.
    pub motions: Vec<Motion>,
    /// Rows without any entry, from 0: held.
    pub held: Vec<u32>,
}

impl Imported {
    /// Facts about the model.
    pub fn inspect(&self) -> Inspection {
        let (k, m) = (self.k.diagonal(), self.m.diagonal());
        let range = |values: &[f64]| {
            let positive = values.iter().copied().filter(|value| *value > 0.0);
            (positive.clone().fold(0.0, f64::max), positive.fold(f64::INFINITY, f64::min))
        };
        let used = used(&self.m);
        let coupled = coupled(&self.k);
        Inspection {
            n: self.k.n,
            entries: [Some(&self.k), Some(&self.m), self.c.as_ref()]
                .into_iter()
                .flatten()
                .map(|a| a.entries())
                .collect(),
            files: self.files.clone(),
            stiffness: range(&k),
            masses: range(&m),
            massless: (0..self.m.n).filter(|&i| !used[i] && self.held.binary_search(&(i as u32)).is_err()).collect(),
            lone: (0..self.k.n).filter(|&i| !coupled[i] && self.held.binary_search(&(i as u32)).is_err()).collect(),
            motions: self.dofs.as_ref().map(|dofs| self.motions(dofs)).unwrap_or_default(),
            held: self.held.clone(),
        }
    }

    /// The support at a station, m from the bridge's begin.
    pub fn support(&self, x: f64) -> Option<&[(u32, f64)]> {
        let from = self.supports.partition_point(|(at, _)| *at < x - NEAR);
        self.supports.get(from).filter(|(at, _)| *at <= x + NEAR).map(|(_, row)| row.as_slice())
    }

    /// Stations without support among those asked for, and supports that none of them asks for.
    pub fn unmatched(&self, stations: &[f64]) -> (Vec<f64>, Vec<f64>) {
        let missing = stations.iter().copied().filter(|&x| self.support(x).is_none()).collect();
        let mut sorted = stations.to_vec();
        sorted.sort_by(f64::total_cmp);
        let asked = |x: f64| sorted.get(sorted.partition_point(|at| *at < x - NEAR)).is_some_and(|at| *at <= x + NEAR);
        let unused = self.supports.iter().map(|(x, _)| *x).filter(|&x| !asked(x)).collect();
        (missing, unused)
    }

    fn motions(&self, dofs: &Dofs) -> Vec<Motion> {
        let directions = if dofs.coordinates.is_some() { 6 } else { 3 };
        let motion = |direction: usize| {
            let r: Vec<f64> = (0..dofs.dofs.len()).map(|row| rigid(dofs, row, direction)).collect();
            if r.iter().all(|r| *r == 0.0) {
                return None;
            }
            let inertia = self.m.product(&r).iter().zip(&r).map(|(mr, r)| mr * r).sum();
            let (force, scale) = (self.k.product(&r), self.k.magnitude(&r));
            let mut held = (0..force.len()).filter(|&i| force[i].abs() > ROUNDING * scale[i]);
            let first_held = held.next();
            let held = held.count() + usize::from(first_held.is_some());
            Some(Motion { direction, inertia, held, first_held })
        };
        (0..directions).filter_map(motion).collect()
    }
}

/// Motion of a row when the model moves rigidly: u = θ × r.
fn rigid(dofs: &Dofs, row: usize, direction: usize) -> f64 {
    if dofs.dofs[row].node > INTERNAL {
        return 0.0;
    }
    let freedom = usize::from(dofs.dofs[row].freedom);
    if freedom == direction {
        return 1.0;
    }
    if direction < 3 || freedom > 2 {
        return 0.0;
    }
    let at = dofs.coordinates.as_ref().and_then(|at| at.get(dofs.node_of[row] as usize)).copied().unwrap_or_default();
    let axis = direction - 3;
    match (freedom + 3 - axis) % 3 {
        1 => -at[(axis + 2) % 3],
        2 => at[(axis + 1) % 3],
        _ => 0.0,
    }
}

/// Rows with any entry.
fn used(a: &SymmetricMatrix) -> Vec<bool> {
    let mut used = vec![false; a.n];
    for j in 0..a.n {
        for (i, _) in a.column(j).filter(|(_, value)| *value != 0.0) {
            (used[i], used[j]) = (true, true);
        }
    }
    used
}

/// Rows with an entry off the diagonal.
fn coupled(a: &SymmetricMatrix) -> Vec<bool> {
    let mut coupled = vec![false; a.n];
    for j in 0..a.n {
        for (i, _) in a.column(j).filter(|(i, _)| *i != j) {
            (coupled[i], coupled[j]) = (true, true);
        }
    }
    coupled
}
