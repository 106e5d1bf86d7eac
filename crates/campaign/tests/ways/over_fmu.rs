//! Runs over FMUs: what a plan of them is, and what becomes of the histories that a master gives.

use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};

use crate::common;
use ttb_assessment::Histories;
use ttb_assessment::reduce::PointHistory;
use ttb_campaign::coupled::{Master, Stepped};
use ttb_campaign::history::History;
use ttb_campaign::plan::Load;
use ttb_campaign::request::{Headings, Request, Variants};
use ttb_campaign::{Compute, Computed, Folder, Foreign, Limits, Plan, Runner, expand, identity};
use ttb_scenario::Checked;

/// A deck that moves by its train's speed, and fails under fast ones.
struct Deck;

impl Master for Deck {
    fn run(&self, checked: Checked, stop: &AtomicBool) -> Result<Option<Stepped>, String> {
        let speed = checked.train_track.speed[0][1];
        if stop.load(Ordering::Relaxed) {
            return Ok(None);
        }
        if speed > 70.0 {
            return Err("Bridge: fmi2DoStep: the process ended by SIGSEGV".into());
        }
        let time: Vec<f64> = (0..1000).map(|i| 1e-3 * f64::from(i)).collect();
        let displacement = time.iter().map(|t| speed * (20.0 * t).sin()).collect();
        let point = PointHistory { name: "mid".into(), x: Some(16.25), displacement, ..PointHistory::default() };
        let histories = Histories { time, points: vec![point], ..Histories::default() };
        Ok(Some(Stepped { histories, history: History::default(), step: 1e-3, remarks: vec!["it sways".into()] }))
    }
}

fn request(speeds: &str) -> Request {
    let scenario = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/r1.json");
    serde_json::from_value(serde_json::json!({ "scenario": scenario, "speeds": speeds })).expect("request")
}

fn expanded(request: &Request, bridges: Vec<Foreign>) -> Result<expand::Expanded, String> {
    let source = expand::source(&request.scenario, []).expect("scenario");
    expand::of_source(request, source, "r1.json".into(), bridges, "0", Limits::default()).map_err(|e| e.to_string())
}

fn fmu(sha256: &str, map: Option<&str>) -> Foreign {
    Foreign { fmu: "Deck.fmu".into(), sha256: sha256.into(), map: map.map(|map| ["map.json".into(), map.into()]) }
}

#[test]
fn what_a_master_gives_is_reduced_and_what_fails_is_a_row() {
    let expanded = expanded(&request("180,250,260"), vec![fmu("00", None)]).expect("a plan");
    assert!(expanded.facts.n0_hz.is_none() && expanded.facts.track.is_some());
    let runs = expanded.plan.runs();
    let runner = Runner::new(&expanded).expect("limits").over(&Deck);
    let computed = runner.compute(&runs, &AtomicBool::new(false));
    let records: Vec<_> =
        computed.into_iter().map(|one| if let Computed::Done(one) = one { one } else { panic!() }).collect();
    let [slow, fast, faster] = &records[..] else { panic!("{} records", records.len()) };
    // sin(20 t) reaches one: the speed itself, m/s.
    assert!((slow.amount("deck.displacement", "raw").expect("a row") - 50.0).abs() < 1e-4);
    assert!((fast.amount("deck.displacement", "raw").expect("a row") - 250.0 / 3.6).abs() < 1e-4);
    assert_eq!((slow.envelopes[0].x.as_slice(), slow.step), ([16.25].as_slice(), Some(1e-3)));
    assert_eq!(slow.remarks, ["it sways"]);
    assert!(faster.error.as_ref().is_some_and(|error| error.contains("SIGSEGV")) && faster.peaks.is_empty());
    assert_eq!(runner.compute(&runs[..1], &AtomicBool::new(true)), [Computed::Stopped]);
    // Nobody takes the scenario's bridge for the FMU.
    let without = Runner::new(&expanded).expect("limits").compute(&runs[..1], &AtomicBool::new(false));
    assert!(matches!(&without[0], Computed::Done(one) if one.error.as_ref().is_some_and(|e| e.contains("FMU"))));
}

