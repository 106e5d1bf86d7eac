//! From records to verdicts, curves and the files of a folder: the same bytes as `ttb sweep` and `ttb report` write.

use std::collections::BTreeMap;

use serde::Serialize;
use ttb_assessment::peak::quantity::{
    BODY_ACCELERATION, DECK_ACCELERATION, DECK_DISPLACEMENT, PHI_DYN, WHEEL_UNLOADING,
};
use ttb_assessment::{Criteria, Verdict, Verdicts, judge};
use ttb_campaign::governing::{self, Compared, FILE as CHECK};
use ttb_campaign::plan::{FILE as PLAN, Plan};
use ttb_campaign::refine::{Known, Refinement};
use ttb_campaign::{Record, Run, tables};
use ttb_dossier::folder::FILE;
use ttb_dossier::noticed::noticed;
use ttb_dossier::{Memory, Opened};

use crate::fault::Fault;
use crate::request::{Limits, SCENARIO, Wanted};
use crate::session::Session;

/// Quantities that have curves over speed, with title, factor and unit for people.
const CURVES: [(&str, &str, f64, &str); 5] = [
    (DECK_ACCELERATION, "Deck acceleration", 1.0, "m/s²"),
    (DECK_DISPLACEMENT, "Deflection of the deck", 1e3, "mm"),
    (PHI_DYN, "Dynamic amplification φ′", 1.0, ""),
    (BODY_ACCELERATION, "Acceleration of car bodies", 1.0, "m/s²"),
    (WHEEL_UNLOADING, "Unloading of wheelsets", 1.0, ""),
];

/// What records say.
#[derive(Serialize)]
pub struct Outcome {
    /// verdicts.json.
    verdicts: Verdicts,
    charts: Vec<Chart>,
    /// Of every judged quantity the run in which it is largest.
    governing: Vec<Governing>,
    /// Runs that failed: which and why.
    failed: Vec<[String; 2]>,
    /// Number of runs.
    runs: usize,
    /// Over an FMU: what was noticed.
    warnings: Vec<String>,
}

/// Largest values over speed of a quantity behind a filter.
#[derive(Serialize)]
struct Chart {
    quantity: &'static str,
    title: &'static str,
    filter: String,
    unit: &'static str,
    /// The strictest limit that judges them, in the same unit, with its criterion.
    limit: Option<(f64, String)>,
    lines: Vec<Line>,
}

/// A train, variant and rail.
#[derive(Serialize)]
struct Line {
    name: String,
    /// km/h and value, rising.
    points: Vec<[f64; 2]>,
}

#[derive(Serialize)]
struct Governing {
    quantity: String,
    filter: String,
    value: f64,
    run: Wanted,
    run_id: String,
    title: String,
}

/// Values by the bits of their speeds.
type Points = BTreeMap<u64, f64>;
/// Name and values of every line, by train, variant and rail.
type Lines = BTreeMap<(usize, usize, String), (String, Points)>;

/// Records by the ids of their runs.
pub type Records = BTreeMap<String, Record>;

/// All runs of a request in the order of its tables, refined ones at the end, as far as records ask for them.
///
/// # Errors
/// As [`Session::runner`].
pub fn runs(session: &Session, records: &Records) -> Result<Vec<Run>, Fault> {
    let plan = &session.expanded.plan;
    let mut runs = plan.runs();
    if plan.refine {
        runs.extend(refined(session, records)?);
    }
    Ok(runs)
}

/// Runs that a refinement asks for, those that are known among them.
///
/// # Errors
/// As [`Session::runner`].
pub fn refined(session: &Session, records: &Records) -> Result<Vec<Run>, Fault> {
    let refined = session.runner()?.refined();
    let mut known = Known::default();
    records.values().for_each(|record| known.add(record, &refined.keys));
    let of = Refinement { plan: &session.expanded.plan, keys: &refined.keys, resonances: &refined.resonances };
    Ok(of.runs(&known))
}

/// Verdicts and curves.
///
/// # Errors
/// A limit that cannot be read.
pub fn outcome(session: &Session, records: &Records, limits: &Limits) -> Result<Outcome, Fault> {
    let plan = &session.expanded.plan;
    let (runs, criteria) = (runs(session, records)?, limits.criteria()?);
    let files = folder(session, records, &[], "")?;
    let opened = Opened::new(&files)?;
    let verdicts = judge(&criteria, &opened.assessment.facts, &opened.results);
    let charts = charts(&runs, &opened, &verdicts, plan);
    let governing = governing::of(&runs, &session.runner()?.keys(), records)?;
    let failed = records.iter().filter_map(|(id, record)| Some([id.clone(), record.error.clone()?]));
    let told = |one: governing::Governing| {
        let speed = one.run.speed_km_h.map_or_else(String::new, |speed| format!(" at {speed} km/h"));
        let title = format!("{}{speed}", plan.title(one.run.train, one.run.variant, one.run.rail));
        let (quantity, filter) = one.key;
        Governing { quantity, filter, value: one.value, run: (&one.run).into(), run_id: one.run.id, title }
    };
    let runs = records.len().max(plan.runs().len());
    Ok(Outcome {
        charts,
        governing: governing.into_iter().map(told).collect(),
        failed: failed.collect(),
        runs,
        warnings: opened.assessment.warnings.clone(),
        verdicts,
    })
}

