//! Files of trains: those that come with the program, and those of a user (CSV and JSON).
//!
//! ```text
//! CSV    x,load              m from the first axle, kN; apart by commas, semicolons or tabs; # begins a remark
//! JSON   { "name", "title", "max_speed_km_h", "coach", "axles": [[x, load], …] }        one train, or
//!        { …, "units": [{ "gaps", "loads", "count", "mirrored" }, …] }                  by vehicles, or
//!        { "source", "trains": [ … ] }                                                  several
//! ```

use std::path::Path;

use serde::Deserialize;
use ttb_scenario::{Problem, Problems};

use crate::hslm::HslmA;
use crate::rule::{Unit, axles};
use crate::train::{Axle, ForceTrain};

/// Axle loads that a file may have, kN: what is beyond them is a slip of the unit.
const LOADS: [f64; 2] = [0.0, 2000.0];
/// Axles that a train may have.
const MOST_AXLES: usize = 100_000;

/// A file of several trains.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Several {
    source: String,
    #[serde(default)]
    verified: String,
    trains: Vec<Written>,
}

/// A train as it is written.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Written {
    #[serde(default)]
    name: String,
    #[serde(default)]
    title: String,
    #[serde(default)]
    max_speed_km_h: Option<f64>,
    #[serde(default)]
    coach: Option<f64>,
    #[serde(default)]
    axles: Vec<[f64; 2]>,
    #[serde(default)]
    units: Vec<Unit>,
    #[serde(default)]
    hslm: Option<HslmA>,
    #[serde(default)]
    source: String,
    #[serde(default)]
    verified: String,
}

/// Collects what is wrong with one file.
struct Found<'a> {
    file: &'a str,
    problems: Vec<Problem>,
}

impl Found<'_> {
    fn note(&mut self, path: impl Into<String>, rule: &str, value: impl std::fmt::Display) {
        let (file, path, rule, value) = (self.file.to_string(), path.into(), rule.to_string(), value.to_string());
        self.problems.push(Problem { file, path, rule, value, suggestion: None });
    }
}

/// Reads a user's file: CSV or JSON by its ending.
///
/// # Errors
/// All problems of the file; one that cannot be read is one.
pub fn read(path: &Path) -> Result<Vec<ForceTrain>, Problems> {
    let file = path.display().to_string();
    let mut found = Found { file: &file, problems: Vec::new() };
    let trains = match ttb_scenario::read_text(path) {
        Err(error) => {
            found.note("", "the file of a train cannot be read", error);
            Vec::new()
        }
        Ok(text) => of_kind(&text, path, &mut found),
    };
    if found.problems.is_empty() { Ok(trains) } else { Err(Problems(found.problems)) }
}

/// Reads the text of a user's file that messages call `file`: CSV or JSON by its ending.
///
/// # Errors
/// All problems of the text.
pub fn read_text(text: &str, file: &str) -> Result<Vec<ForceTrain>, Problems> {
    let mut found = Found { file, problems: Vec::new() };
    let trains = of_kind(text, Path::new(file), &mut found);
    if found.problems.is_empty() { Ok(trains) } else { Err(Problems(found.problems)) }
}

fn of_kind(text: &str, path: &Path, found: &mut Found) -> Vec<ForceTrain> {
    let name = path.file_stem().map(|stem| stem.to_string_lossy().into_owned()).unwrap_or_default();
    if path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("json")) {
        json(text, &name, found)
    } else {
        csv(text, &name, found)
    }
}

/// Reads a text that comes with the program.
pub(crate) fn bundled(text: &str) -> Vec<ForceTrain> {
    let mut found = Found { file: "bundled", problems: Vec::new() };
    let trains = json(text, "", &mut found);
    debug_assert!(found.problems.is_empty(), "{:?}", found.problems);
    trains
}

fn json(text: &str, name: &str, found: &mut Found) -> Vec<ForceTrain> {
    let rule = "must be a train (axles or units) or a list of trains";
    let text = text.trim_start_matches('\u{feff}');
    let value: serde_json::Value = match serde_json::from_str(text) {
        Ok(value) => value,
        Err(error) => {
            found.note("$", "must be JSON", error);
            return Vec::new();
        }
    };
    let several = value.get("trains").is_some();
    let file = if several {
        serde_json::from_str::<Several>(text)
    } else {
        serde_json::from_str::<Written>(text).map(|train| Several {
            source: train.source.clone(),
            verified: train.verified.clone(),
            trains: vec![train],
        })
    };
    match file {
        Ok(file) => {
            let place = |i: usize| if several { format!("$.trains[{i}]") } else { "$".into() };
            let trains = file.trains.iter().enumerate();
            trains.filter_map(|(i, train)| made(train, name, &file, &place(i), found)).collect()
        }
        Err(error) => {
            found.note("$", rule, error);
            Vec::new()
        }
    }
}

