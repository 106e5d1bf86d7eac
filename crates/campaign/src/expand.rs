//! From a request to a plan: names become trains, ranges become speeds, `auto` becomes a way.

use std::path::Path;

use serde_json::Value;
use ttb_assessment::Facts;
use ttb_passage::is_diagonal;
use ttb_scenario::spec::Profile;
use ttb_scenario::types::{self, CarChoice, Forces, Heading};
use ttb_scenario::{Checked, Setting, bundled};
use ttb_trains::ForceTrain;

use crate::coupled::Source;
use crate::error::Error;
use crate::facts;
use crate::foreign::{self, Foreign};
use crate::limits::Limits;
use crate::list::{self, Numbers, Written};
use crate::paths::{joined, real, relative};
use crate::plan::{FORMAT, Load, Plan, Rail, Train, Variant, Way};
use crate::refused;
use crate::request::{Headings, Request};
use crate::speeds::{self, Step};

/// Largest seed: an FMI Integer holds it.
pub const LARGEST_SEED: u64 = 2_147_483_647;
/// Step of speeds where vehicles run, km/h: such a run is a thousand times as dear.
const STEP_OF_VEHICLES: f64 = 5.0;

/// A plan and what it was made from.
pub struct Expanded {
    /// The plan.
    pub plan: Plan,
    /// Its scenario.
    pub source: Source,
    /// The scenario as it is.
    pub checked: Checked,
    /// What is known of its bridge.
    pub facts: Facts,
    /// What was chosen, a sentence each.
    pub chosen: Vec<String>,
}

/// Reads the scenario of a request or plan.
///
/// # Errors
/// It cannot be read.
pub fn source(scenario: &Path, set: impl IntoIterator<Item = (String, Value)>) -> Result<Source, Error> {
    let text = ttb_scenario::read_text(scenario)
        .map_err(|error| Error::Input(format!("{}: the scenario file cannot be read: {error}", scenario.display())))?;
    let folder = scenario.parent().unwrap_or(Path::new("")).to_path_buf();
    let settings = set.into_iter().map(|(key, value)| Setting { key, value }).collect();
    Ok(Source { text, folder, name: scenario.display().to_string(), settings })
}

/// Resolves a request whose scenario is a file. `limits` are those that it names, `version` is the program's, `beside` the folder
/// from which the plan names its scenario and its FMUs.
///
/// # Errors
/// Every problem of the request, a line each; those of the scenario.
pub fn expand(request: &Request, version: &str, beside: &Path, limits: Limits) -> Result<Expanded, Error> {
    let source = source(&request.scenario, request.set.clone())?;
    let bridges = foreign::read(&request.bridges, beside).map_err(Error::Input)?;
    of_source(request, source, relative(&request.scenario, beside), bridges, version, limits)
}

