//! `ttb run SYSTEM.ssp`: from an archive to two FMUs and how they are connected, or to everything that is wrong with it.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use ttb_fmi::Fmu;
use ttb_fmi::archive::{UnpackError, unpack};
use ttb_fmi::isolate::Isolation;
use ttb_fmi::temporary::Temporary;
use ttb_session::Case;
use ttb_ssp::{Report, STRUCTURE, Structure};

use super::annotation::{self, Settings};
use super::roles;
use super::wiring::{Link, links};
use crate::connect::assign::{Assigned, Ends};
use crate::connect::connected::{Bridge, Connected, couple, instantiate};
use crate::connect::isolate::{self, Isolated};
use crate::error::Error;
use crate::files::sha256;
use crate::results::belief::Scale;
use crate::results::job::{Job, Origin};
use crate::results::provenance::Provenance;
use crate::results::scene::Scene;

/// A system structure that can be run.
pub struct Opened {
    /// What a run needs to know.
    pub job: Job,
    /// What is allowed, but rarely meant.
    pub warnings: Vec<String>,
    settings: Settings,
    /// Name of the component and FMU.
    train_track: (String, Fmu),
    /// Name of the component and file of the FMU.
    bridge: (String, PathBuf),
    assigned: Assigned,
    /// The archive's files.
    _folder: Temporary,
}

impl Opened {
    /// Reads and checks an archive.
    pub fn open(path: &Path, isolated: &Isolated) -> Result<Self, Error> {
        let refused = |why: String| Error::Input(format!("{}: {why}", path.display()));
        let folder = unpack(path).map_err(|error| match error {
            UnpackError::Archive(error) => refused(format!("is no readable system structure (zip archive): {error}")),
            other => refused(other.to_string()),
        })?;
        let document = folder.path().join(STRUCTURE);
        let bytes = std::fs::read(document).map_err(|_| refused(format!("has no {STRUCTURE} at its top")))?;
        let file = format!("{}/{STRUCTURE}", path.display());
        let structure = ttb_ssp::read(&bytes, &file).map_err(|report| Error::Input(report.to_string()))?;
        let mut report = Report::new(file);
        let settings = annotation::read(&structure.experiment.annotations, &mut report);
        // Which side an FMU is shows later: until then none is loaded here if any is to be kept apart.
        let isolation = isolated.train_track.as_ref().or(isolated.bridge.as_ref());
        let fmus = open_fmus(&structure, folder.path(), isolation, &mut report)?;
        let Some(mut fmus) = fmus else { return Err(Error::Input(report.to_string())) };
        let components = &structure.system.components;
        let sides = [(&components[0], fmus[0].description()), (&components[1], fmus[1].description())];
        let links = links(&structure, &sides, &mut report);
        let place = settings.place.as_str();
        let train_track = roles::train_track(settings.train_track.as_deref(), &sides, &links, place, &mut report);
        let mut warnings = Vec::new();
        if let Some(train_track) = train_track {
            warnings = roles::complete(train_track, &sides, &links, &mut report);
        }
        let train_track = train_track.unwrap_or(0);
        let (step, end) = times(&structure, &settings, &[&fmus[train_track], &fmus[1 - train_track]], &mut report);
        if !report.is_empty() {
            return Err(Error::Input(report.to_string()));
        }
        let forces = ends(&links, train_track, &fmus, false);
        let assigned = Assigned::one_to_one(forces, ends(&links, 1 - train_track, &fmus, true));
        let title = structure.system.description.or(structure.description).unwrap_or(structure.name);
        let case = Case {
            title,
            settings: ttb_session::case::settings(&settings.coupling, settings.substeps),
            axle_load: settings.force_scale,
            step,
            substeps: settings.substeps,
            end,
            every: settings.output.every as u64,
            supports: settings.output.supports,
            peaks: settings.peaks.map(|times| times.map(|time| time.min(end))),
            columns: settings.output.columns.clone(),
            csv: settings.output.csv,
        };
        let job = Job {
            case,
            origin: Origin::System(sha256(path)?),
            irregularity_seed: None,
            chosen: Vec::new(),
            choice: None,
            scale: Scale::default(),
            scene: Scene::default(),
            provenance: Provenance::default(),
        };
        if isolation.is_some() && isolated.train_track.is_none() {
            fmus[train_track] = ttb_fmi2::import::open(&folder.path().join(&components[train_track].source))?;
        }
        let [first, second] = fmus;
        let bridge = &components[1 - train_track];
        let train_track = (components[train_track].name.clone(), if train_track == 0 { first } else { second });
        let bridge = (bridge.name.clone(), folder.path().join(&bridge.source));
        Ok(Self { job, warnings, settings, train_track, bridge, assigned, _folder: folder })
    }

