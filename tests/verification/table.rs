//! Rows of expected and computed values; printed as Markdown, then held against their tolerances.

use std::fmt;

/// One comparison.
pub struct Row {
    /// What is compared.
    pub case: String,
    /// As published or from the closed form.
    pub expected: f64,
    /// As computed.
    pub computed: f64,
    /// Greatest relative error; infinite: only reported.
    pub tolerance: f64,
}

impl Row {
    /// Computed over expected, less one.
    pub fn error(&self) -> f64 {
        self.computed / self.expected - 1.0
    }
}

/// The rows of one benchmark.
pub struct Table {
    title: &'static str,
    source: &'static str,
    rows: Vec<Row>,
}

impl Table {
    /// Empty; `source`: where the expected values stand.
    pub fn new(title: &'static str, source: &'static str) -> Self {
        Self { title, source, rows: Vec::new() }
    }

    /// Adds a comparison.
    pub fn row(&mut self, case: impl Into<String>, expected: f64, computed: f64, tolerance: f64) {
        self.rows.push(Row { case: case.into(), expected, computed, tolerance });
    }

    /// Adds a comparison that is reported, not judged: no published result for an element of this kind.
    pub fn report(&mut self, case: impl Into<String>, expected: f64, computed: f64) {
        self.row(case, expected, computed, f64::INFINITY);
    }

    /// Prints the table.
    ///
    /// # Panics
    /// An error is beyond its tolerance.
    pub fn finish(self) {
        println!("{self}");
        let within = |r: &Row| r.error().abs() <= r.tolerance;
        let wrong: Vec<&str> = self.rows.iter().filter(|r| !within(r)).map(|r| r.case.as_str()).collect();
        assert!(wrong.is_empty(), "{}: beyond tolerance: {wrong:?}", self.title);
    }
}

impl fmt::Display for Table {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "\n### {}\n\n{}\n\n| case | expected | computed | error | tolerance |", self.title, self.source)?;
        writeln!(f, "|---|---|---|---|---|")?;
        self.rows.iter().try_for_each(|r| {
            let error = 100.0 * r.error();
            let tolerance = if r.tolerance < 1.0 { format!("{} %", 100.0 * r.tolerance) } else { "reported".into() };
            let error = if error.abs() < 0.01 { format!("{error:.1e} %") } else { format!("{error:+.2} %") };
            writeln!(f, "| {} | {:.5e} | {:.5e} | {error} | {tolerance} |", r.case, r.expected, r.computed)
        })
    }
}

/// Order of convergence from errors on two meshes, the second `ratio` times finer.
pub fn order(coarse: f64, fine: f64, ratio: f64) -> f64 {
    (coarse / fine).abs().ln() / ratio.ln()
}
