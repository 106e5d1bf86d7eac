//! Rules of bearings and of what carries the track.

use super::checker::Checker;
use crate::problem::nearest;
use crate::types::DeckCarrier;

impl Checker<'_> {
    pub(super) fn bearings(&mut self) {
        for (i, list) in self.model.bearings.iter().enumerate() {
            for (j, &number) in list.nodes.iter().enumerate() {
                self.node(number, || format!("bearings[{i}].nodes[{j}]"));
            }
            self.once(&list.fixed, "a freedom", &format!("bearings[{i}].fixed"), |f| f.name().to_owned());
        }
    }

    pub(super) fn deck(&mut self) {
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
