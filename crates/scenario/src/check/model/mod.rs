//! Rules inside a finite-element model: numbers and names that stand for something, elements that can be, motions that
//! are eliminated once, parts that are held, a deck that carries.

mod checker;
mod deck;
mod elements;
mod sections;
mod shape;
mod ties;

use checker::Checker;
pub(super) use checker::known_name;

use crate::problem::Report;
use crate::space::{Index, Ties, parts};
use crate::types::Model;

/// Reports every broken rule of the model that stands at the path `at`.
pub(crate) fn check(model: &Model, at: &str, report: &mut Report) {
    let index = Index::new(model);
    let mut checker = Checker { model, index: &index, at, report };
    for &position in &index.repeated {
        let rule = "node numbers must differ";
        checker.problem(format!("nodes[{position}][0]"), rule, model.nodes[position].0);
    }
    checker.sections();
    checker.beams();
    checker.trusses();
    checker.shells();
    checker.springs();
    checker.masses();
    checker.bearings();
    checker.deck();
    let ties = Ties::new(model, &index);
    checker.ties(&ties);
    for part in parts(model, &index, &ties).iter().filter(|part| !part.held) {
        let rule = "every part of the model must be held by bearings or springs to the ground";
        let found = format!("the part with node {} ({} nodes) is not", part.node, part.nodes);
        checker.problem("bearings".to_owned(), rule, found);
    }
}
