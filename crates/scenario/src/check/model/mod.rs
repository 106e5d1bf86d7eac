//! Rules inside a finite-element model: numbers and names that stand for something, elements that can be, motions that
//! are eliminated once, parts that are held, a deck that carries.

mod elements;
mod sections;
mod shape;
mod ties;

use std::collections::HashSet;
use std::hash::Hash;

use crate::problem::{Report, nearest};
use crate::space::{Index, Ties, parts};
use crate::types::{DeckCarrier, Freedom, Model};

/// Among more nodes than this no number is looked for that may have been meant.
const FEW: usize = 5_000;

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

/// Reports a text that is no node's number.
pub(super) fn known_name(model: &Model, name: &str, path: &str, report: &mut Report) {
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

struct Checker<'a> {
    model: &'a Model,
    index: &'a Index,
    at: &'a str,
    report: &'a mut Report,
}

impl<'a> Checker<'a> {
    fn problem(&mut self, place: String, rule: &str, found: impl std::fmt::Display) {
        self.report.problem(format!("{}.{place}", self.at), rule, found);
    }

    /// Coordinates of a node; a number that is none's is reported.
    fn node(&mut self, number: u32, place: impl FnOnce() -> String) -> Option<[f64; 3]> {
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
    fn once<T: Eq + Hash>(&mut self, list: &[T], what: &str, place: &str, shown: impl Fn(&T) -> String) {
        let mut seen = HashSet::new();
        for (i, item) in list.iter().enumerate() {
            if !seen.insert(item) {
                self.problem(format!("{place}[{i}]"), &format!("{what} is named once"), shown(item));
            }
        }
    }

    fn bearings(&mut self) {
        for (i, list) in self.model.bearings.iter().enumerate() {
            for (j, &number) in list.nodes.iter().enumerate() {
                self.node(number, || format!("bearings[{i}].nodes[{j}]"));
            }
            self.once(&list.fixed, "a freedom", &format!("bearings[{i}].fixed"), |f| f.name().to_owned());
        }
    }

    fn deck(&mut self) {
        let model = self.model;
        match &model.deck.on {
            DeckCarrier::Shells(names) => {
                let used: Vec<&str> = model.shells.iter().map(|list| list.section.as_str()).collect();
                self.carriers(names, &used, "shells");
            }
            DeckCarrier::Beams(names) => {
                let used: Vec<&str> = model.beams.iter().map(|list| list.section.as_str()).collect();
                self.carriers(names, &used, "beams");
            }
            DeckCarrier::Nodes(numbers) => {
                for (i, &number) in numbers.iter().enumerate() {
                    self.node(number, || format!("deck.on.nodes[{i}]"));
                }
            }
        }
    }

    fn carriers(&mut self, names: &[String], used: &[&str], kind: &str) {
        if names.is_empty() {
            let rule = format!("the deck needs at least one section of {kind}");
            self.problem(format!("deck.on.{kind}"), &rule, "[]");
        }
        for (i, name) in names.iter().enumerate().filter(|(_, name)| !used.contains(&name.as_str())) {
            let near = nearest(name, used.iter().copied());
            let rule = format!("no {kind} have this section");
            self.report.suggest(format!("{}.deck.on.{kind}[{i}]", self.at), rule, format!("`{name}`"), near);
        }
    }
}

/// A motion in words.
fn in_words(node: u32, freedom: Freedom) -> String {
    format!("{} of node {node}", freedom.describe())
}
