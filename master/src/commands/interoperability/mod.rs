//! `ttb interoperability`: a page of counts about FMUs and system structures of other tools: made by what, with which
//! findings, run or why not.

mod child;
mod page;

use std::path::{Path, PathBuf};
use std::time::Duration;

use serde_json::Value;
use ttb_fmi::archive::unpack;
use ttb_fmi::description::tree::walk;
use ttb_fmi::temporary::Temporary;

use crate::cli::Interoperability;
use crate::error::Error;
use crate::files;
use child::{Ended, run};
use page::page;

/// What is known of a file.
pub struct Row {
    /// Its path from the folder.
    pub path: PathBuf,
    /// What it is.
    pub kind: Kind,
    /// Tool and version, as the file says.
    pub tool: String,
    /// Severity and name of each finding.
    pub findings: Vec<(String, String)>,
    /// Why it was not run, if it was not; each reason without what is special to the file.
    pub reasons: Vec<String>,
}

/// What a file is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// An FMU.
    Fmu,
    /// A system structure.
    System,
}

/// Findings of `ttb check` that mean that the FMU cannot be run here, or not at all.
const NOT_RUN: [&str; 11] = [
    "archive",
    "no-description",
    "description",
    "fmi-version",
    "no-co-simulation",
    "no-binary",
    "library",
    "crash",
    "abort",
    "hang",
    "exit",
];

/// The command.
pub fn interoperability(arguments: &Interoperability) -> Result<(), Error> {
    let duration = |name: &str, seconds: f64| {
        let duration = Duration::try_from_secs_f64(seconds).ok().filter(|duration| !duration.is_zero());
        duration.ok_or_else(|| Error::Input(format!("--{name} is {seconds}; must be positive")))
    };
    let (_, limit) = (duration("timeout", arguments.timeout)?, duration("limit", arguments.limit)?);
    let mut paths = Vec::new();
    gather(&arguments.folder, &mut paths).map_err(Error::io(&arguments.folder))?;
    paths.sort();
    if paths.is_empty() {
        let folder = arguments.folder.display();
        return Err(Error::Input(format!(
            "{folder}: there is neither an FMU (.fmu) nor a system structure (.ssp) in it"
        )));
    }
    let mut rows = Vec::new();
    for (k, path) in paths.iter().enumerate() {
        note!("ttb: {} of {}: {}", k + 1, paths.len(), path.display());
        let row = if has_ending(path, "fmu") { fmu(path, arguments, limit)? } else { system(path, arguments, limit)? };
        let shown = path.strip_prefix(&arguments.folder).unwrap_or(path).to_path_buf();
        rows.push(Row { path: shown, ..row });
    }
    let text = page(&rows, arguments.files);
    match &arguments.output {
        Some(path) => files::write(path, text.as_bytes()),
        None => {
            say!("{}", text.trim_end());
            Ok(())
        }
    }
}

fn has_ending(path: &Path, ending: &str) -> bool {
    path.extension().is_some_and(|own| own.eq_ignore_ascii_case(ending))
}

/// All files of interest in a folder; links are not followed.
fn gather(folder: &Path, paths: &mut Vec<PathBuf>) -> std::io::Result<()> {
    for entry in std::fs::read_dir(folder)? {
        let entry = entry?;
        let (path, kind) = (entry.path(), entry.file_type()?);
        if kind.is_dir() {
            gather(&path, paths)?;
        } else if kind.is_file() && (has_ending(&path, "fmu") || has_ending(&path, "ssp")) {
            paths.push(path);
        }
    }
    Ok(())
}

fn fmu(path: &Path, arguments: &Interoperability, limit: Duration) -> Result<Row, Error> {
    let timeout = arguments.timeout.to_string();
    let place = Temporary::new("ttb-interoperability-").map_err(Error::io(Path::new("temporary folder")))?;
    let path_text = path.as_os_str();
    let ended = run(
        &["check".as_ref(), path_text, "--json".as_ref(), "--timeout".as_ref(), timeout.as_ref()],
        place.path(),
        limit,
    )?;
    let found: Vec<Value> = serde_json::from_str(&ended.printed).unwrap_or_default();
    let text = |finding: &Value, key: &str| finding[key].as_str().unwrap_or_default().to_string();
    let mut reasons: Vec<String> = found
        .iter()
        .filter(|finding| finding["severity"] == "error" && NOT_RUN.contains(&text(finding, "name").as_str()))
        .map(|finding| plain(&text(finding, "what")))
        .collect();
    reasons.dedup();
    if found.is_empty() && !matches!(ended.code, Some(0 | 1)) {
        reasons.push(if ended.code.is_none() { "the check takes too long".into() } else { plain(&ended.complained) });
    }
    let findings = found.iter().map(|finding| (text(finding, "severity"), text(finding, "name"))).collect();
    Ok(Row { path: PathBuf::new(), kind: Kind::Fmu, tool: tool_of_fmu(path), findings, reasons })
}

