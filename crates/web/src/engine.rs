//! The verbs: JSON in, JSON out.

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use serde_json::json;
use ttb_campaign::governing::Compared;
use ttb_campaign::{Compute, Record, Run, compute};

use crate::about::About;
use crate::fault::Fault;
use crate::request::{Asked, Limits, Wanted};
use crate::room::Room;
use crate::session::{Masters, Session, Sessions};
use crate::{film, look, outcome};

/// Answers requests.
pub struct Engine {
    /// Where scenarios look for files.
    pub folder: PathBuf,
    /// How much a computation may take.
    pub room: Room,
    /// Threads that compute runs.
    pub threads: usize,
    /// What runs FMUs; none: they are refused.
    pub masters: Option<Masters>,
    sessions: Sessions,
}

/// A request of verbs that take runs or records.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Of {
    asked: Asked,
    #[serde(default)]
    runs: Vec<Wanted>,
    #[serde(default)]
    records: Vec<Record>,
    #[serde(default)]
    limits: Limits,
    #[serde(default)]
    compared: Vec<Compared>,
    #[serde(default)]
    name: String,
    #[serde(default)]
    date: String,
    /// Number of workers among whom runs are shared out.
    #[serde(default)]
    workers: usize,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Text {
    text: String,
    #[serde(default)]
    file: String,
    #[serde(default)]
    asked: Asked,
}

impl Engine {
    /// An engine without anything prepared.
    pub fn new(folder: PathBuf, room: Room, threads: usize) -> Self {
        Self { folder, room, threads, masters: None, sessions: Sessions::default() }
    }

    /// The answer to a verb with its request: JSON, of a request that has none `{"error": …, "problems": […]}`. `stop` asks to
    /// leave off; the answer is then `{"stopped": true}`.
    pub fn call(&self, verb: &str, body: &[u8], stop: &AtomicBool) -> Vec<u8> {
        let answer = self.answer(verb, body, stop).unwrap_or_else(|fault| written(&fault));
        answer.into_bytes()
    }

    fn answer(&self, verb: &str, body: &[u8], stop: &AtomicBool) -> Result<String, Fault> {
        match verb {
            "about" => Ok(written(&About::new())),
            "look" => {
                let of: Text = read(body)?;
                Ok(written(&look::look(&of.text, &of.asked, &self.folder, &self.room)?))
            }
            "axles" => axles(&read(body)?),
            "limits" => read::<Limits>(body)?.criteria().map(|criteria| written(&criteria.files)),
            "plan" => {
                let of: Of = read(body)?;
                plan(&*self.session(of.asked)?, of.workers)
            }
            "runs" => {
                let of: Of = read(body)?;
                let session = self.session(of.asked)?;
                let runs = of.runs.iter().map(|run| run.of(&session.expanded.plan)).collect::<Result<Vec<Run>, _>>()?;
                Ok(written(&session.compute(&runs, self.threads, stop)?))
            }
            "more" => {
                let of: Of = read(body)?;
                let (session, records) = (self.session(of.asked)?, by_id(of.records));
                let asked = outcome::refined(&session, &records)?;
                let new: Vec<Run> = asked.into_iter().filter(|run| !records.contains_key(&run.id)).collect();
                Ok(written(&parts(&session, &new, of.workers)?))
            }
            "outcome" => {
                let of: Of = read(body)?;
                let session = self.session(of.asked)?;
                Ok(written(&outcome::outcome(&session, &by_id(of.records), &of.limits)?))
            }
            "again" => {
                let of: Of = read(body)?;
                let session = self.session(of.asked)?;
                Ok(or_stopped(outcome::again(&session, &by_id(of.records), stop)?))
            }
            "dossier" => {
                let of: Of = read(body)?;
                let (session, records) = (self.session(of.asked)?, by_id(of.records));
                let made = outcome::dossier(&session, &records, &of.limits, &of.compared, &of.name, of.date)?;
                Ok(written(&made))
            }
            "film" => {
                let of: Of = read(body)?;
                let session = self.session(of.asked)?;
                let run = of.runs.first().ok_or_else(|| Fault::new("film: name a run"))?;
                Ok(or_stopped(film::film(&session, &run.of(&session.expanded.plan)?, stop)?))
            }
            other => Err(Fault::new(format!("there is no verb `{other}`"))),
        }
    }

    fn session(&self, asked: Asked) -> Result<Arc<Session>, Fault> {
        self.sessions.of(asked, &self.folder, &self.room, self.masters.as_ref())
    }
}

/// All runs of a request in the order in which they cost least together, and the parts of a call each.
fn plan(session: &Session, workers: usize) -> Result<String, Fault> {
    let problems = session.asked.problems();
    if !problems.is_empty() {
        return Err(Fault::new(problems.join("\n")));
    }
    let (plan, runner) = (&session.expanded.plan, session.runner()?);
    let mut runs = plan.runs();
    if runs.is_empty() {
        return Err(Fault::new("no run is asked for: every train's greatest speed is below the first speed"));
    }
    runner.arrange(&mut runs);
    let trains: Vec<&str> = plan.trains.iter().map(|train| train.name.as_str()).collect();
    Ok(written(&json!({
        "way": plan.way.name(), "chosen": session.expanded.chosen, "trains": trains,
        "speeds": plan.speeds_km_h.len(), "refine": plan.refine, "hash": plan.scenario_sha256, "bridges": plan.bridges,
        "runs": runs.iter().map(Wanted::from).collect::<Vec<_>>(), "parts": parts(session, &runs, workers)?,
    })))
}

/// Runs in parts of a call each, for so many workers.
fn parts(session: &Session, runs: &[Run], workers: usize) -> Result<Vec<Vec<Wanted>>, Fault> {
    let runner = session.runner()?;
    let parts = compute::parts(&runner, runs, runner.batch(runs.len(), workers.max(1)));
    Ok(parts.into_iter().map(|part| part.iter().map(Wanted::from).collect()).collect())
}

/// A pasted list of axles as [m behind the first, N].
fn axles(of: &Text) -> Result<String, Fault> {
    let file = if of.file.is_empty() { "axles.csv" } else { &of.file };
    let trains = ttb_trains::files::read_text(&of.text, file).map_err(|problems| Fault::of(&problems))?;
    match trains.as_slice() {
        [train] => Ok(written(&train.axles.iter().map(|axle| [axle.x, axle.load]).collect::<Vec<_>>())),
        several => Err(Fault::new(format!("{file}: it must hold one train: {}", several.len()))),
    }
}

fn by_id(records: Vec<Record>) -> BTreeMap<String, Record> {
    records.into_iter().map(|record| (record.run_id.clone(), record)).collect()
}

fn read<T: DeserializeOwned>(body: &[u8]) -> Result<T, Fault> {
    serde_json::from_slice(body).map_err(|error| Fault::new(format!("the request cannot be read: {error}")))
}

fn written(value: &impl Serialize) -> String {
    serde_json::to_string(value).unwrap_or_else(|error| written(&Fault::new(error.to_string())))
}

fn or_stopped(value: Option<impl Serialize>) -> String {
    value.map_or_else(|| r#"{"stopped":true}"#.into(), |value| written(&value))
}
