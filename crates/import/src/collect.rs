//! From entries in any order to the lower triangle by columns, in two passes: one counts, one fills.
//!
//! ```text
//! (i, j), i ≥ j  → column j, row i
//! (i, j), i < j  → column i, row j, marked as coming from above the diagonal
//! ```
//!
//! The marks tell a matrix given in full from one given by a triangle: a place reached from both sides must hold the
//! same value from either. No memory is taken before the first pass has seen what it is for.

use crate::matrix::SymmetricMatrix;
use crate::problem::{Report, Stop};

/// Marks a row as coming from above the diagonal.
const ABOVE: u32 = 1 << 31;
/// Largest number of rows.
pub(crate) const MOST_ROWS: u64 = (1 << 31) - 1;
/// Largest |a_ij − a_ji| relative to √(a_ii a_jj) that counts as rounding.
const ROUNDING: f64 = 1e-8;

/// What a file says of its symmetry.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Symmetry {
    /// The file holds one triangle.
    Triangle,
    /// The file holds both triangles.
    Full,
    /// Nothing: both if any place is given from both sides.
    Either,
}

/// First pass: entries per column.
#[derive(Default)]
pub(crate) struct Counts {
    columns: Vec<u32>,
}

impl Counts {
    /// Counts the entry (i, j), from 0.
    pub fn add(&mut self, i: u32, j: u32) {
        let (column, row) = (i.min(j) as usize, i.max(j) as usize);
        if row >= self.columns.len() {
            self.columns.resize(row + 1, 0);
        }
        // Saturated only by 2³² entries in one column; the second pass then refuses.
        self.columns[column] = self.columns[column].saturating_add(1);
    }

    /// Largest index seen, plus 1.
    pub fn size(&self) -> u32 {
        self.columns.len() as u32
    }
}

/// Second pass: entries to their columns.
pub(crate) struct Filler {
    counts: Vec<u32>,
    /// Before the pass starts[j + 1] is where column j begins, after it where column j ends.
    starts: Vec<usize>,
    rows: Vec<u32>,
    values: Vec<f64>,
}

impl Filler {
    pub fn new(counts: Counts, n: u32) -> Self {
        let mut counts = counts.columns;
        counts.resize(n as usize, 0);
        let mut starts = Vec::with_capacity(counts.len() + 1);
        starts.push(0);
        let mut total = 0;
        for &count in &counts {
            starts.push(total);
            total += count as usize;
        }
        Self { counts, starts, rows: vec![0; total], values: vec![0.0; total] }
    }

    /// Places the entry (i, j), from 0.
    pub fn add(&mut self, i: u32, j: u32, value: f64) {
        let (column, row) = if i >= j { (j, i) } else { (i, j | ABOVE) };
        let Some(at) = self.starts.get_mut(column as usize + 1) else { return };
        if let (Some(r), Some(v)) = (self.rows.get_mut(*at), self.values.get_mut(*at)) {
            (*r, *v) = (row, value);
        }
        *at += 1;
    }

    /// Sorts, sums duplicates, joins both triangles. Returns the matrix and the largest relative |a − aᵀ|.
    pub fn finish(mut self, symmetry: Symmetry, report: &mut Report) -> Result<(SymmetricMatrix, f64), Stop> {
        let n = self.counts.len();
        if (0..n).any(|j| self.starts[j + 1].wrapping_sub(self.starts[j]) != self.counts[j] as usize) {
            return Err(report.fatal(None, "the file must not change while it is read", ""));
        }
        let scale = if symmetry == Symmetry::Triangle { Vec::new() } else { self.scale() };
        let mut judge = Judge { scale, both: 0, unlike: None, twice: None };
        let mut sorted: Vec<(u32, f64)> = Vec::new();
        let (mut begin, mut written) = (0, 0);
        for j in 0..n {
            let end = self.starts[j + 1];
            sorted.clear();
            sorted.extend(self.rows[begin..end].iter().copied().zip(self.values[begin..end].iter().copied()));
            let key = |entry: &(u32, f64)| entry.0.rotate_left(1); // by row, the lower triangle first
            if !sorted.is_sorted_by_key(key) {
                sorted.sort_by_key(key);
            }
            for same_row in sorted.chunk_by(|a, b| a.0 & !ABOVE == b.0 & !ABOVE) {
                let row = same_row[0].0 & !ABOVE;
                let value = judge.join(same_row, row, j as u32);
                if !value.is_finite() {
                    let place = format!("({}, {j})", row + 1, j = j + 1);
                    return Err(report.fatal(None, "entries at one place must have a finite sum", place));
                }
                if value != 0.0 || row as usize == j {
                    (self.rows[written], self.values[written]) = (row, value);
                    written += 1;
                }
            }
            begin = end;
            self.starts[j + 1] = written;
        }
        let asymmetry = judge.verdict(symmetry, report)?;
        self.rows.truncate(written);
        self.values.truncate(written);
        self.rows.shrink_to_fit();
        self.values.shrink_to_fit();
        Ok((SymmetricMatrix { n, starts: self.starts, rows: self.rows, values: self.values }, asymmetry))
    }

