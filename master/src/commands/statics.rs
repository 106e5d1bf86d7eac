//! `ttb static`: a load model or a train wherever it acts worst, by influence lines.

use std::fmt::Write;

use ttb_passage::{Extreme, Heading, ModalBridge, Output, Passage, PlaceKind, Quantity, Settings, statics};
use ttb_scenario::nearest;
use ttb_trains::{find_all, load_model, load_model_names, split};

use crate::cli::Static;
use crate::error::Error;
use crate::files;
use crate::prepare::fmus;

/// The command.
pub fn compute(arguments: &Static) -> Result<(), Error> {
    let checked = fmus::scenario(Some(&arguments.scenario), &arguments.set)?;
    if !(arguments.alpha > 0.0 && arguments.alpha.is_finite()) {
        return Err(Error::Input(format!("--alpha must be positive: {}", arguments.alpha)));
    }
    let settings = Settings { forces: true, ..Settings::default() };
    let bridge = ModalBridge::of_statics(&checked.bridge, &settings).map_err(|e| Error::Input(e.to_string()))?;
    let mut table = String::from("load,quantity,place_kind,place,x_m,max,max_at_m,min,min_at_m,unit\n");
    for (name, found) in loads(&bridge, arguments)? {
        show(&bridge, &name, &found);
        for (Output { quantity, place }, e) in bridge.outputs().iter().zip(&found) {
            let x = place.x.map_or(String::new(), |x| x.to_string());
            let Extreme { max, max_time, min, min_time } = e;
            let (kind, unit) = (place.kind.name(), quantity.unit());
            let _ =
                writeln!(table, "{name},{quantity},{kind},{},{x},{max},{max_time},{min},{min_time},{unit}", place.name);
        }
    }
    if let Some(path) = &arguments.output {
        files::write(path, table.as_bytes())?;
    }
    Ok(())
}

/// Name and extremes of what is to be computed: a load model, or one train or more.
fn loads(bridge: &ModalBridge, arguments: &Static) -> Result<Vec<(String, Vec<Extreme>)>, Error> {
    if let Some(model) = load_model(&arguments.load) {
        let name = model.name.clone();
        note!("ttb: {}: {} ({})", model.name, model.source, model.verified);
        return Ok(vec![(name, statics::extremes(bridge, &model.scaled(arguments.alpha)))]);
    }
    let names = split(&arguments.load);
    let trains = find_all(names.iter().map(String::as_str)).map_err(|mut problems| {
        // A load model may have been meant.
        for problem in problems.0.iter_mut().filter(|problem| problem.suggestion.is_none()) {
            problem.suggestion = nearest(&arguments.load, load_model_names().iter().map(String::as_str));
        }
        Error::Scenario(problems)
    })?;
    let static_of = |mut train: ttb_trains::ForceTrain| {
        train.axles.iter_mut().for_each(|axle| axle.load *= arguments.alpha);
        let found = Passage::new(bridge, &train, Heading::Forward, None).statics().to_vec();
        (train.name, found)
    };
    Ok(trains.into_iter().map(static_of).collect())
}

/// The largest over the deck, the scenario's points, the bearings.
fn show(bridge: &ModalBridge, name: &str, found: &[Extreme]) {
    let rows = || bridge.outputs().iter().zip(found);
    say!("{name}: static, by influence lines");
    for quantity in Quantity::ALL {
        let (scale, unit) = match quantity {
            Quantity::Displacement => (1e3, "mm"),
            Quantity::Moment => (1e-3, "kN m"),
            _ => (1e-3, "kN"),
        };
        let of = || rows().filter(move |(output, _)| output.quantity == quantity);
        let on_deck = || of().filter(|(output, _)| output.place.kind == PlaceKind::Deck);
        let most = on_deck().max_by(|a, b| a.1.max.total_cmp(&b.1.max));
        let least = on_deck().min_by(|a, b| a.1.min.total_cmp(&b.1.min));
        if let (Some((top, most)), Some((bottom, least))) = (most, least) {
            let (top, bottom) = (&top.place.name, &bottom.place.name);
            say!(
                "  {:<18} max {:>12.4} {unit} at x = {top} m,  min {:>12.4} {unit} at x = {bottom} m",
                quantity.name(),
                scale * most.max,
                scale * least.min
            );
        }
        for (output, e) in of().filter(|(output, _)| output.place.kind != PlaceKind::Deck) {
            let place = format!("{} {}", output.place.kind.name(), output.place.name);
            let (max, min) = (scale * e.max, scale * e.min);
            say!("  {:<18} max {max:>12.4} {unit},  min {min:>12.4} {unit}  at {place}", quantity.name());
        }
    }
}