/// As [`expand`], of a scenario and of FMUs that were read already; the plan calls the scenario `scenario`.
///
/// # Errors
/// As [`expand`].
pub fn of_source(
    request: &Request,
    source: Source,
    scenario: String,
    bridges: Vec<Foreign>,
    version: &str,
    limits: Limits,
) -> Result<Expanded, Error> {
    let checked = source.checked().map_err(|problems| Error::Input(problems.to_string()))?;
    let over_fmu = !bridges.is_empty();
    let (facts, mut chosen, mut problems) = (facts::of_plan(&checked, over_fmu), Vec::new(), Vec::new());
    let way = request.way.given().filter(|_| !over_fmu).unwrap_or_else(|| {
        let (way, why) = if over_fmu {
            (Way::Coupled, "the bridge is an FMU, which is known step by step only")
        } else if request.seeds.is_some() {
            (Way::Coupled, "seeds have a meaning for vehicles on an irregular rail only")
        } else if is_diagonal(&checked.bridge) {
            (Way::Modal, "axle loads on a bridge whose damping is diagonal in its modes")
        } else {
            (Way::OneAxle, "axle loads on a linear bridge")
        };
        let other = if over_fmu { "" } else { "; --way chooses another" };
        chosen.push(format!("way: {way} ({why}){other}"));
        way
    });
    let trains = noted(trains(request, way, &checked, over_fmu), &mut problems);
    let variants = noted(variants(request, &source), &mut problems);
    if over_fmu {
        problems.extend(refused::over_fmu(request));
    }
    let rails = noted(rails(request, way, &checked, &trains), &mut problems);
    let vehicles = trains.iter().any(|train| !matches!(train.load, Load::Axles(_)));
    let step = noted(step(request, vehicles, &facts, &trains, &variants), &mut problems);
    let speeds_km_h = match &request.speeds {
        None => Vec::new(),
        Some(written) => {
            let numbers = written.numbers().map_err(|error| format!("speeds: {error}"));
            let speeds = numbers.and_then(|numbers| {
                speeds::speeds(&numbers, step.unwrap_or(Step::Equal(STEP_OF_VEHICLES)))
                    .map_err(|e| format!("speeds: {e}"))
            });
            noted(speeds, &mut problems)
        }
    };
    if request.refine && speeds_km_h.len() < 3 {
        problems.push("refine: at least three speeds are needed: give a range such as 140:420".into());
    }
    if let Some(error) = Error::of_problems(&problems) {
        return Err(error);
    }
    let plan = Plan {
        format: FORMAT,
        version: version.into(),
        scenario,
        scenario_sha256: checked.hash.clone(),
        set: request.set.clone().into_iter().collect(),
        bridges,
        way,
        refine: request.refine,
        forces: request.forces,
        trains,
        variants,
        rails,
        speeds_km_h,
        values: limits.values(&facts),
        limits: limits.texts,
    };
    Ok(Expanded { plan, source, checked, facts, chosen })
}

/// The value, or a default and a problem more.
fn noted<T: Default>(found: Result<T, String>, problems: &mut Vec<String>) -> T {
    found.unwrap_or_else(|problem| {
        problems.push(problem);
        T::default()
    })
}

fn trains(request: &Request, way: Way, checked: &Checked, over_fmu: bool) -> Result<Vec<Train>, String> {
    if request.trains.is_empty() {
        let name = own_name(&checked.scenario.train);
        let own_forces = over_fmu && checked.scenario.train.forces.is_some();
        let load = match way {
            Way::Coupled if !own_forces => Load::Scenario,
            _ => axles(&ForceTrain::of_vehicles(&name, "", &checked.train_track.consist())),
        };
        return Ok(headed(
            vec![Train { name, max_speed_km_h: None, load, heading: Heading::Forward }],
            request.heading,
        ));
    }
    let (mut trains, mut problems) = (Vec::<Train>::new(), Vec::new());
    for name in &request.trains {
        if way == Way::Coupled && bundled::cars(name).is_some() {
            trains.push(Train {
                name: name.clone(),
                max_speed_km_h: None,
                load: Load::Cars(vec![name.clone()]),
                heading: Heading::Forward,
            });
            continue;
        }
        match ttb_trains::find(name) {
            Ok(found) => trains.extend(found.iter().map(|train| Train {
                name: train.name.clone(),
                max_speed_km_h: train.max_speed.map(|speed| list::tidy(3.6 * speed)),
                load: axles(train),
                heading: Heading::Forward,
            })),
            Err(found) => problems.push(format!("trains: {found}")),
        }
    }
    let trains = headed(trains, request.heading);
    let mut names: Vec<&str> = trains.iter().map(|train| train.name.as_str()).collect();
    names.sort_unstable();
    problems.extend(
        names
            .windows(2)
            .filter(|pair| pair[0] == pair[1])
            .map(|pair| format!("trains: every train must have a name of its own: `{}`", pair[0])),
    );
    if problems.is_empty() { Ok(trains) } else { Err(problems.join("\n")) }
}

/// The trains in the directions asked for; those that run backward say so in their names.
fn headed(trains: Vec<Train>, heading: Headings) -> Vec<Train> {
    let backward = |train: &Train| {
        let name = format!("{} backward", train.name);
        Train { name, heading: Heading::Backward, ..train.clone() }
    };
    match heading {
        Headings::Forward => trains,
        Headings::Backward => trains.iter().map(backward).collect(),
        Headings::Both => trains.iter().flat_map(|train| [train.clone(), backward(train)]).collect(),
    }
}

