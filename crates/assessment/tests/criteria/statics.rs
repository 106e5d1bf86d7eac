//! Static load models among the criteria: deflection, comfort by deflection, ends of the deck, uplift, design effects.

use std::collections::BTreeMap;

use serde_json::json;
use ttb_assessment::amplification::{phi_2, phi_3, phi_double_prime};
use ttb_assessment::{Criteria, Facts, LoadCase, Peak, PlaceKind, Results, Statics, Statistic, Status};

use super::{FORCES, run, text_of, verdict};

/// Two spans of 25 m that sag by `w` in their middles under LM71, one run that sags by `dynamic`.
fn results(w: [f64; 2], dynamic: f64) -> Results {
    let row = |quantity: &'static str, statistic, x: f64, value, unit: &'static str| Peak {
        x: Some(x),
        unit: unit.into(),
        ..Peak::raw(quantity, PlaceKind::Deck, statistic, value)
    };
    let mut rows = Vec::new();
    for (x, value) in [(0.0, 0.0), (12.5, w[0]), (25.0, 0.0), (37.5, w[1]), (50.0, 0.0)] {
        rows.push(row("deck.displacement", Statistic::Max, x, value, "m"));
        // As influence lines round.
        rows.push(row("deck.displacement", Statistic::Min, x, -1e-19, "m"));
    }
    rows.push(row("deck.rotation", Statistic::AbsMax, 0.0, 2e-3, "rad"));
    let bearing = |name: &'static str, value| Peak {
        place: name.into(),
        ..Peak::raw("bearing.reaction", PlaceKind::Bearing, Statistic::Min, value)
    };
    rows.extend([bearing("0", -50e3), bearing("50", 0.0)]);
    let sag = row("deck.displacement", Statistic::Max, 12.5, dynamic, "m");
    let up = row("deck.displacement", Statistic::Min, 12.5, -0.001, "m");
    Results {
        runs: vec![run("r0", 250.0, FORCES)],
        rows: vec![(0, Peak { static_value: Some(0.008), ..sag }), (0, Peak { static_value: Some(-1e-19), ..up })],
        statics: Statics { cases: vec![LoadCase { name: "LM71".into(), rows }], reason: None },
        ..Results::default()
    }
}

fn facts() -> Facts {
    Facts {
        n0_hz: Some(3.5543),
        third_mode_hz: Some(32.0),
        spans_m: Some(vec![25.0, 25.0]),
        continuous: Some(false),
        ..Facts::default()
    }
}

fn bundled() -> Criteria {
    Criteria::bundled(&["en1990-2002", "en1991-2-2003"]).expect("bundled")
}

#[test]
fn the_deflection_of_every_span_is_judged_with_its_own_factor() {
    let found = &verdict(&bundled(), &facts(), &results([0.030, 0.0187155], 0.012), "deflection")[0];
    assert_eq!((found.status, found.x_m, found.train.as_deref()), (Status::Fulfilled, Some(12.5), Some("LM71")));
    assert!((found.value.expect("a value") - phi_3(25.0) * 0.030).abs() < 1e-12);
    assert_eq!((found.limit, found.run_id.clone(), found.basis), (Some(25.0 / 600.0), None, None));
    assert!(found.reason.as_deref().is_some_and(|note| note.contains("Φ₃ = 1.18") && note.contains("α = 1")));
    let careful = Facts { maintenance: Some("careful".into()), alpha: Some(1.33), ..facts() };
    let found = &verdict(&bundled(), &careful, &results([0.030, 0.0], 0.012), "deflection")[0];
    assert!((found.value.expect("a value") - 1.33 * phi_2(25.0) * 0.030).abs() < 1e-12);
    // Continuous over two spans: 1.2 of the mean.
    let continuous = Facts { continuous: Some(true), ..facts() };
    let found = &verdict(&bundled(), &continuous, &results([0.036, 0.0], 0.012), "deflection")[0];
    assert!((found.value.expect("a value") - phi_3(30.0) * 0.036).abs() < 1e-12);
    let none =
        Results { statics: Statics { cases: vec![], reason: Some("a foreign FMU".into()) }, ..Results::default() };
    let found = &verdict(&bundled(), &facts(), &none, "deflection")[0];
    assert_eq!((found.status, found.reason.as_deref()), (Status::NotJudged, Some("a foreign FMU")));
}

