//! Materials and sections: names.

use std::collections::HashSet;

use super::checker::Checker;
use crate::problem::nearest;

impl Checker<'_> {
    pub(super) fn sections(&mut self) {
        let model = self.model;
        let materials: Vec<&str> = model.materials.iter().map(|material| material.name.as_str()).collect();
        let lines: Vec<&str> = model.line_sections.iter().map(|section| section.name.as_str()).collect();
        let shells: Vec<&str> = model.shell_sections.iter().map(|section| section.name.as_str()).collect();
        self.distinct("materials", &materials);
        self.distinct("line_sections", &lines);
        self.distinct("shell_sections", &shells);
        for (i, section) in model.line_sections.iter().enumerate() {
            self.known(&section.material, &materials, "material", || format!("line_sections[{i}].material"));
        }
        for (i, section) in model.shell_sections.iter().enumerate() {
            self.known(&section.material, &materials, "material", || format!("shell_sections[{i}].material"));
        }
    }

    fn distinct(&mut self, list: &str, names: &[&str]) {
        let mut seen = HashSet::new();
        for (i, name) in names.iter().enumerate() {
            let place = format!("{list}[{i}].name");
            if name.is_empty() {
                self.problem(place, "a name must not be empty", "\"\"");
            } else if !seen.insert(name) {
                self.problem(place, &format!("names of {list} must differ"), format!("`{name}`"));
            }
        }
    }

    /// Whether a name is among those known; if not, that is reported.
    pub(super) fn known(&mut self, name: &str, names: &[&str], what: &str, place: impl FnOnce() -> String) -> bool {
        let is_known = names.contains(&name);
        if !is_known {
            let near = nearest(name, names.iter().copied());
            let path = format!("{}.{}", self.at, place());
            self.report.suggest(path, format!("unknown {what}"), format!("`{name}`"), near);
        }
        is_known
    }
}
