//! Rules of rigid links and constraints.

use std::collections::HashSet;

use super::checker::{Checker, in_words};
use crate::space::{Motion, Ties, motion};
use crate::types::Freedom;

impl Checker<'_> {
    pub(super) fn ties(&mut self, ties: &Ties) {
        self.links();
        self.constraints();
        let held: HashSet<Motion> = self.held();
        // of several motions that one place ties wrongly, the first is told
        let mut told = HashSet::new();
        for &(before, again) in &ties.twice {
            let (before, again) = (&ties.list[before], &ties.list[again]);
            if told.insert((again.origin, 0)) {
                let found = format!("{}, by {} already", self.words(again.follower), before.origin);
                self.problem(again.origin.to_string(), "a motion is eliminated once", found);
            }
        }
        for tie in ties.list.iter().filter(|tie| held.contains(&tie.follower)) {
            if told.insert((tie.origin, 1)) {
                let rule = "what follows another motion must not be held by a bearing: hold what it follows";
                self.problem(tie.origin.to_string(), rule, self.words(tie.follower));
            }
        }
        for tie in ties.cyclic.iter().map(|i| &ties.list[*i]) {
            // one that follows itself is told of as a repeated term
            if tie.terms.iter().all(|(motion, _)| *motion != tie.follower) && told.insert((tie.origin, 2)) {
                let rule = "a motion must not follow itself over other ties";
                self.problem(tie.origin.to_string(), rule, self.words(tie.follower));
            }
        }
    }

    fn links(&mut self) {
        for (i, link) in self.model.rigid_links.iter().enumerate() {
            let place = format!("rigid_links[{i}]");
            self.node(link.leader, || format!("{place}.leader"));
            for (j, number) in link.followers.iter().enumerate() {
                self.node(*number, || format!("{place}.followers[{j}]"));
                if *number == link.leader {
                    self.problem(format!("{place}.followers[{j}]"), "a node cannot follow itself", number);
                }
            }
            if let Some(freedoms) = &link.freedoms {
                self.once(freedoms, "a freedom", &format!("{place}.freedoms"), |freedom| freedom.name().to_owned());
                if freedoms.is_empty() {
                    self.problem(format!("{place}.freedoms"), "a rigid link needs at least one freedom", "[]");
                }
            }
        }
    }

    fn constraints(&mut self) {
        for (i, constraint) in self.model.constraints.iter().enumerate() {
            let place = format!("constraints[{i}]");
            let mut seen = HashSet::new();
            for (j, (number, freedom, factor)) in constraint.terms.iter().enumerate() {
                self.node(*number, || format!("{place}.terms[{j}][0]"));
                if !seen.insert((number, freedom)) {
                    let rule = "a motion stands once in a constraint";
                    self.problem(format!("{place}.terms[{j}]"), rule, in_words(*number, *freedom));
                }
                if j == 0 && *factor == 0.0 {
                    let rule = "the first factor must not be 0: its motion is eliminated";
                    self.problem(format!("{place}.terms[0][2]"), rule, factor);
                }
            }
        }
    }

    /// All motions held by bearings.
    fn held(&self) -> HashSet<Motion> {
        let lists = self.model.bearings.iter();
        let nodes = lists.flat_map(|list| list.nodes.iter().map(move |node| (node, &list.fixed)));
        nodes
            .filter_map(|(node, fixed)| Some((self.index.position(*node)?, fixed)))
            .flat_map(|(node, fixed)| fixed.iter().map(move |freedom| motion(node, *freedom)))
            .collect()
    }

    fn words(&self, motion: Motion) -> String {
        in_words(self.model.nodes[motion as usize / 6].0, Freedom::ALL[motion as usize % 6])
    }
}
