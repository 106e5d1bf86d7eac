//! `ttb run SYSTEM.ssp`: from an archive or a document to two FMUs, their start values and how they are connected, or to
//! everything that is wrong with it.

use std::collections::{BTreeMap, HashSet};
use std::path::{Path, PathBuf};

use ttb_fmi::description::ModelDescription;
use ttb_scenario::types::OnFailure;
use ttb_session::Case;
use ttb_ssp::{Component, Flat, Report, Structure, flatten, load};

use super::annotation::{self, Settings};
use super::describe::describe;
use super::files::Opener;
use super::resolved::Resolved;
use super::values::{start_values, without_variable};
use super::wiring::{Link, Side, Units, connectors, links};
use super::{roles, steps};
use crate::connect::assign::{Assigned, Ends};
use crate::connect::connected::{Bridge, Connected, couple, instantiate};
use crate::connect::isolate::{self, Isolated};
use crate::connect::map::Value;
use crate::connect::probe::Rules;
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
    /// Files beside the system's own that were read, and as what.
    pub inputs: Vec<(&'static str, PathBuf)>,
    /// The system as it was understood.
    pub resolved: Resolved,
    settings: Settings,
    train_track: Part,
    bridge: Part,
    assigned: Assigned,
    rules: Rules,
    /// The archives' files.
    _opener: Opener,
}

/// A component: its name, its FMU, its start values.
struct Part {
    name: String,
    file: PathBuf,
    parameters: BTreeMap<String, Value>,
}

/// What a document says and what the FMUs say.
struct Read {
    structure: Structure,
    flat: Flat,
    descriptions: Vec<Option<ModelDescription>>,
    parameters: Vec<BTreeMap<String, Value>>,
    warnings: Vec<String>,
}

impl Opened {
    /// Reads and checks an archive (.ssp) or a document by itself (.ssd).
    pub fn open(path: &Path) -> Result<Self, Error> {
        let mut opener = Opener::default();
        let (bytes, base, file) = opener.document(path)?;
        let mut report = Report::new(file);
        let loaded = load(&bytes, &base, &mut opener, &mut report);
        let mut of_wires = Report::new(report.file());
        let flat = flatten(&loaded.structure, &mut of_wires);
        let count = flat.components.len();
        if count != 2 {
            let place = format!("{}/Elements", loaded.structure.system.place);
            let rule = "there must be two, a train–track side and a bridge";
            report.problem(&place, format!("{count} components; {rule}"));
        }
        report.absorb(of_wires);
        let read = read(loaded.structure, flat, &mut report);
        let settings = annotation::read(&read.structure.experiment.annotations, &mut report);
        let outside = |file: &Path| base.archive.as_ref().is_none_or(|archive| !file.starts_with(archive));
        let files = read.flat.components.iter().filter_map(|component| component.file.clone());
        let mut inputs: Vec<_> = loaded.read.into_iter().map(|path| ("values", path)).collect();
        inputs.extend(files.map(|path| ("fmu", path)));
        inputs.retain(|(_, path)| outside(path));
        connected(read, settings, report).and_then(|mut opened| {
            opened.job.origin = Origin::System(sha256(path)?);
            Ok(Self { inputs, _opener: opener, ..opened })
        })
    }

    /// Both FMUs in initialization mode, connected; see [`crate::connect::connected::connect`].
    pub fn connect(&self, isolated: &Isolated, trusted: bool) -> Result<Connected, Error> {
        let Part { name, file, parameters } = &self.train_track;
        let fmu = isolate::open(file, isolated.train_track.as_ref())?;
        let train_track = instantiate(&fmu, name, self.job.case.end, parameters)?;
        let Part { name, file, parameters } = &self.bridge;
        let bridge = Bridge::open(file, name, isolated.bridge.as_ref(), self.job.case.end, parameters)?;
        let parts = vec![(Bridge { trusted, ..bridge }, self.assigned.clone())];
        let connected = couple(train_track, parts, &self.job.case, self.settings.coupling.send, self.warnings.clone())?;
        Ok(Connected { rules: self.rules, ..connected })
    }
}

