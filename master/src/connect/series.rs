//! Variables whose names differ in one number, as series.

use std::collections::BTreeMap;

use ttb_fmi::description::{ModelDescription, ScalarVariable};

use super::map::INDEX;

/// Variables of one causality, type and unit whose names differ in a number; or a single variable.
#[derive(Clone, Debug)]
pub struct Found<'a> {
    /// Name with `{i}` in place of the number; a plain name if there is only one.
    pub pattern: String,
    /// The numbers, ascending; empty for a single variable.
    pub numbers: Vec<i64>,
    /// One of them.
    pub example: &'a ScalarVariable,
}

impl Found<'_> {
    /// How many variables.
    pub fn count(&self) -> usize {
        self.numbers.len().max(1)
    }

    /// Whether no number is left out.
    pub fn gapless(&self) -> bool {
        self.numbers.windows(2).all(|pair| pair[1] == pair[0] + 1)
    }

    /// As `support[1..59].force`.
    pub fn label(&self) -> String {
        let (Some(first), Some(last)) = (self.numbers.first(), self.numbers.last()) else {
            return self.pattern.clone();
        };
        let gaps = if self.gapless() { "" } else { " with gaps" };
        self.pattern.replacen(INDEX, &format!("{first}..{last}{gaps}"), 1)
    }
}

/// All variables of a causality as series, in the order of the file.
pub fn series<'a>(d: &'a ModelDescription, causality: &'a str) -> Vec<Found<'a>> {
    let variables: Vec<&ScalarVariable> = d.with_causality(causality).collect();
    // Every number in a name may be the running one; the candidate with the most variables wins.
    let mut candidates: BTreeMap<String, usize> = BTreeMap::new();
    for v in &variables {
        for (pattern, _) in patterns(v) {
            *candidates.entry(pattern).or_default() += 1;
        }
    }
    let mut found: Vec<Found> = Vec::new();
    let mut places: BTreeMap<String, usize> = BTreeMap::new();
    for v in variables {
        let best =
            patterns(v).max_by_key(|(pattern, _)| candidates[pattern]).filter(|(pattern, _)| candidates[pattern] > 1);
        match best {
            None => found.push(Found { pattern: v.name.clone(), numbers: Vec::new(), example: v }),
            Some((pattern, number)) => {
                let place = *places.entry(pattern.clone()).or_insert(found.len());
                match found.get_mut(place) {
                    Some(series) => series.numbers.push(number),
                    None => {
                        let pattern = pattern.split('\0').next().unwrap_or_default().to_string();
                        found.push(Found { pattern, numbers: vec![number], example: v });
                    }
                }
            }
        }
    }
    found.iter_mut().for_each(|series| series.numbers.sort_unstable());
    found
}

/// A variable's name with each of its numbers replaced in turn, and the number. Behind a zero byte stand type and unit:
/// variables that differ in them are no series.
fn patterns(v: &ScalarVariable) -> impl Iterator<Item = (String, i64)> {
    let name = &v.name;
    let bytes = name.as_bytes();
    let starts = (0..bytes.len()).filter(|&i| bytes[i].is_ascii_digit() && (i == 0 || !bytes[i - 1].is_ascii_digit()));
    starts.filter_map(move |begin| {
        let end = begin + bytes[begin..].iter().take_while(|byte| byte.is_ascii_digit()).count();
        let number = name[begin..end].parse::<i64>().ok();
        // Leading zeros: such a name cannot be made from its number.
        let number = number.filter(|n| n.to_string() == name[begin..end])?;
        let kind = format!("\0{:?}{:?}", v.kind, v.unit);
        Some((format!("{}{INDEX}{}{kind}", &name[..begin], &name[end..]), number))
    })
}
