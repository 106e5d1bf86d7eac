//! Rules inside a plane frame: names, members, and what holds it.

use std::collections::HashSet;

use super::graph::{self, PATH, node};
use crate::problem::{Report, nearest};
use crate::types::{Fixity, Frame, Member, MemberKind, Section};

pub(super) fn check(frame: &Frame, report: &mut Report) {
    distinct("sections", frame.sections.iter().map(|section| section.name.as_str()), report);
    distinct("nodes", frame.nodes.iter().map(|node| node.name.as_str()), report);
    for (i, node) in frame.nodes.iter().enumerate() {
        let held: HashSet<_> = node.fixed.iter().collect();
        if held.len() < node.fixed.len() {
            let found = format!("{:?}", node.fixed);
            report.problem(format!("{PATH}.nodes[{i}].fixed"), "a direction is fixed once", found);
        }
    }
    for (i, member) in frame.members.iter().enumerate() {
        let path = format!("{PATH}.members[{i}]");
        for (end, name) in member.nodes.iter().enumerate() {
            known_node(frame, name, &format!("{path}.nodes[{end}]"), report);
        }
        match frame.sections.iter().find(|section| section.name == member.section) {
            Some(section) => kind(member, section, &path, report),
            None => {
                let near = nearest(&member.section, frame.sections.iter().map(|section| section.name.as_str()));
                let found = format!("`{}`", member.section);
                report.suggest(format!("{path}.section"), "unknown section", found, near);
            }
        }
        if let [Some(a), Some(b)] = member.nodes.each_ref().map(|name| node(frame, name))
            && (a.x, a.z) == (b.x, b.z)
        {
            let rule = "a member must connect two different places";
            report.problem(format!("{path}.nodes"), rule, format!("`{}`, `{}`", a.name, b.name));
        }
    }
    graph::check(frame, report);
    held(frame, report);
}

/// Reports a name that is no node's.
pub(super) fn known_node(frame: &Frame, name: &str, path: &str, report: &mut Report) {
    if node(frame, name).is_none() {
        let near = nearest(name, frame.nodes.iter().map(|node| node.name.as_str()));
        report.suggest(path, "unknown node", format!("`{name}`"), near);
    }
}

fn distinct<'a>(list: &str, names: impl Iterator<Item = &'a str>, report: &mut Report) {
    let mut seen = HashSet::new();
    for (i, name) in names.enumerate() {
        let path = format!("{PATH}.{list}[{i}].name");
        if name.is_empty() {
            report.problem(path, "a name must not be empty", "\"\"");
        } else if !seen.insert(name) {
            report.problem(path, format!("names of {list} must differ"), format!("`{name}`"));
        }
    }
}

/// What a kind of member needs and excludes.
fn kind(member: &Member, section: &Section, path: &str, report: &mut Report) {
    let name = &section.name;
    match member.kind {
        MemberKind::Beam if section.inertia <= 0.0 => {
            report.problem(
                format!("{path}.section"),
                "a beam's section needs an inertia",
                format!("`{name}` has none"),
            );
        }
        MemberKind::Cable if member.tension.is_none() => {
            report.problem(format!("{path}.tension"), "a cable needs a tension", "none");
        }
        _ => {}
    }
    if let Some(tension) = member.tension.filter(|_| member.kind != MemberKind::Cable) {
        report.problem(format!("{path}.tension"), "only cables have a tension", tension);
    }
    if member.kind != MemberKind::Beam && member.elements > 1 {
        report.problem(format!("{path}.elements"), "only beams have several elements", member.elements);
    }
    if member.deck && member.kind != MemberKind::Beam {
        report.problem(format!("{path}.kind"), "a member of the deck must be a beam", format!("{:?}", member.kind));
    }
    if member.deck && section.mass <= 0.0 {
        let found = format!("`{name}` has none");
        report.problem(format!("{path}.section"), "a section of the deck needs a mass", found);
    }
}

/// The structure as a whole cannot move as a rigid body in the plane.
fn held(frame: &Frame, report: &mut Report) {
    let fixed = |direction: Fixity| frame.nodes.iter().filter(move |node| node.fixed.contains(&direction));
    let spread = |values: Vec<f64>| values.iter().any(|value| *value != values[0]);
    let along = fixed(Fixity::X).count() > 0;
    let vertical = fixed(Fixity::Z).count() > 0;
    let turning = fixed(Fixity::Rotation).count() > 0
        || spread(fixed(Fixity::Z).map(|node| node.x).collect())
        || spread(fixed(Fixity::X).map(|node| node.z).collect());
    let loose = [(along, "along the track"), (vertical, "vertically"), (turning, "against turning")];
    let loose: Vec<&str> = loose.iter().filter(|(held, _)| !held).map(|(_, direction)| *direction).collect();
    if !loose.is_empty() {
        let rule = "bearings must hold the structure";
        report.problem(format!("{PATH}.nodes"), rule, format!("not held {}", loose.join(", ")));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bundled;

    #[test]
    fn bundled_frames_are_without_problems() {
        for name in bundled::frame_names() {
            let mut report = Report::new(name);
            check(&bundled::frame(name).unwrap(), &mut report);
            assert_eq!(report.problems, []);
        }
    }
}
