//! `results.h5`: the tables as arrays, for h5py, MATLAB and Julia.
//!
//! ```text
//! /runs/<column>[run]                                the columns of runs.csv
//! /peaks/<quantity>/<filter>/<statistic>[run]        the greatest over all places; NaN where a run has none
//! /envelope/<quantity>/<filter>/min, max[run, x]     with x beside them, m; NaN where a run has none
//! /history/<run_id>/<name>[time]                     with time beside them, of the runs whose histories were kept
//! ```
//!
//! Run i is row i of `runs.csv`. Rows are appended in blocks, so that the memory does not grow with the number of runs. Points
//! of the deck that differ between runs get an array each: `min`, `min-2`, …

use std::collections::BTreeMap;
use std::path::Path;

use rust_hdf5::types::VarLenUnicode;
use rust_hdf5::{H5Dataset, H5File, H5Group, Hdf5Error};

use crate::error::Error;
use crate::history::History;
use crate::journal::Journal;
use crate::plan::{Plan, Run};
use crate::tables::{self, Named};

/// Name of the file.
pub const FILE: &str = "results.h5";
/// Rows of a block.
const BLOCK: usize = 256;
/// Level of deflate: more costs time and gains little.
const LEVEL: u32 = 4;
const TEXTS: [&str; 10] = ["run_id", "way", "train", "variant", "seed", "basis", "rail", "refined", "status", "error"];
const NUMBERS: [(&str, &str); 4] = [("speed_km_h", "km/h"), ("speed_m_s", "m/s"), ("step_s", "s"), ("modes", "1")];

/// Writes the runs that the journal has, in their order.
///
/// # Errors
/// The journal cannot be read, or the file cannot be written.
pub fn write(folder: &Path, plan: &Plan, runs: &[Run], journal: &Journal, own_is_smooth: bool) -> Result<(), Error> {
    let path = folder.join(FILE);
    let part = folder.join(format!("{FILE}.part"));
    let failed = |error: Hdf5Error| Error::io(&path)(std::io::Error::other(error.to_string()));
    let mut writer = Writer::create(&part, plan).map_err(failed)?;
    for run in runs {
        let Some(record) = journal.read(&run.id)? else { continue };
        let named = Named::of(plan, run);
        let load = &plan.trains[run.train].load;
        let status = if record.error.is_some() { "failed" } else { "done" };
        let texts = [
            run.id.clone(),
            plan.way.to_string(),
            named.train,
            named.variant,
            named.seed,
            tables::basis(load).into(),
            tables::rail(load, run.rail, own_is_smooth).into(),
            run.refined.to_string(),
            status.into(),
            record.error.clone().unwrap_or_default(),
        ];
        let numbers = [run.speed_km_h, run.speed(), record.step, record.modes.map(|modes| modes as f64)];
        writer.run(texts, numbers).map_err(failed)?;
        for peak in &record.peaks {
            let key = format!("peaks/{}/{}/{}", peak.quantity, peak.filter, peak.statistic);
            writer.peak(&key, peak.value, &peak.unit).map_err(failed)?;
        }
        for envelope in &record.envelopes {
            let key = format!("envelope/{}/{}", envelope.quantity, envelope.filter);
            writer.envelope(&key, &envelope.x, [&envelope.min, &envelope.max], &envelope.unit).map_err(failed)?;
        }
        writer.end_row().map_err(failed)?;
    }
    for run in runs {
        if let Some(history) = History::read(folder, &run.id)? {
            writer.history(&run.id, &history).map_err(failed)?;
        }
    }
    writer.finish().map_err(failed)?;
    std::fs::rename(&part, &path).map_err(Error::io(&path))
}

/// An array that grows by rows of `width`, with NaN for the runs that have none.
struct Column {
    dataset: H5Dataset,
    width: usize,
    rows: Vec<f64>,
    /// Rows that are in the file.
    written: usize,
}

impl Column {
    fn fill(&mut self, rows: usize) {
        let have = self.written * self.width + self.rows.len();
        self.rows.resize(self.rows.len() + (rows * self.width).saturating_sub(have), f64::NAN);
    }

    fn flush(&mut self) -> Result<(), Hdf5Error> {
        if !self.rows.is_empty() {
            self.dataset.append(&self.rows)?;
            self.written += self.rows.len() / self.width;
            self.rows.clear();
        }
        Ok(())
    }
}

/// Abscissae of a set of points, and the arrays of their least and greatest values.
type OfPoints = (Vec<f64>, [Column; 2]);

struct Writer {
    file: H5File,
    runs: H5Group,
    texts: Vec<Vec<String>>,
    numbers: Vec<Column>,
    peaks: BTreeMap<String, Column>,
    /// By key; every set of points has its two arrays.
    envelopes: BTreeMap<String, Vec<OfPoints>>,
    groups: BTreeMap<String, H5Group>,
    /// Runs so far.
    count: usize,
}

impl Writer {
    fn create(path: &Path, plan: &Plan) -> Result<Self, Hdf5Error> {
        let file = H5File::create(path)?;
        file.set_attr_string("program", &format!("ttb {}", plan.version))?;
        file.set_attr_string("scenario_sha256", &plan.scenario_sha256)?;
        let runs = file.create_group("runs")?;
        for name in TEXTS {
            runs.create_appendable_vlen_dataset(name, BLOCK, None)?;
        }
        let number = |(name, unit): (&str, &str)| column(&runs, name, 1, unit);
        let numbers = NUMBERS.into_iter().map(number).collect::<Result<_, _>>()?;
        let (texts, count) = (vec![Vec::new(); TEXTS.len()], 0);
        let (peaks, envelopes, groups) = (BTreeMap::new(), BTreeMap::new(), BTreeMap::new());
        Ok(Self { file, runs, texts, numbers, peaks, envelopes, groups, count })
    }

