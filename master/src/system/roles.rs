//! Which component is the train–track side, and whether all is connected that must be.

use std::collections::HashSet;

use ttb_fmi::description::VariableType;
use ttb_ssp::Report;

use super::wiring::{Link, Side};

/// Index of the train–track component: the one that is named, or the one that sends forces. Reported where that is open.
pub fn train_track(
    named: Option<&str>,
    sides: &[Side; 2],
    links: &[Link],
    place: &str,
    report: &mut Report,
) -> Option<usize> {
    for from in [0, 1] {
        if !links.iter().any(|link| link.from == from) {
            let (a, b) = (&sides[from].0.name, &sides[1 - from].0.name);
            report.problem("", format!("no usable connection leads from {a} to {b}: there is nothing to iterate"));
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
            let (a, b) = (&sides[0].0.name, &sides[1].0.name);
            let who = if both { "both send" } else { "none sends" };
            report.problem(
                "",
                format!(
                    "which of {a} and {b} is the train–track side? By their units {who} forces (N) to the other; say it with the \
                     attribute train_track of the annotation org.ttb.coupling"
                ),
            );
            None
        }
    }
}

/// Inputs of the train–track side that nothing drives, and forces that would be lost; returns warnings for the bridge.
pub fn complete(train_track: usize, sides: &[Side; 2], links: &[Link], report: &mut Report) -> Vec<String> {
    let bridge = 1 - train_track;
    let mut warnings = Vec::new();
    for (side, (component, _)) in sides.iter().enumerate() {
        let Some(open) = open(sides, links, side, "input") else { continue };
        let said = format!("no connection drives the input {open}");
        if side == train_track {
            report.problem(&component.place, said);
        } else {
            warnings.push(format!("{}: {said}: it keeps its start value", component.name));
        }
    }
    // A series as a whole may stay open; one of which a part is connected would lose forces.
    let series = |name: &str| name.split(|c: char| c.is_ascii_digit()).collect::<Vec<_>>().join("#");
    let connected: HashSet<&str> = links.iter().filter(|l| l.from == train_track).map(|l| l.output.as_str()).collect();
    let begun: HashSet<String> =
        connected.iter().filter(|n| n.contains(|c: char| c.is_ascii_digit())).map(|n| series(n)).collect();
    let outputs = sides[train_track].1.with_causality("output").map(|v| v.name.as_str());
    let mut lost = outputs.filter(|name| !connected.contains(name) && begun.contains(&series(name)));
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

/// The first variable that no connection touches, and how many more there are.
fn open(sides: &[Side; 2], links: &[Link], side: usize, causality: &str) -> Option<String> {
    let driven: HashSet<&str> = links.iter().filter(|link| link.from != side).map(|link| link.input.as_str()).collect();
    let mut open = sides[side]
        .1
        .with_causality(causality)
        .filter(|v| v.kind == VariableType::Real && !driven.contains(v.name.as_str()));
    let first = open.next()?.name.clone();
    let more = open.count();
    Some(if more == 0 { first } else { format!("{first} (and {more} more)") })
}
