//! Variables of equal name belong together, where no map says otherwise.

use std::collections::HashSet;

use ttb_contract::Component;
use ttb_contract::names::parse_support;
use ttb_fmi::description::{ModelDescription, VariableType};
use ttb_fmi::{FmuInstance, Linear};

use super::assign::{Assigned, Ends, declared, without};
use crate::error::Error;

/// Everything that has the same name on both sides, in its declared units.
pub fn equal_names(
    train_track: &FmuInstance,
    bridge: &FmuInstance,
    warnings: &mut Vec<String>,
) -> Result<Assigned, Error> {
    let forces = shared(train_track.description(), bridge.description());
    let motions = shared(bridge.description(), train_track.description());
    let (absent, told) = absent(train_track.description(), &motions);
    let connected = [&motions[..], &absent].concat();
    if let Some(open) = unconnected(train_track.description(), &connected) {
        return Err(Error::Input(format!(
            "{}: no output of {} has the name of its input {open}",
            train_track.name(),
            bridge.name()
        )));
    }
    if forces.is_empty() || motions.is_empty() {
        let (a, b) = (bridge.name(), train_track.name());
        return Err(Error::Input(format!(
            "{a} and {b} share no variable of equal name that is an input of one and an output of the other"
        )));
    }
    refuse_other_scenarios(bridge, train_track, &forces)?;
    warnings.extend(without(bridge.name(), &told));
    if let Some(open) = unconnected(bridge.description(), &forces) {
        warnings.push(format!("{}: input {open} is connected to nothing and keeps its start value", bridge.name()));
    }
    let mut problems = Vec::new();
    let mut ends = |names: Vec<String>, from: &FmuInstance, to: &FmuInstance| -> [Ends; 2] {
        let mut line = |side: &FmuInstance, name: &str| {
            let line = declared(side.description(), name).map_err(|e| problems.push(format!("{}: {e}", side.name())));
            line.ok().flatten().unwrap_or(Linear::IDENTITY)
        };
        let [mut out, mut into] = [Ends::default(), Ends::default()];
        for name in names {
            out.push(name.clone(), line(from, &name));
            let line = line(to, &name).inverse();
            into.push(name, line);
        }
        [out, into]
    };
    let (forces, motions) = (ends(forces, train_track, bridge), ends(motions, bridge, train_track));
    if problems.is_empty() {
        Ok(Assigned::one_to_one(forces, motions))
    } else {
        Err(Error::Input(problems.join("\n  ")))
    }
}

/// Inputs of the train–track side for components of the deck's motion of which the bridge gives none, and those components: a
/// bridge that moves vertically only stays usable in space.
fn absent(train_track: &ModelDescription, motions: &[String]) -> (Vec<String>, Vec<Component>) {
    let of = |name: &str| {
        let (_, quantity) = parse_support(name)?;
        [Component::Lateral, Component::Roll]
            .into_iter()
            .find(|component| [component.position(), component.rate()].contains(&quantity))
    };
    let given: HashSet<Component> = motions.iter().filter_map(|name| of(name)).collect();
    let inputs = train_track.with_causality("input").filter_map(|v| Some((v.name.clone(), of(&v.name)?)));
    let absent: Vec<(String, Component)> = inputs.filter(|(_, component)| !given.contains(component)).collect();
    let has = |component: &Component| absent.iter().any(|(_, other)| other == component);
    let components = [Component::Lateral, Component::Roll].into_iter().filter(has).collect();
    (absent.into_iter().map(|(name, _)| name).collect(), components)
}

/// Real outputs of `from` that are Real inputs of `to`, in the order of the inputs.
fn shared(from: &ModelDescription, to: &ModelDescription) -> Vec<String> {
    let outputs: HashSet<&str> =
        from.with_causality("output").filter(|v| v.kind == VariableType::Real).map(|v| v.name.as_str()).collect();
    let inputs = to.with_causality("input").filter(|v| v.kind == VariableType::Real);
    inputs.filter(|v| outputs.contains(v.name.as_str())).map(|v| v.name.clone()).collect()
}

/// The first input that is not among `connected`, and how many more there are.
fn unconnected(description: &ModelDescription, connected: &[String]) -> Option<String> {
    let connected: HashSet<&str> = connected.iter().map(String::as_str).collect();
    let mut open = description.with_causality("input").filter(|v| !connected.contains(v.name.as_str()));
    let first = open.next()?.name.clone();
    let more = open.count();
    Some(if more == 0 { first } else { format!("{first} (and {more} more)") })
}

/// Two FMUs of different scenarios share some names of a series, `support[1].force` and so on, and lack others: coupled all
/// the same they would lose forces.
fn refuse_other_scenarios(bridge: &FmuInstance, train_track: &FmuInstance, forces: &[String]) -> Result<(), Error> {
    let series = |name: &str| name.split(|c: char| c.is_ascii_digit()).collect::<Vec<_>>().join("#");
    let coupled: HashSet<String> = forces.iter().map(|name| series(name)).collect();
    let known: HashSet<&str> = forces.iter().map(String::as_str).collect();
    for (fmu, causality) in [(bridge, "input"), (train_track, "output")] {
        let alone = |name: &str| coupled.contains(&series(name)) && !known.contains(name);
        let mut alone_there = fmu.description().with_causality(causality).filter(|v| alone(&v.name));
        if let Some(first) = alone_there.next() {
            let (name, more) = (&first.name, alone_there.count());
            return Err(Error::Input(format!(
                "{}: {causality} {name} (and {more} more) has no partner, though {} others of its series have: the two FMUs \
                 belong to different scenarios",
                fmu.name(),
                forces.len()
            )));
        }
    }
    Ok(())
}