/// What the FMUs of a flattened structure say, and their start values.
fn read(structure: Structure, flat: Flat, report: &mut Report) -> Read {
    let units: Units = structure.units.iter().map(|unit| (unit.name.as_str(), unit.base)).collect();
    let (mut descriptions, mut parameters) = (Vec::new(), Vec::new());
    let mut warnings = flat.warnings.clone();
    let mut hit = vec![false; flat.offers.len()];
    for (k, component) in flat.components.iter().enumerate() {
        let description = component.file.as_deref().and_then(|file| {
            describe(file).map_err(|why| report.problem(&component.place, format!("{}: {why}", component.source))).ok()
        });
        if let Some(description) = &description {
            let ends = flat.wires.iter().flat_map(|wire| [&wire.from, &wire.to]);
            let connected: HashSet<&str> = ends.filter(|(of, _)| *of == k).map(|(_, name)| name.as_str()).collect();
            let unknown = connectors(&units, &(component, description), &|name| connected.contains(name), report);
            if let Some(first) = unknown.first() {
                let (name, more) = (&component.name, unknown.len() - 1);
                warnings.push(format!(
                    "{name}: the FMU has no {first} (and {more} more), which the structure lists and nobody connects"
                ));
            }
            parameters.push(start_values(&flat, k, description, &structure.units, &mut hit, &mut warnings, report));
        } else {
            parameters.push(BTreeMap::new());
        }
        descriptions.push(description);
    }
    if descriptions.iter().all(Option::is_some) {
        warnings.extend(without_variable(&flat, &hit));
    }
    Read { structure, flat, descriptions, parameters, warnings }
}

/// How the two are connected.
fn connected(read: Read, mut settings: Settings, mut report: Report) -> Result<Opened, Error> {
    let Read { structure, flat, descriptions, parameters, mut warnings } = read;
    let both: Vec<Side> =
        flat.components.iter().zip(&descriptions).filter_map(|(c, d)| Some((c, d.as_ref()?))).collect();
    let annotated = structure.experiment.annotations.iter().filter(|annotation| annotation.kind == annotation::KIND);
    let given =
        |key: &str| annotated.clone().any(|annotation| annotation.attributes.iter().any(|(name, _)| name == key));
    let sides = match both[..] {
        [first, second] if flat.components.len() == 2 => [first, second],
        _ => {
            // What can be said without knowing which side is which.
            steps::times(&structure, &settings, &both, &mut Vec::new(), &mut report);
            return Err(Error::Input(report.to_string()));
        }
    };
    let units: Units = structure.units.iter().map(|unit| (unit.name.as_str(), unit.base)).collect();
    let mut links = links(&flat, &units, &sides, &mut report);
    let place = settings.place.clone();
    let train_track =
        roles::train_track(settings.train_track.as_deref(), &sides, &links, &place, &mut warnings, &mut report);
    let at = train_track.unwrap_or(0);
    if train_track.is_some() {
        let set = [0, 1].map(|k| &parameters[k]);
        warnings.extend(roles::complete(at, &sides, &links, &flat, set, &mut report));
    }
    let (step, end) = steps::times(&structure, &settings, &[sides[at], sides[1 - at]], &mut warnings, &mut report);
    if !place.is_empty() {
        steps::choose_forces(&mut links, at, &sides[at], settings.substeps);
    }
    steps::sub_steps(&settings, step, &sides[at], &parameters[at], &links, at, &mut warnings, &mut report);
    if !report.is_empty() {
        return Err(Error::Input(report.to_string()));
    }
    let description = sides[at].1;
    if settings.coupling.max_iterations > 1
        && !description.co_simulation.can_get_and_set_state
        && !given("max_iterations")
    {
        (settings.coupling.max_iterations, settings.coupling.on_failure) = (1, OnFailure::Accept);
        warnings.push(format!(
            "{} cannot save and restore its state: both sides take each step once, without iteration",
            sides[at].0.name
        ));
    }
    (settings.step, settings.train_track) = (Some(step), Some(sides[at].0.name.clone()));
    let rules = if roles::is_deck(&links, at) { Rules::SystemOfDeck } else { Rules::System };
    let title =
        structure.system.description.clone().or(structure.description.clone()).unwrap_or(structure.name.clone());
    let job = Job {
        case: Case {
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
        },
        origin: Origin::System(String::new()),
        irregularity_seed: None,
        chosen: Vec::new(),
        choice: None,
        scale: Scale::default(),
        scene: Scene::default(),
        provenance: Provenance::default(),
    };
    let forces = ends(&links, at, &sides, false);
    let assigned = Assigned::one_to_one(forces, ends(&links, 1 - at, &sides, true));
    let part = |k: usize| Part {
        name: sides[k].0.name.clone(),
        file: sides[k].0.file.clone().unwrap_or_default(),
        parameters: parameters[k].clone(),
    };
    let resolved = Resolved::new(&structure, &sides, &links, &parameters, &settings, end);
    let (train_track, bridge) = (part(at), part(1 - at));
    let (inputs, _opener) = (Vec::new(), Opener::default());
    Ok(Opened { job, warnings, inputs, resolved, settings, train_track, bridge, assigned, rules, _opener })
}

/// The links from a component, in the order of the inputs they lead to, as where equal names are connected. The iteration
/// sees what the train–track side sees, in SI: a transformation is the bridge's, whichever way it leads.
fn ends(links: &[Link], from: usize, sides: &[(&Component, &ModelDescription); 2], from_bridge: bool) -> [Ends; 2] {
    let inputs = sides[1 - from].1.with_causality("input");
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
