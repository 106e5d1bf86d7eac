//! Columns chosen by name, with `*` for anything: `car[*].acceleration`.

use crate::column::Column;
use crate::error::{Refusal, RunError};

/// Places of the columns that a pattern names, in the order of the columns; without patterns, all.
///
/// # Errors
/// A pattern that names no column: a slip of the pen would leave a column out silently.
pub(super) fn chosen(columns: &[Column], patterns: &[String]) -> Result<Vec<usize>, RunError> {
    if patterns.is_empty() {
        return Ok((0..columns.len()).collect());
    }
    let names: Vec<String> = columns.iter().map(ToString::to_string).collect();
    let without = |pattern: &&String| !names.iter().any(|name| matches(pattern, name));
    let unknown: Vec<&String> = patterns.iter().filter(without).collect();
    if !unknown.is_empty() {
        let series: std::collections::BTreeSet<String> = columns.iter().map(Column::series).collect();
        let known = series.iter().map(|series| series.replace("[]", "[*]")).collect::<Vec<_>>().join(", ");
        let unknown = unknown.iter().map(|pattern| format!("\"{pattern}\"")).collect::<Vec<_>>().join(", ");
        let text = format!("$.output.columns: no column of this run is called {unknown}; there are {known}");
        return Err(RunError::Refused(Refusal::Input(text)));
    }
    Ok((0..names.len()).filter(|i| patterns.iter().any(|pattern| matches(pattern, &names[*i]))).collect())
}

/// Whether a name is what a pattern says; `*` stands for any text, also none.
fn matches(pattern: &str, name: &str) -> bool {
    let Some((begin, rest)) = pattern.split_once('*') else { return pattern == name };
    let Some(mut name) = name.strip_prefix(begin) else { return false };
    let mut parts: Vec<&str> = rest.split('*').collect();
    // `split` gives at least one part: what stands after the last `*`.
    let end = parts.pop().unwrap_or_default();
    for part in parts {
        let Some(at) = name.find(part) else { return false };
        name = &name[at + part.len()..];
    }
    name.ends_with(end)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_star_stands_for_anything() {
        for (pattern, name, is) in [
            ("car[*].acceleration", "car[12].acceleration", true),
            ("car[*].acceleration", "car[12].displacement", false),
            ("*", "time", true),
            ("*acceleration", "point[mid].acceleration", true),
            ("point[mid].acceleration", "point[mid].acceleration", true),
            ("point[mid]", "point[mid].acceleration", false),
            ("*[*].*force", "wheel[1].contact_force", true),
            ("a*a", "a", false),
        ] {
            assert_eq!(matches(pattern, name), is, "{pattern} {name}");
        }
    }

    #[test]
    fn a_pattern_that_names_nothing_is_refused_with_the_names_there_are() {
        let columns = ["car[1].acceleration", "car[2].acceleration", "point[mid].displacement"]
            .map(|name| Column::parse(name, "m"));
        let patterns = |patterns: &[&str]| patterns.iter().map(ToString::to_string).collect::<Vec<_>>();
        assert_eq!(chosen(&columns, &[]).expect("all"), [0, 1, 2]);
        assert_eq!(chosen(&columns, &patterns(&["point*", "car[2].*"])).expect("known"), [1, 2]);
        let refused = chosen(&columns, &patterns(&["car[*].accel", "point*"])).expect_err("unknown").to_string();
        assert!(
            refused.contains("\"car[*].accel\"; there are car[*].acceleration, point[*].displacement"),
            "{refused}"
        );
    }
}
