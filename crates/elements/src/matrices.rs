//! What every element gives: K and M, and rows of interpolation.

use ttb_sparse::Assembly;

/// A row over an element's degrees of freedom: (place among them, weight).
pub type Weights = Vec<(usize, f64)>;

/// K and M of one element in global axes, row by row.
#[derive(Clone, Debug, PartialEq)]
pub struct Matrices {
    /// Degrees of freedom: six per node.
    pub n: usize,
    /// K, N/m and N m.
    pub k: Vec<f64>,
    /// M, kg and kg m².
    pub m: Vec<f64>,
}

impl Matrices {
    /// Matrices of zeros.
    pub fn zeros(n: usize) -> Self {
        Self { n, k: vec![0.0; n * n], m: vec![0.0; n * n] }
    }

    /// Rows of K.
    pub fn rows_k(&self) -> std::slice::ChunksExact<'_, f64> {
        self.k.chunks_exact(self.n)
    }

    /// Rows of M.
    pub fn rows_m(&self) -> std::slice::ChunksExact<'_, f64> {
        self.m.chunks_exact(self.n)
    }

    /// Adds both to a system; `dofs` as in [`Assembly::add`].
    pub fn add_to(&self, assembly: &mut Assembly, dofs: &[Option<u32>]) {
        // One, two, three or four nodes: the lengths rows can have.
        match self.n {
            6 => self.add_rows::<6>(assembly, dofs),
            12 => self.add_rows::<12>(assembly, dofs),
            18 => self.add_rows::<18>(assembly, dofs),
            _ => self.add_rows::<24>(assembly, dofs),
        }
    }

    fn add_rows<const N: usize>(&self, assembly: &mut Assembly, dofs: &[Option<u32>]) {
        debug_assert_eq!(self.n, N);
        assembly.add(dofs, self.k.as_chunks::<N>().0, self.m.as_chunks::<N>().0);
    }
}

#[cfg(test)]
pub(crate) mod testing {
    //! Checks that hold for every element.

    use super::*;
    use nalgebra::{DMatrix, DVector, Vector3};

    pub fn square(a: &[f64]) -> DMatrix<f64> {
        let n = a.len().isqrt();
        DMatrix::from_row_slice(n, n, a)
    }

    /// The six rigid motions of nodes at `nodes`, about the origin.
    pub fn rigid(nodes: &[[f64; 3]]) -> Vec<DVector<f64>> {
        let motion = |i: usize| {
            let (mut translation, mut rotation) = (Vector3::zeros(), Vector3::zeros());
            if i < 3 {
                translation[i] = 1.0
            } else {
                rotation[i - 3] = 1.0
            }
            let values = nodes.iter().flat_map(|x| {
                let u = translation + rotation.cross(&Vector3::from(*x));
                [u.x, u.y, u.z, rotation.x, rotation.y, rotation.z]
            });
            DVector::from_iterator(6 * nodes.len(), values)
        };
        (0..6).map(motion).collect()
    }

    /// K and M are symmetric, rigid motions carry no force, and nothing else is free of energy but `loose` motions.
    pub fn check(matrices: &Matrices, nodes: &[[f64; 3]], loose: usize) {
        let (k, m) = (square(&matrices.k), square(&matrices.m));
        assert!((&k - k.transpose()).amax() < 1e-12 * k.amax() && (&m - m.transpose()).amax() < 1e-12 * m.amax());
        for (i, motion) in rigid(nodes).iter().enumerate() {
            let force = (&k * motion).amax();
            assert!(force < 1e-11 * k.amax() * motion.amax(), "motion {i}: {force} of {}", k.amax());
        }
        let mut energies: Vec<f64> = k.clone().symmetric_eigenvalues().iter().copied().collect();
        energies.sort_by(f64::total_cmp);
        let (zero, least) = (energies[5 + loose], energies.get(6 + loose).copied().unwrap_or(f64::INFINITY));
        assert!(energies[0] > -1e-11 * k.amax() && zero < 1e-10 * k.amax(), "{energies:?}");
        assert!(least > 1e-8 * k.amax(), "{energies:?}");
        let least = m.symmetric_eigenvalues().min();
        assert!(least > -1e-12 * square(&matrices.m).amax(), "{least}");
    }
}
