//! Tables made from the journal, run by run in the order of the plan; no run is held longer than it is written.
//!
//! ```text
//! runs.csv       one row a run: what it was, its step, whether it failed
//! peaks.csv      tidy: one reduced value a row
//! envelope.csv   tidy: extremes of a quantity at a point of the deck a row
//! timings.csv    seconds a run; not the same from one time to the next
//! ```

use std::fs::{self, File};
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};

use ttb_assessment::Peak;

use crate::error::Error;
use crate::plan::{Load, Plan, Rail, Run};
use crate::record::{Record, Records};

/// Names of the tables that are the same however the runs were computed.
pub const TABLES: [&str; 3] = ["runs.csv", "peaks.csv", "envelope.csv"];
/// Name of the table of times.
pub const TIMINGS: &str = "timings.csv";

/// Columns of runs.csv.
pub const RUNS: [&str; 14] = [
    "run_id",
    "way",
    "train",
    "speed_km_h",
    "speed_m_s",
    "variant",
    "seed",
    "basis",
    "rail",
    "refined",
    "step_s",
    "modes",
    "status",
    "error",
];
/// Columns of peaks.csv.
pub const PEAKS: [&str; 15] = [
    "run_id",
    "train",
    "speed_km_h",
    "variant",
    "seed",
    "quantity",
    "place_kind",
    "place",
    "x_m",
    "filter",
    "statistic",
    "value",
    "unit",
    "time_s",
    "static_value",
];
/// Columns of envelope.csv.
pub const ENVELOPE: [&str; 6] = ["run_id", "quantity", "filter", "x_m", "min", "max"];

/// What a run stands on: loads or vehicles.
pub fn basis(load: &Load) -> &'static str {
    match load {
        Load::Axles(_) => "forces",
        Load::Cars(_) | Load::Scenario => "vehicles",
    }
}

/// Whether a run's rail is smooth; loads run over a smooth one, and of the scenario's own rail `own_is_smooth` tells.
pub fn rail(load: &Load, rail: Rail, own_is_smooth: bool) -> &'static str {
    let smooth = match rail {
        Rail::Scenario => own_is_smooth,
        Rail::Smooth => true,
        Rail::Seed(_) => false,
    };
    if smooth || matches!(load, Load::Axles(_)) { "smooth" } else { "rough" }
}

/// Writes all tables of these runs into the campaign's folder, whole or not at all. Runs that are missing are left out.
/// `own_is_smooth`: the scenario's own rail is.
///
/// # Errors
/// A file cannot be read or written.
pub fn write(
    folder: &Path,
    plan: &Plan,
    runs: &[Run],
    records: &dyn Records,
    own_is_smooth: bool,
) -> Result<(), Error> {
    let mut paths = Vec::new();
    for name in TABLES.into_iter().chain([TIMINGS]) {
        let (path, part) = (folder.join(name), folder.join(format!("{name}.part")));
        paths.push((File::create(&part).map_err(Error::io(&part))?, path, part));
    }
    let files = paths.iter().map(|(file, path, _)| Table::new(path, BufWriter::new(file)));
    let mut tables: Vec<_> = files.collect();
    fill(&mut tables, plan, runs, records, own_is_smooth)?;
    tables.into_iter().try_for_each(|table| table.finish().map(drop))?;
    paths.iter().try_for_each(|(_, path, part)| fs::rename(part, path).map_err(Error::io(path)))
}

/// The same tables as texts, in the order of [`TABLES`].
///
/// # Errors
/// A record cannot be read.
pub fn texts(plan: &Plan, runs: &[Run], records: &dyn Records, own_is_smooth: bool) -> Result<[Vec<u8>; 3], Error> {
    let mut tables: Vec<_> =
        TABLES.into_iter().chain([TIMINGS]).map(|name| Table::new(Path::new(name), Vec::new())).collect();
    fill(&mut tables, plan, runs, records, own_is_smooth)?;
    let mut texts = [const { Vec::new() }; 3];
    for (text, table) in texts.iter_mut().zip(tables) {
        *text = table.finish()?;
    }
    Ok(texts)
}

