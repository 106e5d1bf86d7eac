//! What the page asks for: a scenario, and what is varied.

use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};
use ttb_assessment::Criteria;
use ttb_assessment::criterion::{self, DEFAULT};
use ttb_campaign::expand::LARGEST_SEED;
use ttb_campaign::foreign::Foreign;
use ttb_campaign::limits;
use ttb_campaign::list::{self, Written};
use ttb_campaign::plan::{Plan, Rail, Run};
use ttb_campaign::refused;
use ttb_campaign::request::{Choice, Headings, Request, Variants};
use ttb_scenario::bundled;

use crate::fault::Fault;

/// How the page's scenario is called in messages, plans and saved folders.
pub const SCENARIO: &str = "scenario.json";
/// How the map of its FMU is called.
const MAP: &str = "map.json";

/// A request. What it does not name is as in `ttb sweep`.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Asked {
    /// Text of the scenario.
    pub scenario: String,
    /// Names of trains; none: the scenario's own.
    pub trains: Vec<String>,
    /// km/h; none: the scenario's own.
    pub speeds: Option<Written>,
    /// Step of a range of speeds.
    pub step: Option<Written>,
    /// Whether the largest values are sought between the speeds.
    pub refine: bool,
    /// Seeds of the irregularity.
    pub seeds: Option<Written>,
    /// `bounds`, or nothing.
    pub variants: String,
    /// How runs are computed.
    pub way: Choice,
    /// In which direction trains cross the bridge.
    pub heading: Headings,
    /// Limits by which runs are judged: they decide behind which filters values are made.
    pub limits: Limits,
    /// An FMU of another program in the place of the scenario's bridge.
    pub bridge: Option<Bridge>,
}

/// An FMU of another program in the place of the scenario's bridge.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Bridge {
    /// The FMU on this computer.
    pub fmu: PathBuf,
    /// Text of its map; empty: its variables have our names.
    #[serde(default)]
    pub map: String,
}

impl Asked {
    /// The FMUs of the plan, by whole paths: a folder that is saved may lie anywhere.
    ///
    /// # Errors
    /// One cannot be read.
    pub fn bridges(&self) -> Result<Vec<Foreign>, Fault> {
        let Some(Bridge { fmu, map }) = &self.bridge else { return Ok(Vec::new()) };
        let whole = std::path::absolute(fmu).unwrap_or_else(|_| fmu.clone());
        let map = (!map.trim().is_empty()).then(|| [MAP.into(), map.clone()]);
        Ok(vec![Foreign::new(&whole, map, Path::new("")).map_err(Fault::new)?])
    }

    /// What is wrong with trains, speeds and seeds, a sentence each that begins with the key.
    pub fn problems(&self) -> Vec<String> {
        let mut problems: Vec<String> = Vec::new();
        let vehicles = self.way == Choice::Coupled;
        for name in self.trains.iter().filter(|name| !(vehicles && bundled::cars(name).is_some())) {
            problems.extend(ttb_trains::find(name).err().map(|found| format!("trains: {found}")));
        }
        problems.extend(match &self.speeds {
            Some(speeds) => speeds.numbers().err().map(|error| format!("speeds: {error}")),
            None if vehicles => None,
            None => Some("speeds: axle loads need speeds, such as 140:420:5".into()),
        });
        let seeds = self.seeds.as_ref().and_then(|seeds| list::whole(seeds, LARGEST_SEED).err());
        problems.extend(seeds.map(|error| format!("seeds: {error}")));
        if self.bridge.is_some() {
            problems.extend(refused::over_fmu(&self.request()));
        }
        problems
    }

    /// As a campaign understands it.
    pub fn request(&self) -> Request {
        let variants =
            if self.variants.is_empty() { Variants::default() } else { Variants::Word(self.variants.clone()) };
        Request {
            schema: None,
            scenario: SCENARIO.into(),
            bridges: Vec::new(),
            set: Default::default(),
            trains: self.trains.clone(),
            speeds: self.speeds.clone(),
            step: self.step.clone(),
            refine: self.refine,
            forces: false,
            seeds: self.seeds.clone(),
            variants,
            axes: Default::default(),
            heading: self.heading,
            limits: Vec::new(),
            way: self.way,
        }
    }
}

/// A run of a request, without its id.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Wanted {
    /// Position of its train in the plan.
    pub train: usize,
    /// Position of its variant.
    pub variant: usize,
    /// Irregularity.
    pub rail: Rail,
    /// Speed, km/h; none: the scenario's own.
    pub speed_km_h: Option<f64>,
    /// Whether a refinement asked for it.
    pub refined: bool,
}

impl From<&Run> for Wanted {
    fn from(run: &Run) -> Self {
        let Run { train, variant, rail, speed_km_h, refined, .. } = *run;
        Self { train, variant, rail, speed_km_h, refined }
    }
}

impl Wanted {
    /// The run of a plan.
    ///
    /// # Errors
    /// The plan has no such train or variant.
    pub fn of(self, plan: &Plan) -> Result<Run, Fault> {
        if self.train >= plan.trains.len() || self.variant >= plan.variants.len() {
            return Err(Fault::new("the run belongs to another request: its train or variant is not in the plan"));
        }
        Ok(plan.run(self.train, self.variant, self.rail, self.speed_km_h, self.refined))
    }
}

/// Limits that judge: bundled files by name, and a text of the user's own.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Limits {
    /// Names of bundled files; none: the default set.
    pub names: Vec<String>,
    /// A limits file of the user.
    pub own: Option<String>,
}

impl Limits {
    /// Their texts as a plan keeps them; none where they are the default set.
    ///
    /// # Errors
    /// A name is not known.
    pub fn texts(&self) -> Result<Vec<[String; 2]>, Fault> {
        let default: Vec<String> = DEFAULT.iter().map(|name| (*name).to_string()).collect();
        let names = if self.names.is_empty() { &default } else { &self.names };
        if *names == default && self.own.is_none() {
            return Ok(Vec::new());
        }
        let mut texts = Vec::new();
        for name in names {
            match criterion::text(name) {
                Some(text) => texts.push([name.clone(), text.to_string()]),
                None => {
                    let problems = Criteria::bundled(&[name]).err().unwrap_or_default();
                    return Err(Fault::new(problems.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n")));
                }
            }
        }
        texts.extend(self.own.clone().map(|own| ["limits.json".into(), own]));
        Ok(texts)
    }

    /// The criteria, as `ttb report --limits` takes them.
    ///
    /// # Errors
    /// All problems of names and text.
    pub fn criteria(&self) -> Result<Criteria, Fault> {
        Ok(limits::Limits { texts: self.texts()? }.criteria()?)
    }
}
