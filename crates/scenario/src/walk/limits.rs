//! Limits of numbers, lists and texts.

use serde_json::{Number, Value};

use super::walker::{Walker, shown};
use crate::types::NAME_PATTERN;

impl Walker<'_> {
    pub(super) fn number(&mut self, schema: &Value, number: &Number, path: &str) {
        let Some(x) = number.as_f64() else { return };
        let limit = |keyword: &str| schema[keyword].as_f64();
        let mut broken = |rule: String| self.report.problem(path, rule, number);
        if let Some(low) = limit("minimum").filter(|low| x < *low) {
            broken(format!("must be at least {low}"));
        }
        if let Some(low) = limit("exclusiveMinimum").filter(|low| x <= *low) {
            broken(format!("must be greater than {low}"));
        }
        let width = (schema["format"] == "uint32").then_some(f64::from(u32::MAX));
        if let Some(high) = limit("maximum").or(width).filter(|high| x > *high) {
            broken(format!("must be at most {high}"));
        }
    }

    pub(super) fn length(&mut self, schema: &Value, list: &[Value], path: &str) {
        let limit = |keyword: &str| schema[keyword].as_u64();
        let length = list.len() as u64;
        match (limit("minItems"), limit("maxItems")) {
            (Some(low), Some(high)) if low == high && length != low => {
                self.report.problem(path, format!("must have {low} entries"), length);
            }
            (Some(low), _) if length < low => {
                self.report.problem(path, format!("must have at least {low} entries"), length);
            }
            (_, Some(high)) if length > high => {
                self.report.problem(path, format!("must have at most {high} entries"), length);
            }
            _ => {}
        }
    }

    /// The one pattern of the schema is that of names; the only lists of allowed texts are those of bundled names.
    pub(super) fn text(&mut self, schema: &Value, text: &str, path: &str) {
        if let Some(allowed) = schema["enum"].as_array().filter(|allowed| !allowed.iter().any(|name| name == text)) {
            self.not_among(allowed.iter().filter_map(Value::as_str), &Value::from(text), path);
        }
        let name = !text.is_empty() && text.chars().all(|c| c.is_ascii_alphanumeric() || c == '-' || c == '_');
        if schema["pattern"] == NAME_PATTERN && !name {
            let rule = "must be a name of letters, digits, - and _";
            self.report.problem(path, rule, shown(&Value::from(text)));
        }
    }
}
