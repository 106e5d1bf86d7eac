//! A supernodal factor as the sweeps read it.

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
    /// Every panel.
    All,
    /// The panels of these numbers.
    Some(&'a [u32]),
}

impl Which<'_> {
    pub(super) fn len(self, all: usize) -> usize {
        match self {
            Self::All => all,
            Self::Some(panels) => panels.len(),
        }
    }

    #[inline(always)]
    pub(super) fn at(self, i: usize) -> usize {
        match self {
            Self::All => i,
            Self::Some(panels) => panels[i] as usize,
        }
    }
}

impl<'a> Panels<'a> {
    /// Number of panels.
    pub(super) fn count(&self) -> usize {
        self.columns.len() - 1
    }

    /// First column, width, rows R, numbers.
    #[inline(always)]
    pub(super) fn panel(&self, s: usize) -> (usize, usize, &'a [u32], &'a [f64]) {
        let begin = self.columns[s] as usize;
        let rows = &self.rows[self.row_starts[s] as usize..self.row_starts[s + 1] as usize];
        let values = &self.values[self.value_starts[s]..self.value_starts[s + 1]];
        (begin, self.columns[s + 1] as usize - begin, rows, values)
    }
}

/// R of the columns j … j + 3 of a panel.
#[inline(always)]
pub(super) fn below(values: &[f64], height: usize, width: usize, j: usize) -> [&[f64]; 4] {
    std::array::from_fn(|k| &values[(j + k) * height + width..(j + k + 1) * height])
}