    fn run(&mut self, texts: [String; TEXTS.len()], numbers: [Option<f64>; NUMBERS.len()]) -> Result<(), Hdf5Error> {
        self.texts.iter_mut().zip(texts).for_each(|(column, text)| column.push(text));
        self.numbers.iter_mut().zip(numbers).for_each(|(column, x)| column.rows.push(x.unwrap_or(f64::NAN)));
        Ok(())
    }

    fn peak(&mut self, key: &str, value: f64, unit: &str) -> Result<(), Hdf5Error> {
        if !self.peaks.contains_key(key) {
            let (group, name) = self.place(key)?;
            let new = column(group, name, 1, unit)?;
            self.peaks.insert(key.into(), new);
        }
        let count = self.count;
        if let Some(column) = self.peaks.get_mut(key) {
            column.fill(count + 1);
            if let Some(last) = column.rows.last_mut()
                && (last.is_nan() || *last < value)
            {
                *last = value;
            }
        }
        Ok(())
    }

    fn envelope(&mut self, key: &str, x: &[f64], ends: [&[f64]; 2], unit: &str) -> Result<(), Hdf5Error> {
        let known = self.envelopes.get(key).map_or(0, Vec::len);
        let at = self.envelopes.get(key).and_then(|all| all.iter().position(|(of, _)| of == x));
        let at = match at {
            Some(at) => at,
            None => {
                let path = format!("{key}/min");
                let (group, _) = self.place(&path)?;
                let name = |name: &str| if known == 0 { name.to_string() } else { format!("{name}-{}", known + 1) };
                let places = group.new_dataset::<f64>().shape([x.len()]).create(&name("x"))?;
                places.write_raw(x)?;
                unit_of(&places, "m")?;
                let pair = [column(group, &name("min"), x.len(), unit)?, column(group, &name("max"), x.len(), unit)?];
                self.envelopes.entry(key.into()).or_default().push((x.to_vec(), pair));
                known
            }
        };
        let count = self.count;
        if let Some((_, pair)) = self.envelopes.get_mut(key).and_then(|all| all.get_mut(at)) {
            for (column, values) in pair.iter_mut().zip(ends) {
                column.fill(count);
                column.rows.extend_from_slice(values);
            }
        }
        Ok(())
    }

    fn end_row(&mut self) -> Result<(), Hdf5Error> {
        self.count += 1;
        if self.count.is_multiple_of(BLOCK) { self.flush() } else { Ok(()) }
    }

    fn flush(&mut self) -> Result<(), Hdf5Error> {
        for (name, texts) in TEXTS.into_iter().zip(&mut self.texts) {
            if !texts.is_empty() {
                self.runs.append_vlen_strings(name, &texts.iter().map(String::as_str).collect::<Vec<_>>())?;
                texts.clear();
            }
        }
        let count = self.count;
        let pairs = self.envelopes.values_mut().flatten().flat_map(|(_, pair)| pair);
        for column in self.numbers.iter_mut().chain(self.peaks.values_mut()).chain(pairs) {
            column.fill(count);
            column.flush()?;
        }
        Ok(())
    }

    fn history(&mut self, id: &str, history: &History) -> Result<(), Hdf5Error> {
        for (name, unit, values) in history.columns() {
            let path = format!("history/{id}/{name}");
            let (group, name) = self.place(&path)?;
            let chunk = values.len().clamp(1, 1 << 14);
            let dataset =
                group.new_dataset::<f64>().shape([values.len()]).chunk(&[chunk]).deflate(LEVEL).create(name)?;
            dataset.write_raw(values)?;
            unit_of(&dataset, unit)?;
        }
        Ok(())
    }

    fn finish(mut self) -> Result<(), Hdf5Error> {
        self.flush()?;
        self.file.close()
    }

    /// The group of a path, made with those above it, and the last name.
    fn place<'p>(&mut self, path: &'p str) -> Result<(&H5Group, &'p str), Hdf5Error> {
        let (folder, name) = path.rsplit_once('/').unwrap_or(("", path));
        let ends = folder.match_indices('/').map(|(at, _)| at).chain([folder.len()]);
        for end in ends {
            let at = &folder[..end];
            if !self.groups.contains_key(at) {
                let made = match at.rsplit_once('/') {
                    Some((above, last)) => self.groups.get(above).map(|group| group.create_group(last)),
                    None => Some(self.file.create_group(at)),
                };
                let made = made.ok_or_else(|| Hdf5Error::InvalidState(format!("{path} has no folder")))?;
                self.groups.insert(at.into(), made?);
            }
        }
        let group = self.groups.get(folder).ok_or_else(|| Hdf5Error::InvalidState(format!("{path} has no folder")))?;
        Ok((group, name))
    }
}

fn column(group: &H5Group, name: &str, width: usize, unit: &str) -> Result<Column, Hdf5Error> {
    let new = group.new_dataset::<f64>();
    let new = match width {
        1 => new.shape([0usize]).chunk(&[BLOCK]).max_shape(&[None]),
        _ => new.shape([0usize, width]).chunk(&[BLOCK / 4, width]).max_shape(&[None, Some(width)]),
    };
    let dataset = new.deflate(LEVEL).create(name)?;
    unit_of(&dataset, unit)?;
    Ok(Column { dataset, width, rows: Vec::new(), written: 0 })
}

fn unit_of(dataset: &H5Dataset, unit: &str) -> Result<(), Hdf5Error> {
    dataset.new_attr::<VarLenUnicode>().shape(()).create("unit")?.write_string(unit)
}
