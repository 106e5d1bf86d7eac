//! Rules inside the section on the bridge.

use std::collections::HashSet;

use super::{frame, model};
use crate::deck::Deck;
use crate::pieces::Pieces;
use crate::problem::Report;
use crate::resolve::Resolved;
use crate::spec::StructureSpec;
use crate::types::{Damping, Direction, FrameChoice, ModelChoice, Point, RayleighAt, Structure};

pub(super) fn check(pieces: &Pieces, resolved: &Resolved, report: &mut Report) {
    // a bundled frame is right: a test checks it
    if let Some(Structure::Frame { frame: FrameChoice::Data(frame) }) = &pieces.structure {
        frame::check(frame, report);
    }
    // one in a file of its own has been checked when it was read
    if let Some(Structure::FiniteElements { model: ModelChoice::Data(model) }) = &pieces.structure {
        model::check(model, "$.bridge.structure.model", report);
    }
    if let Some(damping) = &pieces.damping {
        rayleigh(damping, report);
    }
    if let Some(structure) = &resolved.structure {
        modes(pieces, degrees_of_freedom(structure), report);
    }
    let mut names = HashSet::new();
    for (i, point) in pieces.points.iter().enumerate() {
        let Some(point) = point else { continue };
        let path = format!("$.bridge.points[{i}]");
        if !names.insert(&point.name) {
            report.problem(format!("{path}.name"), "names of points must differ", format!("`{}`", point.name));
        }
        place(point, &path, resolved.structure.as_ref(), report);
    }
}

/// A point lies on the deck or at a node.
fn place(point: &Point, path: &str, structure: Option<&StructureSpec>, report: &mut Report) {
    if let Some(StructureSpec::Matrices { .. }) = structure {
        let found = format!("`{}`", point.name);
        return report.problem(path, "points of imported matrices stand in the file `points` of the structure", found);
    }
    match (&point.x, &point.node) {
        (Some(_), Some(_)) => report.problem(path, "a point has either x or node", "both"),
        (None, None) => report.problem(path, "a point has either x or node", "neither"),
        (Some(x), None) => {
            let length = structure.and_then(Deck::new).map(|deck| deck.length);
            if let Some(length) = length.filter(|length| *length > 0.0 && !(0.0..=*length).contains(x)) {
                let found = format!("{x} m, the deck is {length} m long");
                report.problem(format!("{path}.x"), "a point must lie on the bridge", found);
            }
            match point.direction {
                Direction::Z => {}
                Direction::X => {
                    report.problem(format!("{path}.direction"), "motion along the track is known at nodes only", "x");
                }
                Direction::Y if matches!(structure, Some(StructureSpec::FiniteElements(_))) => {}
                Direction::Y => {
                    report.problem(format!("{path}.direction"), "motion across the track is known at nodes only", "y");
                }
            }
        }
        (None, Some(name)) => match structure {
            Some(StructureSpec::Frame(frame)) => {
                frame::known_node(frame, name, &format!("{path}.node"), report);
                if point.direction == Direction::Y {
                    report.problem(format!("{path}.direction"), "a plane frame does not move across the track", "y");
                }
            }
            Some(StructureSpec::FiniteElements(model)) => {
                model::known_name(model, name, &format!("{path}.node"), report);
            }
            Some(_) => {
                report.problem(
                    format!("{path}.node"),
                    "only frames and models in space have named nodes: give x",
                    format!("`{name}`"),
                );
            }
            None => {}
        },
    }
}

/// Rayleigh damping needs two different frequencies.
fn rayleigh(damping: &Damping, report: &mut Report) {
    let Damping::Rayleigh { at, .. } = damping else { return };
    match at {
        RayleighAt::Hz([a, b]) if !(*a > 0.0 && *b > 0.0 && a != b) => {
            let rule = "the two frequencies must be positive and different";
            report.problem("$.bridge.damping.at.hz", rule, format!("[{a}, {b}]"));
        }
        RayleighAt::Modes([a, b]) if *a == 0 || *b == 0 || a == b => {
            let rule = "the two modes must be different and count from 1";
            report.problem("$.bridge.damping.at.modes", rule, format!("[{a}, {b}]"));
        }
        _ => {}
    }
}

/// No more modes than degrees of freedom.
fn modes(pieces: &Pieces, freedoms: usize, report: &mut Report) {
    let rule = format!("the structure has only {freedoms} modes");
    if let Some(modes) = pieces.bridge.as_ref().and_then(|bridge| bridge.modes).filter(|modes| *modes > freedoms) {
        report.problem("$.bridge.modes", &rule, modes);
    }
    match pieces.damping {
        Some(Damping::Modal { modes, .. }) if modes > freedoms => {
            report.problem("$.bridge.damping.modes", rule, modes);
        }
        Some(Damping::Rayleigh { at: RayleighAt::Modes(modes), .. }) if modes.iter().any(|mode| *mode > freedoms) => {
            report.problem("$.bridge.damping.at.modes", rule, format!("{modes:?}"));
        }
        _ => {}
    }
}

/// Degrees of freedom of a structure's model; but for beams an upper bound. Numbers of elements may be anything.
fn degrees_of_freedom(structure: &StructureSpec) -> usize {
    let sum = |counts: &mut dyn Iterator<Item = usize>| counts.fold(0, usize::saturating_add);
    match structure {
        StructureSpec::Beams { spans, continuous } => {
            let free = sum(&mut spans.iter().map(|span| span.elements)).saturating_mul(2);
            // two per node, less one per bearing: between simple spans every bearing belongs to two of them
            if *continuous { free.saturating_add(1).saturating_sub(spans.len()) } else { free }
        }
        StructureSpec::Frame(frame) => {
            let inner = sum(&mut frame.members.iter().map(|member| member.elements.saturating_sub(1)));
            let fixed = sum(&mut frame.nodes.iter().map(|node| node.fixed.len()));
            inner.saturating_add(frame.nodes.len()).saturating_mul(3).saturating_sub(fixed)
        }
        StructureSpec::FiniteElements(model) => model.nodes.len().saturating_mul(6),
        StructureSpec::Matrices { .. } | StructureSpec::Stored => usize::MAX,
    }
}
