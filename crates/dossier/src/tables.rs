//! runs.csv and peaks.csv as they are read: the tables of runs and of their reduced values.

use std::collections::HashMap;
use std::str::FromStr;

use ttb_assessment::{Basis, Loads, Peak, PlaceKind, Rail, Results, Run, Statistic};

use crate::error::Error;
use crate::files::Files;

/// Name of the table of runs.
pub const RUNS: &str = "runs.csv";
/// Name of the table of reduced values.
pub const PEAKS: &str = "peaks.csv";

/// A table that was read: rows by the names of their columns.
struct Read {
    path: String,
    columns: HashMap<String, usize>,
    rows: Vec<csv::StringRecord>,
}

impl Read {
    fn new(files: &dyn Files, name: &str) -> Result<Self, Error> {
        let path = files.shown(name);
        let wrong = |e: csv::Error| match e.into_kind() {
            csv::ErrorKind::Io(source) => Error::Io { path: path.clone(), source },
            other => Error::Input(format!("{path}: {other:?}")),
        };
        let content = files.open(name)?.ok_or_else(|| Error::Input(format!("{path}: it is not there")))?;
        let mut reader = csv::Reader::from_reader(content);
        let headers = reader.headers().map_err(wrong)?;
        let columns = headers.iter().enumerate().map(|(at, name)| (name.to_string(), at)).collect();
        let rows = reader.records().collect::<Result<Vec<_>, _>>().map_err(wrong)?;
        Ok(Self { path, columns, rows })
    }

    fn text<'a>(&self, row: &'a csv::StringRecord, column: &str) -> &'a str {
        self.columns.get(column).and_then(|at| row.get(*at)).unwrap_or_default()
    }

    /// A number, `None` where the field is empty.
    fn number<T: FromStr>(&self, row: &csv::StringRecord, column: &str) -> Result<Option<T>, Error> {
        let text = self.text(row, column);
        if text.is_empty() {
            return Ok(None);
        }
        text.parse().map(Some).map_err(|_| self.wrong(row, column, "must be a number"))
    }

    fn wrong(&self, row: &csv::StringRecord, column: &str, rule: &str) -> Error {
        let line = row.position().map_or(0, csv::Position::line);
        let value = self.text(row, column);
        Error::Input(format!("{}: line {line}: {column} {rule}: {value:?}", self.path))
    }
}

/// Reads the runs that are done and their values.
///
/// # Errors
/// A table is missing, or is none; with its line.
pub fn read(files: &dyn Files) -> Result<Results, Error> {
    let mut results = Results::default();
    let runs = Read::new(files, RUNS)?;
    let mut index = HashMap::new();
    for row in &runs.rows {
        if runs.text(row, "status") != "done" {
            continue;
        }
        let loads = match runs.text(row, "basis") {
            "forces" => Loads::Forces,
            "vehicles" => Loads::Vehicles,
            _ => return Err(runs.wrong(row, "basis", "must be forces or vehicles")),
        };
        let rail = match runs.text(row, "rail") {
            "smooth" => Rail::Smooth,
            "rough" => Rail::Rough,
            _ => return Err(runs.wrong(row, "rail", "must be smooth or rough")),
        };
        let text = |column| runs.text(row, column).to_string();
        index.insert(text("run_id"), results.runs.len());
        results.runs.push(Run {
            run_id: text("run_id"),
            train: text("train"),
            speed_km_h: runs.number(row, "speed_km_h")?,
            variant: text("variant"),
            seed: text("seed"),
            basis: Basis { loads, rail },
            refined: runs.text(row, "refined") == "true",
        });
    }
    let peaks = Read::new(files, PEAKS)?;
    for row in &peaks.rows {
        let id = peaks.text(row, "run_id");
        let Some(at) = index.get(id) else { continue };
        let text = |column| peaks.text(row, column).to_string();
        let kind = PlaceKind::parse(peaks.text(row, "place_kind"));
        let statistic = Statistic::parse(peaks.text(row, "statistic"));
        let value: Option<f64> = peaks.number(row, "value")?;
        results.rows.push((
            *at,
            Peak {
                quantity: text("quantity").into(),
                place_kind: kind.ok_or_else(|| peaks.wrong(row, "place_kind", "is not known"))?,
                place: text("place").into(),
                x: peaks.number(row, "x_m")?,
                filter: text("filter").into(),
                statistic: statistic.ok_or_else(|| peaks.wrong(row, "statistic", "is not known"))?,
                value: value.filter(|v| v.is_finite()).ok_or_else(|| peaks.wrong(row, "value", "must be a number"))?,
                unit: text("unit").into(),
                time: peaks.number(row, "time_s")?,
                static_value: peaks.number(row, "static_value")?,
            },
        ));
    }
    Ok(results)
}