fn made(train: &Written, name: &str, file: &Several, place: &str, found: &mut Found) -> Option<ForceTrain> {
    let before = found.problems.len();
    let forms = [!train.axles.is_empty(), !train.units.is_empty(), train.hslm.is_some()];
    if forms.iter().filter(|given| **given).count() != 1 {
        found.note(place, "a train needs either axles or units, and at least one axle", "");
        return None;
    }
    let count: usize = train.units.iter().map(|unit| unit.gaps.len().saturating_mul(unit.count)).sum();
    if count.max(train.axles.len()) > MOST_AXLES {
        found.note(place, "a train must have at most 100000 axles", count.max(train.axles.len()));
        return None;
    }
    for (i, unit) in train.units.iter().enumerate() {
        for (rule, value, within) in unit.problems() {
            found.note(format!("{place}.units[{i}].{within}"), rule, value);
        }
    }
    if found.problems.len() > before {
        return None;
    }
    let mut buffers = None;
    let list = if let Some(rule) = &train.hslm {
        rule.axles()
    } else if train.units.is_empty() {
        train.axles.iter().map(|[x, load]| Axle { x: *x, load: 1e3 * load }).collect()
    } else {
        let (list, length) = axles(&train.units);
        buffers = Some(length);
        list
    };
    let list = checked(list, |i| format!("{place}.axles[{i}]"), found);
    if let Some(speed) = train.max_speed_km_h.filter(|speed| !(*speed > 0.0 && *speed <= 1000.0)) {
        found.note(format!("{place}.max_speed_km_h"), "must be between 0 and 1000 km/h", speed);
    }
    let pick = |own: &String, shared: &str| if own.is_empty() { shared.to_string() } else { own.clone() };
    let verified = pick(&pick(&train.verified, &file.verified), "user");
    let name = pick(&train.name, name);
    (found.problems.len() == before).then(|| ForceTrain {
        title: pick(&train.title, &name),
        name,
        max_speed: train.max_speed_km_h.map(|speed| speed / 3.6),
        axles: list,
        buffers,
        coach: train.coach,
        source: pick(&train.source, &file.source),
        verified,
    })
}

/// Axles from the first on, after all rules; `place` names the axle of a number.
fn checked(mut list: Vec<Axle>, place: impl Fn(usize) -> String, found: &mut Found) -> Vec<Axle> {
    for (i, axle) in list.iter().enumerate() {
        let load = 1e-3 * axle.load;
        if !(load > LOADS[0] && load <= LOADS[1]) {
            found.note(place(i), "an axle load must be above 0 and at most 2000 kN", load);
        }
        if !axle.x.is_finite() {
            found.note(place(i), "x must be a finite number", axle.x);
        }
        if i > 0 && axle.x < list[i - 1].x {
            let value = format!("{} after {}", axle.x, list[i - 1].x);
            found.note(place(i), "x must not fall: axles stand from the first backwards", value);
        }
    }
    let first = list.first().map_or(0.0, |axle| axle.x);
    if first != 0.0 {
        list.iter_mut().for_each(|axle| axle.x -= first);
    }
    list
}

fn csv(text: &str, name: &str, found: &mut Found) -> Vec<ForceTrain> {
    let text = text.trim_start_matches('\u{feff}');
    let header = text.lines().find(|line| !line.trim().is_empty() && !line.trim_start().starts_with('#'));
    let delimiter = [b'\t', b';'].into_iter().find(|mark| header.is_some_and(|line| line.as_bytes().contains(mark)));
    let delimiter = delimiter.unwrap_or(b',');
    let mut reader = csv::ReaderBuilder::new();
    let reader = reader.delimiter(delimiter).comment(Some(b'#')).trim(csv::Trim::All).flexible(true);
    let mut reader = reader.from_reader(text.as_bytes());
    let names: Vec<String> =
        reader.headers().map(|row| row.iter().map(str::to_lowercase).collect()).unwrap_or_default();
    let column = |name: &str| names.iter().position(|column| column == name);
    let (Some(x), Some(load)) = (column("x"), column("load")) else {
        found.note("", "the first line must name the columns x (m) and load (kN)", names.join(", "));
        return Vec::new();
    };
    let (mut list, mut lines) = (Vec::new(), Vec::new());
    for record in reader.records() {
        let record = match record {
            Ok(record) => record,
            Err(error) => {
                found.note("", "the file of a train cannot be read", error);
                return Vec::new();
            }
        };
        let line = record.position().map_or(0, csv::Position::line);
        // A decimal comma stands where commas part no columns.
        let number = |column: usize| {
            let text = record.get(column)?;
            if delimiter == b',' { text.parse().ok() } else { text.replace(',', ".").parse::<f64>().ok() }
        };
        match (number(x), number(load)) {
            (Some(x), Some(load)) => {
                list.push(Axle { x, load: 1e3 * load });
                lines.push(line);
            }
            _ => {
                let value = record.iter().collect::<Vec<_>>().join(" ");
                found.note(format!("line {line}"), "x and load must be numbers", value);
            }
        }
    }
    if list.is_empty() {
        found.note("", "a train needs at least one axle", "no line with x and load");
    }
    let axles = checked(list, |i| format!("line {}", lines[i]), found);
    vec![ForceTrain {
        name: name.into(),
        title: name.into(),
        max_speed: None,
        axles,
        buffers: None,
        coach: None,
        source: found.file.into(),
        verified: "user".into(),
    }]
}
