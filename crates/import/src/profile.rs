//! A measured profile: a table with columns x and r, x increasing.

use crate::input::Input;
use crate::problem::{Problem, Problems, Report, Stop};
use crate::table::Table;

/// A gap is longer than so many usual spacings.
const GAP: f64 = 3.0;
/// Places shown one by one.
const SHOWN: usize = 5;

/// What was read.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Profile {
    /// Abscissae, m, rising.
    pub x: Vec<f64>,
    /// Values there, m.
    pub r: Vec<f64>,
    /// What should be known of it, a sentence each: gaps.
    pub remarks: Vec<String>,
}

/// Reads a profile; other columns than x and r are passed over.
///
/// # Errors
/// Everything that is wrong with the file, up to a limit.
pub fn profile(input: &Input) -> Result<Profile, Problems> {
    let mut report = Report::new(input.name());
    match read(input, &mut report) {
        Ok(profile) if report.problems.is_empty() => Ok(profile),
        _ => Err(Problems(report.problems)),
    }
}

fn read(input: &Input, report: &mut Report) -> Result<Profile, Stop> {
    let mut table = Table::open(input, None, report)?;
    let (Some(x), Some(r)) = (table.column("x"), table.column("r")) else {
        let unit = table.header.iter().any(|name| name.starts_with("x ") || name.starts_with("r "));
        let also = if unit { "; both in m (the scenario's `scale` turns other units of r into m)" } else { "" };
        let found = format!("columns {}{also}", table.header.join(", "));
        return Err(report.fatal(Some(table.line()), "the measured profile must have columns x and r", found));
    };
    let mut profile = Profile::default();
    let mut back: Vec<(u64, f64, f64)> = Vec::new();
    while table.advance(report)? {
        let (Some(x), Some(r)) = (table.number(x, report)?, table.number(r, report)?) else { continue };
        match profile.x.last() {
            Some(last) if x <= *last => back.push((table.line(), x, *last)),
            _ => {
                profile.x.push(x);
                profile.r.push(r);
            }
        }
    }
    unsorted(&back, profile.x.len(), report);
    if profile.x.len() < 2 && report.problems.is_empty() {
        report.whole("the measured profile must have at least 2 lines", profile.x.len());
    }
    profile.remarks = gaps(&profile.x);
    Ok(profile)
}

fn unsorted(back: &[(u64, f64, f64)], good: usize, report: &mut Report) {
    let Some((line, x, last)) = back.first() else { return };
    let more = if back.len() > 1 { format!(" (and {} more lines)", back.len() - 1) } else { String::new() };
    let advice = if back.iter().all(|(_, x, last)| x == last) {
        ": twice the same place"
    } else if good == 1 {
        ": it falls throughout; sort the lines"
    } else {
        ": sort the lines"
    };
    let found = format!("{x} m after {last} m{more}{advice}");
    report.problems.push(Problem {
        file: report.file().to_owned(),
        line: Some(*line),
        rule: "x must increase".into(),
        value: found,
    });
}

/// Gaps among samples at a usual spacing, the median.
fn gaps(x: &[f64]) -> Vec<String> {
    let mut steps: Vec<f64> = x.windows(2).map(|pair| pair[1] - pair[0]).collect();
    let middle = steps.len() / 2;
    if steps.len() < 4 {
        return Vec::new();
    }
    let usual = *steps.select_nth_unstable_by(middle, f64::total_cmp).1;
    let gaps: Vec<[f64; 2]> =
        x.windows(2).filter(|pair| pair[1] - pair[0] > GAP * usual).map(|pair| [pair[0], pair[1]]).collect();
    if gaps.is_empty() {
        return Vec::new();
    }
    let shown: Vec<String> = gaps.iter().take(SHOWN).map(|[from, to]| format!("{from} to {to} m")).collect();
    let more = if gaps.len() > SHOWN { format!(" and {} more", gaps.len() - SHOWN) } else { String::new() };
    vec![format!(
        "the measured profile has gaps ({}{more}) among samples every {usual} m: a straight line bridges them",
        shown.join(", ")
    )]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn gaps_are_those_of_more_than_three_spacings() {
        let mut x: Vec<f64> = (0..100).map(|i| 0.25 * f64::from(i)).collect();
        assert!(gaps(&x).is_empty());
        x.drain(40..60);
        let found = gaps(&x);
        assert!(found[0].contains("(9.75 to 15 m) among samples every 0.25 m"), "{found:?}");
    }
}
