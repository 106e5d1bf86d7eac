//! `ttb sweep`: trains × speeds × variants × seeds over one bridge.

pub mod compute;
mod estimate;
mod outcome;
pub mod over_fmu;
mod progress;

use std::path::{Path, PathBuf};

use ttb_campaign::foreign::Named;
use ttb_campaign::list::Written;
use ttb_campaign::plan::Variant;
use ttb_campaign::request::{Choice, Headings, Request, Variants};

use crate::cli::{Sweep, SweepHeading, SweepWay};
use crate::connect::map::maps_fit;
use crate::error::Error;
use crate::signals::Stop;

/// The command.
pub fn sweep(arguments: &Sweep, stop: &Stop) -> Result<(), Error> {
    compute::request(&request(arguments)?, &arguments.common, stop)
}

/// The options as a request.
fn request(arguments: &Sweep) -> Result<Request, Error> {
    let text = |option: &Option<String>| option.clone().map(Written::Text);
    Ok(Request {
        schema: None,
        scenario: arguments.scenario.clone(),
        bridges: bridges(&arguments.bridge, &arguments.map)?,
        set: arguments.set.set.iter().map(|setting| (setting.key.clone(), setting.value.clone())).collect(),
        trains: arguments.trains.as_deref().map(ttb_trains::split).unwrap_or_default(),
        speeds: text(&arguments.speeds),
        step: text(&arguments.step),
        refine: arguments.refine,
        forces: arguments.forces,
        seeds: text(&arguments.seeds),
        variants: arguments.variants.as_deref().map(variants).transpose()?.unwrap_or_default(),
        axes: std::collections::BTreeMap::new(),
        way: match arguments.way {
            SweepWay::Auto => Choice::Auto,
            SweepWay::Modal => Choice::Modal,
            SweepWay::OneAxle => Choice::OneAxle,
            SweepWay::Coupled => Choice::Coupled,
        },
        heading: match arguments.heading {
            SweepHeading::Forward => Headings::Forward,
            SweepHeading::Backward => Headings::Backward,
            SweepHeading::Both => Headings::Both,
        },
        limits: arguments.limits.clone(),
    })
}

/// Every FMU with its map: one for all, or one for each.
fn bridges(fmus: &[PathBuf], maps: &[PathBuf]) -> Result<Vec<Named>, Error> {
    maps_fit(fmus, maps)?;
    let map = |k: usize| if maps.len() > 1 { maps.get(k) } else { maps.first() }.cloned();
    Ok(fmus.iter().enumerate().map(|(k, fmu)| Named { fmu: fmu.clone(), map: map(k) }).collect())
}

/// A word, or a file with a list of variants.
fn variants(text: &str) -> Result<Variants, Error> {
    let path = Path::new(text);
    if path.extension().is_none_or(|ending| ending != "json") {
        return Ok(Variants::Word(text.into()));
    }
    let file = ttb_scenario::read_text(path).map_err(|error| Error::Input(format!("--variants: {text}: {error}")))?;
    let list: Result<Vec<Variant>, _> = serde_json::from_str(&file);
    list.map(Variants::These).map_err(|error| Error::Input(format!("--variants: {text}: {error}")))
}
