//! The page: counts by tool and by reason, in Markdown.

use std::collections::BTreeMap;
use std::fmt::Write;

use super::{Kind, Row};
use crate::printed::one_line;

/// Reasons in a table at most; the others are counted together.
const REASONS: usize = 30;

/// The whole page; `files` adds a row for each file.
pub fn page(rows: &[Row], files: bool) -> String {
    let of = |kind: Kind| rows.iter().filter(move |row| row.kind == kind);
    let mut text = String::from("# Interoperability\n\n");
    let run = |kind: Kind| of(kind).filter(|row| row.reasons.is_empty()).count();
    let counts = [Kind::Fmu, Kind::System].map(|kind| (of(kind).count(), run(kind)));
    put(
        &mut text,
        format_args!(
            "Made by `ttb interoperability` {}: {} FMUs, of which {} run; {} system structures, of which {} run. An FMU runs if it \
             can be loaded, initialized and stepped here; findings are those of `ttb check`. A system runs if `ttb run` ends \
             without failure, or still runs after the time that was given.",
            env!("CARGO_PKG_VERSION"),
            counts[0].0,
            counts[0].1,
            counts[1].0,
            counts[1].1
        ),
    );
    if counts[0].0 > 0 {
        put(&mut text, format_args!("\n## FMUs by tool\n\n| tool | FMUs | run | findings |\n|---|---|---|---|"));
        tools(&mut text, &of(Kind::Fmu).collect::<Vec<_>>(), true);
        reasons(&mut text, "Why FMUs are not run", of(Kind::Fmu));
    }
    if counts[1].0 > 0 {
        put(&mut text, format_args!("\n## System structures by tool\n\n| tool | systems | run |\n|---|---|---|"));
        tools(&mut text, &of(Kind::System).collect::<Vec<_>>(), false);
        reasons(&mut text, "Why system structures are not run", of(Kind::System));
    }
    if files {
        put(&mut text, format_args!("\n## Files\n\n| file | tool | findings | run, or why not |\n|---|---|---|---|"));
        for row in rows {
            let why = if row.reasons.is_empty() { "runs".into() } else { row.reasons.join("; ") };
            let [path, tool, found, why] =
                [row.path.display().to_string(), row.tool.clone(), found(std::iter::once(row)), why]
                    .map(|text| cell(&text));
            put(&mut text, format_args!("| {path} | {tool} | {found} | {why} |"));
        }
    }
    format!("{}\n", text.trim_end())
}

fn put(text: &mut String, line: std::fmt::Arguments) {
    // Writing to memory does not fail.
    let _ = writeln!(text, "{line}");
}

fn tools(text: &mut String, rows: &[&Row], findings: bool) {
    let mut tools: BTreeMap<&str, Vec<&Row>> = BTreeMap::new();
    for row in rows {
        tools.entry(&row.tool).or_default().push(row);
    }
    for (tool, rows) in tools {
        let (tool, all, run) = (cell(tool), rows.len(), rows.iter().filter(|row| row.reasons.is_empty()).count());
        let found = if findings { format!(" {} |", found(rows.into_iter())) } else { String::new() };
        put(text, format_args!("| {tool} | {all} | {run} |{found}"));
    }
}

/// Names of findings and of how many files they are told, remarks left out.
fn found<'a>(rows: impl Iterator<Item = &'a Row>) -> String {
    let mut names: BTreeMap<&str, usize> = BTreeMap::new();
    for row in rows {
        let mut own: Vec<&str> =
            row.findings.iter().filter(|(severity, _)| severity != "remark").map(|(_, name)| name.as_str()).collect();
        own.sort_unstable();
        own.dedup();
        own.into_iter().for_each(|name| *names.entry(name).or_default() += 1);
    }
    let told: Vec<String> = names.iter().map(|(name, count)| format!("{name} {count}")).collect();
    if told.is_empty() { "none".into() } else { told.join(", ") }
}

fn reasons<'a>(text: &mut String, title: &str, rows: impl Iterator<Item = &'a Row>) {
    let mut counts: BTreeMap<&str, usize> = BTreeMap::new();
    rows.flat_map(|row| &row.reasons).for_each(|reason| *counts.entry(reason).or_default() += 1);
    if counts.is_empty() {
        return;
    }
    let mut counts: Vec<(&str, usize)> = counts.into_iter().collect();
    counts.sort_by_key(|(reason, count)| (std::cmp::Reverse(*count), *reason));
    put(text, format_args!("\n## {title}\n\nA file may have several reasons.\n\n| reason | files |\n|---|---|"));
    for (reason, count) in counts.iter().take(REASONS) {
        put(text, format_args!("| {} | {count} |", cell(reason)));
    }
    let more: usize = counts.iter().skip(REASONS).map(|(_, count)| count).sum();
    if more > 0 {
        put(text, format_args!("| others | {more} |"));
    }
}

/// A text within a table.
fn cell(text: &str) -> String {
    one_line(text).replace('|', "\\|").replace('<', "&lt;")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_are_counted_by_tool_and_by_reason() {
        let row = |kind, tool: &str, findings: &[(&str, &str)], reasons: &[&str]| Row {
            path: "a|b.fmu".into(),
            kind,
            tool: tool.into(),
            findings: findings.iter().map(|(severity, name)| (severity.to_string(), name.to_string())).collect(),
            reasons: reasons.iter().map(ToString::to_string).collect(),
        };
        let rows = [
            row(Kind::Fmu, "T", &[("error", "x"), ("error", "x"), ("remark", "y")], &[]),
            row(Kind::Fmu, "T", &[("error", "no-binary")], &["it has none"]),
            row(Kind::System, "not said", &[], &["N components"]),
        ];
        let text = page(&rows, false);
        assert!(text.contains("2 FMUs, of which 1 run; 1 system structures, of which 0 run"));
        assert!(text.contains("| T | 2 | 1 | no-binary 1, x 1 |") && text.contains("| N components | 1 |"));
        assert!(!text.contains("b.fmu") && page(&rows, true).contains("a\\|b.fmu"));
    }
}
