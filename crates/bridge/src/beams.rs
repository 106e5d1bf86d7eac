//! Spans of beams in a row → mesh.
//!
//! Each simply supported span has nodes of its own, so that neighbours share no rotation; a continuous beam has one node
//! over each inner bearing. Beams move only down: the axial direction is fixed everywhere.

use ttb_contract::ModelError;
use ttb_dynamics::beam::Beam;
use ttb_dynamics::frame::FrameElement;
use ttb_scenario::limits::MOST_ELEMENTS_PER_SPAN;
use ttb_scenario::spec::Span;

use crate::mesh::{Element, Mesh, Node};

/// The mesh of a beam bridge.
///
/// # Errors
/// No span, or one without length, stiffness, mass or elements.
pub fn mesh(spans: &[Span], continuous: bool) -> Result<Mesh, ModelError> {
    if spans.is_empty() {
        return Err(ModelError("bridge: it has no spans; it needs at least one".into()));
    }
    let (mut nodes, mut elements) = (Vec::<Node>::new(), Vec::new());
    let mut begin = 0.0;
    for (number, span) in (1..).zip(spans) {
        check(number, span)?;
        let beam = Beam {
            bending_stiffness: span.bending_stiffness,
            mass: span.mass,
            shear_stiffness: span.shear_stiffness,
            rotary_inertia: 0.0,
        };
        let part = span.length / span.elements as f64;
        if !(continuous && number > 1) {
            nodes.push(node(begin, true));
        }
        for i in 1..=span.elements {
            let bearing = i == span.elements;
            nodes.push(node(if bearing { begin + span.length } else { begin + part * i as f64 }, bearing));
            let frame = FrameElement { beam, axial_stiffness: 0.0, span: [part, 0.0], hinged: [false; 2] };
            elements.push(Element { nodes: [nodes.len() - 2, nodes.len() - 1], frame, deck: true });
        }
        begin += span.length;
    }
    Mesh::new(nodes, elements)
}

fn node(x: f64, bearing: bool) -> Node {
    Node { name: format!("at x = {x} m"), x, z: 0.0, fixed: [true, bearing, false] }
}

fn check(number: usize, span: &Span) -> Result<(), ModelError> {
    let values = [
        ("length", Some(span.length)),
        ("bending_stiffness", Some(span.bending_stiffness)),
        ("mass", Some(span.mass)),
        ("shear_stiffness", span.shear_stiffness),
    ];
    for (name, value) in values.into_iter().filter_map(|(name, value)| Some((name, value?))) {
        if !(value > 0.0 && value.is_finite()) {
            return Err(ModelError(format!("bridge: {name} of span {number} is {value}; it must be positive")));
        }
    }
    if span.elements == 0 {
        return Err(ModelError(format!("bridge: span {number} has no elements; it needs at least one")));
    }
    if span.elements > MOST_ELEMENTS_PER_SPAN {
        let (most, has) = (MOST_ELEMENTS_PER_SPAN, span.elements);
        return Err(ModelError(format!("bridge: span {number} has {has} elements; at most {most} are possible")));
    }
    Ok(())
}