/// Of the scenario's own train: that of its one bundled train or car.
fn own_name(train: &types::Train) -> String {
    match (train.cars.as_deref(), &train.forces) {
        (Some([CarChoice::Bundled(name)]), _) | (_, Some(Forces::Named(name))) => name.clone(),
        _ => "scenario".into(),
    }
}

fn axles(train: &ForceTrain) -> Load {
    Load::Axles(train.axles.iter().map(|axle| [axle.x, axle.load]).collect())
}

/// Variants with every combination of the axes; the scenario of each is checked.
fn variants(request: &Request, source: &Source) -> Result<Vec<Variant>, String> {
    let (named, mut variants, mut problems) = (request.variants.list()?, Vec::new(), Vec::new());
    for variant in &named {
        for (name, set) in request.combinations() {
            let between = if variant.name.is_empty() || name.is_empty() { "" } else { ", " };
            let name = format!("{}{between}{name}", variant.name);
            let set = variant.set.iter().cloned().chain(set).collect();
            variants.push(Variant { name, set, ..variant.clone() });
        }
    }
    for variant in variants.iter().filter(|variant| !variant.set.is_empty()) {
        if let Err(found) = source.varied(variant) {
            problems.push(format!("variant `{}`:\n{found}", variant.name));
        }
    }
    if problems.is_empty() { Ok(variants) } else { Err(problems.join("\n")) }
}

fn rails(request: &Request, way: Way, checked: &Checked, trains: &[Train]) -> Result<Vec<Rail>, String> {
    let Some(seeds) = &request.seeds else { return Ok(vec![Rail::Scenario]) };
    if way != Way::Coupled || trains.iter().any(|train| matches!(train.load, Load::Axles(_))) {
        return Err("seeds: they have a meaning for vehicles only: way must be coupled, trains of vehicles".into());
    }
    if !matches!(checked.train_track.irregularity, Profile::Spectrum { .. }) {
        return Err("seeds: the scenario's irregularity must be of type spectrum".into());
    }
    let seeds = list::whole(seeds, LARGEST_SEED).map_err(|error| format!("seeds: {error}"))?;
    // The smooth rail is always run, too.
    Ok([Rail::Smooth].into_iter().chain(seeds.into_iter().map(Rail::Seed)).collect())
}

fn step(
    request: &Request,
    vehicles: bool,
    facts: &Facts,
    trains: &[Train],
    variants: &[Variant],
) -> Result<Option<Step>, String> {
    match &request.step {
        Some(Written::Text(word)) if word == "auto" => {}
        Some(written) => {
            return match written.numbers() {
                Ok(Numbers::These(step)) if step.len() == 1 => Ok(Some(Step::Equal(step[0]))),
                _ => Err("step: it must be `auto` or a number of km/h".into()),
            };
        }
        None if vehicles => return Ok(Some(Step::Equal(STEP_OF_VEHICLES))),
        None => {}
    }
    let longest = trains.iter().filter_map(Train::length).fold(0.0, f64::max);
    let highest = variants.iter().map(|v| (v.stiffness_factor / v.mass_factor).sqrt()).fold(0.0, f64::max);
    Ok(match facts.n0_hz {
        Some(frequency) if longest > 0.0 => Some(Step::Auto { frequency: frequency * highest, length: longest }),
        _ => Some(Step::Equal(STEP_OF_VEHICLES)),
    })
}

/// A plan of one folder as another one names its files, which need not be there yet.
#[must_use]
pub fn moved(plan: Plan, from: &Path, to: &Path) -> Plan {
    if real(from) == real(to) {
        return plan;
    }
    let file = |name: &str| relative(&joined(from, name), to);
    let bridges = plan.bridges.iter().map(|bridge| Foreign { fmu: file(&bridge.fmu), ..bridge.clone() }).collect();
    Plan { scenario: file(&plan.scenario), bridges, ..plan }
}