/// Headers and rows of the tables and of the times.
fn fill<W: Write>(
    tables: &mut [Table<W>],
    plan: &Plan,
    runs: &[Run],
    records: &dyn Records,
    own_is_smooth: bool,
) -> Result<(), Error> {
    let [of_runs, of_peaks, of_envelopes, of_times] = tables else { return Ok(()) };
    of_runs.row(&RUNS)?;
    of_peaks.row(&PEAKS)?;
    of_envelopes.row(&ENVELOPE)?;
    of_times.row(&["run_id", "seconds"])?;
    for run in runs {
        let Some(record) = records.of(&run.id)? else { continue };
        let named = Named::of(plan, run);
        of_runs.row(&run_row(plan, run, &named, &record, own_is_smooth))?;
        for peak in &record.peaks {
            of_peaks.row(&peak_row(&run.id, &named, peak))?;
        }
        for envelope in &record.envelopes {
            for ((x, min), max) in envelope.x.iter().zip(&envelope.min).zip(&envelope.max) {
                let numbers = [x, min, max].map(f64::to_string);
                let [x, min, max] = &numbers;
                of_envelopes.row(&[run.id.as_str(), &envelope.quantity, &envelope.filter, x, min, max])?;
            }
        }
        of_times.row(&[run.id.as_str(), &format!("{:.6}", record.seconds)])?;
    }
    Ok(())
}

/// How a run is named in tables.
pub struct Named {
    /// Train.
    pub train: String,
    /// km/h, empty for the scenario's own.
    pub speed_km_h: String,
    /// Variant.
    pub variant: String,
    /// Seed, `smooth`, or empty for the scenario's own irregularity.
    pub seed: String,
}

impl Named {
    /// Of a run.
    pub fn of(plan: &Plan, run: &Run) -> Self {
        Self {
            train: plan.trains[run.train].name.clone(),
            speed_km_h: optional(run.speed_km_h),
            variant: plan.variants[run.variant].name.clone(),
            seed: run.rail.to_string(),
        }
    }
}

fn run_row(plan: &Plan, run: &Run, named: &Named, record: &Record, own_is_smooth: bool) -> Vec<String> {
    let load = &plan.trains[run.train].load;
    vec![
        run.id.clone(),
        plan.way.to_string(),
        named.train.clone(),
        named.speed_km_h.clone(),
        optional(run.speed()),
        named.variant.clone(),
        named.seed.clone(),
        basis(load).into(),
        rail(load, run.rail, own_is_smooth).into(),
        run.refined.to_string(),
        optional(record.step),
        record.modes.map_or_else(String::new, |modes| modes.to_string()),
        if record.error.is_some() { "failed" } else { "done" }.into(),
        record.error.clone().unwrap_or_default(),
    ]
}

/// A row of peaks.csv, in the order of [`PEAKS`].
pub fn peak_row(id: &str, named: &Named, peak: &Peak) -> Vec<String> {
    vec![
        id.into(),
        named.train.clone(),
        named.speed_km_h.clone(),
        named.variant.clone(),
        named.seed.clone(),
        peak.quantity.to_string(),
        peak.place_kind.to_string(),
        peak.place.to_string(),
        optional(peak.x),
        peak.filter.to_string(),
        peak.statistic.to_string(),
        peak.value.to_string(),
        peak.unit.to_string(),
        optional(peak.time),
        optional(peak.static_value),
    ]
}

/// A number, or an empty field.
pub fn optional(value: Option<f64>) -> String {
    value.map_or_else(String::new, |value| value.to_string())
}

/// A table as it is written.
struct Table<W: Write> {
    path: PathBuf,
    rows: csv::Writer<W>,
}

impl<W: Write> Table<W> {
    fn new(path: &Path, into: W) -> Self {
        Self { path: path.into(), rows: csv::Writer::from_writer(into) }
    }

    fn row<T: AsRef<[u8]>>(&mut self, row: &[T]) -> Result<(), Error> {
        let written = self.rows.write_record(row);
        written.map_err(std::io::Error::from).map_err(Error::io(&self.path))
    }

    /// What it was written into, all of it there.
    fn finish(self) -> Result<W, Error> {
        let failed = Error::io(&self.path);
        match self.rows.into_inner() {
            Ok(mut inner) => inner.flush().map_err(failed).map(|()| inner),
            Err(error) => Err(failed(error.into_error())),
        }
    }
}
