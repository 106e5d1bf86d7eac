//! The coupled way: the bits of single runs, the answers of the modal way.

use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;

use crate::common;
use ttb_assessment::criterion::DEFAULT;
use ttb_assessment::peak::quantity::{DECK_ACCELERATION, DECK_DISPLACEMENT};
use ttb_assessment::{Criteria, Filter, Phase};
use ttb_campaign::coupled::{Bridges, Loads, Shared, Source, Task, Vehicles};
use ttb_campaign::modal::Modal;
use ttb_campaign::plan::{Load, Rail, Train, Variant};
use ttb_campaign::request::Request;
use ttb_campaign::{Compute, Computed, Limits, Plan, Record, expand, facts};
use ttb_scenario::types::Heading;
use ttb_session::{Case, Column, Plan as Steps, Table};

type Prepared = ttb_session::Prepared<ttb_train_track::Prepared, ttb_bridge::Prepared>;

const JUDGED: Filter = Filter::Butterworth { order: 4, cut_off_hz: 30.0, phase: Phase::Zero };

fn example(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples").join(name)
}

fn source_of(path: &Path) -> Source {
    expand::source(path, []).expect("scenario")
}

fn plan_of(load: Load, speeds: &[f64]) -> Plan {
    let train = Train { name: "one".into(), max_speed_km_h: None, load, heading: Heading::Forward };
    Plan { trains: vec![train], speeds_km_h: speeds.to_vec(), rails: vec![Rail::Scenario], ..common::plan(0, 0) }
}

fn done(computed: Vec<Computed>) -> Vec<Record> {
    let one = |computed| match computed {
        Computed::Done(record) => record,
        Computed::Stopped => panic!("nobody asked to stop"),
    };
    computed.into_iter().map(one).collect()
}

#[test]
fn a_run_of_a_sweep_has_the_bits_of_the_same_scenario_run_alone() {
    let (source, criteria) = (source_of(&example("r1.json")), Criteria::bundled(DEFAULT).expect("bundled"));
    let plan = plan_of(Load::Scenario, &[220.0, 250.0]);
    let facts = facts::of(&source.checked().expect("checked"));
    let shared = Shared::default();
    let (plan, source, criteria, facts, shared) = (&plan, &source, &criteria, &facts, &shared);
    let with =
        Vehicles { task: Task { plan, source, criteria, facts, judged: JUDGED, keep: None }, shared, abreast: 2 };
    let runs = plan.runs();
    for run in &runs {
        let history = with.history(run, &AtomicBool::new(false)).expect("run").expect("whole");
        let checked = source.of_run(plan, run).expect("checked");
        let mut alone = Table::default();
        let mut sides = Prepared::new(&checked).expect("prepared").sides(&checked).expect("sides");
        let steps = Steps { axis: Case::of(&checked).axis(), wanted: &Column::has_extremes, clock: &|| 0.0 };
        sides.run(&steps, &mut [&mut alone]).expect("run");
        assert_eq!(history.time, alone.time);
        let mut compared = 0;
        for (name, _, values) in &history.values {
            if let Some(alone) = alone.history(name) {
                let bits = |x: &[f64]| x.iter().map(|x| x.to_bits()).collect::<Vec<_>>();
                assert!(bits(values) == bits(alone), "{name}");
                compared += 1;
            }
        }
        assert!(compared >= 8, "{compared} columns");
    }
    // R1 at 250 km/h on its irregular rail, mid-span, raw and behind 30 Hz: values computed independently, m/s².
    let records = done(with.compute(&runs, &AtomicBool::new(false)));
    for (filter, expected) in [("raw", 0.17649), (JUDGED.label().as_str(), 0.11287)] {
        let is = |peak: &&ttb_assessment::Peak| peak.place == "mid" && peak.filter == filter && peak.unit == "m/s2";
        let found = records[1].peaks.iter().find(is).expect("mid").value;
        assert!((found - expected).abs() < 1e-5, "{filter}: {found}");
    }
    let points = records[1].envelopes.iter().find(|one| one.quantity == DECK_DISPLACEMENT).expect("envelope");
    assert_eq!(points.x.len(), 23);
}

