//! `ttb report`: judges the results of a folder and writes the report.

use std::path::Path;
use std::time::{SystemTime, UNIX_EPOCH};

use ttb_assessment::{Status, Verdict, Verdicts, judge};
use ttb_dossier::{Opened, page};
use ttb_model_description::Date;
use ttb_report::number::{beside, readable, short};

use crate::assess::{limits, verify};
use crate::cli::Report;
use crate::error::Error;
use crate::files;

/// Name of the verdicts' file.
const VERDICTS: &str = "verdicts.json";

/// The command.
pub fn report(arguments: &Report) -> Result<(), Error> {
    let opened = Opened::new(&arguments.folder)?;
    let criteria = match opened.limits() {
        Some(stored) if arguments.limits.is_empty() => stored.criteria()?,
        _ if arguments.limits.is_empty() => limits::load(&opened.assessment.limits)?,
        _ => limits::load(&arguments.limits)?,
    };
    let verdicts = judge(&criteria, &opened.assessment.facts, &opened.results);
    files::write_json(&arguments.folder.join(VERDICTS), &verdicts)?;
    if arguments.verify {
        verify::write(&arguments.folder, &opened, &criteria, &verdicts)?;
    }
    let page = page::page(&opened, &verdicts, &criteria.people, date()?)?;
    let path = arguments.output.clone().unwrap_or_else(|| arguments.folder.join("report.html"));
    files::write(&path, page.as_bytes())?;
    if !arguments.quiet {
        print(&verdicts, &path);
    }
    match verdicts.exceeded().count() {
        count @ 1.. if arguments.check => Err(Error::Exceeded { folder: arguments.folder.clone(), count }),
        _ => Ok(()),
    }
}

/// The day, or that of `SOURCE_DATE_EPOCH`.
fn date() -> Result<String, Error> {
    let asked = Date::asked_for().map_err(Error::Input)?;
    let now = || SystemTime::now().duration_since(UNIX_EPOCH).ok().and_then(|now| Date::from_epoch(now.as_secs()));
    let text = asked.or_else(now).map_or_else(String::new, Date::text);
    Ok(text.split('T').next().unwrap_or_default().to_string())
}

/// A line for every verdict, then what was not judged.
fn print(verdicts: &Verdicts, path: &Path) {
    for verdict in verdicts.verdicts.iter().filter(|verdict| verdict.status != Status::NotJudged) {
        say!("{}", line(verdict));
    }
    for verdict in verdicts.verdicts.iter().filter(|verdict| verdict.status == Status::NotJudged) {
        say!("not judged   {:<22} {}", verdict.criterion, verdict.reason.as_deref().unwrap_or_default());
    }
    say!("report in {}", path.display());
}

fn line(verdict: &Verdict) -> String {
    let (factor, unit) = readable(&verdict.unit);
    let limit = verdict.limit.map(|limit| limit * factor);
    let told = |value: Option<f64>| value.map_or_else(|| "–".into(), |value| beside(value * factor, limit));
    let mut text = format!("{:<12} {:<22} {}", verdict.status.name(), verdict.criterion, told(verdict.value));
    if let Some(limit) = limit {
        text += &format!(" of {}", short(limit));
    }
    if !unit.is_empty() {
        text += &format!(" {unit}");
    }
    if let Some(share) = verdict.utilisation {
        text += &format!(" = {} %", beside(100.0 * share, Some(100.0)));
    }
    if verdict.raw.is_some() && verdict.filter != "raw" {
        text += &format!(", raw {}", told(verdict.raw));
    }
    if let Some(grade) = &verdict.grade {
        text += &format!(", {grade}");
    }
    let train = verdict.train.as_deref().unwrap_or_default();
    let speed = verdict.speed_km_h.map_or_else(String::new, |v| format!(" at {} km/h", short(v)));
    let basis = verdict.basis.map_or_else(|| "; static".into(), |basis| format!("; {basis}"));
    let outside = if verdict.in_basis { "" } else { ", not the code's basis" };
    text + &format!("; {train}{speed}{basis}{outside}")
}