fn system(path: &Path, arguments: &Interoperability, limit: Duration) -> Result<Row, Error> {
    let timeout = arguments.timeout.to_string();
    let place = Temporary::new("ttb-interoperability-").map_err(Error::io(Path::new("temporary folder")))?;
    let out = place.path().join("out");
    let ended = run(
        &[
            "run".as_ref(),
            path.as_os_str(),
            "-q".as_ref(),
            "--isolate".as_ref(),
            "--timeout".as_ref(),
            timeout.as_ref(),
            "-o".as_ref(),
            out.as_os_str(),
        ],
        place.path(),
        limit,
    )?;
    let Ended { code, complained, .. } = &ended;
    let mut reasons = Vec::new();
    if let Some(code @ 1..) = code {
        for reason in refusal(complained).map(|line| problem(line, path)).filter(|reason| !reason.is_empty()) {
            if !reasons.contains(&reason) {
                reasons.push(reason);
            }
        }
        if reasons.is_empty() {
            reasons.push(format!("exit code {code}"));
        }
    }
    Ok(Row { path: PathBuf::new(), kind: Kind::System, tool: tool_of_system(path), findings: Vec::new(), reasons })
}

/// The lines of the error that ended a command: from the last line on that this program itself has begun. What comes before
/// are warnings, and what FMUs say.
fn refusal(complained: &str) -> std::vec::IntoIter<&str> {
    let mut lines: Vec<&str> = complained.lines().collect();
    let own = |line: &&str| line.starts_with("ttb: ") && !line.starts_with("ttb: warning");
    let begin = lines.iter().rposition(own).unwrap_or(lines.len());
    lines.split_off(begin).into_iter()
}

/// A problem without its file and its place.
fn problem(line: &str, path: &Path) -> String {
    let line = line.trim().trim_start_matches("ttb: ").replace(&path.display().to_string(), "");
    let parts = line.split(": ").filter(|part| !part.trim_start_matches('/').starts_with("System"));
    plain(&parts.collect::<Vec<_>>().join(": "))
}

/// A reason without what is special to one file: numbers, paths and names in quotes.
fn plain(text: &str) -> String {
    let special =
        |word: &str| word.contains(['/', '"', '[', '\'']) || word.trim_matches(',').contains('.') && word.len() > 4;
    let word = |word: &str| match word {
        _ if special(word) => "…".to_string(),
        _ if word.chars().all(|c| c.is_ascii_digit()) => "N".to_string(),
        _ => word.to_string(),
    };
    let mut words: Vec<String> = text.lines().next().unwrap_or_default().split_whitespace().map(word).collect();
    words.dedup_by(|a, b| *a == "…" && *b == "…");
    words.join(" ").trim_start_matches([':', ' ']).to_string()
}

/// Attributes of the root element of a document, whatever its version.
fn root(bytes: &[u8], names: [&str; 2]) -> [String; 2] {
    let mut found = [String::new(), String::new()];
    let _ = walk(bytes, |path, element| {
        if path.is_empty() {
            found = names.map(|name| element.attribute(name).unwrap_or_default().trim().to_string());
        }
        Ok(())
    });
    found
}

fn tool_of_fmu(path: &Path) -> String {
    let xml = unpack(path).ok().and_then(|folder| std::fs::read(folder.path().join("modelDescription.xml")).ok());
    let [tool, version] = root(&xml.unwrap_or_default(), ["generationTool", "fmiVersion"]);
    let tool = if tool.is_empty() { "not said".into() } else { tool };
    let version = if version.is_empty() { "?".into() } else { version };
    format!("{tool}, FMI {version}")
}

fn tool_of_system(path: &Path) -> String {
    let ssd = unpack(path).ok().and_then(|folder| std::fs::read(folder.path().join(ttb_ssp::STRUCTURE)).ok());
    let [tool, version] = root(&ssd.unwrap_or_default(), ["generationTool", "version"]);
    let tool = if tool.is_empty() { "not said".into() } else { tool };
    let version = if version.is_empty() { "?".into() } else { version };
    format!("{tool}, SSP {version}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_reason_says_nothing_that_is_special_to_a_file() {
        let line = "ttb: a/b.ssp/SystemStructure.ssd: /SystemStructureDescription/System[@name='S']/Elements: 3 components; there must be two";
        assert_eq!(problem(line, Path::new("a/b.ssp")), "N components; there must be two");
        assert_eq!(plain("the archive has no file resources/My Bridge.fmu"), "the archive has no file …");
        assert_eq!(
            plain("modelDescription.xml is for FMI \"1.0\"; only FMI 2.0 is supported"),
            "… is for FMI … only FMI 2.0 is supported"
        );
    }
}