/// B25: L 25 m, m 15 t/m, EI 30 GN m², ζ 1 % in three modes, under HSLM-A3 at 250 km/h. The two ways agree, also in a variant
/// of the mass; raw accelerations of the coupled way have higher modes, which are not damped here, and are not compared.
#[test]
fn loads_on_a_rigid_track_agree_with_the_modal_way() {
    let place = tempfile::tempdir().expect("folder");
    let path = place.path().join("b25.json");
    let text = r#"{ "train": { "cars": ["ice3"], "speed": { "km_h": 250 } },
        "bridge": { "structure": { "type": "beams", "spans": [{ "length": 25, "bending_stiffness": 30e9, "mass": 15000 }] },
                    "damping": { "type": "modal", "ratio": 0.01, "modes": 3 } },
        "time": { "step": 2e-4 } }"#;
    std::fs::write(&path, text).expect("written");
    let (source, criteria) = (source_of(&path), Criteria::bundled(DEFAULT).expect("bundled"));
    let train = &ttb_trains::find("hslm-a3").expect("train")[0];
    let axles = train.axles.iter().map(|axle| [axle.x, axle.load]).collect();
    let mut plan = plan_of(Load::Axles(axles), &[250.0]);
    plan.variants.push(Variant { name: "heavy".into(), mass_factor: 1.05, ..Variant::default() });
    let facts = facts::of(&source.checked().expect("checked"));
    assert!((facts.n0_hz.expect("n0") - 3.5543).abs() < 1e-3);
    let bridges = Bridges::default();
    let task = Task { plan: &plan, source: &source, criteria: &criteria, facts: &facts, judged: JUDGED, keep: None };
    let loads = Loads { task, step: None, bridges: &bridges };
    let modal = Modal::new(&plan, &source, vec![JUDGED]);
    let (runs, stop) = (plan.runs(), AtomicBool::new(false));
    let (coupled, modal) = (done(loads.compute(&runs, &stop)), done(modal.compute(&runs, &stop)));
    for (coupled, modal) in coupled.iter().zip(&modal) {
        assert_eq!((&coupled.error, &modal.error), (&None, &None));
        let filtered = JUDGED.label();
        for (quantity, filter, allowed) in
            [(DECK_DISPLACEMENT, "raw", 1e-3), (DECK_ACCELERATION, filtered.as_str(), 5e-3)]
        {
            let [a, b] = [coupled, modal].map(|record| record.amount(quantity, filter).expect("value"));
            assert!((a / b - 1.0).abs() < allowed, "{quantity} {filter}: {a} coupled, {b} modal");
        }
    }
    let w = |record: &Record| record.amount(DECK_DISPLACEMENT, "raw").expect("value");
    assert!(w(&modal[0]) != w(&modal[1]));
    // Accelerations of three modes at 0.05 L … 0.5 L from the independent program, 3 %.
    let envelope = modal[0].envelopes.iter().find(|one| one.quantity == DECK_ACCELERATION && one.filter == "raw");
    let envelope = envelope.expect("envelope");
    for (i, expected) in [1.631, 3.204, 4.663, 5.964, 7.076, 8.003, 8.841, 9.486, 9.900, 10.057].into_iter().enumerate()
    {
        let x = 25.0 * (i + 1) as f64 / 20.0;
        let at = envelope.x.iter().position(|other| (other - x).abs() < 1e-6).expect("a point of the deck");
        let found = envelope.max[at].max(-envelope.min[at]);
        assert!((found / expected - 1.0).abs() < 0.03, "{x} m: {found}, expected {expected}");
    }
}

#[test]
fn a_scenario_may_name_its_train_of_forces() {
    let text = r#"{ "train": { "forces": "hslm-a1", "speed": { "km_h": 200 } },
        "bridge": { "structure": { "type": "beams", "spans": [{ "length": 25, "bending_stiffness": 30e9, "mass": 15000 }] },
                    "damping": { "type": "none" } } }"#;
    let source = Source { text: text.into(), folder: "".into(), name: "named.json".into(), settings: Vec::new() };
    let checked = source.checked().expect("the name is known");
    assert_eq!(checked.train_track.axle_count(), ttb_trains::find("hslm-a1").expect("train")[0].axles.len());
}

#[test]
fn a_request_names_all_its_problems_at_once() {
    let request = Request {
        scenario: example("r1.json"),
        trains: vec!["hslm-z".into()],
        speeds: Some(ttb_campaign::list::Written::Text("420:140".into())),
        seeds: Some(ttb_campaign::list::Written::Text("1:3".into())),
        variants: ttb_campaign::request::Variants::Word("bound".into()),
        ..Request::default()
    };
    let error = expand::expand(&request, "0", Path::new(""), Limits::default()).err().expect("refused").to_string();
    for told in ["hslm-z", "must rise", "seeds", "`bound`"] {
        assert!(error.contains(told), "{told}: {error}");
    }
}
