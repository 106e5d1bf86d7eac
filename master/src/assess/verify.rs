//! Governing runs with vehicles once more, in this process: at half the step, and over a deck that does not move.
//!
//! ```text
//! step halved    value(h) → value(h/2) of every criterion that the run governs
//! without        the same train on the same rail, stiffness of the bridge · 10⁸: the deck moves by 10⁻⁸ of what it did
//! ```

use std::path::Path;

use ttb_assessment::peak::quantity::BODY_ACCELERATION;
use ttb_assessment::{Criteria, Loads, Peak, PlaceKind, Statistic, Status, Verdict, Verdicts, reduce};
use ttb_campaign::expand;
use ttb_contract::Model;
use ttb_dossier::Opened;
use ttb_dossier::verified::{Beside, FILE, Line, Verified};
use ttb_scenario::Checked;
use ttb_scenario::step::Steps;
use ttb_session::{Case, Column, Plan};

use super::watch::Watch;
use crate::error::Error;
use crate::files;
use crate::prepare::fmus::prepared;
use crate::results::scene::Scene;

/// Factor on the stiffness of a deck that does not move.
const RIGID: f64 = 1e8;

/// Computes the lines of the run with vehicles that governs most, and writes them.
pub fn write(folder: &Path, opened: &Opened, criteria: &Criteria, verdicts: &Verdicts) -> Result<(), Error> {
    let of_vehicles = |verdict: &&Verdict| {
        let basis = verdict.basis.is_some_and(|basis| basis.loads == Loads::Vehicles);
        basis && verdict.status != Status::NotJudged && verdict.run_id.is_some()
    };
    let Some(governing) = verdicts.verdicts.iter().find(of_vehicles) else {
        return Err(Error::Input(
            "--verify: there is no run with vehicles; a sweep of axle loads verifies itself".into(),
        ));
    };
    let run_id = governing.run_id.clone().unwrap_or_default();
    let checked = scenario(folder, opened, &run_id)?;
    let steps = checked.steps();
    let facts = &verdicts.facts;
    let values = |checked: &Checked, stiffness: f64| -> Result<Vec<Peak>, Error> {
        reduced(checked, stiffness, criteria, facts)
    };
    let with = values(&checked, 1.0)?;
    let mut finer = checked.clone();
    finer.set_steps(Steps { step: 0.5 * steps.step, ..steps });
    let halved = values(&finer, 1.0)?;
    let without = values(&checked, RIGID)?;
    let of_run = verdicts.verdicts.iter().filter(|verdict| verdict.run_id.as_ref() == Some(&run_id));
    let changes = of_run.filter_map(|verdict| {
        let (before, after) = (worst(&with, verdict)?, worst(&halved, verdict)?);
        let what = format!("step {} ms instead of {} ms", 500.0 * steps.step, 1e3 * steps.step);
        let (criterion, filter, unit) = (verdict.criterion.clone(), verdict.filter.clone(), verdict.unit.clone());
        Some(Line { what, criterion, filter, before, after, unit })
    });
    let (changes, comfort) = (changes.collect(), beside(&with, &without));
    let verified = Verified { run_id, changes, comfort };
    files::write_json(&folder.join(FILE), &verified)
}

/// The scenario of a run, with its steps.
fn scenario(folder: &Path, opened: &Opened, run_id: &str) -> Result<Checked, Error> {
    if opened.over_fmu {
        return Err(Error::Input("--verify: the bridge is a foreign FMU, which no run in this process has".into()));
    }
    if opened.plan.is_some() {
        let plan = ttb_campaign::Folder::read(folder)?.plan;
        let source = expand::source(&folder.join(&plan.scenario), plan.set.iter().cloned())?;
        let runs = plan.runs();
        let run = runs.iter().find(|run| run.id == run_id);
        let run = run
            .ok_or_else(|| Error::Input(format!("--verify: run {run_id} is none of the plan's own: it was refined")))?;
        return source.of_run(&plan, run).map_err(Error::Scenario);
    }
    opened.checked.clone().ok_or_else(|| Error::Input("--verify: the folder has no scenario".into()))
}

/// A run in this process, reduced.
fn reduced(
    checked: &Checked,
    stiffness: f64,
    criteria: &Criteria,
    facts: &ttb_assessment::Facts,
) -> Result<Vec<Peak>, Error> {
    let wrong = |e: ttb_contract::ModelError| Error::Input(e.to_string());
    let mut sides = prepared(checked)?.sides(checked).map_err(wrong)?;
    if stiffness != 1.0 {
        let bridge = sides.bridge.instance();
        let place = bridge.model().interface().find("stiffness_factor");
        let place = place.ok_or_else(|| Error::Input("the bridge has no parameter stiffness_factor".into()))?;
        bridge.set(&[place as u32], &[stiffness]).map_err(wrong)?;
    }
    let case = Case::of(checked);
    let mut watch = Watch::of(Some(checked));
    let deck = watch.supports();
    let wanted = |column: &Column| column.has_extremes() || watch_needs(column) || deck.contains(column);
    let plan = Plan { axis: case.axis(), wanted: &wanted, clock: &|| 0.0 };
    sides.run(&plan, &mut [&mut watch])?;
    let histories = watch.histories(Some(checked), &Scene::new(checked));
    Ok(reduce(&histories, criteria, facts).peaks)
}

/// Positions have no extremes, and filters over the way need them.
fn watch_needs(column: &Column) -> bool {
    column.is(ttb_session::column::Kind::Wheel, &ttb_session::Quantity::Position)
}

/// The value that a verdict would have.
fn worst(peaks: &[Peak], verdict: &Verdict) -> Option<f64> {
    let is = |peak: &&Peak| {
        peak.quantity == verdict.quantity && peak.statistic.name() == verdict.statistic && peak.filter == verdict.filter
    };
    let values = peaks.iter().filter(is).map(|peak| peak.value);
    values.reduce(if verdict.statistic == "min" { f64::min } else { f64::max })
}

/// Of every filter and statistic of car bodies the worst over the bridge, and the same place without it.
fn beside(with: &[Peak], without: &[Peak]) -> Vec<Beside> {
    let statistics = [Statistic::AbsMax, Statistic::Rms, Statistic::Rms1sMax, Statistic::Rms5sMax];
    let of_cars = |peak: &&Peak| {
        peak.place_kind == PlaceKind::Car
            && (peak.quantity != BODY_ACCELERATION || statistics.contains(&peak.statistic))
    };
    let mut worst: Vec<&Peak> = Vec::new();
    for peak in with.iter().filter(of_cars) {
        let same = |kept: &&mut &Peak| {
            kept.quantity == peak.quantity && kept.filter == peak.filter && kept.statistic == peak.statistic
        };
        match worst.iter_mut().find(same) {
            Some(kept) if peak.value > kept.value => *kept = peak,
            Some(_) => {}
            None => worst.push(peak),
        }
    }
    let line = |peak: &Peak| {
        let other = without.iter().find(|other| {
            (&other.quantity, &other.place, &other.filter, other.statistic)
                == (&peak.quantity, &peak.place, &peak.filter, peak.statistic)
        })?;
        Some(Beside {
            quantity: peak.quantity.to_string(),
            place: peak.place.to_string(),
            filter: peak.filter.to_string(),
            statistic: peak.statistic.to_string(),
            unit: peak.unit.to_string(),
            with: peak.value,
            without: other.value,
        })
    };
    worst.into_iter().filter_map(line).collect()
}
