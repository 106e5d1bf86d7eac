//! runs.csv and peaks.csv: the tables of runs and of their reduced values, as sweeps write them too.

use std::collections::HashMap;
use std::path::Path;
use std::str::FromStr;

use ttb_assessment::{Basis, Loads, Peak, PlaceKind, Rail, Results, Run, Statistic};
use ttb_campaign::tables::{self, Named, optional, peak_row};

use crate::error::Error;
use crate::files;

/// Name of the table of runs.
pub const RUNS: &str = "runs.csv";
/// Name of the table of reduced values.
pub const PEAKS: &str = "peaks.csv";

/// Writes both tables of one coupled run with steps of `step` s.
pub fn write(folder: &Path, run: &Run, step: f64, peaks: &[Peak]) -> Result<(), Error> {
    let (loads, rail) = words(run.basis);
    let speed = run.speed_km_h.map(|v| v / 3.6);
    let row = [
        run.run_id.clone(),
        "coupled".into(),
        run.train.clone(),
        optional(run.speed_km_h),
        optional(speed),
        run.variant.clone(),
        run.seed.clone(),
        loads.into(),
        rail.into(),
        run.refined.to_string(),
        step.to_string(),
        String::new(),
        "done".into(),
        String::new(),
    ];
    table(&folder.join(RUNS), &tables::RUNS, std::iter::once(row.to_vec()))?;
    let named = Named {
        train: run.train.clone(),
        speed_km_h: optional(run.speed_km_h),
        variant: run.variant.clone(),
        seed: run.seed.clone(),
    };
    let rows = peaks.iter().map(|peak| peak_row(&run.run_id, &named, peak));
    table(&folder.join(PEAKS), &tables::PEAKS, rows)
}

fn words(basis: Basis) -> (&'static str, &'static str) {
    let loads = match basis.loads {
        Loads::Forces => "forces",
        Loads::Vehicles => "vehicles",
    };
    let rail = match basis.rail {
        Rail::Smooth => "smooth",
        Rail::Rough => "rough",
    };
    (loads, rail)
}

fn table(path: &Path, header: &[&str], rows: impl Iterator<Item = Vec<String>>) -> Result<(), Error> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    let failed = |e: csv::Error| Error::io(path)(std::io::Error::other(e.to_string()));
    writer.write_record(header).map_err(failed)?;
    for row in rows {
        writer.write_record(&row).map_err(failed)?;
    }
    let text = writer.into_inner().map_err(|e| Error::io(path)(std::io::Error::other(e.to_string())))?;
    files::write(path, &text)
}

/// A table that was read: rows by the names of their columns.
struct Read {
    path: String,
    columns: HashMap<String, usize>,
    rows: Vec<csv::StringRecord>,
}

impl Read {
    fn new(path: &Path) -> Result<Self, Error> {
        let wrong = |e: csv::Error| match e.into_kind() {
            csv::ErrorKind::Io(error) => Error::io(path)(error),
            other => Error::Input(format!("{}: {other:?}", path.display())),
        };
        let mut reader = csv::Reader::from_path(path).map_err(wrong)?;
        let headers = reader.headers().map_err(wrong)?;
        let columns = headers.iter().enumerate().map(|(at, name)| (name.to_string(), at)).collect();
        let rows = reader.records().collect::<Result<Vec<_>, _>>().map_err(wrong)?;
        Ok(Self { path: path.display().to_string(), columns, rows })
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
pub fn read(folder: &Path) -> Result<Results, Error> {
    let mut results = Results::default();
    let runs = Read::new(&folder.join(RUNS))?;
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
    let peaks = Read::new(&folder.join(PEAKS))?;
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
