//! Lists of numbers as a user types them: `140:420`, `140:420:5`, `200,250,300`, `1:20`.
//!
//! ```text
//! from:to        both ends belong to it; the step is the caller's
//! from:to:step   from, from + step, … up to and with the end
//! a,b,c          these; parts may be ranges with a step
//! ```

use serde::{Deserialize, Serialize};

/// More values than this are a slip of the pen.
const MOST: f64 = 100_000.0;

/// Numbers, or a range whose step somebody else knows.
#[derive(Clone, Debug, PartialEq)]
pub enum Numbers {
    /// These, in the order given.
    These(Vec<f64>),
    /// From the first to the second, both belonging to it.
    Range([f64; 2]),
}

/// Numbers in a file: text as on the command line, one number, or a list.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum Written {
    /// As typed: `"140:420"`.
    Text(String),
    /// One.
    One(f64),
    /// A list.
    List(Vec<f64>),
}

impl Written {
    /// What it means.
    ///
    /// # Errors
    /// What is wrong with it, a sentence.
    pub fn numbers(&self) -> Result<Numbers, String> {
        match self {
            Self::Text(text) => numbers(text),
            Self::One(one) => Ok(Numbers::These(vec![*one])),
            Self::List(list) if list.is_empty() => Err("the list is empty".into()),
            Self::List(list) => Ok(Numbers::These(list.clone())),
        }
    }
}

/// Reads a list or a range.
///
/// # Errors
/// What is wrong with it, a sentence.
pub fn numbers(text: &str) -> Result<Numbers, String> {
    if let [from, to] = text.split(':').collect::<Vec<_>>()[..]
        && !text.contains(',')
    {
        return Ok(Numbers::Range(rising(number(from)?, number(to)?)?));
    }
    let mut these = Vec::new();
    for part in text.split(',') {
        match part.split(':').collect::<Vec<_>>()[..] {
            [one] => these.push(number(one)?),
            [from, to, step] => steps(rising(number(from)?, number(to)?)?, number(step)?, &mut these)?,
            _ => return Err(format!("`{part}` must be a number or from:to:step")),
        }
    }
    Ok(Numbers::These(these))
}

/// Whole numbers: `1:20`, `7`, `1,5,9`.
///
/// # Errors
/// What is wrong with it, a sentence.
pub fn whole(written: &Written, greatest: u64) -> Result<Vec<u64>, String> {
    let values = match written.numbers()? {
        Numbers::These(these) => these,
        Numbers::Range(ends) => {
            let mut values = Vec::new();
            steps(ends, 1.0, &mut values)?;
            values
        }
    };
    let mut whole = Vec::with_capacity(values.len());
    for value in values {
        if value.fract() != 0.0 || !(0.0..=greatest as f64).contains(&value) {
            return Err(format!("{value} must be a whole number from 0 to {greatest}"));
        }
        let value = value as u64;
        if !whole.contains(&value) {
            whole.push(value);
        }
    }
    Ok(whole)
}

fn steps([from, to]: [f64; 2], step: f64, into: &mut Vec<f64>) -> Result<(), String> {
    if step.is_nan() || step <= 0.0 {
        return Err(format!("a step of {step} must be positive"));
    }
    let count = ((to - from) / step + 1e-9).floor();
    if count + into.len() as f64 >= MOST {
        return Err(format!("{from}:{to}:{step} is more than {MOST} values"));
    }
    let count = count as usize;
    into.extend((0..=count).map(|k| tidy(from + k as f64 * step)));
    if (to - from - count as f64 * step).abs() > 1e-9 * step {
        into.push(to);
    }
    Ok(())
}

/// Nine decimals: `0.1 + 0.2` is 0.3 for a user.
pub fn tidy(value: f64) -> f64 {
    (value * 1e9).round() / 1e9
}

fn rising(from: f64, to: f64) -> Result<[f64; 2], String> {
    if from <= to { Ok([from, to]) } else { Err(format!("{from}:{to} must rise; write {to}:{from}")) }
}

fn number(text: &str) -> Result<f64, String> {
    let number: f64 = text.trim().parse().map_err(|_| format!("`{text}` must be a number"))?;
    if number.is_finite() { Ok(number) } else { Err(format!("`{text}` must be finite")) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_hold_both_ends_and_lists_keep_their_order() {
        assert_eq!(numbers("140:420"), Ok(Numbers::Range([140.0, 420.0])));
        assert_eq!(numbers("0.1:0.4:0.1"), Ok(Numbers::These(vec![0.1, 0.2, 0.3, 0.4])));
        assert_eq!(numbers("10:17:5"), Ok(Numbers::These(vec![10.0, 15.0, 17.0])));
        assert_eq!(numbers("300, 250,1:2:1"), Ok(Numbers::These(vec![300.0, 250.0, 1.0, 2.0])));
        assert_eq!(whole(&Written::Text("3:5".into()), 9), Ok(vec![3, 4, 5]));
        assert_eq!(whole(&Written::List(vec![5.0, 1.0, 5.0]), 9), Ok(vec![5, 1]));
    }

    #[test]
    fn what_is_no_list_is_told() {
        for (text, told) in [
            ("420:140", "must rise"),
            ("a:2", "`a` must be a number"),
            ("1:2:0", "must be positive"),
            ("1:2,3", "from:to:step"),
            ("inf", "finite"),
            ("1:2:1e-9", "more than"),
        ] {
            let error = numbers(text).unwrap_err();
            assert!(error.contains(told), "{text}: {error}");
        }
        assert!(whole(&Written::Text("1.5".into()), 9).unwrap_err().contains("whole"));
        assert!(Written::List(vec![]).numbers().is_err());
    }
}
