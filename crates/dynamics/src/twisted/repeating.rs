//! Rows of coefficients that repeat from some row on, each kept once.

use std::ops::Range;

use super::Pair;

/// Longest period that is looked for, rows.
const LONGEST: usize = 200;
/// A period is kept as often as it takes to have so many rows: a loop over a few rows costs more than the rows.
const LEAST: usize = 100;

/// Rows of coefficients.
#[derive(Clone, Debug)]
pub struct Repeating {
    /// Rows there are.
    count: usize,
    /// Rows before the first repetition.
    head: usize,
    /// Rows after which all coefficients are the same, at least 1.
    period: usize,
    /// Coefficients of the first `head + period` rows.
    kept: Vec<Pair>,
}

impl Repeating {
    /// From all rows of `width` coefficients.
    pub fn new(rows: Vec<Pair>, width: usize, count: usize) -> Self {
        let [own, _] = Self::both([rows, Vec::new()], [width, 0], count);
        own
    }

    /// Two sets of rows, which repeat together.
    pub fn both(rows: [Vec<Pair>; 2], widths: [usize; 2], count: usize) -> [Self; 2] {
        // Bits, so that -0 is not taken for 0.
        let bits = |pairs: &[Pair], i: usize, j: usize, width: usize| {
            let row = |i: usize| pairs[i * width..(i + 1) * width].iter().flatten().map(|x| x.to_bits());
            row(i).eq(row(j))
        };
        let same = |i: usize, j: usize| (0..2).all(|k| bits(&rows[k], i, j, widths[k]));
        let (mut head, mut period) = (count, 1);
        for candidate in 1..=LONGEST.min(count / 2) {
            let begin = (0..count - candidate).rev().take_while(|i| same(*i, i + candidate)).last();
            if let Some(begin) = begin.filter(|begin| *begin < head) {
                (head, period) = (begin, candidate * LEAST.div_ceil(candidate));
            }
        }
        let mut widths = widths.into_iter();
        rows.map(|mut kept| {
            kept.truncate((head + period).min(count) * widths.next().unwrap_or(0));
            kept.shrink_to_fit();
            Self { count, head, period, kept }
        })
    }

    /// The coefficients that are kept.
    pub fn kept(&self) -> &[Pair] {
        &self.kept
    }

    /// Where the coefficients of a row are kept.
    pub fn place(&self, row: usize) -> usize {
        if row < self.head { row } else { self.head + (row - self.head) % self.period }
    }

    /// All rows in parts, each with the kept ones that it has the coefficients of.
    pub fn parts(&self) -> impl DoubleEndedIterator<Item = (Range<usize>, Range<usize>)> {
        let Self { count, head, period, .. } = *self;
        let periods = (count - head).div_ceil(period);
        let repeated = (0..periods).map(move |k| {
            let begin = head + k * period;
            let end = (begin + period).min(count);
            (begin..end, head..head + end - begin)
        });
        std::iter::once((0..head, 0..head)).chain(repeated)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_that_repeat_are_kept_once_and_found_again() {
        for (head, period, count) in [(0, 1, 300), (7, 3, 1000), (40, 13, 997), (300, 1, 300), (5, 190, 1000)] {
            let value = |row: usize| if row < head { -(row as f64) - 1.0 } else { ((row - head) % period) as f64 };
            let rows: Vec<Pair> = (0..2 * count).map(|i| [value(i / 2), (i % 2) as f64]).collect();
            let own = Repeating::new(rows, 2, count);
            assert!(own.kept().len() <= 2 * count.min(head + period.max(LEAST) + period));
            let mut seen = 0;
            for (rows, kept) in own.parts() {
                for (row, kept) in rows.zip(kept) {
                    assert_eq!((row, own.kept()[2 * kept][0], own.place(row)), (seen, value(row), kept));
                    seen += 1;
                }
            }
            assert_eq!(seen, count);
        }
    }
}
