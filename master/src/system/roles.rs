//! Which component is the train–track side, and whether all is connected that must be.

use std::collections::{BTreeMap, HashMap, HashSet};

use ttb_contract::names::parse_support;
use ttb_fmi::description::VariableType;
use ttb_ssp::{Flat, Report};

use super::wiring::{Link, Side};
use crate::connect::map::Value;

/// Index of the train–track component: the one that is named, or the one that sends forces. Where neither tells, the one
/// that can repeat steps, else the first: then a warning says so.
pub fn train_track(
    named: Option<&str>,
    sides: &[Side; 2],
    links: &[Link],
    place: &str,
    warnings: &mut Vec<String>,
    report: &mut Report,
) -> Option<usize> {
    for from in [0, 1] {
        if !links.iter().any(|link| link.from == from) {
            let (a, b) = (&sides[from].0.name, &sides[1 - from].0.name);
            report.problem("", format!("no usable connection leads from {a:?} to {b:?}: there is nothing to iterate"));
            return None;
        }
    }
    if let Some(name) = named {
        let found = sides.iter().position(|(component, _)| component.name == name);
        if found.is_none() {
            report.problem(&format!("{place}/@train_track"), format!("there is no component {name}"));
        }
        return found;
    }
    let sends = |from: usize| links.iter().any(|link| link.from == from && link.is_force);
    match (sends(0), sends(1)) {
        (true, false) => Some(0),
        (false, true) => Some(1),
        (both, _) => {
            let repeats = |k: usize| sides[k].1.co_simulation.can_get_and_set_state;
            let found = usize::from(repeats(1) && !repeats(0));
            let (a, b) = (&sides[found].0.name, &sides[1 - found].0.name);
            let who = if both { "both components send" } else { "no component sends" };
            warnings.push(format!(
                "by their units {who} forces (N): {a} is taken for the side that gives forces to {b}; say it with the attribute \
                 train_track of the annotation org.ttb.coupling"
            ));
            Some(found)
        }
    }
}

/// Whether forces and motions are those of a track's supports, by our names: then what holds for decks holds.
pub fn is_deck(links: &[Link], train_track: usize) -> bool {
    links.iter().filter(|link| link.from == train_track).all(|link| parse_support(&link.output).is_some())
}

/// Inputs that nothing drives and forces that would be lost; returns warnings. A single input may stay open: it keeps its
/// start value. One of a series others of which are driven has been forgotten, on the train–track side.
pub fn complete(
    train_track: usize,
    sides: &[Side; 2],
    links: &[Link],
    flat: &Flat,
    values: [&BTreeMap<String, Value>; 2],
    report: &mut Report,
) -> Vec<String> {
    let bridge = 1 - train_track;
    let mut warnings = Vec::new();
    for (side, (component, _)) in sides.iter().enumerate() {
        let driven: HashSet<&str> =
            links.iter().filter(|link| link.from != side).map(|link| link.input.as_str()).collect();
        let begun: HashSet<String> = driven.iter().filter_map(|name| series(name)).collect();
        let open = sides[side].1.with_causality("input").filter(|v| v.kind == VariableType::Real);
        let open =
            open.map(|v| v.name.as_str()).filter(|name| !driven.contains(name) && !values[side].contains_key(*name));
        let (forgotten, kept): (Vec<&str>, Vec<&str>) =
            open.partition(|name| side == train_track && series(name).is_some_and(|series| begun.contains(&series)));
        if let Some(said) = named(&forgotten) {
            report.problem(
                &component.place,
                format!("no connection drives the input {said}, though others of its series are driven"),
            );
        }
        if let Some(said) = named(&kept) {
            let connectors: HashMap<&str, &str> = flat
                .undriven
                .iter()
                .filter(|(k, ..)| *k == side)
                .map(|(_, input, connector)| (input.as_str(), connector.as_str()))
                .collect();
            let by =
                connectors.get(kept[0]).map_or_else(String::new, |by| format!(" (nothing drives {by} of the system)"));
            warnings.push(format!(
                "{}: no connection drives the input {said}{by}: it keeps its start value",
                component.name
            ));
        }
    }
    // A series as a whole may stay open; one of which a part is connected would lose forces.
    let connected: HashSet<&str> = links.iter().filter(|l| l.from == train_track).map(|l| l.output.as_str()).collect();
    let begun: HashSet<String> = connected.iter().filter_map(|name| series(name)).collect();
    let outputs = sides[train_track].1.with_causality("output").map(|v| v.name.as_str());
    let mut lost =
        outputs.filter(|name| !connected.contains(name) && series(name).is_some_and(|series| begun.contains(&series)));
    if let Some(first) = lost.next() {
        let (more, others) = (lost.count(), connected.len());
        let (component, bridge) = (sides[train_track].0, &sides[bridge].0.name);
        report.problem(
            &component.place,
            format!("the output {first} (and {more} more) is not connected to {bridge}, though {others} others are: forces would be lost"),
        );
    }
    warnings
}

/// What the names of a series share; none of a name without number.
fn series(name: &str) -> Option<String> {
    let numbered = name.contains(|c: char| c.is_ascii_digit());
    numbered.then(|| name.split(|c: char| c.is_ascii_digit()).collect::<Vec<_>>().join("#"))
}

/// The first name, and how many more there are.
fn named(names: &[&str]) -> Option<String> {
    let first = names.first()?;
    let more = names.len() - 1;
    Some(if more == 0 { first.to_string() } else { format!("{first} (and {more} more)") })
}
