//! `ttb list limits` and `ttb list criteria`: the limits that come with the program.

use serde_json::{Value, json};
use ttb_assessment::criterion::{DEFAULT, names, text};

use super::listed::{json as print, unknown};
use crate::cli::List;
use crate::error::Error;

/// The files: their names and editions, or one as it is.
pub(super) fn files(arguments: &List) -> Result<(), Error> {
    if let Some(name) = &arguments.name {
        let text =
            text(name).ok_or_else(|| unknown("file of limits", name, names().collect::<Vec<_>>().into_iter()))?;
        say!("{}", text.trim_end());
        return Ok(());
    }
    let all: Vec<(&str, Value)> = names().map(|name| (name, parsed(name))).collect();
    if arguments.json {
        return print(&all.into_iter().collect::<std::collections::BTreeMap<_, _>>());
    }
    for (name, file) in &all {
        let count = file["criteria"].as_array().map_or(0, Vec::len);
        let note = if DEFAULT.contains(name) { ", judges by default" } else { "" };
        say!("{name:<16} {} ({count} criteria{note})", word(&file["edition"]));
    }
    say!("--limits A,B.json chooses; your own file overrides single criteria by their id (docs/guide/assessment.md).");
    Ok(())
}

/// All criteria, one a line, or the data of those with an id.
pub(super) fn criteria(arguments: &List) -> Result<(), Error> {
    let all: Vec<(&str, Value)> = names()
        .flat_map(|file| {
            parsed(file)["criteria"].as_array().cloned().unwrap_or_default().into_iter().map(move |c| (file, c))
        })
        .collect();
    let ids: Vec<&str> = all.iter().map(|(_, criterion)| word(&criterion["id"])).collect();
    let asked = |criterion: &Value| arguments.name.as_ref().is_none_or(|name| word(&criterion["id"]) == name);
    let chosen: Vec<&(&str, Value)> = all.iter().filter(|(_, criterion)| asked(criterion)).collect();
    if let (Some(name), true) = (&arguments.name, chosen.is_empty()) {
        return Err(unknown("criterion", name, ids.iter().copied()));
    }
    if arguments.json || arguments.name.is_some() {
        return print(
            &chosen.iter().map(|(file, criterion)| json!({ "file": file, "criterion": criterion })).collect::<Vec<_>>(),
        );
    }
    for (file, criterion) in chosen {
        let (id, clause) = (word(&criterion["id"]), word(&criterion["clause"]));
        let verified = word(&criterion["verified"]);
        say!("{id:<24} {file:<16} {:<36} {clause}, {verified}", word(&criterion["quantity"]));
    }
    Ok(())
}

fn parsed(name: &str) -> Value {
    text(name).and_then(|text| serde_json::from_str(text).ok()).unwrap_or_default()
}

fn word(value: &Value) -> &str {
    value.as_str().unwrap_or_default()
}
