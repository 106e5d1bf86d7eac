//! Over speed: each judged quantity over the speeds of all trains, and the utilisation of all trains at all speeds.

use std::collections::BTreeMap;

use ttb_assessment::{Status, Verdict};

use super::{Figure, Table};
use crate::chart::{Cells, Chart, Curve, Line, cells};
use crate::input::Input;
use crate::number::{digits, readable, short};

/// So many trains are named; the others are grey.
const NAMED: usize = 3;
const CLASSES: [&str; 3] = ["c1", "c2 dash", "c3 dot-line"];

/// Greatest value of every train at every speed; and whether that speed was refined.
type ByTrain = BTreeMap<String, Vec<(f64, f64, bool)>>;

pub(crate) fn figures(input: &Input) -> Vec<Figure> {
    let mut figures: Vec<Figure> = Vec::new();
    for verdict in &input.verdicts.verdicts {
        if verdict.status == Status::NotJudged || !has_speeds(input, verdict) {
            continue;
        }
        let filtered = by_train(input, verdict, &verdict.filter);
        let raw = if verdict.filter == "raw" { ByTrain::new() } else { by_train(input, verdict, "raw") };
        figures.push(over_speed(input, verdict, &filtered, &raw));
        if verdict.limit.is_some() && filtered.len() > 1 {
            figures.push(heat(verdict, &filtered));
        }
    }
    figures.extend(others(input));
    figures
}

/// Quantities that nothing judges, but an engineer looks at: displacement, moment, shear.
fn others(input: &Input) -> Vec<Figure> {
    let names = [
        ("deck.displacement", "Displacement of the deck"),
        ("deck.moment", "Bending moment"),
        ("deck.shear", "Shear force"),
    ];
    let shown = |(quantity, title): &(&str, &str)| {
        let row = input.results.rows.iter().find(|(_, peak)| peak.quantity == *quantity && peak.filter == "raw")?;
        let statistic = input
            .results
            .rows
            .iter()
            .filter(|(_, p)| p.quantity == *quantity)
            .map(|(_, p)| p.statistic.name())
            .find(|name| *name == "abs-max" || *name == "max")?;
        let verdict = Plain { quantity: (*quantity).into(), statistic: statistic.into(), unit: row.1.unit.to_string() };
        let trains = collect(input, &verdict, "raw", &|_| true);
        if trains.values().all(|points| points.len() < 2) {
            return None;
        }
        Some(figure(input, title, &verdict, &trains, &ByTrain::new(), None))
    };
    names.iter().filter_map(shown).collect()
}

/// What names rows of the table.
struct Plain {
    quantity: String,
    statistic: String,
    unit: String,
}

fn has_speeds(input: &Input, verdict: &Verdict) -> bool {
    by_train(input, verdict, &verdict.filter).values().any(|points| points.len() > 1)
}

fn by_train(input: &Input, verdict: &Verdict, filter: &str) -> ByTrain {
    let plain =
        Plain { quantity: verdict.quantity.clone(), statistic: verdict.statistic.clone(), unit: verdict.unit.clone() };
    collect(input, &plain, filter, &|basis| Some(basis) == verdict.basis)
}

fn collect(input: &Input, of: &Plain, filter: &str, basis: &dyn Fn(ttb_assessment::Basis) -> bool) -> ByTrain {
    let mut trains = ByTrain::new();
    for (at, peak) in &input.results.rows {
        let run = &input.results.runs[*at];
        let Some(v) = run.speed_km_h else { continue };
        if peak.quantity != of.quantity
            || peak.statistic.name() != of.statistic
            || peak.filter != filter
            || !basis(run.basis)
        {
            continue;
        }
        let points = trains.entry(run.train.clone()).or_default();
        // Rows of one run follow each other.
        match points.last_mut() {
            Some(last) if last.0 == v => last.1 = last.1.max(peak.value),
            _ => points.push((v, peak.value, run.refined)),
        }
    }
    for points in trains.values_mut() {
        points.sort_by(|a, b| a.0.total_cmp(&b.0));
        points.dedup_by(|next, kept| {
            let same = next.0 == kept.0;
            if same {
                kept.1 = kept.1.max(next.1);
            }
            same
        });
    }
    trains
}

/// Trains by their greatest value, the worst first.
fn ranked(trains: &ByTrain) -> Vec<&String> {
    let greatest = |name: &String| trains[name].iter().map(|p| p.1).fold(f64::NEG_INFINITY, f64::max);
    let mut names: Vec<&String> = trains.keys().collect();
    names.sort_by(|a, b| greatest(b).total_cmp(&greatest(a)));
    names
}

fn over_speed(input: &Input, verdict: &Verdict, filtered: &ByTrain, raw: &ByTrain) -> Figure {
    let basis = verdict.basis.map_or_else(String::new, |basis| format!(" ({basis})"));
    let plain =
        Plain { quantity: verdict.quantity.clone(), statistic: verdict.statistic.clone(), unit: verdict.unit.clone() };
    let mut figure = figure(input, &format!("{}{basis}", verdict.title), &plain, filtered, raw, verdict.limit);
    figure.note = format!("Behind {}, thin lines raw. {}", verdict.filter, figure.note);
    if verdict.filter == "raw" {
        figure.note = figure.note.replacen("Behind raw, thin lines raw. ", "Raw. ", 1);
    }
    figure
}

