//! Columns of numbers over a rising first one: wind coefficients, ground motion, irregularity of several components.

use crate::input::Input;
use crate::problem::{Problems, Report, Stop};
use crate::table::{Column, Table};

/// Columns that were read, in the order in which they were asked for; one that may be absent and is, is none.
pub type Columns = Vec<Option<Vec<f64>>>;

/// Reads the columns `needed`, of which the first must rise, and those of `also` that are there; others are passed over.
///
/// # Errors
/// Everything that is wrong with the file, up to a limit.
pub fn series(input: &Input, needed: &[&str], also: &[&str]) -> Result<Columns, Problems> {
    let mut report = Report::new(input.name());
    match read(input, needed, also, &mut report) {
        Ok(columns) if report.problems.is_empty() => Ok(columns),
        _ => Err(Problems(report.problems)),
    }
}

fn read(input: &Input, needed: &[&str], also: &[&str], report: &mut Report) -> Result<Columns, Stop> {
    let mut table = Table::open(input, None, report)?;
    let must = needed.iter().map(|name| table.needs(name, report).map(Some)).collect::<Result<Vec<_>, _>>()?;
    let columns: Vec<Option<Column>> = must.into_iter().chain(also.iter().map(|name| table.column(name))).collect();
    let mut lists: Columns = columns.iter().map(|column| column.map(|_| Vec::new())).collect();
    while table.advance(report)? {
        let mut row = Vec::with_capacity(columns.len());
        for column in columns.iter().flatten() {
            row.extend(table.number(*column, report)?);
        }
        if row.len() < columns.iter().flatten().count() {
            continue; // has been reported
        }
        if let (Some(Some(first)), Some(now)) = (lists.first(), row.first())
            && let Some(last) = first.last().filter(|last| now <= last)
        {
            report.line(table.line(), format!("{} must increase", needed[0]), format!("{now} after {last}"))?;
            continue;
        }
        lists.iter_mut().flatten().zip(&row).for_each(|(list, value)| list.push(*value));
    }
    let rows = lists.iter().flatten().map(Vec::len).max().unwrap_or(0);
    if rows < 2 && report.problems.is_empty() {
        report.whole("the table must have at least 2 lines of numbers", rows);
    }
    Ok(lists)
}
