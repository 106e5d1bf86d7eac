//! Reads JSON so that people learn what is wrong with it and where.
//!
//! A stock parser stops at `NaN` and at `1e999` without saying which quantity that was, and silently drops a repeated
//! key. This one reports all three with their path and reads on; only broken syntax stops it.

use std::collections::HashSet;

use serde_json::{Map, Number, Value};

use crate::problem::Report;

/// Deeper nesting than this is no scenario.
const DEPTH: usize = 64;

/// A key for people; it may stand in every object, with any value.
pub(crate) const COMMENT: &str = "$comment";

/// A document read, as far as it can be read.
pub(crate) struct Document {
    pub value: Value,
    /// Paths whose value was reported here and stands as `null`: not to be reported again.
    pub reported: HashSet<String>,
}

/// Reads `text`; `None` after a syntax error. Problems go into the report.
pub(crate) fn read(text: &str, report: &mut Report) -> Option<Document> {
    let mut reader = Reader { text, at: 0, report, reported: HashSet::new() };
    match reader.document() {
        Ok(value) => Some(Document { value, reported: reader.reported }),
        Err(Syntax { path, expected }) => {
            let (line, column, found) = reader.place();
            let rule = format!("not JSON: expected {expected}");
            reader.report.problem(path, rule, format!("found {found} in line {line}, column {column}"));
            None
        }
    }
}

/// What was expected where the reader stopped.
struct Syntax {
    path: String,
    expected: &'static str,
}

struct Reader<'a> {
    text: &'a str,
    /// Byte the reader stands at.
    at: usize,
    report: &'a mut Report,
    reported: HashSet<String>,
}

impl Reader<'_> {
    fn document(&mut self) -> Result<Value, Syntax> {
        self.at = if self.text.starts_with('\u{feff}') { '\u{feff}'.len_utf8() } else { 0 };
        let value = self.value("$", 0)?;
        match self.peek() {
            None => Ok(value),
            Some(_) => Err(Syntax { path: String::new(), expected: "the end of the file" }),
        }
    }

    fn value(&mut self, path: &str, depth: usize) -> Result<Value, Syntax> {
        let error = |expected| Syntax { path: path.to_owned(), expected };
        match self.peek() {
            _ if depth > DEPTH => Err(error("less nesting")),
            Some('{') => self.object(path, depth),
            Some('[') => self.array(path, depth),
            Some('"') => self.string().map(Value::String).ok_or_else(|| error("a text in double quotes")),
            Some(_) => self.word(path).ok_or_else(|| error("a value")),
            None => Err(error("a value")),
        }
    }

    fn object(&mut self, path: &str, depth: usize) -> Result<Value, Syntax> {
        let error = |expected| Syntax { path: path.to_owned(), expected };
        let (mut map, mut first) = (Map::new(), true);
        self.skip('{');
        while !self.skip('}') {
            if !first && !self.skip(',') {
                return Err(error("a comma or }"));
            }
            if self.peek() != Some('"') {
                return Err(error("a key in double quotes"));
            }
            let key = self.string().ok_or_else(|| error("a key in double quotes"))?;
            if !self.skip(':') {
                return Err(error("a colon"));
            }
            let inner = format!("{path}.{key}");
            let value = self.value(&inner, depth + 1)?;
            first = false;
            if key == COMMENT {
                // For readers of the file alone.
            } else if map.contains_key(&key) {
                self.report.problem(inner, "duplicate key", format!("`{key}`"));
            } else {
                map.insert(key, value);
            }
        }
        Ok(Value::Object(map))
    }

    fn array(&mut self, path: &str, depth: usize) -> Result<Value, Syntax> {
        let mut list = Vec::new();
        self.skip('[');
        while !self.skip(']') {
            if !list.is_empty() && !self.skip(',') {
                return Err(Syntax { path: path.to_owned(), expected: "a comma or ]" });
            }
            list.push(self.value(&format!("{path}[{}]", list.len()), depth + 1)?);
        }
        Ok(Value::Array(list))
    }

    /// A quoted text; the reader stands at its opening quote, and stays there if it is broken.
    fn string(&mut self) -> Option<String> {
        let mut escaped = false;
        let inside = &self.text[self.at + 1..];
        let end = inside.find(|c| {
            let closing = c == '"' && !escaped;
            escaped = c == '\\' && !escaped;
            closing
        })?;
        let token = &self.text[self.at..self.at + 1 + end + 1];
        let text = serde_json::from_str(token).ok()?;
        self.at += token.len();
        Some(text)
    }

    /// A number, `true`, `false`, `null`, or what others write for a number that is none.
    fn word(&mut self, path: &str) -> Option<Value> {
        let rest = &self.text[self.at..];
        let end = rest.find(|c: char| !(c.is_ascii_alphanumeric() || "+-._".contains(c))).unwrap_or(rest.len());
        let word = &rest[..end];
        let value = match word {
            "true" => Value::Bool(true),
            "false" => Value::Bool(false),
            "null" => Value::Null,
            _ => match serde_json::from_str::<Number>(word) {
                Ok(number) => Value::Number(number),
                // "inf", "nan", or too large for a double, which serde_json refuses and Rust reads as infinity
                Err(_) if word.parse::<f64>().is_ok_and(|x| !x.is_finite()) => {
                    self.report.problem(path, "must be a finite number", word);
                    self.reported.insert(path.to_owned());
                    Value::Null
                }
                Err(_) => return None,
            },
        };
        self.at += end;
        Some(value)
    }

    /// The next character that is not white space; the reader then stands at it.
    fn peek(&mut self) -> Option<char> {
        let rest = &self.text[self.at..];
        self.at = self.text.len() - rest.trim_start_matches([' ', '\t', '\n', '\r']).len();
        self.text[self.at..].chars().next()
    }

    /// Steps over `wanted` if it comes next.
    fn skip(&mut self, wanted: char) -> bool {
        let found = self.peek() == Some(wanted);
        self.at += if found { wanted.len_utf8() } else { 0 };
        found
    }

    /// Line and column, counted from 1, where the reader stands, and what stands there.
    fn place(&self) -> (usize, usize, String) {
        let before = &self.text[..self.at];
        let line = before.matches('\n').count() + 1;
        let column = before.chars().rev().take_while(|c| *c != '\n').count() + 1;
        let found = match self.text[self.at..].chars().next() {
            Some(c) if c.is_control() => format!("`{}`", c.escape_default()),
            Some(c) => format!("`{c}`"),
            None => "the end of the file".to_owned(),
        };
        (line, column, found)
    }
}
