//! How good the numbers are: the governing value behind other filters, by the other way, in other steps, with more modes.
//!
//! Each line is computed: of a sweep over modes while the page is made, of coupled runs by `ttb report --verify`, which leaves
//! its lines in the folder.

use serde_json::Value;
use ttb_assessment::{Filter, Verdict};
use ttb_passage::{Heading, ModalBridge, Passage, Settings};
use ttb_report::{Change, Comfort};
use ttb_scenario::spec::BridgeSpec;

use super::histories::filter;
use super::trains::force_train;
use crate::folder::Opened;
use crate::verified;

/// A value that was computed once more is the same up to this share: the tables have all its digits.
const SAME: f64 = 1e-6;

/// All lines.
pub fn changes(opened: &Opened, governing: Option<&Verdict>, modal: Option<&ModalBridge>) -> Vec<Change> {
    let Some((verdict, before)) = governing.and_then(|verdict| Some((verdict, verdict.value?))) else {
        return Vec::new();
    };
    let mut changes = of_filters(opened, verdict, before);
    changes.extend(of_modes(opened, verdict, before, modal).into_iter().flatten());
    changes.extend(of_ways(opened));
    if let Some(verified) = verified::read(opened) {
        changes.extend(verified.changes.iter().map(|line| Change {
            what: format!("{}, {}: {}", line.criterion, line.filter, line.what),
            before: line.before,
            after: line.after,
            unit: line.unit.clone(),
        }));
    }
    changes
}

/// What else can be computed.
pub fn more(opened: &Opened) -> String {
    let vehicles = opened.results.runs.iter().any(|run| run.basis.loads == ttb_assessment::Loads::Vehicles);
    if vehicles && verified::read(opened).is_none() {
        "`ttb report --verify` computes the governing run with vehicles once more at half the step and over a deck that does not \
         move, and adds its lines here."
            .into()
    } else {
        String::new()
    }
}

/// Comfort with and without the bridge.
pub fn comfort(opened: &Opened) -> Vec<Comfort> {
    let verified = verified::read(opened).map(|verified| verified.comfort).unwrap_or_default();
    let shown = |line: verified::Beside| Comfort {
        what: format!("{}, car {}", line.quantity, line.place),
        how: format!("{}, {}", line.filter, line.statistic),
        unit: line.unit,
        with: line.with,
        without: line.without,
    };
    verified.into_iter().map(shown).collect()
}

/// The same run behind its other filters.
fn of_filters(opened: &Opened, verdict: &Verdict, before: f64) -> Vec<Change> {
    let mut changes: Vec<Change> = Vec::new();
    for (run, peak) in &opened.results.rows {
        let same = peak.quantity == verdict.quantity
            && peak.statistic.name() == verdict.statistic
            && Some(&opened.results.runs[*run].run_id) == verdict.run_id.as_ref()
            && peak.filter != verdict.filter;
        if !same {
            continue;
        }
        let what = format!("filter {} instead of {}", peak.filter, verdict.filter);
        match changes.iter_mut().find(|change| change.what == what) {
            Some(change) => change.after = change.after.max(peak.value),
            None => changes.push(Change { what, before, after: peak.value, unit: verdict.unit.clone() }),
        }
    }
    changes
}

/// The governing passage of axle loads over modes: half the step, two modes more, the filter forwards only.
fn of_modes(opened: &Opened, verdict: &Verdict, before: f64, modal: Option<&ModalBridge>) -> Option<Vec<Change>> {
    let modal = modal.filter(|_| verdict.quantity == "deck.acceleration" && verdict.variant.is_none())?;
    let plan = opened.plan.as_ref().filter(|plan| plan["way"] == "modal")?;
    let mut trains = plan["trains"].as_array()?.iter().filter_map(force_train);
    let train = trains.find(|train| Some(&train.name) == verdict.train.as_ref())?;
    let speed = verdict.speed_km_h? / 3.6;
    let judged = filter(&verdict.filter)?;
    let value_from = |bridge: &ModalBridge, filter: &Filter, heading: Heading| -> Option<f64> {
        let passage = Passage::new(bridge, &train, heading, None);
        let histories = passage.histories(speed);
        let filtered = histories.accelerations(|h, signals| filter.apply_each(signals, 1.0 / h, speed * h)).ok()?;
        filtered.iter().map(|extreme| extreme.largest().0.abs()).reduce(f64::max)
    };
    // The direction in which the train ran is that which gives the value once more.
    let is_same = |heading: &Heading| {
        value_from(modal, &judged, *heading).is_some_and(|value| (value / before - 1.0).abs() < SAME)
    };
    let heading = [Heading::Forward, Heading::Backward].into_iter().find(is_same)?;
    let value = |bridge: &ModalBridge, filter: &Filter| value_from(bridge, filter, heading);
    let line =
        |what: String, after: Option<f64>| Some(Change { what, before, after: after?, unit: verdict.unit.clone() });
    let mut changes = Vec::new();
    changes.extend(line("step halved".into(), value(&modal.clone().in_steps(0.5), &judged)));
    let count = modal.modes().len();
    let spec = BridgeSpec { modes: Some(count + 2), ..opened.checked.as_ref()?.bridge.clone() };
    if let Ok(more) = ModalBridge::new(&spec, &Settings::default())
        && more.modes().len() > count
    {
        let what = format!("{} modes instead of {count}", more.modes().len());
        changes.extend(line(what, value(&more, &judged)));
    }
    if let Filter::Butterworth { order, cut_off_hz, .. } = judged {
        let causal = Filter::Butterworth { order, cut_off_hz, phase: ttb_assessment::Phase::Causal };
        changes.extend(line(format!("filter {} instead of {}", causal.label(), judged.label()), value(modal, &causal)));
    }
    Some(changes)
}

/// Governing runs of a sweep by the coupled way.
fn of_ways(opened: &Opened) -> Vec<Change> {
    let mut changes = Vec::new();
    let text = opened.files.text("coupled-check.json").ok().flatten();
    let read = text.and_then(|text| serde_json::from_str::<Value>(&text).ok());
    for one in read.as_ref().and_then(Value::as_array).into_iter().flatten() {
        let (Some(sweep), Some(coupled), Some(quantity)) =
            (one["sweep"].as_f64(), one["coupled"].as_f64(), one["quantity"].as_str())
        else {
            continue;
        };
        let unit = if quantity == "deck.displacement" { "m" } else { "m/s2" };
        let text = |key: &str| one[key].as_str().unwrap_or_default();
        let what = format!("{quantity}, {}, by the coupled way (run {})", text("filter"), text("run_id"));
        changes.push(Change { what, before: sweep, after: coupled, unit: unit.into() });
    }
    changes
}
