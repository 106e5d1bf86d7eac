//! A plane frame with trusses and cables → mesh.
//!
//! Beams are divided into equal elements; trusses and cables are one element each, cables with Ernst's equivalent
//! modulus. A Timoshenko section turns with ρI = m I/A, which takes dead loads as spread like the section itself.

use ttb_contract::ModelError;
use ttb_dynamics::beam::Beam;
use ttb_dynamics::frame::{FrameElement, ernst_modulus};
use ttb_scenario::limits::MOST_ELEMENTS_PER_SPAN;
use ttb_scenario::types::{Fixity, Frame, Member, MemberKind, Section};

use crate::mesh::{Element, Mesh, Node};

/// The mesh of a frame.
///
/// # Errors
/// A name that is missing or given twice, a value that cannot be, a member without length.
pub fn mesh(frame: &Frame) -> Result<Mesh, ModelError> {
    let mut nodes: Vec<Node> = frame.nodes.iter().map(node).collect();
    unique("node", frame.nodes.iter().map(|n| &n.name))?;
    unique("section", frame.sections.iter().map(|s| &s.name))?;
    frame.sections.iter().try_for_each(check_section)?;
    let mut elements = Vec::new();
    for member in &frame.members {
        let section = frame.sections.iter().find(|s| s.name == member.section);
        let section = section.ok_or_else(|| wrong(member, &format!("there is no section named {}", member.section)))?;
        let mut ends = [0; 2];
        for (end, name) in ends.iter_mut().zip(&member.nodes) {
            let found = frame.nodes.iter().position(|n| n.name == *name);
            *end = found.ok_or_else(|| wrong(member, &format!("there is no node named {name}")))?;
        }
        divide(member, section, ends, &mut nodes, &mut elements)?;
    }
    Mesh::new(nodes, elements)
}

/// Appends a member's elements and inner nodes.
fn divide(
    member: &Member,
    section: &Section,
    ends: [usize; 2],
    nodes: &mut Vec<Node>,
    elements: &mut Vec<Element>,
) -> Result<(), ModelError> {
    let [a, b] = ends.map(|end| [nodes[end].x, nodes[end].z]);
    let chord = [b[0] - a[0], b[1] - a[1]];
    let length = libm::hypot(chord[0], chord[1]);
    if !(length > 0.0 && length.is_finite()) {
        return Err(wrong(member, &format!("its length is {length} m; it must be positive")));
    }
    let axial = section.modulus * section.area;
    match member.kind {
        MemberKind::Truss => {
            elements.push(Element {
                nodes: ends,
                frame: FrameElement::truss(axial, section.mass, chord),
                deck: member.deck,
            });
        }
        MemberKind::Cable => {
            let tension = member.tension.filter(|t| *t > 0.0 && t.is_finite());
            let tension = tension.ok_or_else(|| wrong(member, "a cable needs a positive tension"))?;
            let modulus = ernst_modulus(section.modulus, section.area, section.mass, tension, chord[0].abs());
            let frame = FrameElement::truss(modulus * section.area, section.mass, chord);
            elements.push(Element { nodes: ends, frame, deck: member.deck });
        }
        MemberKind::Beam => {
            if section.inertia <= 0.0 {
                return Err(wrong(member, &format!("it is a beam, but section {} has no inertia", section.name)));
            }
            if member.elements == 0 {
                return Err(wrong(member, "it needs at least one element"));
            }
            if member.elements > MOST_ELEMENTS_PER_SPAN {
                let rule =
                    format!("it has {} elements; at most {MOST_ELEMENTS_PER_SPAN} are possible", member.elements);
                return Err(wrong(member, &rule));
            }
            let beam = Beam {
                bending_stiffness: section.modulus * section.inertia,
                mass: section.mass,
                shear_stiffness: section.shear_stiffness,
                rotary_inertia: section.shear_stiffness.map_or(0.0, |_| section.mass * section.inertia / section.area),
            };
            let n = member.elements;
            let mut from = ends[0];
            for i in 1..=n {
                let part = i as f64 / n as f64;
                let to = if i == n { ends[1] } else { nodes.len() };
                if i < n {
                    let name = format!("{i} of {n} on member {}", title(member));
                    nodes.push(Node { name, x: a[0] + part * chord[0], z: a[1] + part * chord[1], fixed: [false; 3] });
                }
                let hinged = [member.hinged[0] && i == 1, member.hinged[1] && i == n];
                let span = chord.map(|component| component / n as f64);
                let frame = FrameElement { beam, axial_stiffness: axial, span, hinged };
                elements.push(Element { nodes: [from, to], frame, deck: member.deck });
                from = to;
            }
        }
    }
    Ok(())
}

fn node(node: &ttb_scenario::types::Node) -> Node {
    let fixed = [Fixity::X, Fixity::Z, Fixity::Rotation].map(|direction| node.fixed.contains(&direction));
    Node { name: node.name.clone(), x: node.x, z: node.z, fixed }
}

fn check_section(section: &Section) -> Result<(), ModelError> {
    let positive = [
        ("modulus", Some(section.modulus)),
        ("area", Some(section.area)),
        ("shear_stiffness", section.shear_stiffness),
    ];
    let bad = |name: &str, value: f64, rule: &str| {
        Err(ModelError(format!("bridge: {name} of section {} is {value}; it must be {rule}", section.name)))
    };
    for (name, value) in positive.into_iter().filter_map(|(name, value)| Some((name, value?))) {
        if !(value > 0.0 && value.is_finite()) {
            return bad(name, value, "positive");
        }
    }
    for (name, value) in [("inertia", section.inertia), ("mass", section.mass)] {
        if !(value >= 0.0 && value.is_finite()) {
            return bad(name, value, "zero or positive");
        }
    }
    Ok(())
}

fn unique<'a>(what: &str, names: impl Iterator<Item = &'a String> + Clone) -> Result<(), ModelError> {
    let mut seen = std::collections::BTreeSet::new();
    match names.into_iter().find(|name| !seen.insert(*name)) {
        Some(name) => Err(ModelError(format!("bridge: two {what}s are named {name}"))),
        None => Ok(()),
    }
}

fn title(member: &Member) -> String {
    format!("{}–{}", member.nodes[0], member.nodes[1])
}

fn wrong(member: &Member, what: &str) -> ModelError {
    ModelError(format!("bridge: member {}: {what}", title(member)))
}