    /// Both FMUs in initialization mode, connected; see [`crate::connect::connected::connect`].
    pub fn connect(&self, isolated: &Isolated, trusted: bool) -> Result<Connected, Error> {
        let (name, fmu) = &self.train_track;
        let none = BTreeMap::new();
        let train_track = instantiate(fmu, name, self.job.case.end, &none)?;
        let (name, path) = &self.bridge;
        let bridge = Bridge::open(path, name, isolated.bridge.as_ref(), self.job.case.end, &none)?;
        let parts = vec![(Bridge { trusted, ..bridge }, self.assigned.clone())];
        couple(train_track, parts, &self.job.case, self.settings.coupling.send, self.warnings.clone())
    }
}

/// The two FMUs in the order of the components; nothing if there are not two, which is then reported.
fn open_fmus(
    structure: &Structure,
    folder: &Path,
    isolation: Option<&Isolation>,
    report: &mut Report,
) -> Result<Option<[Fmu; 2]>, Error> {
    let components = &structure.system.components;
    let paths: Vec<_> = components.iter().map(|component| folder.join(&component.source)).collect();
    let mut missing = false;
    for (component, path) in components.iter().zip(&paths) {
        if !path.is_file() {
            missing = true;
            report.problem(&component.place, format!("the archive has no file {}", component.source));
        }
    }
    let [first, second] = paths.as_slice() else {
        let count = components.len();
        report.problem(
            "/SystemStructureDescription/System/Elements",
            format!("{count} components; there must be two, a train–track side and a bridge"),
        );
        return Ok(None);
    };
    if missing {
        return Ok(None);
    }
    Ok(Some([isolate::open(first, isolation)?, isolate::open(second, isolation)?]))
}

/// Step and end of the run; where the structure does not say, the FMUs are asked.
fn times(structure: &Structure, settings: &Settings, fmus: &[&Fmu; 2], report: &mut Report) -> (f64, f64) {
    const PLACE: &str = "/SystemStructureDescription/DefaultExperiment";
    let experiment = &structure.experiment;
    if let Some(start) = experiment.start.filter(|start| *start != 0.0) {
        report.problem(&format!("{PLACE}/@startTime"), format!("is {start}; runs start at 0"));
    }
    let positive = |time: &f64| *time > 0.0 && time.is_finite();
    let end = experiment.stop.or_else(|| fmus.iter().find_map(|fmu| fmu.description().stop_time));
    let end = end.filter(positive).unwrap_or_else(|| {
        report.problem(&format!("{PLACE}/@stopTime"), "there is no end after 0, neither here nor in the FMUs");
        0.0
    });
    let step = settings.step.or_else(|| fmus.iter().find_map(|fmu| fmu.description().step_size));
    let step = step.filter(positive).unwrap_or_else(|| {
        let message = "there is no step: say it with the attribute step of the annotation org.ttb.coupling";
        report.problem(PLACE, message);
        0.0
    });
    (step, end)
}

/// The links from a component, in the order of the inputs they lead to, as where equal names are connected. The iteration
/// sees what the train–track side sees, in SI: a transformation is the bridge's, whichever way it leads.
fn ends(links: &[Link], from: usize, fmus: &[Fmu; 2], from_bridge: bool) -> [Ends; 2] {
    let inputs = fmus[1 - from].description().with_causality("input");
    let order: std::collections::HashMap<&str, usize> = inputs.enumerate().map(|(i, v)| (v.name.as_str(), i)).collect();
    let mut links: Vec<&Link> = links.iter().filter(|link| link.from == from).collect();
    links.sort_by_key(|link| order.get(link.input.as_str()));
    let [mut out, mut into] = [Ends::default(), Ends::default()];
    for link in links {
        let (from_output, to_input) = if from_bridge {
            (link.to_si.then(link.from_si).then(link.input_to_si), link.input_to_si.inverse())
        } else {
            (link.to_si, link.from_si)
        };
        out.push(link.output.clone(), from_output);
        into.push(link.input.clone(), to_input);
    }
    [out, into]
}
