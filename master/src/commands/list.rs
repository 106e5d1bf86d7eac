//! `ttb list`: what comes with the program, by kind; the data of one.

use ttb_scenario::bundled::{Kind, files};
use ttb_trains::{ForceTrain, find, load_model, load_model_names, names::TRAINS};

use super::limits;
use super::listed::{json, unknown};
use crate::cli::{List, Listed};
use crate::error::Error;

/// The command.
pub fn list(arguments: &List) -> Result<(), Error> {
    match arguments.what {
        Listed::Trains => trains(arguments),
        Listed::LoadModels => load_models(arguments),
        Listed::Cars => data(Kind::Cars, "car", arguments),
        Listed::Tracks => data(Kind::Tracks, "track", arguments),
        Listed::Spectra => data(Kind::Spectra, "spectrum", arguments),
        Listed::Bridges => data(Kind::Bridges, "bridge", arguments),
        Listed::Limits => limits::files(arguments),
        Listed::Criteria => limits::criteria(arguments),
    }
}

fn trains(arguments: &List) -> Result<(), Error> {
    let one = arguments.name.is_some();
    let trains = match &arguments.name {
        Some(name) => find(name).map_err(Error::Scenario)?,
        None => TRAINS.clone(),
    };
    if arguments.json {
        return json(&trains.iter().map(written).collect::<Vec<_>>());
    }
    if arguments.axles {
        // One train is a file that can be read again; of several each row names its own.
        let several = trains.len() > 1;
        say!("{}x,load", if several { "train," } else { "" });
        for train in &trains {
            let name = if several { format!("{},", train.name) } else { String::new() };
            train.axles.iter().for_each(|axle| say!("{name}{},{}", rounded(axle.x), rounded(1e-3 * axle.load)));
        }
        return Ok(());
    }
    say!("{:<18} {:>6} {:>10} {:>10} {:>8} {:>9}  title", "train", "axles", "first–last", "sum", "coach", "top speed");
    say!("{:<18} {:>6} {:>10} {:>10} {:>8} {:>9}", "", "", "m", "kN", "m", "km/h");
    for train in &trains {
        let (length, sum) = (rounded(train.length()), rounded(1e-3 * train.total()));
        let [coach, speed] = [train.coach, train.max_speed.map(|v| 3.6 * v)].map(or_dash);
        let (name, axles) = (&train.name, train.axles.len());
        say!("{name:<18} {axles:>6} {length:>10} {sum:>10} {coach:>8} {speed:>9}  {}", train.title);
    }
    if one {
        trains.iter().for_each(|train| say!("{}: {} ({})", train.name, train.source, train.verified));
    } else {
        say!(
            "Families: hslm-a, annex-d, en15528. By numbers: hslm-b:N,d. Several wagons: en15528-d2x6. Or a file, CSV or JSON."
        );
    }
    Ok(())
}

/// A train in the form of a user's file.
fn written(train: &ForceTrain) -> serde_json::Value {
    let axles: Vec<[f64; 2]> = train.axles.iter().map(|axle| [rounded(axle.x), rounded(1e-3 * axle.load)]).collect();
    serde_json::json!({
        "name": train.name, "title": train.title, "max_speed_km_h": train.max_speed.map(|v| rounded(3.6 * v)),
        "coach": train.coach, "axles": axles, "source": train.source, "verified": train.verified,
    })
}

/// Without the last digits that sums leave.
fn rounded(value: f64) -> f64 {
    (value * 1e6).round() / 1e6
}

fn or_dash(value: Option<f64>) -> String {
    value.map_or("–".into(), |value| rounded(value).to_string())
}

fn load_models(arguments: &List) -> Result<(), Error> {
    let models = load_model_names();
    let chosen: Vec<_> = match &arguments.name {
        Some(name) => match load_model(name) {
            Some(model) => vec![model],
            None => return Err(unknown("load model", name, models.iter().map(String::as_str))),
        },
        None => models.iter().filter_map(|name| load_model(name)).collect(),
    };
    if arguments.json {
        return json(&chosen);
    }
    for model in &chosen {
        say!("{:<6} {} ({}: {})", model.name, model.title, model.verified, model.source);
    }
    Ok(())
}

/// Data files of scenarios: name and source, or the file itself.
fn data(kind: Kind, what: &str, arguments: &List) -> Result<(), Error> {
    let all = files(kind);
    if let Some(name) = &arguments.name {
        let found = all.iter().find(|(known, _)| known == name);
        let (_, text) = found.ok_or_else(|| unknown(what, name, all.iter().map(|(name, _)| *name)))?;
        say!("{}", text.trim_end());
        return Ok(());
    }
    let parsed = |text: &str| serde_json::from_str::<serde_json::Value>(text).unwrap_or_default();
    if arguments.json {
        let map: serde_json::Map<String, serde_json::Value> =
            all.iter().map(|(name, text)| ((*name).to_string(), parsed(text))).collect();
        return json(&map);
    }
    for (name, text) in all {
        say!("{name:<20} {}", parsed(text)["source"].as_str().unwrap_or_default());
    }
    Ok(())
}
