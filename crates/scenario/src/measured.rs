//! Measured irregularities: a CSV file with columns `x` and `r`.

use std::path::Path;

use crate::problem::Report;

/// Where a scenario names the file.
const PATH: &str = "$.irregularity.file";

/// Abscissae and values of a measured profile, m; what is wrong with the file is reported.
pub(crate) fn read(file: &Path, report: &mut Report) -> Option<(Vec<f64>, Vec<f64>)> {
    let before = report.problems.len();
    let mut bad = |rule: &str, found: &str| report.problem(PATH, rule, format!("{}: {found}", file.display()));
    let mut reader = csv::ReaderBuilder::new();
    let mut reader = match reader.trim(csv::Trim::All).flexible(true).from_path(file) {
        Ok(reader) => reader,
        Err(error) => {
            bad("the measured profile cannot be read", &error.to_string());
            return None;
        }
    };
    let headers = reader.headers().cloned().unwrap_or_default();
    let column = |name: &str| headers.iter().position(|header| header == name);
    let (Some(column_x), Some(column_r)) = (column("x"), column("r")) else {
        let found: Vec<&str> = headers.iter().collect();
        bad("the measured profile must have columns x and r", &format!("columns {}", found.join(", ")));
        return None;
    };

    let (mut x, mut r) = (Vec::new(), Vec::new());
    let (mut no_numbers, mut no_increase) = (Vec::new(), Vec::new()); // bad lines
    for record in reader.records() {
        let record = match record {
            Ok(record) => record,
            Err(error) => {
                bad("the measured profile cannot be read", &error.to_string());
                return None;
            }
        };
        let line = record.position().map_or(0, csv::Position::line);
        let number = |column: usize| record.get(column)?.parse::<f64>().ok().filter(|x| x.is_finite());
        match (number(column_x), number(column_r)) {
            (Some(at), Some(_)) if x.last().is_some_and(|last| at <= *last) => no_increase.push(line),
            (Some(at), Some(value)) => {
                x.push(at);
                r.push(value);
            }
            _ => no_numbers.push(line),
        }
    }
    if !no_numbers.is_empty() {
        bad("x and r must be finite numbers", &lines(&no_numbers));
    }
    if !no_increase.is_empty() {
        bad("x must increase", &lines(&no_increase));
    }
    if x.len() < 2 {
        bad("the measured profile must have at least 2 good lines", &x.len().to_string());
    }
    (report.problems.len() == before).then_some((x, r))
}

/// Line numbers for a message, the first few of them.
fn lines(numbers: &[u64]) -> String {
    const SHOWN: usize = 5;
    let shown: Vec<String> = numbers.iter().take(SHOWN).map(u64::to_string).collect();
    let more = if numbers.len() > SHOWN { format!(" and {} more", numbers.len() - SHOWN) } else { String::new() };
    format!("line {}{more}", shown.join(", "))
}
