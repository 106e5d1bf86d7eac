//! Keys of a limits file: an unknown one is refused with its path and the nearest known one, all at once.

use serde_json::Value;

use super::problem::LimitsProblem;

/// Keys of an object, and which of their values are objects with keys of their own.
pub(super) struct Shape {
    keys: &'static [&'static str],
    inner: &'static [(&'static str, &'static Shape)],
}

const WHEN: Shape = Shape { keys: &["track", "speed_to_km_h", "comfort_level"], inner: &[] };
const CASE: Shape = Shape { keys: &["when", "limit"], inner: &[("when", &WHEN), ("limit", &LIMIT)] };
const CHART: Shape = Shape { keys: &["spans_m", "speeds_km_h", "values"], inner: &[] };
const LIMIT: Shape =
    Shape { keys: &["span_over", "static_plus", "at_most", "chart", "as_given", "user"], inner: &[("chart", &CHART)] };
const GRADE: Shape = Shape { keys: &["to", "name"], inner: &[] };
const CUT_OFF: Shape =
    Shape { keys: &["max_of", "times_f1", "frequency_of_mode"], inner: &[("max_of", &CUT_OFF_PART)] };
const CUT_OFF_PART: Shape = Shape { keys: &["times_f1", "frequency_of_mode"], inner: &[] };
const FILTER: Shape =
    Shape { keys: &["type", "order", "phase", "cut_off_hz", "length_m", "curve"], inner: &[("cut_off_hz", &CUT_OFF)] };
const CRITERION: Shape = Shape {
    keys: &[
        "id",
        "title",
        "quantity",
        "statistic",
        "filter",
        "basis",
        "cases",
        "sense",
        "grades",
        "unit",
        "clause",
        "edition",
        "source",
        "verified",
        "note",
        "never",
        "needs",
    ],
    inner: &[("filter", &FILTER), ("cases", &CASE), ("grades", &GRADE)],
};
const FACTS: Shape = Shape {
    keys: &[
        "n0_hz",
        "third_mode_hz",
        "modes_from",
        "track",
        "spans_m",
        "l_phi_m",
        "continuous",
        "maintenance",
        "alpha",
        "line_speed_km_h",
        "overhang_m",
        "dead_reactions_kn",
        "comfort_level",
    ],
    inner: &[],
};
pub(super) const FILE: Shape = Shape {
    keys: &["code", "edition", "source", "note", "facts", "people", "criteria"],
    inner: &[("facts", &FACTS), ("criteria", &CRITERION)],
};

impl Shape {
    /// Every key that is not known. `$comment` and `$schema` are allowed everywhere.
    pub(super) fn check(&self, value: &Value, file: &str, path: &str, problems: &mut Vec<LimitsProblem>) {
        match value {
            Value::Array(items) => {
                for (i, item) in items.iter().enumerate() {
                    self.check(item, file, &format!("{path}[{i}]"), problems);
                }
            }
            Value::Object(object) => {
                for (key, value) in object {
                    let path = format!("{path}.{key}");
                    if key == "$comment" || key == "$schema" {
                    } else if !self.keys.contains(&key.as_str()) {
                        let suggestion = nearest(key, self.keys.iter().copied());
                        problems.push(LimitsProblem {
                            file: file.into(),
                            path,
                            rule: "unknown key".into(),
                            value: String::new(),
                            suggestion,
                        });
                    } else if let Some((_, inner)) = self.inner.iter().find(|(name, _)| name == key) {
                        inner.check(value, file, &path, problems);
                    }
                }
            }
            _ => {}
        }
    }
}

/// The known word nearest to this one, if it is near.
pub(super) fn nearest<'a>(word: &str, known: impl Iterator<Item = &'a str>) -> Option<String> {
    let scored = known.map(|one| (strsim::jaro_winkler(word, one), one)).filter(|(score, _)| *score > 0.8);
    scored.max_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, one)| one.to_string())
}
