//! Measured irregularities: a table with columns `x` and `r`.

use std::path::Path;

use ttb_import::{Input, profile};

use crate::problem::{Report, Warning};

/// Where a scenario names the file.
const PATH: &str = "$.irregularity.file";

/// Abscissae and values of a measured profile, m; what is wrong with the file, or should be known of it, is reported.
pub(crate) fn read(file: &Path, report: &mut Report) -> Option<(Vec<f64>, Vec<f64>)> {
    match profile(&Input::path(file)) {
        Ok(profile) => {
            for remark in profile.remarks {
                report.note(Warning::at(PATH, format!("{PATH}: {}: {remark}", file.display())));
            }
            Some((profile.x, profile.r))
        }
        Err(problems) => {
            for problem in problems.0 {
                let line = problem.line.map_or_else(String::new, |line| format!(": line {line}"));
                let value = if problem.value.is_empty() { String::new() } else { format!(": {}", problem.value) };
                report.problem(PATH, problem.rule, format!("{}{line}{value}", file.display()));
            }
            None
        }
    }
}
