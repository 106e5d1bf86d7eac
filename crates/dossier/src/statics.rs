//! Static load models on the bridge of a scenario, by influence lines; the static values of its own train.
//!
//! ```text
//! θ of an end   w(ε)/ε at ε = L/1000 from the end, where the end rests on a bearing that does not yield
//! ```

use ttb_assessment::peak::quantity::DECK_ROTATION;
use ttb_assessment::{LoadCase, Peak, PlaceKind, Statics, Statistic};
use ttb_passage::{Extreme, Heading, ModalBridge, Output, Passage, PlaceKind as Kind, Quantity, Settings, statics};
use ttb_scenario::Checked;
use ttb_scenario::deck::Deck;
use ttb_scenario::spec::{BridgeSpec, StructureSpec};
use ttb_scenario::types::{Direction, Point};
use ttb_trains::{ForceTrain, load_model};

/// Larger models are not solved in passing: nodes of elements in space, bytes of a file of K.
const NODES: usize = 4000;
const BYTES: u64 = 40_000_000;
/// Distance from an end at which its rotation is read, over the length of the deck.
const NEAR: f64 = 1e-3;
/// What names of added points begin with; a scenario's names cannot.
const END: &str = "@end ";

/// LM71, and SW/0 where the deck may be continuous.
pub fn of(checked: &Checked) -> Statics {
    if is_large(&checked.bridge) {
        return unknown("the model is large: `ttb static --load lm71` computes its static answer");
    }
    let mut spec = checked.bridge.clone();
    add_ends(&mut spec);
    let bridge = match ModalBridge::of_statics(&spec, &settings()) {
        Ok(bridge) => bridge,
        Err(error) => return unknown(&format!("static load models: {error}")),
    };
    let bearings = bridge.outputs().iter().filter(|output| output.place.kind == Kind::Bearing);
    let held: Vec<f64> = bearings.filter_map(|output| output.place.x).collect();
    let simple =
        matches!(&spec.structure, StructureSpec::Beams { spans, continuous } if !continuous || spans.len() == 1);
    let names: &[(&str, &str)] = if simple { &[("lm71", "LM71")] } else { &[("lm71", "LM71"), ("sw0", "SW/0")] };
    let case = |(name, title): &(&str, &str)| {
        let found = statics::extremes(&bridge, &load_model(name)?);
        let outputs = bridge.outputs().iter().zip(&found);
        let rows = outputs.flat_map(|(output, extreme)| rows(output, extreme, &held, NEAR * bridge.length())).collect();
        Some(LoadCase { name: (*title).into(), rows })
    };
    Statics { cases: names.iter().filter_map(case).collect(), reason: None }
}

/// None, and why.
pub fn unknown(reason: &str) -> Statics {
    Statics { cases: Vec::new(), reason: Some(reason.into()) }
}

/// Gives every point of the deck among the rows the static value of the scenario's train.
pub fn add_own(checked: &Checked, rows: &mut [Peak]) {
    let train = ForceTrain::of_vehicles("", "", &checked.train_track.consist());
    if train.axles.is_empty() || is_large(&checked.bridge) {
        return;
    }
    // Rows along the deck are at places of their own.
    let mut spec = checked.bridge.clone();
    let on_deck = |row: &&Peak| row.place_kind == PlaceKind::Deck && row.statistic != Statistic::AbsMax;
    let places: Vec<f64> = rows.iter().filter(on_deck).filter_map(|row| row.x).collect();
    spec.points.extend(places.iter().map(|x| point(format!("{END}{x}"), *x)));
    let Ok(bridge) = ModalBridge::of_statics(&spec, &settings()) else { return };
    let passage = Passage::new(&bridge, &train, Heading::Forward, None);
    for row in rows {
        let name = match (row.place_kind, row.x) {
            (PlaceKind::Point, _) => row.place.to_string(),
            (PlaceKind::Deck, Some(x)) => format!("{END}{x}"),
            _ => continue,
        };
        let is = |output: &Output| output.quantity.name() == row.quantity && output.place.name == name;
        let found = bridge.outputs().iter().zip(passage.statics());
        let found = found.filter(|(output, _)| output.place.kind == Kind::Point).find(|(output, _)| is(output));
        row.static_value = match (found, row.statistic) {
            (Some((_, extreme)), Statistic::Max) => Some(extreme.max),
            (Some((_, extreme)), Statistic::Min) => Some(extreme.min),
            _ => None,
        };
    }
}

fn point(name: String, x: f64) -> Point {
    Point { name, x: Some(x), node: None, direction: Direction::Z }
}

fn settings() -> Settings {
    Settings { forces: true, ..Settings::default() }
}

fn is_large(spec: &BridgeSpec) -> bool {
    match &spec.structure {
        StructureSpec::FiniteElements(model) => model.nodes.len() > NODES,
        StructureSpec::Matrices { files, folder, .. } => {
            std::fs::metadata(folder.join(&files.stiffness)).is_ok_and(|file| file.len() > BYTES)
        }
        _ => false,
    }
}

/// Adds points beside the ends of the deck, and beside the joints of simple spans.
fn add_ends(spec: &mut BridgeSpec) {
    let Some(deck) = Deck::new(&spec.structure) else { return };
    let e = NEAR * deck.length;
    let mut places = vec![(0.0, e), (deck.length, deck.length - e)];
    if let StructureSpec::Beams { spans, continuous: false } = &spec.structure {
        let mut joint = 0.0;
        for span in &spans[..spans.len() - 1] {
            joint += span.length;
            places.extend([(joint, joint - e), (joint, joint + e)]);
        }
    }
    spec.points.extend(places.into_iter().map(|(end, x)| point(format!("{END}{end}"), x)));
}

/// The greatest and the least value of an output; of a point beside an end the end's rotation.
fn rows(output: &Output, extreme: &Extreme, held: &[f64], e: f64) -> Vec<Peak> {
    let (kind, place) = match output.place.kind {
        Kind::Deck => (PlaceKind::Deck, output.place.name.clone()),
        Kind::Bearing => (PlaceKind::Bearing, output.place.name.clone()),
        Kind::Point => match (output.place.name.strip_prefix(END), output.quantity) {
            (Some(end), Quantity::Displacement) => return rotation(end, extreme, held, e),
            _ => return Vec::new(),
        },
    };
    let row = |statistic, value| Peak {
        place: place.clone().into(),
        x: output.place.x,
        unit: output.quantity.unit().into(),
        ..Peak::raw(output.quantity.name(), kind, statistic, value)
    };
    vec![row(Statistic::Max, extreme.max), row(Statistic::Min, extreme.min)]
}

fn rotation(end: &str, extreme: &Extreme, held: &[f64], e: f64) -> Vec<Peak> {
    let at = end.parse::<f64>().ok().filter(|at| held.iter().any(|x| (x - at).abs() < 1e-6));
    let Some(at) = at else { return Vec::new() };
    let value = extreme.max.abs().max(extreme.min.abs()) / e;
    let row = Peak::raw(DECK_ROTATION, PlaceKind::Deck, Statistic::AbsMax, value);
    vec![Peak { place: format!("end at x = {end} m").into(), x: Some(at), unit: "rad".into(), ..row }]
}
