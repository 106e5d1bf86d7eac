//! Entries of a lower triangle, as an assembly collects them.

/// An entry of K and M; other matrices keep their number in `k`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Entry {
    pub column: u32,
    pub row: u32,
    pub k: f64,
    pub m: f64,
}

/// Sorted by columns, one entry a place.
pub(crate) fn merged(mut entries: Vec<Entry>) -> Vec<Entry> {
    entries.sort_by_key(|e| (e.column, e.row));
    entries.dedup_by(|next, kept| {
        let same = (next.column, next.row) == (kept.column, kept.row);
        if same {
            kept.k += next.k;
            kept.m += next.m;
        }
        same
    });
    entries.shrink_to_fit();
    entries
}

/// Starts of the columns, and rows, of sorted entries.
pub(crate) fn columns_of(n: usize, entries: &[Entry]) -> (Vec<u32>, Vec<u32>) {
    let mut starts = vec![0_u32; n + 1];
    entries.iter().for_each(|e| starts[e.column as usize + 1] += 1);
    (0..n).for_each(|j| starts[j + 1] += starts[j]);
    (starts, entries.iter().map(|e| e.row).collect())
}
