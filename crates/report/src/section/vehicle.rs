//! Vehicles: unloading three times, losses of contact on the bridge and in all, car bodies.

use std::collections::BTreeMap;

use serde::Serialize;
use ttb_assessment::{Peak, Statistic};

use super::{Figure, Table};
use crate::chart::{Band, Chart};
use crate::input::Input;
use crate::number::{digits, short, with_unit};

#[derive(Serialize)]
pub(crate) struct Vehicle {
    wheels: Table,
    losses: String,
    bars: Option<Figure>,
    comfort: Table,
    bodies: Table,
}

/// The row of the greatest value of a quantity, filter and statistic, over all runs with vehicles.
fn greatest<'a>(input: &'a Input, quantity: &str, filter: &str, statistic: Statistic) -> Option<(&'a str, &'a Peak)> {
    let rows = input.results.rows.iter();
    let of = rows.filter(|(_, p)| p.quantity == quantity && p.filter == filter && p.statistic == statistic);
    let worst = of.reduce(|worst, one| if one.1.value > worst.1.value { one } else { worst })?;
    Some((input.results.runs[worst.0].run_id.as_str(), &worst.1))
}

/// Filters that the results of a quantity have.
fn filters(input: &Input, quantity: &str) -> Vec<String> {
    let mut found: Vec<String> = Vec::new();
    for (_, peak) in input.results.rows.iter().filter(|(_, peak)| peak.quantity == quantity) {
        if !found.iter().any(|one| *one == peak.filter) {
            found.push(peak.filter.to_string());
        }
    }
    found
}

impl Vehicle {
    pub fn new(input: &Input) -> Self {
        let comfort = comfort(input);
        Self { wheels: wheels(input), losses: losses(input), bars: bars(input), comfort, bodies: bodies(input) }
    }
}

fn wheels(input: &Input) -> Table {
    let mut table = Table::new(&["quantity", "filter", "statistic", "greatest", "axle", "x, m", "t, s", "run"]);
    for quantity in ["wheel.unloading", "wheel.load"] {
        for filter in filters(input, quantity) {
            for statistic in [Statistic::Max, Statistic::Percentile9985] {
                let Some((run, peak)) = greatest(input, quantity, &filter, statistic) else { continue };
                table.rows.push(vec![
                    quantity.into(),
                    filter.clone(),
                    statistic.to_string(),
                    with_unit(peak.value, &peak.unit),
                    peak.place.to_string(),
                    super::optional(peak.x, 5),
                    super::optional(peak.time, 5),
                    run.into(),
                ]);
            }
        }
    }
    table
}

/// Losses of contact in a sentence: of the run with the most.
fn losses(input: &Input) -> String {
    let quantity = "wheel.contact-loss";
    let mut sums: BTreeMap<usize, (f64, f64, f64)> = BTreeMap::new();
    for (run, peak) in input.results.rows.iter().filter(|(_, peak)| peak.quantity == quantity) {
        let (count, sum, longest) = sums.entry(*run).or_default();
        match peak.statistic {
            Statistic::Count => *count += peak.value,
            Statistic::Sum => *sum += peak.value,
            _ => *longest = longest.max(peak.value),
        }
    }
    let Some((run, (count, sum, longest))) =
        sums.into_iter().reduce(|worst, one| if one.1.2 > worst.1.2 { one } else { worst })
    else {
        return String::new();
    };
    let (run, axles) = (
        &input.results.runs[run],
        input
            .results
            .rows
            .iter()
            .filter(|(at, p)| *at == run && p.quantity == quantity && p.statistic == Statistic::Count && p.value > 0.0)
            .count(),
    );
    if count == 0.0 {
        return "No wheelset lost contact in any run.".into();
    }
    let on = input.results.rows.iter().filter(|(at, p)| {
        input.results.runs[*at].run_id == run.run_id
            && p.quantity == "wheel.contact-loss-on-bridge"
            && p.statistic == Statistic::Count
    });
    let on: f64 = on.map(|(_, peak)| peak.value).sum();
    format!(
        "{axles} wheelsets lost contact {count} times, {} ms in all, {} ms at most; {on} of the losses began on the bridge (run {}).",
        digits(1e3 * sum, 4),
        digits(1e3 * longest, 3),
        run.run_id
    )
}

/// Every loss of one run as a bar over the way, the bridge shaded.
fn bars(input: &Input) -> Option<Figure> {
    let losses = input.losses.as_ref().filter(|losses| !losses.bars.is_empty())?;
    let band = losses.bridge.map(|range| Band { range, name: "the bridge".into() });
    let on = |x: f64| losses.bridge.is_some_and(|[a, b]| (a..=b).contains(&x));
    let chart = Chart {
        name: "Losses of contact over the way".into(),
        x_name: "on the track, m".into(),
        y_name: "duration, ms".into(),
        bars: losses.bars.iter().map(|[x, t]| ([*x, 1e3 * t], if on(*x) { "stick c2" } else { "stick c1" })).collect(),
        bars_over: losses.bridge,
        bands: band.into_iter().collect(),
        height: 200.0,
        from_zero: true,
        ..Chart::default()
    };
    let mut table = Table::new(&["x, m", "duration, ms", "place"]);
    for [x, t] in &losses.bars {
        let place = if on(*x) { "on the bridge" } else { "off the bridge" };
        table.rows.push(vec![short((x * 100.0).round() / 100.0), digits(1e3 * t, 3), place.into()]);
    }
    let note = format!(
        "{}; shaded: the bridge. Every loss at the place where it begins (run {}).",
        losses.title, losses.run_id
    );
    Some(Figure { title: "Losses of contact over the way".into(), svg: chart.svg(), note, table })
}

fn comfort(input: &Input) -> Table {
    let mut table = Table::new(&["value", "filter and statistic", "with the bridge", "without", "difference"]);
    for one in &input.comfort {
        let value = |value: f64| with_unit(value, &one.unit);
        let percent = 100.0 * (one.with / one.without - 1.0);
        let percent = if percent.is_finite() { format!("{percent:+.1} %") } else { "–".into() };
        table.rows.push(vec![one.what.clone(), one.how.clone(), value(one.with), value(one.without), percent]);
    }
    table
}

fn bodies(input: &Input) -> Table {
    let mut table = Table::new(&["quantity", "filter", "statistic", "greatest", "car", "run"]);
    for quantity in [
        "body.acceleration",
        "body.sperling",
        "body.sperling-whole",
        "body.sperling-wz",
        "body.sperling-wz-whole",
        "body.comfort-n-mv",
    ] {
        for filter in filters(input, quantity) {
            for statistic in Statistic::ALL {
                let Some((run, peak)) = greatest(input, quantity, &filter, *statistic) else { continue };
                table.rows.push(vec![
                    quantity.into(),
                    filter.clone(),
                    statistic.to_string(),
                    with_unit(peak.value, &peak.unit),
                    peak.place.to_string(),
                    run.into(),
                ]);
            }
        }
    }
    table
}
