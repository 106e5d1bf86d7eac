//! The table of verdicts, and what was not judged and why.

use serde::Serialize;
use ttb_assessment::{Status, Verdict};

use super::speed;
use crate::input::Input;
use crate::number::{beside, digits, readable};

#[derive(Serialize)]
pub(crate) struct Verdicts {
    judged: Vec<Row>,
    open: Vec<Open>,
    limits: String,
    facts: Vec<[String; 2]>,
}

#[derive(Serialize)]
struct Row {
    id: String,
    title: String,
    status: &'static str,
    sign: &'static str,
    value: String,
    raw: String,
    limit: String,
    unit: String,
    percent: String,
    bar: String,
    grade: String,
    train: String,
    speed: String,
    place: String,
    time: String,
    variant: String,
    seed: String,
    filter: String,
    basis: String,
    outside: bool,
    permissible: String,
    clause: String,
    edition: String,
    verified: String,
    source: String,
    run_id: String,
    note: String,
    runs: usize,
}

#[derive(Serialize)]
struct Open {
    id: String,
    title: String,
    reason: String,
    clause: String,
}

impl Verdicts {
    pub fn new(input: &Input) -> Self {
        let all = &input.verdicts.verdicts;
        let open = |verdict: &Verdict| Open {
            id: verdict.criterion.clone(),
            title: verdict.title.clone(),
            reason: verdict.reason.clone().unwrap_or_default(),
            clause: format!("{} {}", verdict.edition, verdict.clause),
        };
        let facts = &input.verdicts.facts;
        let hz = |value: Option<f64>| value.map(|hz| format!("{} Hz", digits(hz, 5)));
        let told = [
            ("first frequency n₀", hz(facts.n0_hz)),
            ("third mode", hz(facts.third_mode_hz)),
            ("frequencies from", facts.modes_from.clone()),
            ("track", facts.track.clone()),
            ("level of comfort", facts.comfort_level.clone()),
            ("maintenance of the track", facts.maintenance.clone()),
            ("classification factor α", facts.alpha.map(|alpha| digits(alpha, 3))),
            ("speed of the line", facts.line_speed_km_h.map(|v| format!("{} km/h", speed(Some(v))))),
        ];
        Self {
            judged: all.iter().filter(|verdict| verdict.status != Status::NotJudged).map(Row::new).collect(),
            open: all.iter().filter(|verdict| verdict.status == Status::NotJudged).map(open).collect(),
            limits: input.verdicts.limits.join(", "),
            facts: told.into_iter().filter_map(|(name, text)| Some([name.to_string(), text?])).collect(),
        }
    }
}

impl Row {
    fn new(verdict: &Verdict) -> Self {
        let (factor, unit) = readable(&verdict.unit);
        let scaled = |value: Option<f64>| value.map(|value| value * factor);
        let limit = scaled(verdict.limit);
        let told = |value: Option<f64>| scaled(value).map_or_else(String::new, |value| beside(value, limit));
        let share = verdict.utilisation;
        let text = |value: &Option<String>| value.clone().unwrap_or_default();
        let (word, sign) = match verdict.status {
            Status::Exceeded => ("exceeded", "✗"),
            Status::Fulfilled => ("fulfilled", "✓"),
            _ => ("informative", "i"),
        };
        let permissible = match (verdict.permissible_speed_km_h, verdict.first_exceeded_km_h) {
            _ if verdict.limit.is_none() => String::new(),
            (Some(v), None) => format!("all up to {}", speed(Some(v))),
            (Some(v), Some(_)) => speed(Some(v)),
            (None, Some(v)) => format!("none from {} on", speed(Some(v))),
            (None, None) => String::new(),
        };
        let place = [text(&verdict.place), verdict.x_m.map_or_else(String::new, |x| format!("x = {} m", digits(x, 5)))];
        Self {
            id: verdict.criterion.clone(),
            title: verdict.title.clone(),
            status: word,
            sign,
            value: told(verdict.value),
            raw: told(verdict.raw),
            limit: limit.map_or_else(String::new, crate::number::short),
            unit: unit.into(),
            percent: share.map_or_else(String::new, |share| format!("{} %", beside(100.0 * share, Some(100.0)))),
            bar: share.map_or_else(String::new, |share| format!("{:.1}", (100.0 * share).clamp(0.0, 150.0))),
            grade: text(&verdict.grade),
            train: text(&verdict.train),
            speed: speed(verdict.speed_km_h),
            place: place.iter().filter(|part| !part.is_empty()).cloned().collect::<Vec<_>>().join(", "),
            time: verdict.time_s.map_or_else(String::new, |t| format!("{} s", digits(t, 5))),
            variant: text(&verdict.variant),
            seed: text(&verdict.seed),
            filter: if verdict.filter_assumed {
                format!("{} (assumed)", verdict.filter)
            } else {
                verdict.filter.clone()
            },
            basis: verdict
                .basis
                .map_or_else(|| "static load model, by influence lines".into(), |basis| basis.to_string()),
            outside: !verdict.in_basis,
            permissible,
            clause: verdict.clause.clone(),
            edition: verdict.edition.clone(),
            verified: verdict.verified.clone(),
            source: verdict.source.clone(),
            run_id: text(&verdict.run_id),
            note: [verdict.note.clone(), text(&verdict.reason)].join(" ").trim().to_string(),
            runs: verdict.runs,
        }
    }
}
