//! Histories of the governing run: of a run from its results, of a sweep by the modes of the bridge once more.

use ttb_assessment::criterion::ResolvedFilter;
use ttb_assessment::{Filter, Phase, Verdict};
use ttb_passage::{Heading, ModalBridge, Quantity};
use ttb_report::{History, Passage, input::SpaceTime};

use super::trains::force_train;
use crate::folder::Opened;

/// Rows of the picture over place and time.
const TIMES: usize = 160;

/// The governing passage, where histories can be had.
pub fn all(opened: &Opened, governing: Option<&Verdict>, modal: Option<&ModalBridge>) -> Vec<Passage> {
    let Some(verdict) = governing else { return Vec::new() };
    let passage = if opened.plan.is_some() { of_sweep(opened, verdict, modal) } else { of_run(opened, verdict) };
    passage.into_iter().collect()
}

fn title(verdict: &Verdict) -> String {
    let train = verdict.train.as_deref().unwrap_or_default();
    let speed = verdict.speed_km_h.map_or_else(String::new, |v| format!(" at {} km/h", ttb_report::number::short(v)));
    format!("{}: {train}{speed}", verdict.title)
}

/// The filter that a label names.
pub(super) fn filter(label: &str) -> Option<Filter> {
    let rest = label.strip_prefix("butterworth-")?;
    let (order, rest) = rest.split_once('-')?;
    let (hz, phase) = rest.split_once("Hz-")?;
    let phase = match phase {
        "zero" => Phase::Zero,
        "causal" => Phase::Causal,
        _ => Phase::Compensated,
    };
    Some(Filter::Butterworth { order: order.parse().ok()?, cut_off_hz: hz.parse().ok()?, phase })
}

fn history(title: String, unit: &str, time: Vec<f64>, raw: Vec<f64>, label: &str) -> Option<History> {
    let [first, .., last] = time[..] else { return None };
    let rate = (time.len() - 1) as f64 / (last - first);
    let filter = filter(label).map(|filter| ResolvedFilter { filter, assumed: false });
    let filtered = filter.and_then(|one| one.filter.apply(&raw, rate, f64::NAN).ok()).unwrap_or_default();
    let cut_off = match filter.map(|one| one.filter) {
        Some(Filter::Butterworth { cut_off_hz, .. }) => Some(cut_off_hz),
        _ => None,
    };
    Some(History { title, unit: unit.into(), time, raw, filtered, filter: label.into(), cut_off })
}

/// Columns of results.csv that belong to the governing place.
fn of_run(opened: &Opened, verdict: &Verdict) -> Option<Passage> {
    let (kind, place) = verdict.place.as_deref()?.split_once(' ').unwrap_or_default();
    let number = place.split(' ').next().unwrap_or_default();
    let (column, unit) = match (kind, verdict.quantity.as_str()) {
        ("point", "deck.acceleration") => (format!("point[{place}].acceleration"), "m/s2"),
        ("axle", _) => (format!("wheel[{number}].contact_force"), "N"),
        ("car", _) => (format!("car[{number}].acceleration"), "m/s2"),
        _ => return None,
    };
    let mut reader = csv::Reader::from_reader(opened.files.open("results.csv").ok()??);
    let at = reader.headers().ok()?.iter().position(|name| name == column)?;
    let (mut time, mut raw) = (Vec::new(), Vec::new());
    for row in reader.records() {
        let row = row.ok()?;
        time.push(row.get(0)?.parse().ok()?);
        raw.push(row.get(at)?.parse::<f64>().ok()?);
    }
    let label = verdict.filter.as_str();
    let mut shown = history(column, unit, time, raw, label)?;
    if kind == "axle" {
        // The dynamic part is filtered, and shown about the static load.
        let mean = *shown.raw.first()?;
        let dynamic = shown.raw.iter().map(|force| force - mean).collect();
        let filtered = history(String::new(), unit, shown.time.clone(), dynamic, label)?.filtered;
        shown.filtered = filtered.iter().map(|force| force + mean).collect();
    }
    let run_id = verdict.run_id.clone()?;
    Some(Passage { run_id, title: title(verdict), histories: vec![shown], space_time: None })
}

/// The passage once more over the modes of the bridge, with the whole deck.
fn of_sweep(opened: &Opened, verdict: &Verdict, modal: Option<&ModalBridge>) -> Option<Passage> {
    let modal = modal.filter(|_| verdict.quantity == "deck.acceleration" && verdict.variant.is_none())?;
    let entries = opened.plan.as_ref()?["trains"].as_array()?;
    let entry = entries.iter().find(|entry| entry["name"].as_str() == verdict.train.as_deref())?;
    let train = force_train(entry)?;
    let backward = entry["heading"].as_str() == Some("backward");
    let heading = if backward { Heading::Backward } else { Heading::Forward };
    let speed = verdict.speed_km_h? / 3.6;
    let passage = ttb_passage::Passage::new(modal, &train, heading, None);
    let histories = passage.histories(speed);
    let accelerations: Vec<(usize, f64)> = modal
        .outputs()
        .iter()
        .enumerate()
        .filter(|(_, output)| output.quantity == Quantity::Acceleration)
        .filter_map(|(at, output)| Some((at, output.place.x?)))
        .collect();
    let x = verdict.x_m?;
    let (nearest, _) = accelerations.iter().min_by(|a, b| (a.1 - x).abs().total_cmp(&(b.1 - x).abs()))?;
    let n = histories.samples();
    let time: Vec<f64> = (0..n).map(|i| i as f64 * histories.h).collect();
    let name = format!("Acceleration of the deck at x = {} m", ttb_report::number::short(x));
    let shown = history(name, "m/s2", time.clone(), histories.output(*nearest), &verdict.filter)?;
    let mut places = accelerations;
    places.sort_by(|a, b| a.1.total_cmp(&b.1));
    places.dedup_by(|a, b| a.1 == b.1);
    let columns: Vec<Vec<f64>> = places.iter().map(|(at, _)| histories.output(*at)).collect();
    let stride = n.div_ceil(TIMES).max(1);
    let rows: Vec<usize> = (0..n).step_by(stride).collect();
    let length = modal.length();
    let [begin, end] = if backward { [length, 0.0] } else { [0.0, length] };
    let paths = train.axles.iter().map(|axle| [[axle.x / speed, begin], [(axle.x + length) / speed, end]]).collect();
    let space_time = SpaceTime {
        x: places.iter().map(|(_, x)| *x).collect(),
        time: rows.iter().map(|i| time[*i]).collect(),
        values: rows.iter().map(|i| columns.iter().map(|column| column[*i]).collect()).collect(),
        paths,
    };
    let run_id = verdict.run_id.clone()?;
    Some(Passage { run_id, title: title(verdict), histories: vec![shown], space_time: Some(space_time) })
}
