//! The assessment of one run: its tables beside its results, so that a report of its folder can be made at any time.

use std::path::Path;

use ttb_assessment::peak::quantity::DECK_ACCELERATION;
use ttb_assessment::{Basis, Criteria, Facts, Filter, Histories, Loads, Rail, Run, reduce};
use ttb_campaign::coupled::rows::envelopes;
use ttb_dossier::folder::{Assessment, FILE};
use ttb_dossier::statics;
use ttb_scenario::Checked;
use ttb_scenario::spec::Profile;
use ttb_scenario::types::{CarChoice, Speed};

use super::tables;
use crate::error::Error;
use crate::files;

/// What a run is for its tables.
pub struct About<'a> {
    /// Hash of all that decides its results.
    pub hash: &'a str,
    /// For people.
    pub title: &'a str,
    /// Step, s.
    pub step: f64,
    /// The scenario; none of a system structure.
    pub checked: Option<&'a Checked>,
}

/// Writes the tables of a run into its folder.
pub fn write(
    folder: &Path,
    about: &About,
    histories: &Histories,
    criteria: &Criteria,
    facts: &Facts,
) -> Result<(), Error> {
    let mut reduced = reduce(histories, criteria, facts);
    let run = run(about);
    for peak in &mut reduced.peaks {
        peak.time = peak.time.map(written);
        peak.x = peak.x.map(written);
    }
    // A foreign bridge has no static answer here: its spans are not known either.
    if let Some(checked) = about.checked.filter(|_| facts.spans_m.is_some()) {
        statics::add_own(checked, &mut reduced.peaks);
    }
    tables::write(folder, &run, about.step, &reduced.peaks)?;
    if !histories.deck.is_empty() {
        let points = histories.points.iter().chain(&histories.deck).cloned().collect();
        let along = Histories { time: histories.time.clone(), points, ..Histories::default() };
        let judged = criteria.filters(DECK_ACCELERATION, facts).first().copied().unwrap_or(Filter::Raw);
        let mut envelopes = envelopes(&along, &judged);
        envelopes.iter_mut().flat_map(|one| &mut one.x).for_each(|x| *x = written(*x));
        tables::write_envelopes(folder, &run.run_id, &envelopes)?;
    }
    let assessment = Assessment {
        title: about.title.into(),
        facts: facts.clone(),
        limits: criteria.files.clone(),
        missing: reduced.missing,
        losses: reduced.losses,
        warnings: Vec::new(),
    };
    files::write_json(&folder.join(FILE), &assessment)
}

/// The shortest form of a time n h or of a place n d: 1.533, where the product of binary numbers is 1.5330000000000001.
fn written(value: f64) -> f64 {
    format!("{value:.12e}").parse().unwrap_or(value)
}

fn run(about: &About) -> Run {
    let run_id = about.hash.chars().take(16).collect();
    let Some(checked) = about.checked else {
        let basis = Basis { loads: Loads::Vehicles, rail: Rail::Rough };
        let (train, speed_km_h, variant, seed) = ("of the system".into(), None, String::new(), String::new());
        return Run { run_id, train, speed_km_h, variant, seed, basis, refined: false };
    };
    let spec = &checked.train_track;
    let smooth = matches!(spec.irregularity, Profile::None) || spec.irregularity_scale == 0.0;
    let seed = match spec.irregularity {
        Profile::Spectrum { seed, .. } => seed.to_string(),
        _ if smooth => "smooth".into(),
        _ => String::new(),
    };
    let loads = if checked.scenario.train.forces.is_some() { Loads::Forces } else { Loads::Vehicles };
    // Nothing under forces alone feels the rail.
    let smooth = smooth || loads == Loads::Forces;
    let basis = Basis { loads, rail: if smooth { Rail::Smooth } else { Rail::Rough } };
    Run {
        run_id,
        train: train(checked),
        speed_km_h: speed(checked),
        variant: String::new(),
        seed,
        basis,
        refined: false,
    }
}

/// Constant speed, km/h, as the scenario has it.
fn speed(checked: &Checked) -> Option<f64> {
    match &checked.scenario.train.speed {
        Speed::KmH(v) => Some(*v),
        Speed::MS(v) => Some(v * 3.6),
        Speed::Profile(points) => {
            points.windows(2).all(|p| p[0][1] == p[1][1]).then(|| points.first().map(|p| p[1] * 3.6))?
        }
    }
}

/// The names of its cars, equal ones counted.
fn train(checked: &Checked) -> String {
    let train = &checked.scenario.train;
    if train.forces.is_some() {
        return format!("{} forces", checked.train_track.axle_count());
    }
    let named = |name: &String, word: &str| if name.is_empty() { word.to_string() } else { name.clone() };
    let names = train.cars.iter().flatten().map(|car| match car {
        CarChoice::Bundled(name) => name.clone(),
        CarChoice::Data(car) => named(&car.name, "car"),
        CarChoice::Vehicle(vehicle) => named(&vehicle.name, "vehicle"),
    });
    let mut counted: Vec<(String, usize)> = Vec::new();
    for name in names {
        match counted.last_mut() {
            Some((last, count)) if *last == name => *count += 1,
            _ => counted.push((name, 1)),
        }
    }
    let parts = counted.into_iter().map(|(name, count)| if count > 1 { format!("{count} × {name}") } else { name });
    parts.collect::<Vec<_>>().join(" + ")
}
