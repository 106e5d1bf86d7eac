//! What all rules of a model use: places, nodes by number, lists without repetitions.

use std::collections::HashSet;
use std::hash::Hash;

use crate::problem::{Report, nearest};
use crate::space::Index;
use crate::types::{Freedom, Model};

/// Among more nodes than this no number is looked for that may have been meant.
const FEW: usize = 5_000;

/// Reports a text that is no node's number.
pub fn known_name(model: &Model, name: &str, path: &str, report: &mut Report) {
    let number = name.parse::<u32>();
    if !number.is_ok_and(|number| model.nodes.iter().any(|node| node.0 == number)) {
        report.suggest(path, "unknown node", format!("`{name}`"), near(model, name));
    }
}

/// The node number that looks most like `name`.
fn near(model: &Model, name: &str) -> Option<String> {
    let few = if model.nodes.len() > FEW { &[] } else { model.nodes.as_slice() };
    let numbers: Vec<String> = few.iter().map(|node| node.0.to_string()).collect();
    nearest(name, numbers.iter().map(String::as_str))
}

/// A model under examination.
pub struct Checker<'a> {
    pub model: &'a Model,
    pub index: &'a Index,
    /// Path of the model in its file.
    pub at: &'a str,
    pub report: &'a mut Report,
}

impl<'a> Checker<'a> {
    pub fn problem(&mut self, place: String, rule: &str, found: impl std::fmt::Display) {
        self.report.problem(format!("{}.{place}", self.at), rule, found);
    }

    /// Coordinates of a node; a number that is none's is reported.
    pub fn node(&mut self, number: u32, place: impl FnOnce() -> String) -> Option<[f64; 3]> {
        const RULE: &str = "unknown node";
        match self.index.position(number) {
            Some(position) => {
                let (_, x, y, z) = self.model.nodes[position];
                Some([x, y, z])
            }
            None => {
                let near = if self.report.is_full(RULE) { None } else { near(self.model, &number.to_string()) };
                self.report.suggest(format!("{}.{}", self.at, place()), RULE, number, near);
                None
            }
        }
    }

    /// A list without repetitions.
    pub fn once<T: Eq + Hash>(&mut self, list: &[T], what: &str, place: &str, shown: impl Fn(&T) -> String) {
        let mut seen = HashSet::new();
        for (i, item) in list.iter().enumerate() {
            if !seen.insert(item) {
                self.problem(format!("{place}[{i}]"), &format!("{what} is named once"), shown(item));
            }
        }
    }
}

/// A motion in words.
pub fn in_words(node: u32, freedom: Freedom) -> String {
    format!("{} of node {node}", freedom.describe())
}
