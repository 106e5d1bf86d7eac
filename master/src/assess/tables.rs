//! runs.csv and peaks.csv: the tables of runs and of their reduced values, as sweeps write them too.

use std::path::Path;

use ttb_assessment::{Basis, Loads, Peak, Rail, Run};
use ttb_campaign::record::Envelope;
use ttb_campaign::tables::{self, Named, optional, peak_row};
use ttb_dossier::tables::{PEAKS, RUNS};

use crate::error::Error;
use crate::files;

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

/// Writes extremes along the deck of one run.
pub fn write_envelopes(folder: &Path, run_id: &str, envelopes: &[Envelope]) -> Result<(), Error> {
    let rows = envelopes.iter().flat_map(|one| {
        let values = one.x.iter().zip(&one.min).zip(&one.max);
        values.map(|((x, min), max)| {
            let numbers = [x, min, max].map(f64::to_string);
            [run_id, &one.quantity, &one.filter].map(str::to_string).into_iter().chain(numbers).collect()
        })
    });
    table(&folder.join(tables::TABLES[2]), &tables::ENVELOPE, rows)
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
