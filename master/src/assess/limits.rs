//! Limits by name: bundled files and the user's own, in the order of the list.

use std::path::Path;

use ttb_assessment::Criteria;
use ttb_assessment::criterion::{self, DEFAULT};
use ttb_campaign::Limits;

use crate::error::Error;

/// The criteria of `--limits A,B,FILE.json`; without any the default set. A name that ends in `.json` is a file.
pub fn load(names: &[String]) -> Result<Criteria, Error> {
    Ok(Limits { texts: texts(names)? }.criteria()?)
}

/// Name and content of the files that [`load`] reads.
pub fn texts(names: &[String]) -> Result<Vec<[String; 2]>, Error> {
    let default: Vec<String> = DEFAULT.iter().map(|name| (*name).to_string()).collect();
    // A user's file alone overrides entries of the default set.
    let only_own = names.iter().all(|name| is_file(name));
    let all = if only_own { [default.as_slice(), names].concat() } else { names.to_vec() };
    let mut texts = Vec::with_capacity(all.len());
    let mut problems = Vec::new();
    for name in &all {
        match (is_file(name), criterion::text(name)) {
            (false, Some(text)) => texts.push([name.clone(), text.to_string()]),
            (true, _) => match ttb_scenario::read_text(Path::new(name)) {
                Ok(text) => texts.push([name.clone(), text]),
                Err(error) => problems.push(format!("{name}: {error}")),
            },
            (false, None) => {
                problems
                    .extend(Criteria::bundled(&[name]).err().into_iter().flatten().map(|problem| problem.to_string()));
            }
        }
    }
    if problems.is_empty() {
        return Ok(texts);
    }
    let read = Criteria::read(texts.iter().map(|[name, text]| (name.as_str(), text.as_str())));
    problems.extend(read.err().into_iter().flatten().map(|problem| problem.to_string()));
    Err(Error::Input(problems.join("\n")))
}

fn is_file(name: &str) -> bool {
    Path::new(name).extension().is_some_and(|ending| ending.eq_ignore_ascii_case("json"))
}
