//! Rows of expected and computed values. A test puts them into a [`Table`]; when the table is finished it is printed, held
//! against its tolerances and against its record in docs/verification, of which the report is made: what the report says
//! is what the tests compute. With `TTB_BLESS=1` the record is written anew.

use std::fmt;
use std::path::PathBuf;

use serde::{Deserialize, Serialize};

/// One comparison of a computed value with an expected one.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// What is compared.
    pub case: String,
    /// The expected value, published or from a closed form.
    pub expected: f64,
    /// The computed value.
    pub computed: f64,
    /// Greatest relative error; absent: only reported.
    pub tolerance: Option<f64>,
}

impl Row {
    /// Relative error: computed over expected, less one.
    pub fn error(&self) -> f64 {
        self.computed / self.expected - 1.0
    }

    fn within(&self) -> bool {
        self.tolerance.is_none_or(|tolerance| self.error().abs() <= tolerance)
    }
}

/// The rows of one benchmark.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Table {
    /// Heading of the table in the report.
    pub title: String,
    /// Source of the expected values.
    pub source: String,
    /// The command that computes it.
    pub command: String,
    /// The comparisons, in the order in which they were added.
    pub rows: Vec<Row>,
}

/// Records are kept to so many digits, and a record is stale when it differs by more than this: what vector instructions
/// and the order of summation may change is far below.
const DIGITS: f64 = 1e6;
const STALE: f64 = 3e-6;

impl Table {
    /// Empty. `source`: where the expected values stand; `command`: the arguments of `cargo test --release` that run the
    /// test.
    pub fn new(title: &str, source: &str, command: &str) -> Self {
        let command = format!("cargo test --release {command}");
        Self { title: title.into(), source: source.into(), command, rows: Vec::new() }
    }

    /// Adds a comparison.
    pub fn row(&mut self, case: impl Into<String>, expected: f64, computed: f64, tolerance: f64) {
        self.rows.push(Row { case: case.into(), expected, computed, tolerance: Some(tolerance) });
    }

    /// Adds a comparison that is reported, not judged: no published result for an element of this kind.
    pub fn report(&mut self, case: impl Into<String>, expected: f64, computed: f64) {
        self.rows.push(Row { case: case.into(), expected, computed, tolerance: None });
    }

    /// Prints the table and compares it with its record.
    ///
    /// # Panics
    /// An error is beyond its tolerance, or the record says something else.
    pub fn finish(mut self) {
        println!("{self}");
        let wrong: Vec<&str> = self.rows.iter().filter(|r| !r.within()).map(|r| r.case.as_str()).collect();
        assert!(wrong.is_empty(), "{}: beyond tolerance: {wrong:?}", self.title);
        let path = folder().join(format!("{}.json", self.key()));
        if blessing() {
            for row in &mut self.rows {
                (row.expected, row.computed) = (rounded(row.expected), rounded(row.computed));
            }
            let text = serde_json::to_string_pretty(&self).expect("a table is JSON");
            std::fs::write(&path, text + "\n").unwrap_or_else(|e| panic!("{}: {e}", path.display()));
            return;
        }
        let stale = format!("{} does not say what this test computes; {BLESS}", path.display());
        let text = std::fs::read_to_string(&path).unwrap_or_else(|e| panic!("{}: {e}; {BLESS}", path.display()));
        let kept: Self = serde_json::from_str(&text).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
        let heads = |t: &Self| [&t.title, &t.source, &t.command].map(Clone::clone);
        assert_eq!((heads(&self), self.rows.len()), (heads(&kept), kept.rows.len()), "{stale}");
        for (now, kept) in self.rows.iter().zip(&kept.rows) {
            let same = |a: f64, b: f64| (a - b).abs() <= STALE * a.abs().max(b.abs()).max(1e-3 * now.expected.abs());
            let equal = (&now.case, now.tolerance) == (&kept.case, kept.tolerance);
            assert!(equal && same(now.expected, kept.expected), "{stale}: {now:?}, kept {kept:?}");
            assert!(same(now.computed, kept.computed), "{stale}: {now:?}, kept {kept:?}");
        }
    }

    /// Name of its record.
    fn key(&self) -> String {
        let letters = self.title.to_lowercase().replace('°', " degrees").replace('×', "x");
        let words = letters.split(|c: char| !c.is_ascii_alphanumeric()).filter(|word| !word.is_empty());
        words.collect::<Vec<_>>().join("-")
    }
}

/// How to write records anew.
pub const BLESS: &str = "TTB_BLESS=1 writes it anew";

/// Whether records are to be written.
pub fn blessing() -> bool {
    std::env::var_os("TTB_BLESS").is_some_and(|value| value == "1")
}

/// The folder docs/verification of the repository.
pub fn folder() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../docs/verification")
}

fn rounded(x: f64) -> f64 {
    if x == 0.0 || !x.is_finite() {
        return x;
    }
    let scale = 10_f64.powi(x.abs().log10().floor() as i32);
    let digits = format!("{:e}", (x / scale * DIGITS).round() / DIGITS * scale);
    // As few digits as the comparison needs.
    digits.parse::<f64>().ok().and_then(|x| format!("{x:.6e}").parse().ok()).unwrap_or(x)
}

impl fmt::Display for Table {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "\n### {}\n\n{}\n", self.title, self.source)?;
        writeln!(f, "| case | expected | computed | error | allowed |\n|---|---|---|---|---|")?;
        self.rows.iter().try_for_each(|r| {
            let error = 100.0 * r.error();
            let tolerance = r.tolerance.map_or_else(|| "reported".into(), |t| format!("{} %", significant(100.0 * t)));
            let error = if error.abs() < 0.01 { format!("{error:.0e} %") } else { format!("{error:+.2} %") };
            let (expected, computed) = (significant(r.expected), significant(r.computed));
            writeln!(f, "| {} | {expected} | {computed} | {error} | {tolerance} |", r.case)
        })
    }
}

/// Six significant digits.
fn significant(x: f64) -> String {
    if x == 0.0 {
        return "0".into();
    }
    let magnitude = x.abs().log10().floor() as i32;
    if !(-3..6).contains(&magnitude) {
        let text = format!("{x:.5e}");
        let (digits, exponent) = text.split_once('e').unwrap_or((&text, "0"));
        return format!("{}e{exponent}", digits.trim_end_matches('0').trim_end_matches('.'));
    }
    let text = format!("{x:.*}", (5 - magnitude).max(0) as usize);
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').into() } else { text }
}

/// Order of convergence from errors on two meshes, the second `ratio` times finer.
pub fn order(coarse: f64, fine: f64, ratio: f64) -> f64 {
    (coarse / fine).abs().ln() / ratio.ln()
}