#[test]
fn bytes_and_map_of_an_fmu_decide_the_ids_and_other_plans_keep_theirs() {
    let of = |bridges: Vec<Foreign>| Plan { bridges, ..common::plan(1, 1) };
    let id = |bridges| of(bridges).runs()[0].id.clone();
    let own = of(Vec::new());
    let (load, variant) = (&own.trains[0].load, &own.variants[0]);
    let factors = [variant.mass_factor, variant.stiffness_factor].map(f64::to_bits);
    let run = &own.runs()[0];
    let decides = (
        (&own.version, &own.scenario_sha256, own.way, own.forces),
        (load, factors, &variant.set, run.rail, run.speed_km_h.map(f64::to_bits)),
    );
    assert_eq!(run.id, identity::of(&decides));
    assert!(!own.text().expect("JSON").contains("bridges"));
    let ids = [id(vec![]), id(vec![fmu("00", None)]), id(vec![fmu("01", None)]), id(vec![fmu("00", Some("{}"))])];
    let mut different = ids.to_vec();
    different.sort();
    different.dedup();
    assert_eq!(different.len(), ids.len());
    // Where the file lies and what the map is called is nothing to the results.
    let elsewhere = Foreign { fmu: "../a/Deck.fmu".into(), ..fmu("00", None) };
    assert_eq!(id(vec![elsewhere]), ids[1]);
    let folder = tempfile::tempdir().expect("folder");
    Folder::open(folder.path(), of(vec![fmu("00", None)])).expect("new");
    Folder::open(folder.path(), of(vec![fmu("00", None)])).expect("the same");
    let refused = Folder::open(folder.path(), own).expect_err("another").to_string();
    assert!(refused.contains("Deck.fmu") && refused.contains("the scenario's own"), "{refused}");
}

#[test]
fn what_cannot_be_varied_is_refused_at_once() {
    let wrong = Request {
        forces: true,
        variants: Variants::Word("bounds".into()),
        heading: Headings::Both,
        axes: [("bridge.damping.ratio".to_string(), vec![0.02.into()])].into(),
        way: ttb_campaign::request::Choice::Modal,
        ..request("250")
    };
    let told = expanded(&wrong, vec![fmu("00", None)]).err().expect("refused");
    for key in ["forces: ", "variants: ", "heading: ", "axes: bridge.damping.ratio", "way: "] {
        assert!(told.contains(key), "{key} is not in\n{told}");
    }
}

#[test]
fn axle_loads_run_as_the_train_of_the_scenario() {
    let mut scenario: serde_json::Value =
        serde_json::from_str(&std::fs::read_to_string(request("").scenario).expect("R1")).expect("JSON");
    scenario["train"] = serde_json::json!({ "forces": [[0.0, 1e5], [3.0, 1e5]], "speed": { "km_h": 250 } });
    scenario["track"] = serde_json::json!({ "type": "slab" });
    scenario["time"] = serde_json::json!({ "step": 1e-3 });
    let folder = tempfile::tempdir().expect("folder");
    let path = folder.path().join("forces.json");
    std::fs::write(&path, scenario.to_string()).expect("scenario");
    let plan =
        expanded(&Request { scenario: path.clone(), ..request("250") }, vec![fmu("00", None)]).expect("a plan").plan;
    let own = Load::Axles(vec![[0.0, 1e5], [3.0, 1e5]]);
    assert_eq!(plan.trains[0].load, own);
    // Trains by name take its place, of loads as of cars; the scenario's speed is that of the run.
    let request = Request { scenario: path, trains: vec!["hslm-a1".into(), "ice3-trailer".into()], ..request("200") };
    let expand::Expanded { plan, source, .. } = expanded(&request, vec![fmu("00", None)]).expect("a plan");
    let runs = plan.runs();
    let of = |at: usize| source.of_run(&plan, &runs[at]).expect("a scenario");
    assert_eq!((of(0).train_track.axle_count(), of(1).train_track.cars.len()), (50, 1));
    assert!(of(0).scenario.train.cars.is_none() && of(1).scenario.train.forces.is_none());
    assert!((of(0).train_track.speed[0][1] - 200.0 / 3.6).abs() < 1e-12);
}