    /// √|a_jj|.
    fn scale(&self) -> Vec<f64> {
        let sum = |j: usize| -> f64 {
            let column = self.starts[j]..self.starts[j + 1];
            let entries = self.rows[column.clone()].iter().zip(&self.values[column]);
            entries.filter(|(row, _)| **row as usize == j).map(|(_, value)| value).sum()
        };
        (0..self.counts.len()).map(|j| sum(j).abs().sqrt()).collect()
    }
}

/// Compares both triangles.
struct Judge {
    scale: Vec<f64>,
    /// Places given from both sides.
    both: u64,
    /// Largest relative difference and where: row, column, below, above.
    unlike: Option<(f64, u32, u32, f64, f64)>,
    /// First place given from both sides: row, column.
    twice: Option<(u32, u32)>,
}

impl Judge {
    /// The value at a place from all that was given for it.
    fn join(&mut self, given: &[(u32, f64)], i: u32, j: u32) -> f64 {
        let below = given.partition_point(|(row, _)| row & ABOVE == 0);
        let sum = |part: &[(u32, f64)]| part.iter().fold(0.0, |sum, (_, value)| sum + value);
        let (lower, upper) = (sum(&given[..below]), sum(&given[below..]));
        if i == j {
            return lower;
        }
        let both = 0 < below && below < given.len();
        if both {
            self.both += 1;
            self.twice.get_or_insert((i, j));
        }
        if let (Some(a), Some(b)) = (self.scale.get(i as usize), self.scale.get(j as usize)) {
            let scale = (a * b).max(lower.abs()).max(upper.abs());
            let difference = if scale > 0.0 { (lower - upper).abs() / scale } else { 0.0 };
            if difference > self.unlike.map_or(0.0, |worst| worst.0) {
                self.unlike = Some((difference, i, j, lower, upper));
            }
        }
        if both { 0.5 * lower + 0.5 * upper } else { lower + upper }
    }

    fn verdict(&self, symmetry: Symmetry, report: &mut Report) -> Result<f64, Stop> {
        if let (Symmetry::Triangle, Some((i, j))) = (symmetry, self.twice) {
            let found = format!("({}, {}) and ({}, {})", i + 1, j + 1, j + 1, i + 1);
            return Err(report.fatal(None, "a symmetric file must hold one triangle, not both", found));
        }
        let full = symmetry == Symmetry::Full || symmetry == Symmetry::Either && self.both > 0;
        match self.unlike.filter(|_| full) {
            Some((difference, i, j, lower, upper)) if difference > ROUNDING => {
                let (i, j) = (i + 1, j + 1);
                let one = if self.both == 0 {
                    "; only one triangle is given: the header must say symmetric (RSA)"
                } else {
                    ""
                };
                let found = format!("a({i}, {j}) = {lower:e}, a({j}, {i}) = {upper:e}{one}");
                Err(report.fatal(None, "the matrix must be symmetric", found))
            }
            worst => Ok(worst.map_or(0.0, |worst| worst.0)),
        }
    }
}
