//! Combinations of motions, and the transformation of an element some of whose motions are combinations.

/// Weights with each motion once, in the order in which they came.
#[derive(Default)]
pub(super) struct Sums {
    pub list: Vec<(u32, f64)>,
}

impl Sums {
    /// Adds to what is there.
    pub fn add(&mut self, key: u32, weight: f64) {
        match self.list.iter_mut().find(|(other, _)| *other == key) {
            Some((_, sum)) => *sum += weight,
            None => self.list.push((key, weight)),
        }
    }
}

/// T of one element: its motions as combinations of degrees of freedom.
pub(super) struct Tied {
    pub dofs: Vec<u32>,
    /// Per motion: (position in `dofs`, weight).
    pub t: Vec<Vec<(usize, f64)>>,
}

impl Tied {
    /// Tᵀ A T of an element's matrix, row by row.
    pub fn transform(&self, a: &[f64]) -> Vec<Vec<f64>> {
        let n = self.t.len();
        let mut whole = vec![vec![0.0; self.dofs.len()]; self.dofs.len()];
        for (i, row) in self.t.iter().enumerate() {
            for (j, column) in self.t.iter().enumerate() {
                let value = a[i * n + j];
                for (p, left) in row {
                    column.iter().for_each(|(q, right)| whole[*p][*q] += left * value * right);
                }
            }
        }
        whole
    }

    /// The degrees of freedom as [`ttb_sparse::Assembly::add`] takes them.
    pub fn present(&self) -> Vec<Option<u32>> {
        self.dofs.iter().map(|dof| Some(*dof)).collect()
    }
}
