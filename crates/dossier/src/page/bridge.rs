//! The bridge of a report: bearings, points, inputs with their units, modes with their shapes.

use ttb_campaign::foreign::{self, Foreign};
use ttb_passage::{ModalBridge, modal};
use ttb_report::{Bridge, ModeShape, Property};
use ttb_scenario::Checked;
use ttb_scenario::deck::Deck;
use ttb_scenario::spec::StructureSpec;
use ttb_scenario::types::Damping;

use crate::folder::Opened;

/// Modes that are shown at most, and points of a shape.
const MODES: usize = 8;
const SHAPE: usize = 60;

/// The bridge, and its modes where it has some.
pub fn of(opened: &Opened) -> (Option<Bridge>, Option<ModalBridge>) {
    let Some(checked) = &opened.checked else { return (None, None) };
    let Some(deck) = Deck::new(&checked.bridge.structure) else { return (None, None) };
    // A foreign FMU stands for the scenario's bridge: nothing of that one is shown.
    if opened.over_fmu {
        return (None, None);
    }
    let modal = ModalBridge::new(&checked.bridge, &modal::Settings::default()).ok();
    let mut bearings = vec![0.0];
    bearings.extend(deck.inner_bearings.iter().copied());
    bearings.push(deck.length);
    let points = checked.bridge.points.iter().filter_map(|point| Some((point.name.clone(), point.x?))).collect();
    let modes = modal.as_ref().map(|modal| shapes(modal, deck.length)).unwrap_or_default();
    (Some(Bridge { length: deck.length, bearings, points, properties: properties(checked), modes }), modal)
}

/// FMUs in the place of the scenario's bridge, and their maps, as the summary of a run or the plan of a sweep names them.
pub fn given(opened: &Opened) -> Vec<Property> {
    let row = |name: &str, value: &str, sha256: &str| Property {
        name: name.into(),
        value: value.into(),
        unit: String::new(),
        source: format!("SHA-256 {sha256}"),
    };
    let inputs = opened.summary.as_ref().and_then(|summary| summary["inputs"].as_array()).into_iter().flatten();
    let of_run = inputs.filter_map(|input| {
        let name = match input["role"].as_str()? {
            "bridge" => "bridge FMU",
            "map" => "map of the FMU",
            _ => return None,
        };
        Some(row(name, input["path"].as_str()?, input["sha256"].as_str()?))
    });
    let bridges = opened.plan.as_ref().map(|plan| plan["bridges"].clone()).unwrap_or_default();
    let bridges: Vec<Foreign> = serde_json::from_value(bridges).unwrap_or_default();
    let of_plan = bridges.iter().flat_map(|bridge| {
        let map = bridge.map.as_ref().map(|[name, text]| row("map of the FMU", name, &foreign::of_text(text)));
        std::iter::once(row("bridge FMU", &bridge.fmu, &bridge.sha256)).chain(map)
    });
    of_run.chain(of_plan).collect()
}

fn shapes(modal: &ModalBridge, length: f64) -> Vec<ModeShape> {
    let places: Vec<f64> = (0..=SHAPE).map(|i| length * i as f64 / SHAPE as f64).collect();
    let rows: Vec<Vec<f64>> = places.iter().map(|x| modal.lines().at(*x)).collect();
    let of = |(at, oscillator): (usize, &ttb_passage::recursion::Oscillator)| {
        let shape: Vec<f64> = rows.iter().map(|row| row[at]).collect();
        let most = shape.iter().map(|y| y.abs()).fold(0.0, f64::max).max(f64::MIN_POSITIVE);
        ModeShape {
            frequency: oscillator.omega / std::f64::consts::TAU,
            damping: Some(0.5 * oscillator.rate / oscillator.omega),
            shape: places.iter().zip(shape).map(|(x, y)| [*x, y / most]).collect(),
        }
    };
    modal.modes().iter().enumerate().take(MODES).map(of).collect()
}

fn properties(checked: &Checked) -> Vec<Property> {
    let mut list = Vec::new();
    let mut add = |name: String, value: String, unit: &str| {
        list.push(Property { name, value, unit: unit.into(), source: "scenario".into() });
    };
    match &checked.bridge.structure {
        StructureSpec::Beams { spans, continuous } => {
            let kind = if *continuous { "continuous beam" } else { "simply supported beams" };
            add("structure".into(), kind.into(), "");
            for (i, span) in spans.iter().enumerate() {
                let n = i + 1;
                add(format!("span {n}, length"), span.length.to_string(), "m");
                add(format!("span {n}, bending stiffness"), format!("{:.6e}", span.bending_stiffness), "N m²");
                add(format!("span {n}, mass"), span.mass.to_string(), "kg/m");
            }
        }
        StructureSpec::Frame(frame) => {
            add("structure".into(), "plane frame".into(), "");
            add("nodes".into(), frame.nodes.len().to_string(), "");
            add("members".into(), frame.members.len().to_string(), "");
        }
        StructureSpec::FiniteElements(model) => {
            add("structure".into(), "finite elements in space".into(), "");
            add("length of the deck".into(), model.deck.length.to_string(), "m");
        }
        StructureSpec::Matrices { length, .. } => {
            add("structure".into(), "imported matrices".into(), "");
            add("length of the deck".into(), length.to_string(), "m");
        }
        StructureSpec::Stored => {}
    }
    let damping = match &checked.bridge.damping {
        Damping::None => "none".into(),
        Damping::Rayleigh { ratio, .. } => format!("Rayleigh, ratio {ratio}"),
        Damping::Modal { ratio, modes } => format!("ratio {ratio} in {modes} modes"),
    };
    add("damping".into(), damping, "");
    add("step".into(), checked.steps().step.to_string(), "s");
    list
}
