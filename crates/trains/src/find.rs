//! From what a user types to trains.
//!
//! ```text
//! hslm-a                all ten                     hslm-a3      one of them
//! hslm-b:10,3.5         N and d (also 10x3.5)       annex-d, annex-d-5
//! en15528-d2x6          six wagons                  ice2, talgo350, ave-s100, velaro-like
//! ice3, manchester, …   static loads of vehicles    mine.csv, folder/mine.json
//! ```

use std::path::Path;

use ttb_scenario::{Problem, Problems, nearest};

use crate::files;
use crate::hslm::hslm_b;
use crate::names::{FAMILIES, TRAINS};
use crate::train::{Axle, ForceTrain};

/// The trains of a name, or of a file.
///
/// # Errors
/// Nothing has this name; all problems of a file.
pub fn find(name: &str) -> Result<Vec<ForceTrain>, Problems> {
    let wanted = name.trim().to_lowercase();
    if let Some(train) = TRAINS.iter().find(|train| train.name == wanted) {
        return Ok(vec![train.clone()]);
    }
    if let Some((_, begin)) = FAMILIES.iter().find(|(family, _)| *family == wanted) {
        return Ok(TRAINS.iter().filter(|train| train.name.starts_with(begin)).cloned().collect());
    }
    if let Some(numbers) = wanted.strip_prefix("hslm-b").and_then(|rest| rest.strip_prefix([':', '-'])) {
        return numbers_of_b(numbers).map(|train| vec![train]).ok_or_else(|| {
            problem(
                name,
                "HSLM-B needs a number N from 2 to 1000 of forces and their distance d from 0.1 to 100 m",
                Some("hslm-b:10,3.5".into()),
            )
        });
    }
    if let Some(train) = wagons(&wanted) {
        return Ok(vec![train]);
    }
    let path = Path::new(name.trim());
    let is_file = path.extension().is_some_and(|e| e.eq_ignore_ascii_case("csv") || e.eq_ignore_ascii_case("json"));
    if is_file || path.is_file() {
        return files::read(path);
    }
    let known = names();
    Err(problem(
        name,
        "there must be a train of this name (`ttb list trains`), or a file NAME.csv or NAME.json",
        nearest(&wanted, known.iter().map(String::as_str)),
    ))
}

/// Axles (m behind the first one, N) of the one train of a name, or of a file that is looked for from a folder: what a scenario
/// means by a name of forces.
///
/// # Errors
/// Nothing has this name, or several trains have; all problems of a file.
pub fn axles_of(name: &str, folder: &Path) -> Result<Vec<[f64; 2]>, String> {
    let file = folder.join(name);
    let file = file.is_file().then(|| file.display().to_string());
    let trains = find(file.as_deref().unwrap_or(name)).map_err(|problems| problems.to_string())?;
    match trains.as_slice() {
        [train] => Ok(train.axles.iter().map(|axle| [axle.x, axle.load]).collect()),
        several => {
            let names: Vec<&str> = several.iter().map(|train| train.name.as_str()).collect();
            Err(format!("stands for {} trains, and a run has one: {}", several.len(), names.join(", ")))
        }
    }
}

/// The trains of several names; a name given twice counts once.
///
/// # Errors
/// All problems of all names.
pub fn find_all<'a>(names: impl IntoIterator<Item = &'a str>) -> Result<Vec<ForceTrain>, Problems> {
    let (mut trains, mut problems) = (Vec::<ForceTrain>::new(), Vec::new());
    for name in names {
        match find(name) {
            Ok(found) => trains.extend(found),
            Err(Problems(found)) => problems.extend(found),
        }
    }
    if !problems.is_empty() {
        return Err(Problems(problems));
    }
    let mut kept: Vec<ForceTrain> = Vec::with_capacity(trains.len());
    for train in trains {
        if !kept.contains(&train) {
            kept.push(train);
        }
    }
    let twice = kept.iter().enumerate().find(|(i, train)| kept[..*i].iter().any(|other| other.name == train.name));
    if let Some((_, train)) = twice {
        return Err(problem(&train.name, "two different trains must not have the same name", None));
    }
    Ok(kept)
}

/// The names in a list that commas part; the comma of `hslm-b:10,3.5` parts nothing.
#[must_use]
pub fn split(list: &str) -> Vec<String> {
    let mut names = Vec::<String>::new();
    for part in list.split(',').map(str::trim).filter(|part| !part.is_empty()) {
        match names.last_mut() {
            Some(last) if needs_distance(last) && part.parse::<f64>().is_ok() => {
                last.push(',');
                last.push_str(part);
            }
            _ => names.push(part.into()),
        }
    }
    names
}

fn needs_distance(name: &str) -> bool {
    let name = name.to_lowercase();
    name.strip_prefix("hslm-b").is_some_and(|rest| !rest.contains([',', 'x']))
}

/// Names for a list and for suggestions: families and trains.
#[must_use]
pub fn names() -> Vec<String> {
    let families = FAMILIES.iter().map(|(family, _)| (*family).to_string());
    families.chain(TRAINS.iter().map(|train| train.name.clone())).chain(["hslm-b:N,d".into()]).collect()
}

fn numbers_of_b(numbers: &str) -> Option<ForceTrain> {
    let (count, spacing) = numbers.split_once([',', 'x'])?;
    let (count, spacing): (usize, f64) = (count.trim().parse().ok()?, spacing.trim().parse().ok()?);
    ((2..=1000).contains(&count) && (0.1..=100.0).contains(&spacing)).then(|| hslm_b(count, spacing))
}

/// `NAMExCOUNT`: so many vehicles of a train of one vehicle whose length over buffers is known.
fn wagons(name: &str) -> Option<ForceTrain> {
    let (one, count) = name.rsplit_once('x')?;
    let count: usize = count.parse().ok().filter(|count| (1..=1000).contains(count))?;
    let wagon = TRAINS.iter().find(|train| train.name == one)?;
    let pitch = wagon.buffers?;
    let axles = (0..count)
        .flat_map(|i| wagon.axles.iter().map(move |axle| Axle { x: i as f64 * pitch + axle.x, load: axle.load }));
    Some(ForceTrain {
        name: name.into(),
        title: format!("{count} × {}", wagon.title),
        axles: axles.collect(),
        buffers: Some(count as f64 * pitch),
        coach: if count > 1 { Some(pitch) } else { wagon.coach },
        ..wagon.clone()
    })
}

fn problem(name: &str, rule: &str, suggestion: Option<String>) -> Problems {
    let (file, path, rule, value) = ("train".to_string(), String::new(), rule.to_string(), format!("`{name}`"));
    Problems(vec![Problem { file, path, rule, value, suggestion }])
}
