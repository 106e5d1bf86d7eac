//! The deck seen from the track: how long it is, where it bears, which of the track's supports rest on it.

use crate::spec::StructureSpec;
use crate::types::{Fixity, Frame, OverBearings};

/// What the track needs to know of a structure.
#[derive(Clone, Debug, PartialEq)]
pub struct Deck {
    /// Length of the deck, m.
    pub length: f64,
    /// Where it bears between its ends, m from its begin.
    pub inner_bearings: Vec<f64>,
}

impl Deck {
    /// The deck of a structure; `None` for a frame without one.
    #[must_use]
    pub fn new(structure: &StructureSpec) -> Option<Self> {
        match structure {
            StructureSpec::Beams { spans, .. } => {
                let mut bearings = Vec::with_capacity(spans.len());
                let mut length = 0.0;
                for span in spans {
                    length += span.length;
                    bearings.push(length);
                }
                bearings.pop();
                Some(Self { length, inner_bearings: bearings })
            }
            StructureSpec::Frame(frame) => Self::of_frame(frame),
            StructureSpec::FiniteElements(model) => {
                Some(Self { length: model.deck.length, inner_bearings: Vec::new() })
            }
            StructureSpec::Matrices { length, .. } => Some(Self { length: *length, inner_bearings: Vec::new() }),
            StructureSpec::Stored => None,
        }
    }

    /// The deck ends at its last node; it bears where a deck node is held vertically.
    fn of_frame(frame: &Frame) -> Option<Self> {
        let node = |name: &String| frame.nodes.iter().find(|node| node.name == *name);
        let ends = frame.members.iter().filter(|member| member.deck).filter_map(|member| node(&member.nodes[1]));
        let ends: Vec<_> = ends.collect();
        let (last, inner) = ends.split_last()?;
        let bearings = inner.iter().filter(|node| node.fixed.contains(&Fixity::Z)).map(|node| node.x);
        Some(Self { length: last.x, inner_bearings: bearings.collect() })
    }

    /// The deck as a train meets it that runs against its abscissa.
    #[must_use]
    pub fn mirrored(&self) -> Self {
        let inner_bearings = self.inner_bearings.iter().rev().map(|x| self.length - x).collect();
        Self { length: self.length, inner_bearings }
    }

    /// Which of `count` supports at `from`, `from + spacing`, … rest on this deck when it begins at `at`, as index and
    /// distance from its begin.
    ///
    /// A support on an abutment line stands on the ground; one over an inner bearing goes where `over` says. *On* a line
    /// means within 1e-9 of the spacing.
    #[must_use]
    pub fn supports(&self, at: f64, from: f64, spacing: f64, count: usize, over: OverBearings) -> Vec<(usize, f64)> {
        let tolerance = 1e-9 * spacing;
        let bears = |x: f64| self.inner_bearings.iter().any(|bearing| (x - bearing).abs() <= tolerance);
        (0..count)
            .map(|i| (i, from + i as f64 * spacing - at))
            .filter(|(_, x)| *x > tolerance && *x < self.length - tolerance)
            .filter(|(_, x)| over == OverBearings::Deck || !bears(*x))
            .collect()
    }
}