fn figure(input: &Input, title: &str, of: &Plain, trains: &ByTrain, raw: &ByTrain, limit: Option<f64>) -> Figure {
    let (factor, unit) = readable(&of.unit);
    let ranked = ranked(trains);
    let worst: Vec<&String> = ranked.iter().take(NAMED).copied().collect();
    let curve = |name: &String, points: &[(f64, f64, bool)], class: String, named: bool| Curve {
        name: if named { name.clone() } else { String::new() },
        class,
        points: points.iter().map(|p| [p.0, p.1 * factor]).collect(),
        dots: if named { points.iter().enumerate().filter(|(_, p)| p.2).map(|(i, _)| i).collect() } else { Vec::new() },
    };
    let mut curves = Vec::new();
    for name in ranked.iter().skip(NAMED).rev() {
        curves.push(curve(name, &trains[*name], "grey".into(), false));
    }
    for (place, name) in worst.iter().enumerate().rev() {
        if let Some(points) = raw.get(*name) {
            curves.push(curve(
                name,
                points,
                format!("{} thin", CLASSES[place].split(' ').next().unwrap_or("c1")),
                false,
            ));
        }
    }
    for (place, name) in worst.iter().enumerate().rev() {
        curves.push(curve(name, &trains[*name], format!("{} bold", CLASSES[place]), true));
    }
    let across = limit.map(|limit| Line {
        at: limit * factor,
        name: format!("limit {}", short(limit * factor)),
        class: "limit",
    });
    let y_name = if unit.is_empty() { of.quantity.clone() } else { format!("{}, {unit}", of.quantity) };
    let chart = Chart {
        name: format!("{title} over speed"),
        x_name: "speed, km/h".into(),
        y_name,
        curves,
        across: across.into_iter().collect(),
        upright: worst.first().map(|name| marks(input, name, trains)).unwrap_or_default(),
        from_zero: true,
        ..Chart::default()
    };
    let others = ranked.len().saturating_sub(worst.len());
    let rest = if others > 0 {
        format!(" The worst {NAMED} trains are named, {others} others are grey.")
    } else {
        String::new()
    };
    let dots = if trains.values().flatten().any(|p| p.2) { " Dots: refined speeds." } else { "" };
    let mut table = Table::new(&["km/h"]);
    table.head.extend(ranked.iter().map(|name| (*name).clone()));
    let mut speeds: Vec<f64> = trains.values().flatten().map(|p| p.0).collect();
    speeds.sort_by(f64::total_cmp);
    speeds.dedup();
    for v in speeds {
        let value = |name: &&String| {
            let found = trains[*name].iter().find(|p| p.0 == v);
            found.map_or_else(|| "–".into(), |p| digits(p.1 * factor, 4))
        };
        table.rows.push(std::iter::once(short(v)).chain(ranked.iter().map(value)).collect());
    }
    Figure { title: title.into(), svg: chart.svg(), note: format!("{rest}{dots}").trim().into(), table }
}

/// Resonance v = f d/i, i = 1 … 4, and cancellation v = 2 f L/(2i + 1), of the first frequency and the worst train.
fn marks(input: &Input, train: &str, trains: &ByTrain) -> Vec<Line> {
    let Some(f) = input.verdicts.facts.n0_hz else { return Vec::new() };
    let speeds = || trains.values().flatten().map(|p| p.0);
    let (low, high) = (speeds().fold(f64::INFINITY, f64::min), speeds().fold(0.0, f64::max));
    let mut lines = Vec::new();
    let spacing = input.trains.iter().find(|one| one.name == train).and_then(|one| one.spacings.first());
    if let Some(d) = spacing {
        lines.extend((1..=4).map(|i| Line {
            at: 3.6 * f * d / f64::from(i),
            name: format!("n₀d/{i}"),
            class: "resonance",
        }));
    }
    if let Some(l) = input.verdicts.facts.shortest_span() {
        lines.extend((1..=4).map(|i| {
            let odd = 2 * i + 1;
            Line { at: 3.6 * 2.0 * f * l / f64::from(odd), name: format!("2n₀L/{odd}"), class: "cancel" }
        }));
    }
    lines.retain(|line| (low..=high).contains(&line.at));
    lines.sort_by(|a, b| a.at.total_cmp(&b.at));
    lines
}

/// Utilisation of all trains at all speeds.
fn heat(verdict: &Verdict, trains: &ByTrain) -> Figure {
    let limit = verdict.limit.unwrap_or(f64::NAN);
    let mut speeds: Vec<f64> = trains.values().flatten().filter(|p| !p.2).map(|p| p.0).collect();
    speeds.sort_by(f64::total_cmp);
    speeds.dedup();
    let mut rows: Vec<String> = trains.keys().cloned().collect();
    // A2 before A10.
    rows.sort_by(|a, b| a.len().cmp(&b.len()).then_with(|| a.cmp(b)));
    let of = |name: &String| -> Vec<Option<f64>> {
        speeds.iter().map(|v| trains[name].iter().find(|p| p.0 == *v).map(|p| p.1 / limit)).collect()
    };
    let values: Vec<Vec<Option<f64>>> = rows.iter().map(of).collect();
    let class = |share: f64| match share {
        s if s > 1.0 => "h6",
        s if s > 0.9 => "h5",
        s if s > 0.75 => "h4",
        s if s > 0.5 => "h3",
        s if s > 0.25 => "h2",
        _ => "h1",
    };
    let name = format!("Utilisation: {}", verdict.title);
    let svg = cells(&Cells {
        name: &name,
        x_name: "speed, km/h",
        x: &speeds,
        rows: &rows,
        values: &values,
        class: &class,
        height: 18.0,
        lines: &[],
    });
    let note = "Steps at 25, 50, 75, 90 and 100 % of the limit; cells above the limit are darkest and framed.".into();
    Figure { title: name, svg, note, table: Table::default() }
}
