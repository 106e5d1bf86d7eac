//! The engine's answers, without a browser.

use std::path::Path;
use std::sync::atomic::AtomicBool;

use serde_json::{Value, json};
use ttb_web::room::Room;
use ttb_web::{Engine, page};

fn engine() -> Engine {
    Engine::new(Path::new("").into(), Room::PAGE, 1)
}

fn call(engine: &Engine, verb: &str, request: &Value) -> Value {
    let answer = engine.call(verb, request.to_string().as_bytes(), &AtomicBool::new(false));
    serde_json::from_slice(&answer).expect("JSON")
}

/// B25: L 25 m, 15 t/m, EI 30 GN m², ζ 1 % in three modes; peaks of two other programs (`crates/passage/tests/tables.rs`).
#[test]
fn b25_has_the_peaks_of_other_programs() {
    let scenario = json!({
        "train": { "cars": ["ice3"], "speed": { "km_h": 150 } },
        "bridge": {
            "structure": { "type": "beams", "spans": [{ "length": 25, "bending_stiffness": 30e9, "mass": 15000 }] },
            "damping": { "type": "modal", "ratio": 0.01, "modes": 3 },
        },
    });
    let engine = engine();
    let asked = json!({ "scenario": scenario.to_string(), "trains": ["hslm-a1"], "speeds": "150,230" });
    let plan = call(&engine, "plan", &json!({ "asked": asked }));
    let records = call(&engine, "runs", &json!({ "asked": asked, "runs": plan["runs"] }));
    for (record, [w, a]) in records.as_array().unwrap().iter().zip([[7.6395, 1.011], [17.8245, 6.215]]) {
        let at = |quantity: &str, place: &str| {
            let peaks = record["peaks"].as_array().unwrap().iter();
            let of = peaks.filter(|one| one["quantity"] == quantity && one["filter"] == "raw" && one["place"] == place);
            of.map(|one| one["value"].as_f64().unwrap().abs()).fold(0.0, f64::max)
        };
        assert!((1e3 * at("deck.displacement", "mid") / w - 1.0).abs() < 2e-3);
        assert!((at("deck.acceleration", "mid") / a - 1.0).abs() < 3e-3);
    }
    let outcome = call(&engine, "outcome", &json!({ "asked": asked, "records": records }));
    assert_eq!(outcome["governing"][0]["run"]["speed_km_h"], 230.0);
    // The same records in another order make the same files.
    let (one, other) = (records.clone(), Value::Array(records.as_array().unwrap().iter().rev().cloned().collect()));
    let made = |records: Value| call(&engine, "dossier", &json!({ "asked": asked, "records": records, "date": "x" }));
    assert_eq!(made(one), made(other));
}

#[test]
fn what_has_no_room_or_no_meaning_is_told() {
    let engine = engine();
    let long = |end: f64| {
        json!({ "text": json!({
            "train": { "cars": ["ice3"], "speed": { "km_h": 200 } },
            "bridge": {
                "structure": { "type": "beams", "spans": [{ "length": 25, "bending_stiffness": 3e10, "mass": 15000 }] },
                "damping": { "type": "none" },
            },
            "time": { "step": 1e-6, "end": end },
        }).to_string() })
    };
    let told = call(&engine, "look", &long(20.0))["error"].to_string();
    assert!(told.contains("GB of memory"), "{told}");
    assert_eq!(call(&engine, "look", &long(0.01))["sketch"]["length"], 25.0);
    let axles = |text: &str| call(&engine, "axles", &json!({ "text": text }));
    assert_eq!(axles("x;load\n0;170\n3;170\n"), json!([[0.0, 170e3], [3.0, 170e3]]));
    assert!(axles("0,170").to_string().contains("the first line must name the columns"));
    assert!(call(&engine, "nothing", &json!({}))["error"].to_string().contains("no verb"));
    let of_other = json!({ "asked": { "scenario": "{}" }, "runs": [] });
    assert!(!call(&engine, "runs", &of_other)["problems"].as_array().unwrap().is_empty());
}

#[test]
fn the_page_names_its_own_files_alone() {
    let known = |name: &str| page::FILES.iter().any(|(file, ..)| *file == name);
    for (name, _, text) in page::FILES {
        for part in text.split("from \"./").skip(1) {
            let file = part.split('"').next().unwrap();
            assert!(known(file), "{name} takes {file}");
        }
        let outside = text.replace("http://www.w3.org/2000/svg", "");
        assert!(!outside.contains("http://") && !outside.contains("https://"), "{name}");
    }
    // Every element that a script looks for by name is in the page or made by a script.
    let all: String = page::FILES.iter().map(|(.., text)| *text).collect();
    for (name, _, text) in page::FILES.iter().filter(|(name, ..)| name.ends_with(".js")) {
        for part in text.split("byId(\"").skip(1) {
            let id = part.split('"').next().unwrap();
            let base = id.trim_end_matches("-told").trim_end_matches("-usual");
            let made = [format!("id=\"{id}\""), format!("id: \"{id}\""), format!("id: \"{base}\"")];
            assert!(made.iter().any(|one| all.contains(one)), "{name}: {id}");
        }
    }
}

#[test]
fn a_page_without_the_program_says_where_fmus_can_be_had() {
    let scenario =
        std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/r1.json")).unwrap();
    let asked = json!({ "scenario": scenario, "speeds": "250", "way": "coupled", "bridge": { "fmu": "Deck.fmu" } });
    let told = call(&engine(), "plan", &json!({ "asked": asked }))["error"].as_str().unwrap().to_string();
    assert!(told.contains("ttb ui"), "{told}");
    // What is known of the scenario's bridge is not told of the FMU.
    let look = |asked: &Value| call(&engine(), "look", &json!({ "text": scenario, "asked": asked }));
    let (own, over) = (look(&json!({ "way": "coupled" })), look(&asked));
    assert!(!own["modes"].as_array().unwrap().is_empty() && own["facts"]["n0_hz"].is_number());
    assert!(over["modes"].as_array().unwrap().is_empty() && over["facts"]["n0_hz"].is_null());
    assert!(over["facts"]["track"].is_string() && over["sketch"].is_object());
}
