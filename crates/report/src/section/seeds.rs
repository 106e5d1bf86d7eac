//! Seeds: the sample of every judged quantity over the irregularities, the smooth rail beside it.

use ttb_assessment::sample::{Sample, Seeded};
use ttb_assessment::{Status, Verdict};

use super::{Figure, Table};
use crate::chart::{Chart, Curve, Line};
use crate::input::Input;
use crate::number::{digits, readable};

pub(crate) fn figures(input: &Input) -> Vec<Figure> {
    let judged = input.verdicts.verdicts.iter().filter(|verdict| verdict.status != Status::NotJudged);
    judged.filter_map(|verdict| figure(input, verdict)).collect()
}

/// The greatest value of every seed over trains, speeds and places.
fn figure(input: &Input, verdict: &Verdict) -> Option<Figure> {
    let mut values: Vec<Seeded> = Vec::new();
    let mut smooth: Option<f64> = None;
    for (at, peak) in &input.results.rows {
        let run = &input.results.runs[*at];
        if peak.quantity != verdict.quantity
            || peak.statistic.name() != verdict.statistic
            || peak.filter != verdict.filter
        {
            continue;
        }
        if run.seed == "smooth" {
            smooth = Some(smooth.map_or(peak.value, |before| before.max(peak.value)));
        } else if let Ok(seed) = run.seed.parse() {
            match values.iter_mut().find(|one| one.seed == seed) {
                Some(one) => one.value = one.value.max(peak.value),
                None => values.push(Seeded { seed, value: peak.value }),
            }
        }
    }
    if values.len() < 2 {
        return None;
    }
    let sample = Sample::of(&values)?;
    let (factor, unit) = readable(&verdict.unit);
    values.sort_by_key(|one| one.seed);
    let points: Vec<[f64; 2]> = values.iter().map(|one| [one.seed as f64, one.value * factor]).collect();
    let line = |at: f64, name: &str, class| Line { at: at * factor, name: name.into(), class };
    let mut across = vec![line(sample.p95, "95 % of the sample", "resonance")];
    across.extend(smooth.map(|value| line(value, "smooth rail", "cancel")));
    across.extend(verdict.limit.map(|limit| line(limit, "limit", "limit")));
    let dots = (0..points.len()).collect();
    let chart = Chart {
        name: format!("{} over seeds", verdict.title),
        x_name: "seed".into(),
        y_name: unit.into(),
        curves: vec![Curve { name: "greatest of each seed".into(), class: "c1 points".into(), points, dots }],
        across,
        height: 220.0,
        from_zero: true,
        ..Chart::default()
    };
    let mut table =
        Table::new(&["n", "mean", "s (n − 1)", "least", "greatest", "95 %", "seed of the greatest", "smooth rail"]);
    let told = |value: f64| digits(value * factor, 4);
    table.rows.push(vec![
        sample.n.to_string(),
        told(sample.mean),
        sample.deviation.map_or_else(|| "–".into(), told),
        told(sample.min),
        told(sample.max),
        told(sample.p95),
        sample.seed_of_max.to_string(),
        smooth.map_or_else(|| "–".into(), told),
    ]);
    let note = format!(
        "With n = {} the greatest value is not below the 95 % fractile of all rails with {:.0} % confidence; 59 seeds give 95 %.",
        sample.n,
        100.0 * sample.confidence
    );
    Some(Figure { title: format!("{} over seeds", verdict.title), svg: chart.svg(), note, table })
}
