//! Rules of elements: their nodes, sections and shapes.

use super::checker::Checker;
use super::shape::{Point, add, difference, norm, parallel, spans};
use crate::types::{Beams, Freedom, LineSection};

impl Checker<'_> {
    pub(super) fn beams(&mut self) {
        for (i, list) in self.model.beams.iter().enumerate() {
            let place = format!("beams[{i}]");
            if let Some(section) = self.line_section(&list.section, &place) {
                let needed =
                    [("inertia_2", section.inertia_2), ("inertia_3", section.inertia_3), ("torsion", section.torsion)];
                for (key, _) in needed.into_iter().filter(|(_, value)| *value <= 0.0) {
                    let rule = format!("a beam's section needs {key}");
                    self.problem(format!("{place}.section"), &rule, format!("`{}` has none", section.name));
                }
            }
            let has_orientation = norm(list.orientation) > 0.0;
            if !has_orientation {
                self.problem(format!("{place}.orientation"), "the orientation must not be zero", "[0, 0, 0]");
            }
            self.releases(list, &place);
            let [a, b] = list.offsets.unwrap_or_default();
            for (j, ends) in list.elements.iter().enumerate() {
                let axis = self.axis(*ends, &place, j, [a, b]);
                if let Some(axis) = axis.filter(|axis| has_orientation && parallel(*axis, list.orientation)) {
                    let rule = "the orientation must not run along the beam";
                    self.problem(format!("{place}.elements[{j}]"), rule, format!("both run along {axis:?}"));
                }
            }
        }
    }

    fn releases(&mut self, list: &Beams, place: &str) {
        if list.releases.as_ref().is_some_and(|ends| ends.iter().all(|freed| freed.contains(&Freedom::Rx))) {
            let rule = "rx must not be released at both ends, or the beam turns about its own axis";
            self.problem(format!("{place}.releases"), rule, "rx at both");
        }
        for (end, released) in list.releases.iter().flatten().enumerate() {
            let place = format!("{place}.releases[{end}]");
            for (k, freedom) in released.iter().enumerate() {
                if matches!(freedom, Freedom::X | Freedom::Y | Freedom::Z) {
                    let rule = "only the rotations rx, ry, rz can be released";
                    self.problem(format!("{place}[{k}]"), rule, freedom.name());
                }
            }
            self.once(released, "a freedom", &place, |freedom| freedom.name().to_owned());
        }
    }

    pub(super) fn trusses(&mut self) {
        for (i, list) in self.model.trusses.iter().enumerate() {
            let place = format!("trusses[{i}]");
            self.line_section(&list.section, &place);
            for (j, ends) in list.elements.iter().enumerate() {
                self.axis(*ends, &place, j, [[0.0; 3]; 2]);
            }
            let Some(tensions) = &list.tensions else { continue };
            if tensions.len() != list.elements.len() {
                let found = format!("{} tensions, {} elements", tensions.len(), list.elements.len());
                self.problem(format!("{place}.tensions"), "every cable needs its tension", found);
            }
            for (j, tension) in tensions.iter().enumerate().filter(|(_, tension)| **tension <= 0.0) {
                self.problem(format!("{place}.tensions[{j}]"), "a tension must be greater than 0", tension);
            }
        }
    }

    fn line_section(&mut self, name: &str, place: &str) -> Option<LineSection> {
        let names: Vec<&str> = self.model.line_sections.iter().map(|section| section.name.as_str()).collect();
        self.known(name, &names, "section", || format!("{place}.section"));
        self.model.line_sections.iter().find(|section| section.name == name).cloned()
    }

    /// From the first to the second end of an element, if it has two.
    fn axis(&mut self, ends: [u32; 2], place: &str, j: usize, offsets: [Point; 2]) -> Option<Point> {
        let [a, b] = [0, 1].map(|end| self.node(ends[end], || format!("{place}.elements[{j}][{end}]")));
        let axis = difference(add(b?, offsets[1]), add(a?, offsets[0]));
        let rule = if ends[0] == ends[1] {
            "the nodes of an element must differ"
        } else if norm(axis) == 0.0 {
            "an element must connect two different places"
        } else {
            return Some(axis);
        };
        self.problem(format!("{place}.elements[{j}]"), rule, format!("{ends:?}"));
        None
    }

    pub(super) fn shells(&mut self) {
        let names: Vec<&str> = self.model.shell_sections.iter().map(|section| section.name.as_str()).collect();
        for (i, list) in self.model.shells.iter().enumerate() {
            self.known(&list.section, &names, "section", || format!("shells[{i}].section"));
            for (j, element) in list.elements.iter().enumerate() {
                let place = || format!("shells[{i}].elements[{j}]");
                if !matches!(element.len(), 3 | 4) {
                    self.problem(place(), "a shell has 3 or 4 nodes", element.len());
                    continue;
                }
                let Some(corners) = self.corners(element, place) else { continue };
                if repeats(element) {
                    self.problem(place(), "the nodes of an element must differ", format!("{element:?}"));
                } else if !spans(&corners) {
                    self.problem(place(), "the nodes of a shell must span an area", format!("{element:?}"));
                }
            }
        }
    }

    /// Coordinates of an element's nodes.
    fn corners(&mut self, element: &[u32], place: impl Fn() -> String) -> Option<Vec<Point>> {
        let mut corners = Vec::with_capacity(4);
        for (k, number) in element.iter().enumerate() {
            corners.extend(self.node(*number, || format!("{}[{k}]", place())));
        }
        (corners.len() == element.len()).then_some(corners)
    }

    pub(super) fn springs(&mut self) {
        for (i, list) in self.model.springs.iter().enumerate() {
            let place = format!("springs[{i}]");
            let values = list.stiffness.iter().chain(&list.damping);
            for value in values.clone().filter(|value| **value < 0.0) {
                self.problem(place.clone(), "stiffness and damping must not be negative", value);
            }
            if values.clone().all(|value| *value == 0.0) {
                self.problem(place.clone(), "a spring needs a stiffness or a damping", "neither");
            }
            for (j, element) in list.elements.iter().enumerate() {
                let place = || format!("{place}.elements[{j}]");
                if !matches!(element.len(), 1 | 2) {
                    self.problem(place(), "a spring has 1 or 2 nodes", element.len());
                } else if self.corners(element, place).is_some() && repeats(element) {
                    self.problem(place(), "the nodes of an element must differ", format!("{element:?}"));
                }
            }
        }
    }

    pub(super) fn masses(&mut self) {
        for (i, list) in self.model.masses.iter().enumerate() {
            for (j, number) in list.nodes.iter().enumerate() {
                self.node(*number, || format!("masses[{i}].nodes[{j}]"));
            }
            for (k, inertia) in list.inertia.iter().enumerate().filter(|(_, inertia)| **inertia < 0.0) {
                self.problem(format!("masses[{i}].inertia[{k}]"), "must be at least 0", inertia);
            }
        }
    }
}

fn repeats(element: &[u32]) -> bool {
    element.iter().enumerate().any(|(k, number)| element[..k].contains(number))
}
