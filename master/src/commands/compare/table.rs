//! The table: on the screen, as compare.csv and as compare.json.

use std::path::Path;

use serde::Serialize;
use ttb_scenario::Checked;

use crate::error::Error;
use crate::files;
use crate::results::ran::{QUANTITIES, Ran, Watched};

/// A row as it is shown.
#[derive(Debug, Serialize)]
pub struct Row {
    method: String,
    step_s: f64,
    steps: u64,
    steps_taken: u64,
    /// False: the total is extrapolated, and the differences are those of the time reached.
    complete: bool,
    reached_s: f64,
    preparation_cpu_s: f64,
    cpu_per_step_s: f64,
    total_cpu_s: f64,
    mean_iterations: f64,
    mean_factorisations: f64,
    /// Peaks of the four quantities, SI.
    peaks: [f64; 4],
    /// Their differences from the reference run, relative.
    #[serde(skip_serializing_if = "Option::is_none")]
    peak_differences: Option<[f64; 4]>,
    /// Greatest differences of the four histories from the row of equal step above that went furthest, relative to the
    /// greatest of all rows.
    #[serde(skip_serializing_if = "Option::is_none")]
    equal_step_differences: Option<[f64; 4]>,
    notes: Vec<String>,
    /// Why it could not go on.
    #[serde(skip_serializing_if = "Option::is_none")]
    failure: Option<String>,
}

/// All rows.
#[derive(Debug)]
pub struct Table {
    quantities: Vec<String>,
    reference_step_s: Option<f64>,
    rows: Vec<Row>,
}

impl Table {
    /// From the rows and the run of a fine step.
    pub fn new(rows: &[Ran], truth: Option<&Ran>, watched: &Watched) -> Self {
        let quantities = || std::array::from_fn(|i| i);
        // A row cut short before the train reaches the bridge has no peaks worth the name: the greatest of all rows count.
        let greatest = |q: usize| rows.iter().map(|ran| ran.peak(q, f64::INFINITY)).fold(0.0, f64::max);
        let row = |(place, ran): (usize, &Ran)| {
            let until = |truth: &Ran| ran.reached().min(truth.reached());
            let relative = |truth: &Ran, q: usize| ran.peak(q, until(truth)) / truth.peak(q, until(truth)) - 1.0;
            let of_equal_step = rows[..place].iter().filter(|other| (other.step / ran.step - 1.0).abs() < 1e-9);
            // The first of those that went furthest: one that was cut short says little.
            let equal = of_equal_step.rev().max_by(|a, b| a.reached().total_cmp(&b.reached()));
            Row {
                method: ran.method.clone(),
                step_s: ran.step,
                steps: ran.steps,
                steps_taken: ran.taken,
                complete: ran.complete(),
                reached_s: ran.reached(),
                preparation_cpu_s: ran.preparation,
                cpu_per_step_s: ran.per_step(),
                total_cpu_s: ran.total(),
                mean_iterations: ran.mean_iterations(),
                mean_factorisations: ran.factors as f64 / ran.taken.max(1) as f64,
                peaks: quantities().map(|q: usize| ran.peak(q, f64::INFINITY)),
                peak_differences: truth.map(|truth| quantities().map(|q: usize| relative(truth, q))),
                equal_step_differences: equal
                    .map(|other| quantities().map(|q: usize| ran.difference(other, q) / greatest(q))),
                notes: ran.notes.clone(),
                failure: ran.failure.clone(),
            }
        };
        Self {
            quantities: (0..4).map(|q| watched.describe(q)).collect(),
            reference_step_s: truth.map(|truth| truth.step),
            rows: rows.iter().enumerate().map(row).collect(),
        }
    }

