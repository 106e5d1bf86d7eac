//! Scenarios, models and resources of FMUs: read, and where they are small built and stepped.

use std::path::Path;

use ttb_bridge::Bridge;
use ttb_contract::{Instance, Model};
use ttb_scenario::Checked;
use ttb_scenario::spec::{BridgeSpec, StructureSpec, TrainTrackSpec};
use ttb_train_track::TrainTrack;

use crate::files::{NOWHERE, names_files};
use crate::parts;

/// Unknowns, bays and cars up to which a model is built: it is the readers that are tried here.
const UNKNOWNS: usize = 400;
const BAYS: usize = 200;
const CARS: usize = 2;

/// A scenario without problems.
pub(crate) fn checked(text: &str, folder: &Path) -> Option<Checked> {
    ttb_scenario::from_str(text, folder, "scenario.json").ok()
}

/// A scenario file, its two models built and stepped.
pub fn scenario(bytes: &[u8]) {
    let Ok(text) = std::str::from_utf8(bytes) else { return };
    if names_files(text) {
        return;
    }
    let Some(checked) = checked(text, Path::new(NOWHERE)) else { return };
    let _ = checked.steps();
    both(&checked);
}

/// A model of finite elements, as the key `model` of a scenario.
pub fn model(bytes: &[u8]) {
    let Ok(model) = std::str::from_utf8(bytes) else { return };
    if names_files(model) {
        return;
    }
    let text = format!(
        r#"{{"train":{{"cars":["ice3-trailer"],"front_wheel":30.0,"speed":{{"m_s":70}}}},"track":{{"type":"slab","bays":100}},
        "bridge":{{"at":39.0,"structure":{{"type":"finite-elements","model":{model}}},"damping":{{"type":"none"}}}},
        "time":{{"step":1e-3,"end":0.01}}}}"#
    );
    let Some(checked) = checked(&text, Path::new(NOWHERE)) else { return };
    bridge(&checked.bridge);
}

fn both(checked: &Checked) {
    bridge(&checked.bridge);
    train_track(&checked.train_track);
}

fn bridge(spec: &BridgeSpec) {
    let elements = match &spec.structure {
        StructureSpec::Beams { spans, .. } => {
            spans.iter().fold(0, |sum: usize, span| sum.saturating_add(span.elements))
        }
        StructureSpec::Frame(frame) => frame.members.len().saturating_mul(4),
        StructureSpec::FiniteElements(model) => model.nodes.len(),
        StructureSpec::Matrices { .. } | StructureSpec::Stored => return,
    };
    if elements <= UNKNOWNS
        && spec.supports.len() <= UNKNOWNS
        && let Ok(bridge) = Bridge::new(spec.clone())
    {
        steps(bridge, spec.step);
    }
}

fn train_track(spec: &TrainTrackSpec) {
    let small = spec.bays <= BAYS && spec.elements_per_bay <= 4 && spec.cars.len() <= CARS && spec.substeps <= 8;
    if small && let Ok(train_track) = TrainTrack::new(spec.clone()) {
        steps(train_track, spec.step);
    }
}

/// Three steps; outputs are finite as long as nothing is refused.
fn steps<M: Model>(model: M, step: f64) {
    let outputs: Vec<u32> = model.interface().outputs().map(|reference| reference as u32).collect();
    let mut instance = Instance::new(model);
    if instance.enter_initialization(0.0).is_err() || instance.exit_initialization().is_err() {
        return;
    }
    let mut values = vec![0.0; outputs.len()];
    for n in 0..4 {
        if instance.get(&outputs, &mut values).is_err() {
            return;
        }
        if let Some(at) = values.iter().position(|value| !value.is_finite()) {
            let name = &instance.model().interface().variables()[outputs[at] as usize].name;
            panic!("{name} is {} after {n} steps, and nothing was said", values[at]);
        }
        if instance.step(f64::from(n) * step, step).is_err() {
            return;
        }
    }
}

/// Resources of our FMUs: the first byte says whose; bridge.json and bridge.bin, or train-track.json.
pub fn resources(bytes: &[u8]) {
    let Some((whose, bytes)) = bytes.split_first() else { return };
    let parts = parts(bytes);
    if parts.iter().filter_map(|part| std::str::from_utf8(part).ok()).any(names_files) {
        return;
    }
    let Ok(folder) = tempfile::tempdir() else { return };
    let put = |name: &str, part: &[u8]| std::fs::write(folder.path().join(name), part).is_ok();
    if whose % 2 == 0 {
        let (json, binary) = (parts[0], parts.get(1).copied().unwrap_or_default());
        let stored = put("bridge.json", json) && (binary.is_empty() || put("bridge.bin", binary));
        if stored
            && !asks_for_more(json, "elements", UNKNOWNS)
            && let Ok(bridge) = Bridge::load(folder.path())
        {
            let step = bridge.default_experiment().0;
            steps(bridge, step);
        }
    } else if put("train-track.json", parts[0])
        && !asks_for_more(parts[0], "bays", BAYS)
        && let Ok(train_track) = TrainTrack::load(folder.path())
    {
        let step = train_track.default_experiment().0;
        steps(train_track, step);
    }
}

/// Whether a key asks for more than a model of the targets has and less than is refused: slow, not wrong.
fn asks_for_more(json: &[u8], key: &str, most: usize) -> bool {
    let text = String::from_utf8_lossy(json);
    text.match_indices(key).any(|(at, _)| {
        let rest = text[at + key.len()..].trim_start_matches(|c: char| !c.is_ascii_digit());
        let digits = rest.len() - rest.trim_start_matches(|c: char| c.is_ascii_digit()).len();
        rest[..digits].parse::<usize>().is_ok_and(|number| (most + 1..1 << 40).contains(&number))
    })
}
