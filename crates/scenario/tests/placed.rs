//! A scenario that leaves out start, track and end is placed; one that does not fit says which value would do.

use std::path::Path;

use serde_json::{Value, json};
use ttb_scenario::passage::on_bridge;
use ttb_scenario::spec::StructureSpec;
use ttb_scenario::travel::{distance, fade_in, wheel_offsets};
use ttb_scenario::{Checked, Problems, from_str, spans};

/// A bridge, a train and a speed.
fn short() -> Value {
    json!({
        "train": { "cars": ["ice3"], "speed": { "km_h": 250 } },
        "bridge": {
            "structure": { "type": "beams", "spans": [{ "length": 25, "first_frequency": 4, "mass": 15000 }] },
            "damping": { "type": "rayleigh", "ratio": 0.01 }
        }
    })
}

fn check(scenario: &Value) -> Result<Checked, Problems> {
    from_str(&scenario.to_string(), &Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/broken"), "f")
}

fn checked(scenario: &Value) -> Checked {
    check(scenario).unwrap_or_else(|problems| panic!("{problems}"))
}

fn changed(pointer: &str, value: Value) -> Value {
    let mut scenario = short();
    let (parent, key) = pointer.rsplit_once('/').unwrap();
    scenario.pointer_mut(parent).unwrap()[key] = value;
    scenario
}

fn spans_of(checked: &Checked) -> &[ttb_scenario::spec::Span] {
    let StructureSpec::Beams { spans, .. } = &checked.bridge.structure else { panic!("beams") };
    spans
}

/// 250 km/h are 69.444 m/s; the ice3 has 193.3 m from first to last wheel; ζ = 1 % halves a motion in 11.03 periods of 0.25 s.
#[test]
fn a_span_a_train_and_a_speed_are_enough() {
    let found = checked(&short());
    assert_eq!(found.warnings, Vec::<String>::new());
    let train = &found.train_track;
    assert_eq!((train.front_wheel, train.pre_roll), (-35.0, 0.0));
    let off = (35.0 + 25.0 + 193.3) / (250.0 / 3.6);
    assert_eq!(found.scenario.time.free_vibration, Some(2.76));
    assert!((off + 2.76..off + 2.77).contains(&train.end), "{}", train.end);
    assert_eq!(found.peaks[0], 35.0 / (250.0 / 3.6));
    assert!((found.peaks[1] - off - 2.76).abs() < 1e-9, "{:?}", found.peaks);
    // 15 m of rail, and less than a bay more, beyond the wheels; a support stands over the abutment, on the ground
    let spacing = train.track.spacing;
    let (rear, to) = (-35.0 - 193.3 - train.from, train.from + train.bays as f64 * spacing);
    let beyond = to + 35.0 - distance(&train.speed, train.end);
    assert!((15.0..15.0 + spacing).contains(&rear) && (15.0..15.0 + spacing).contains(&beyond), "{rear} {beyond}");
    assert!((found.bridge.supports[0] - spacing).abs() < 1e-9, "{:?}", found.bridge.supports);
    assert!((spans::first_frequency(&found.bridge.structure).unwrap() - 4.0).abs() < 1e-12);
    // ω² = (π/L)⁴ EI/m
    let stiffness = (2.0 * std::f64::consts::PI * 4.0).powi(2) * 15e3 * (25.0 / std::f64::consts::PI).powi(4);
    assert!((spans_of(&found)[0].bending_stiffness / stiffness - 1.0).abs() < 1e-12);
    assert_eq!(found.bridge.points[0].name, "mid");
    assert_eq!(found.bridge.points[0].x, Some(12.5));
    let keys: Vec<&str> = found.chosen.iter().map(|chosen| chosen.key.as_str()).collect();
    let all = ["track.type", "time.step", "bridge.points", "time.free_vibration", "train.front_wheel", "time.end"];
    assert_eq!(keys, [&all[..], &["track.from", "track.bays"]].concat());
    // what was chosen, written in, is the same scenario
    let written = serde_json::to_string(&found.scenario).unwrap();
    let again = from_str(&written, Path::new(""), "written").unwrap_or_else(|p| panic!("{p}"));
    assert_eq!((again.hash, again.peaks), (found.hash, found.peaks));
    assert!(again.chosen.is_empty(), "{:?}", again.chosen);
}

/// Wherever the bridge lies, whatever the train does: all of it stands on rail, and the passage is complete.
#[test]
fn every_passage_is_complete_and_without_warnings() {
    for at in [-1000.0, 0.0, 12.34, 1e5] {
        for speed in [json!({ "m_s": 3 }), json!({ "km_h": 420 }), json!({ "profile": [[0, 80], [2, 80], [6, 20]] })] {
            for cars in [json!(["manchester"]), json!(["ice3", "ice3"])] {
                for rough in [false, true] {
                    let mut scenario = changed("/bridge/at", json!(at));
                    (scenario["train"]["speed"], scenario["train"]["cars"]) = (speed.clone(), cars.clone());
                    if rough {
                        scenario["irregularity"] = json!({ "type": "spectrum", "spectrum": "german-low", "seed": 1,
                            "wavelengths": [3, 80] });
                    }
                    let found = checked(&scenario);
                    assert_eq!(found.warnings, Vec::<String>::new(), "{scenario}");
                    let train = &found.train_track;
                    let [on, off] = on_bridge(train, at, 25.0);
                    assert!(0.0 < on && on < off && off < train.end, "{on} {off} {}", train.end);
                    assert_eq!(train.pre_roll > 0.0, rough);
                    // grown under the last wheel when the run starts
                    let last = *wheel_offsets(&train.cars).last().unwrap();
                    let length = train.cars.iter().map(|car| car.length).sum();
                    let grown = fade_in(train.front_wheel, last, length, train.pre_roll) + 20.0;
                    assert!(grown <= train.front_wheel - last, "{grown}");
                }
            }
        }
    }
}

#[test]
fn a_train_that_stops_before_it_has_passed_needs_an_end() {
    let found = check(&changed("/train/speed", json!({ "profile": [[0, 20], [5, 0]] }))).unwrap_err();
    assert_eq!(found.0.len(), 1, "{found}");
    assert_eq!(found.0[0].path, "$.time.end");
    assert!(found.0[0].rule.starts_with("must be given: the train comes to a stop"), "{found}");
    let mut standing = changed("/train/speed", json!({ "m_s": 0 }));
    standing["time"] = json!({ "end": 1 });
    standing["train"]["front_wheel"] = json!(10);
    let found = checked(&standing);
    assert_eq!((found.peaks, found.warnings.len()), ([0.0, 1.0], 0));
}

/// Two and three equal spans swing first as one of them does; of unequal ones the stiffness is multiplied as a whole.
#[test]
fn a_first_frequency_gives_the_stiffness_of_continuous_beams_too() {
    let with = |spans: Value| {
        let mut scenario = short();
        let structure = json!({ "type": "beams", "continuous": true, "first_frequency": 3.5, "spans": spans });
        scenario["bridge"]["structure"] = structure;
        checked(&scenario)
    };
    let equal = with(json!([{ "length": 25, "mass": 15000 }, { "length": 25, "mass": 15000 }]));
    let simple = (2.0 * std::f64::consts::PI * 3.5).powi(2) * 15e3 * (25.0 / std::f64::consts::PI).powi(4);
    assert!((spans_of(&equal)[1].bending_stiffness / simple - 1.0).abs() < 1e-9);
    let unequal = with(
        json!([{ "length": 20, "mass": 15000, "bending_stiffness": 2 }, { "length": 30, "mass": 15000, "bending_stiffness": 3 }]),
    );
    assert!((spans::first_frequency(&unequal.bridge.structure).unwrap() / 3.5 - 1.0).abs() < 1e-12);
    let [a, b] = spans_of(&unequal) else { panic!("two spans") };
    assert!((b.bending_stiffness / a.bending_stiffness - 1.5).abs() < 1e-12);
    let names: Vec<&str> = unequal.bridge.points.iter().map(|point| point.name.as_str()).collect();
    assert_eq!(names, ["mid1", "mid2"]);
}

#[test]
fn stiffness_or_frequency_and_each_where_it_belongs() {
    let problems = |structure: Value| {
        let found = check(&changed("/bridge/structure", structure)).unwrap_err();
        found.0.into_iter().map(|p| (p.path, p.rule)).collect::<Vec<_>>()
    };
    let span = |more: Value| {
        let mut span = json!({ "length": 25, "mass": 15000 });
        more.as_object().unwrap().iter().for_each(|(key, value)| span[key] = value.clone());
        span
    };
    let both = span(json!({ "bending_stiffness": 1e10, "first_frequency": 4 }));
    let soft = span(json!({ "first_frequency": 4, "shear_stiffness": 1e8 }));
    let found = problems(json!({ "type": "beams", "first_frequency": 4, "spans": [both, span(json!({})), soft] }));
    let expected = [
        (
            "$.bridge.structure.first_frequency",
            "simply supported spans have a first frequency each: first_frequency belongs into the spans",
        ),
        ("$.bridge.structure.spans[0]", "a span has either bending_stiffness or first_frequency"),
        ("$.bridge.structure.spans[1]", "a span needs its bending_stiffness or its first_frequency"),
        (
            "$.bridge.structure.spans[2].first_frequency",
            "a span that is so soft in shear cannot have this first frequency",
        ),
    ];
    assert_eq!(found, expected.map(|(path, rule)| (path.to_string(), rule.to_string())));
    let found =
        problems(json!({ "type": "beams", "continuous": true, "spans": [span(json!({ "first_frequency": 4 }))] }));
    assert_eq!(found[0].0, "$.bridge.structure.spans[0].first_frequency");
}

#[test]
fn a_pre_roll_keeps_to_the_measured_profile_and_a_fade_in_on_the_bridge_is_told() {
    let measured = json!({ "type": "measured", "file": "short.csv" });
    let found = checked(&changed("/irregularity", measured));
    // it begins at 0 m, and the train stands before: no pre-roll is covered
    assert_eq!(found.train_track.pre_roll, 0.0);
    let ramp = json!({ "start": -10, "length": 12 });
    let waves =
        json!({ "type": "harmonics", "waves": [{ "amplitude": 1e-3, "wavelength": 10 }], "origin": 0, "ramp": ramp });
    let found = checked(&changed("/irregularity", waves));
    assert_eq!(
        found.warnings,
        [
            "the irregularity grows to its size from -10.0 to 2.0 m, on the bridge from 0 to 25 m: begin it at -12.0 m or before"
        ]
    );
}

#[test]
fn peaks_count_from_where_the_scenario_says() {
    let peaks = |from: Value| checked(&changed("/output", json!({ "peaks_from": from })));
    let end = checked(&short()).train_track.end;
    assert_eq!(peaks(json!("start")).peaks, [0.0, end]);
    assert_eq!(peaks(json!(0.5)).peaks, [0.5, end]);
    assert_eq!(peaks(json!("bridge")).peaks, checked(&short()).peaks);
    let mut early = short();
    early["time"] = json!({ "end": 0.3 });
    let found = checked(&early);
    assert_eq!(found.peaks, [0.0, 0.3]);
    let told = |text: &str| found.warnings.iter().any(|warning| warning.starts_with(text));
    assert!(told("no wheel is on the bridge during the run"), "{:?}", found.warnings);
    assert!(told("$.time.end: the train never reaches the bridge"), "{:?}", found.warnings);
}

/// A problem's number, put in, leaves no problem.
#[test]
fn every_problem_of_geometry_names_a_value_that_does() {
    let track = |from: f64, bays: usize| json!({ "type": "slab", "from": from, "bays": bays });
    let number = |text: &str, key: &str| -> f64 {
        let after = text.split(&format!("{key} ")).nth(1).unwrap_or_else(|| panic!("{key}: {text}"));
        let end = after.find(|c: char| !(c.is_ascii_digit() || c == '.' || c == '-')).unwrap_or(after.len());
        after[..end].trim_end_matches('.').parse().unwrap_or_else(|_| panic!("{after}"))
    };
    let only = |scenario: &Value| {
        let found = check(scenario).unwrap_err();
        assert_eq!(found.0.len(), 1, "{found}");
        found.0[0].clone()
    };
    let mut scenario = short();
    (scenario["train"]["front_wheel"], scenario["track"], scenario["time"]) =
        (json!(-35), track(-100.0, 1000), json!({ "end": 4 }));
    let told = only(&scenario).value;
    for (pointer, key) in [("/train/front_wheel", "front_wheel"), ("/track/from", "track.from")] {
        let mut mended = scenario.clone();
        *mended.pointer_mut(pointer).unwrap() = json!(number(&told, key));
        if key == "front_wheel" {
            mended["bridge"]["at"] = json!(200);
        }
        // The run is too short for the bridge that was moved away.
        let warnings = checked(&mended).warnings;
        assert!(
            warnings.iter().all(|warning| warning.starts_with("$.time.end: the run ends before")),
            "{key}: {warnings:?}"
        );
    }
    scenario["track"] = track(-250.0, 500);
    scenario["time"] = json!({ "end": 6 });
    let told = only(&scenario);
    assert_eq!(told.path, "$.time.end");
    for (pointer, key) in [("/track/bays", "track.bays"), ("/time/end", "time.end")] {
        let mut mended = scenario.clone();
        let value = number(&told.value, key);
        *mended.pointer_mut(pointer).unwrap() = if key == "track.bays" { json!(value as usize) } else { json!(value) };
        let warnings = checked(&mended).warnings;
        assert!(
            warnings.iter().all(|warning| warning.starts_with("$.time.end: the run ends before")),
            "{key}: {warnings:?}"
        );
    }
    // all at once: too short a track that lies elsewhere, and a bridge beside it
    let mut scenario = short();
    scenario["track"] = track(40.0, 100);
    scenario["bridge"]["at"] = json!(0);
    let found = check(&scenario).unwrap_err();
    let paths: Vec<&str> = found.0.iter().map(|p| p.path.as_str()).collect();
    assert_eq!(paths, ["$.bridge.at", "$.track.from", "$.track.bays"], "{found}");
    assert!(found.0.iter().all(|problem| problem.value.ends_with("would do")), "{found}");
}

#[test]
fn a_comment_may_stand_in_every_object() {
    fn add(value: &mut Value) {
        match value {
            Value::Object(map) => {
                map.values_mut().for_each(add);
                map.insert("$comment".into(), json!(["any", { "thing": 1 }]));
            }
            Value::Array(list) => list.iter_mut().for_each(add),
            _ => {}
        }
    }
    let mut commented = short();
    add(&mut commented);
    assert_eq!(checked(&commented).hash, checked(&short()).hash);
    let schema = ttb_scenario::schema();
    assert!(schema["$defs"]["Train"]["properties"]["$comment"]["description"].is_string());
}
