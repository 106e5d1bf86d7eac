//! What a modal bridge is made from: matrices, the deck's path, and what is looked at.

use ttb_contract::ModelError;
use ttb_sparse::{Factor, Pencil};

use crate::lines::Lines;
use crate::place::Output;

/// A structure under a path.
pub trait Source {
    /// K, M and the dashpots' C.
    fn pencil(&self) -> &Pencil;

    /// Number of separate members in a row, each with modes of its own (simple spans): their third modes are sought.
    fn members(&self) -> usize;

    /// Begins and ends of the spans, m.
    fn spans(&self) -> &[[f64; 2]];

    /// What is looked at and follows the displacements (all but accelerations).
    fn outputs(&self) -> &[Output];

    /// The outputs of a shape, without the share of a force that stands on the same element.
    fn rows(&self, shape: &[f64]) -> Vec<f64>;

    /// Lines over the place of a unit force: displacement of the path in every shape, then zeros up to `pads[0]` lines;
    /// static influence lines of all outputs, then zeros up to `pads[1]` more.
    ///
    /// # Errors
    /// A static solution fails.
    fn lines(&self, shapes: &[Vec<f64>], pads: [usize; 2], statics: &Factor) -> Result<Lines, ModelError>;

    /// Largest displacement of the path in a shape.
    fn liveliness(&self, shape: &[f64]) -> f64;
}

/// Abscissae of `parts` equal parts of each span, both ends included.
pub fn stations(spans: &[[f64; 2]], parts: impl Fn(f64) -> usize) -> Vec<f64> {
    let mut found = Vec::<f64>::new();
    for [begin, end] in spans {
        let n = parts(end - begin).max(1);
        for i in 0..=n {
            let x = if i == n { *end } else { begin + (end - begin) * i as f64 / n as f64 };
            if found.last().is_none_or(|last| x > last + NEAR) {
                found.push(x);
            }
        }
    }
    found
}

/// Places closer than this are the same, m.
pub const NEAR: f64 = 1e-6;
