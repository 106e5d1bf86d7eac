//! Vehicles: unloading three times, losses of contact on the bridge and in all, car bodies.

use std::collections::BTreeMap;

use serde::Serialize;
use ttb_assessment::{Peak, Statistic};

use super::Table;
use crate::input::Input;
use crate::number::{digits, with_unit};

#[derive(Serialize)]
pub(crate) struct Vehicle {
    wheels: Table,
    losses: String,
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
        Self { wheels: wheels(input), losses: losses(input), bodies: bodies(input) }
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