#[test]
fn the_users_chart_limits_the_deflection_for_comfort() {
    let results = results([0.0187155, 0.01], 0.012);
    let share = 25.0 / (phi_3(25.0) * 0.0187155);
    let found = &verdict(&bundled(), &facts(), &results, "comfort-deflection")[0];
    assert_eq!(found.status, Status::NotJudged);
    assert!((found.value.expect("a value") - share).abs() < 1e-9);
    assert!(found.reason.as_deref().is_some_and(|reason| reason.contains("give your own table")));
    let chart = |as_given: bool| {
        let chart = json!({ "spans_m": [20, 30], "speeds_km_h": [200, 300], "values": [[1000, 1200], [1400, 1800]] });
        let limit = json!({ "chart": chart, "as_given": as_given });
        let entry =
            json!({ "id": "comfort-deflection", "source": "figure A2.3 as read", "cases": [{ "limit": limit }] });
        let text =
            json!({ "criteria": [entry], "facts": { "line_speed_km_h": 250, "comfort_level": "good" } }).to_string();
        Criteria::read([("en1990-2002", text_of("en1990-2002")), ("mine.json", text.as_str())]).expect("a chart")
    };
    // Halfway between all four values, 1350; two simple spans 0.7; b_v = 1.3.
    let found = &verdict(&chart(true), &facts(), &results, "comfort-deflection")[0];
    assert_eq!((found.status, found.limit), (Status::Exceeded, Some(1350.0)));
    let found = &verdict(&chart(false), &facts(), &results, "comfort-deflection")[0];
    assert!((found.limit.expect("a limit") - 1350.0 * 0.7 / 1.3).abs() < 1e-9 && found.status == Status::Fulfilled);
    let wrong = json!({ "criteria": [{ "id": "comfort-deflection", "source": "s", "cases": [{ "limit": { "chart": {
        "spans_m": [20, 30], "speeds_km_h": [200], "values": [[1000]] } } }] }] })
    .to_string();
    let problems = Criteria::read([("en1990-2002", text_of("en1990-2002")), ("mine.json", wrong.as_str())]);
    assert!(problems.expect_err("a row too short")[0].to_string().contains("1 rows (speeds) of 2 values (spans)"));
}

#[test]
fn ends_of_the_deck_need_the_overhang_and_bearings_the_dead_load() {
    let results = results([0.02, 0.02], 0.012);
    let reason =
        |facts: &Facts, id: &str| verdict(&bundled(), facts, &results, id)[0].reason.clone().expect("a reason");
    assert!(reason(&facts(), "deck-end").contains("`overhang_m`"));
    assert!(reason(&facts(), "uplift").contains("by bearing: 0, 50"));
    let dead = |list: &[(&str, f64)]| Facts {
        overhang_m: Some(0.8),
        dead_reactions_kn: Some(list.iter().map(|(name, kn)| ((*name).to_string(), *kn)).collect::<BTreeMap<_, _>>()),
        ..facts()
    };
    assert!(reason(&dead(&[("0", 100.0)]), "uplift").contains("no bearing 50"));
    let known = dead(&[("0", 58.0), ("50", 100.0)]);
    let found = &verdict(&bundled(), &known, &results, "uplift")[0];
    // 58 kN − 1.18 · 50 kN.
    assert_eq!((found.status, found.place.as_deref()), (Status::Exceeded, Some("bearing 0")));
    assert!((found.value.expect("a value") - (58e3 - phi_3(25.0) * 50e3)).abs() < 1e-6);
    let found = &verdict(&bundled(), &known, &results, "deck-end")[0];
    // The run's 250 km/h: 2 mm.
    assert!((found.value.expect("a value") - phi_3(25.0) * 2e-3 * 0.8).abs() < 1e-12);
    assert_eq!((found.status, found.limit), (Status::Fulfilled, Some(0.002)));
}

#[test]
fn design_effects_stand_beside_the_load_model_at_the_same_place() {
    let found = &verdict(&bundled(), &facts(), &results([0.0187155, 0.01], 0.0125), "design-effect")[0];
    let effect = 0.0125 + 0.008 * phi_double_prime(250.0 / 3.6, 25.0, 3.5543);
    assert!((found.value.expect("a value") - effect / (phi_3(25.0) * 0.0187155)).abs() < 1e-12);
    assert_eq!((found.status, found.grade.as_deref()), (Status::Informative, Some("Φ·LM71 covers the trains")));
    assert_eq!((found.place.as_deref(), found.run_id.as_deref()), (Some("deck displacement"), Some("r0")));
    let careful = Facts { maintenance: Some("careful".into()), ..facts() };
    let found = &verdict(&bundled(), &careful, &results([0.0187155, 0.01], 0.030), "design-effect")[0];
    let effect = 0.030 + 0.5 * 0.008 * phi_double_prime(250.0 / 3.6, 25.0, 3.5543);
    assert!((found.value.expect("a value") - effect / (phi_2(25.0) * 0.0187155)).abs() < 1e-12);
    assert_eq!(found.grade.as_deref(), Some("the trains govern the design"));
}

#[test]
fn facts_that_cannot_be_are_refused_all_at_once() {
    let text = r#"{ "facts": { "track": "balast", "alpha": 0, "spans_m": [], "maintenance": "good" } }"#;
    let problems = Criteria::read([("mine.json", text)]).expect_err("four");
    let told: Vec<String> = problems.iter().map(ToString::to_string).collect();
    assert_eq!(told.len(), 4, "{told:?}");
    assert!(told[0].contains("$.facts.track: must be one of ballast, ballastless: `balast` (did you mean `ballast`?)"));
}
