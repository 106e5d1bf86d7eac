//! How a frame hangs together: the deck's path, unused nodes, separate parts, nodes free to spin.

use crate::problem::Report;
use crate::types::{Fixity, Frame, Member, MemberKind, Node};

/// Where a scenario holds the frame.
pub(super) const PATH: &str = "$.bridge.structure.frame";

/// The node of this name.
pub(super) fn node<'a>(frame: &'a Frame, name: &str) -> Option<&'a Node> {
    frame.nodes.iter().find(|node| node.name == name)
}

pub(super) fn check(frame: &Frame, report: &mut Report) {
    deck(frame, report);
    connected(frame, report);
    for (i, node) in frame.nodes.iter().enumerate() {
        let ends = || frame.members.iter().flat_map(|member| ends(member)).filter(|end| end.node == node.name);
        let mut beams = ends().filter(|end| end.beam).peekable();
        let path = format!("{PATH}.nodes[{i}]");
        if ends().next().is_none() {
            report.problem(path, "a node must belong to a member", format!("`{}`", node.name));
        } else if beams.peek().is_some() && beams.all(|end| end.hinged) && !node.fixed.contains(&Fixity::Rotation) {
            let rule = "one beam at a node must not be hinged there, or the node spins: leave one hinge out";
            report.problem(path, rule, format!("`{}`", node.name));
        }
    }
}

/// Where a member meets a node.
struct End<'a> {
    node: &'a str,
    beam: bool,
    hinged: bool,
}

fn ends(member: &Member) -> [End<'_>; 2] {
    let end =
        |i: usize| End { node: &member.nodes[i], beam: member.kind == MemberKind::Beam, hinged: member.hinged[i] };
    [end(0), end(1)]
}

/// The deck's members, in the order listed, lead from x = 0 to the other end, each going on where the last one ended.
fn deck(frame: &Frame, report: &mut Report) {
    let deck: Vec<(usize, &Member)> = frame.members.iter().enumerate().filter(|(_, member)| member.deck).collect();
    if deck.is_empty() {
        report.problem(format!("{PATH}.members"), "some members must be the deck", "none has `deck`: true");
    }
    let mut before: Option<&str> = None;
    for (i, member) in deck {
        let path = format!("{PATH}.members[{i}].nodes");
        let [Some(a), Some(b)] = member.nodes.each_ref().map(|name| node(frame, name)) else { return };
        match before {
            None if a.x != 0.0 => {
                report.problem(&path, "the deck must begin at x = 0", format!("`{}` at {} m", a.name, a.x));
            }
            Some(last) if last != a.name => {
                let rule =
                    "the deck's members must be listed along the track, each beginning where the one before ended";
                report.problem(&path, rule, format!("`{}` after `{last}`", a.name));
            }
            _ => {}
        }
        if b.x <= a.x {
            let found = format!("`{}` at {} m, `{}` at {} m", a.name, a.x, b.name, b.x);
            report.problem(&path, "x must increase along the deck", found);
        }
        before = Some(&b.name);
    }
}

/// Every used node can be reached from every other, over members or the ground.
fn connected(frame: &Frame, report: &mut Report) {
    let held = |name: &str| node(frame, name).is_some_and(|node| !node.fixed.is_empty());
    let mut groups: Vec<Vec<&str>> = Vec::new();
    for member in &frame.members {
        let joined: Vec<&str> = member.nodes.iter().map(String::as_str).collect();
        let (touching, mut rest): (Vec<_>, Vec<_>) =
            groups.into_iter().partition(|group| group.iter().any(|name| joined.contains(name)));
        rest.push(touching.into_iter().flatten().chain(joined).collect());
        groups = rest;
    }
    for group in groups.iter().filter(|group| !group.iter().any(|name| held(name))) {
        let rule = "every part of the frame must be held by a bearing";
        report.problem(format!("{PATH}.members"), rule, format!("the part with node `{}` is not", group[0]));
    }
}