fn charts(runs: &[Run], opened: &Opened, verdicts: &Verdicts, plan: &Plan) -> Vec<Chart> {
    let by_id: BTreeMap<&str, &Run> = runs.iter().map(|run| (run.id.as_str(), run)).collect();
    let mut found: BTreeMap<(usize, String), Lines> = BTreeMap::new();
    for (of, peak) in &opened.results.rows {
        let Some(at) = CURVES.iter().position(|(quantity, ..)| *quantity == peak.quantity) else { continue };
        let Some(run) = opened.results.runs.get(*of).and_then(|run| by_id.get(run.run_id.as_str())) else { continue };
        let Some(speed) = run.speed_km_h else { continue };
        let lines = found.entry((at, peak.filter.to_string())).or_default();
        let line = lines.entry((run.train, run.variant, run.rail.to_string()));
        let (_, points) = line.or_insert_with(|| (plan.title(run.train, run.variant, run.rail), Points::new()));
        // Speeds are positive: their bits rise with them.
        let value = points.entry(speed.to_bits()).or_insert(f64::NEG_INFINITY);
        *value = value.max(if peak.quantity == PHI_DYN { peak.value } else { peak.value.abs() });
    }
    let chart = |((at, filter), lines): ((usize, String), Lines)| {
        let (quantity, title, factor, unit) = CURVES[at];
        let of = |verdict: &&Verdict| verdict.quantity == quantity && verdict.filter == filter && verdict.in_basis;
        let limits =
            verdicts.verdicts.iter().filter(of).filter_map(|one| Some((one.limit? * factor, one.title.clone())));
        let points = |points: Points| points.into_iter().map(|(v, y)| [f64::from_bits(v), y * factor]).collect();
        let lines = lines.into_values().map(|(name, of)| Line { name, points: points(of) });
        let limit = limits.min_by(|a, b| a.0.total_cmp(&b.0));
        Chart { quantity, title, filter, unit, limit, lines: lines.collect() }
    };
    found.into_iter().map(chart).collect()
}

/// The folder that `ttb sweep` would write, as far as `ttb report` reads it, under a name.
///
/// # Errors
/// It cannot be written as text.
pub fn folder(session: &Session, records: &Records, compared: &[Compared], name: &str) -> Result<Memory, Fault> {
    let plan = &session.expanded.plan;
    let runs = runs(session, records)?;
    let texts = tables::texts(plan, &runs, records, session.own_is_smooth())?;
    let mut files: BTreeMap<String, Vec<u8>> =
        tables::TABLES.iter().map(|name| (*name).to_string()).zip(texts).collect();
    files.insert(PLAN.into(), plan.text()?.into_bytes());
    files.insert(SCENARIO.into(), session.asked.scenario.clone().into_bytes());
    let mut add = |name: &str, text: Result<String, serde_json::Error>| {
        let text = text.map_err(|error| Fault::new(error.to_string()))?;
        files.insert(name.into(), (text + "\n").into_bytes());
        Ok::<_, Fault>(())
    };
    if let Some(noticed) = noticed(&session.expanded, &runs, records)? {
        add(FILE, serde_json::to_string_pretty(&noticed))?;
    }
    if !compared.is_empty() {
        add(CHECK, serde_json::to_string_pretty(compared))?;
    }
    Ok(Memory { name: name.into(), beside: session.expanded.source.folder.clone(), files })
}

/// The folder with verdicts and report, as texts by name. `date` is the day that the report names.
///
/// # Errors
/// A limit that cannot be read.
pub fn dossier(
    session: &Session,
    records: &Records,
    limits: &Limits,
    compared: &[Compared],
    name: &str,
    date: String,
) -> Result<BTreeMap<String, String>, Fault> {
    let criteria: Criteria = limits.criteria()?;
    let files = folder(session, records, compared, name)?;
    let opened = Opened::new(&files)?;
    let verdicts = judge(&criteria, &opened.assessment.facts, &opened.results);
    let text = serde_json::to_string_pretty(&verdicts).map_err(|error| Fault::new(error.to_string()))? + "\n";
    // The report lists the files that are there, its verdicts among them.
    let mut judged = files.clone();
    judged.files.insert("verdicts.json".into(), text.into_bytes());
    let page = ttb_dossier::page::page(&Opened { files: &judged, ..opened }, &verdicts, &criteria.people, date)?;
    let mut texts: BTreeMap<String, String> =
        judged.files.into_iter().map(|(name, bytes)| (name, String::from_utf8_lossy(&bytes).into_owned())).collect();
    texts.insert("report.html".into(), page);
    Ok(texts)
}

/// The governing runs of axle loads once more, step by step on a rigid track; `None` if it was asked to stop.
///
/// # Errors
/// A run that cannot be repeated.
pub fn again(
    session: &Session,
    records: &Records,
    stop: &std::sync::atomic::AtomicBool,
) -> Result<Option<Vec<Compared>>, Fault> {
    let (plan, runner) = (&session.expanded.plan, session.runner()?);
    if plan.way == ttb_campaign::Way::Coupled {
        return Ok(Some(Vec::new()));
    }
    let governing = governing::of(&runs(session, records)?, &runner.keys(), records)?;
    let mut again = Records::new();
    for (id, one) in runner.again_each(&governing, 1, stop) {
        let Some((record, _)) = one.map_err(Fault::new)? else { return Ok(None) };
        again.extend(record.map(|record| (id, record)));
    }
    Ok(Some(governing::all_compared(plan, &governing, &again)))
}