    /// Writes compare.csv and compare.json.
    pub fn write(&self, checked: &Checked, folder: &Path) -> Result<(), Error> {
        let titled = serde_json::json!({ "title": checked.scenario.title, "scenario_sha256": checked.hash,
            "quantities": self.quantities, "reference_step_s": self.reference_step_s, "rows": self.rows });
        files::write_json(&folder.join("compare.json"), &titled)?;
        let path = folder.join("compare.csv");
        let failed = |e: csv::Error| Error::Io { path: path.clone(), source: e.into() };
        let mut file = csv::Writer::from_writer(Vec::new());
        let mut header: Vec<String> = [
            "method",
            "step_s",
            "steps",
            "steps_taken",
            "preparation_cpu_s",
            "cpu_per_step_s",
            "total_cpu_s",
            "mean_iterations",
            "mean_factorisations",
        ]
        .map(String::from)
        .to_vec();
        for of in ["peak", "peak_difference", "equal_step_difference"] {
            header.extend(QUANTITIES.iter().map(|q| format!("{of}_{}", q.key.replace('-', "_"))));
        }
        file.write_record(&header).map_err(failed)?;
        for row in &self.rows {
            let counts = [row.steps, row.steps_taken].map(|n| n.to_string());
            let mut fields = vec![row.method.clone(), row.step_s.to_string()];
            fields.extend(counts);
            let numbers = [row.preparation_cpu_s, row.cpu_per_step_s, row.total_cpu_s];
            fields.extend(numbers.iter().map(|x| format!("{x:.6e}")));
            fields.extend([row.mean_iterations, row.mean_factorisations].iter().map(|x| format!("{x:.4}")));
            for group in [Some(row.peaks), row.peak_differences, row.equal_step_differences] {
                fields.extend((0..4).map(|q| group.map_or_else(String::new, |g| format!("{:.9e}", g[q]))));
            }
            file.write_record(&fields).map_err(failed)?;
        }
        let text = file.into_inner().map_err(|e| e.into_error()).map_err(Error::io(&path))?;
        files::write(&path, &text)
    }

    /// The paper's Table 2.
    pub fn print(&self, checked: &Checked, folder: &Path) {
        say!("{}", checked.scenario.title);
        if let Some(h) = self.reference_step_s {
            say!("peaks against a run of the hybrid algorithm with steps of {} ms:", 1e3 * h);
        }
        for (q, quantity) in self.quantities.iter().enumerate() {
            say!("  ({}) {quantity}", (b'a' + q as u8) as char);
        }
        say!("");
        say!(
            "{:<24} {:>7} {:>8} {:>10} {:>10} {:>6}   {:>8} {:>8} {:>8} {:>8}  {:>9}",
            "method",
            "h, ms",
            "steps",
            "CPU s/step",
            "total s",
            "iter.",
            "(a) %",
            "(b) %",
            "(c) %",
            "(d) %",
            "equal h"
        );
        for row in &self.rows {
            let differences = (0..4).map(|q| {
                let percent = row.peak_differences.map(|d| 100.0 * d[q]).filter(|d| d.is_finite());
                percent.map_or_else(|| format!("{:>8}", "–"), |d| format!("{d:>8.3}"))
            });
            let differences: Vec<String> = differences.collect();
            let equal = row.equal_step_differences.map(|d| d.iter().copied().fold(0.0, f64::max));
            let equal = equal.filter(|d| d.is_finite()).map_or_else(String::new, |d| format!("{d:.1e}"));
            let total = match (&row.failure, row.complete) {
                (Some(_), _) => "–".into(),
                (None, true) => format!("{:.1}", row.total_cpu_s),
                (None, false) => format!("{:.1}*", row.total_cpu_s),
            };
            say!(
                "{:<24} {:>7.4} {:>8} {:>10.3e} {:>10} {:>6.2}   {}  {:>9}",
                row.method,
                1e3 * row.step_s,
                row.steps,
                row.cpu_per_step_s,
                total,
                row.mean_iterations,
                differences.join(" "),
                equal
            );
        }
        for row in self.rows.iter().filter(|row| !row.complete && row.failure.is_none()) {
            say!(
                "* {}: extrapolated from {} steps; its peaks are compared up to t = {:.4} s",
                row.method,
                row.steps_taken,
                row.reached_s
            );
        }
        for row in &self.rows {
            let stopped = row.failure.iter().map(|why| format!("stopped: {why}"));
            row.notes
                .iter()
                .cloned()
                .chain(stopped)
                .for_each(|note| say!("  {} at {:.4} ms: {note}", row.method, 1e3 * row.step_s));
        }
        say!("  equal h: greatest difference of the four histories from the furthest row above of that step, relative");
        say!("  results in {}", folder.display());
    }
}
