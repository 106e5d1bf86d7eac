//! Limits as data: bundled files, overriding, refusals, verdicts.

#[path = "criteria/statics.rs"]
mod statics;

use serde_json::json;
use ttb_assessment::criterion::{DEFAULT, names, text};
use ttb_assessment::{
    Basis, Criteria, Facts, Loads, Missing, Peak, PlaceKind, Rail, Results, Run, Statistic, Status, Verdict, judge,
};

const FORCES: Basis = Basis { loads: Loads::Forces, rail: Rail::Smooth };
const VEHICLES: Basis = Basis { loads: Loads::Vehicles, rail: Rail::Rough };

fn run(id: &str, speed: f64, basis: Basis) -> Run {
    let text = String::new;
    Run {
        run_id: id.into(),
        train: "A3".into(),
        speed_km_h: Some(speed),
        variant: text(),
        seed: text(),
        basis,
        refined: false,
    }
}

fn peak(quantity: &'static str, statistic: Statistic, filter: &'static str, value: f64) -> Peak {
    Peak { filter: filter.into(), unit: "m/s2".into(), ..Peak::raw(quantity, PlaceKind::Deck, statistic, value) }
}

/// Deck accelerations behind the filter of a bridge with n₀ = 4 Hz, third mode 36 Hz; the raw one is twice as large.
fn deck(values: &[(f64, f64)], basis: Basis) -> Results {
    let mut results = Results::default();
    for (i, (speed, value)) in values.iter().enumerate() {
        results.runs.push(run(&format!("r{i}"), *speed, basis));
        results.rows.push((i, peak("deck.acceleration", Statistic::AbsMax, "butterworth-4-36Hz-zero", *value)));
        results.rows.push((i, peak("deck.acceleration", Statistic::AbsMax, "raw", 2.0 * value)));
    }
    results
}

fn facts(track: &str) -> Facts {
    Facts { n0_hz: Some(4.0), third_mode_hz: Some(36.0), track: Some(track.into()), ..Facts::default() }
}

fn verdict(criteria: &Criteria, facts: &Facts, results: &Results, id: &str) -> Vec<Verdict> {
    judge(criteria, facts, results).verdicts.into_iter().filter(|verdict| verdict.criterion == id).collect()
}

fn mine(entry: serde_json::Value) -> Result<Criteria, String> {
    let text = json!({ "criteria": [entry] }).to_string();
    let en1990 = text_of("en1990-2002");
    Criteria::read([("en1990-2002", en1990), ("mine.json", text.as_str())])
        .map_err(|problems| problems.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n"))
}

fn text_of(name: &str) -> &'static str {
    text(name).expect("bundled")
}

#[test]
fn every_bundled_file_is_read_and_says_its_source() {
    for name in names() {
        let criteria = Criteria::bundled(&[name]).unwrap_or_else(|problems| panic!("{problems:?}"));
        assert!(!criteria.all.is_empty());
        for criterion in &criteria.all {
            assert!(["read", "secondary"].contains(&criterion.verified.as_str()), "{}", criterion.id);
            assert!(criterion.source.len() > 20 && !criterion.edition.is_empty(), "{}", criterion.id);
        }
    }
    let together = Criteria::bundled(&names().collect::<Vec<_>>()).expect("all");
    let apart: usize = names().map(|name| Criteria::bundled(&[name]).expect("one").all.len()).sum();
    assert_eq!(together.all.len(), apart, "ids of bundled files are unique");
    assert!(Criteria::bundled(DEFAULT).is_ok());
}

#[test]
fn an_unknown_file_and_unknown_keys_are_refused_all_at_once() {
    let error = Criteria::bundled(&["en1990-2022"]).expect_err("unknown")[0].to_string();
    assert!(error.contains("no limits file") && error.contains("did you mean `en1990-2002`"), "{error}");
    let error = mine(
        json!({ "id": "deck-acceleration", "source": "owner", "limits": 4.99, "filter": { "type": "raw", "ordr": 4 } }),
    )
    .expect_err("two unknown keys");
    assert!(error.contains("mine.json: $.criteria[0].limits: unknown key"), "{error}");
    assert!(error.contains("$.criteria[0].filter.ordr: unknown key (did you mean `order`?)"), "{error}");
    let error =
        mine(json!({ "id": "deck-aceleration", "source": "owner", "cases": [] })).expect_err("unknown criterion");
    assert!(error.contains("unknown criterion") && error.contains("did you mean `deck-acceleration`"), "{error}");
    let error = mine(json!({ "id": "deck-acceleration", "cases": [{ "limit": 4.99 }] })).expect_err("no source");
    assert!(error.contains("must say in `source` where its numbers come from: `deck-acceleration`"), "{error}");
    assert!(mine(json!({ "id": "deck-acceleration", "source": "o", "cases": [{ "limit": "five" }] })).is_err());
    assert!(Criteria::read([("x.json", "{")]).expect_err("JSON")[0].to_string().starts_with("x.json: must be JSON"));
}

#[test]
fn a_limit_a_little_lower_turns_the_verdict() {
    let results = deck(&[(200.0, 3.0), (300.0, 5.0)], FORCES);
    for (limit, status) in [(4.99, Status::Exceeded), (5.0, Status::Fulfilled), (5.01, Status::Fulfilled)] {
        let entry =
            json!({ "id": "deck-acceleration", "source": "owner's specification, 3.2", "cases": [{ "limit": limit }] });
        let criteria = mine(entry).expect("a limits file");
        let found = verdict(&criteria, &facts("ballastless"), &results, "deck-acceleration");
        assert_eq!((found.len(), found[0].status, found[0].limit), (1, status, Some(limit)));
        assert_eq!((found[0].verified.as_str(), found[0].limits.as_str()), ("user", "mine.json"));
        assert_eq!(found[0].source, "owner's specification, 3.2");
        assert_eq!((found[0].value, found[0].raw, found[0].run_id.as_deref()), (Some(5.0), Some(10.0), Some("r1")));
        assert!((found[0].utilisation.expect("a utilisation") - 5.0 / limit).abs() < 1e-12);
    }
}

#[test]
fn there_is_no_tolerance_and_the_permissible_speed_is_below_the_first_that_is_exceeded() {
    let criteria = Criteria::bundled(&["en1990-2002"]).expect("bundled");
    let results = deck(&[(150.0, 1.0), (200.0, 3.500_1), (250.0, 2.0), (180.0, 3.5)], FORCES);
    let found = &verdict(&criteria, &facts("ballast"), &results, "deck-acceleration")[0];
    assert_eq!(found.status, Status::Exceeded);
    assert_eq!((found.permissible_speed_km_h, found.first_exceeded_km_h), (Some(180.0), Some(200.0)));
    let found = &verdict(&criteria, &facts("ballastless"), &results, "deck-acceleration")[0];
    assert_eq!((found.status, found.permissible_speed_km_h), (Status::Fulfilled, Some(250.0)));
    let results = deck(&[(150.0, 9.0)], FORCES);
    let found = &verdict(&criteria, &facts("ballast"), &results, "deck-acceleration")[0];
    assert_eq!((found.permissible_speed_km_h, found.first_exceeded_km_h), (None, Some(150.0)));
}

#[test]
fn bases_are_judged_apart() {
    let criteria = Criteria::bundled(&["en1990-2002"]).expect("bundled");
    let mut results = deck(&[(200.0, 3.0)], FORCES);
    let vehicles = deck(&[(200.0, 9.0)], VEHICLES);
    results.runs.push(Run { run_id: "v0".into(), ..vehicles.runs[0].clone() });
    results.rows.extend(vehicles.rows.into_iter().map(|(_, peak)| (1, peak)));
    let found = verdict(&criteria, &facts("ballast"), &results, "deck-acceleration");
    let told: Vec<_> = found.iter().map(|v| (v.status, v.basis, v.in_basis, v.value)).collect();
    assert_eq!(
        told,
        [(Status::Exceeded, Some(VEHICLES), false, Some(9.0)), (Status::Fulfilled, Some(FORCES), true, Some(3.0)),]
    );
    // Without a run with moving forces the code's own check is missing, and that is said.
    let alone = verdict(&criteria, &facts("ballast"), &deck(&[(200.0, 3.0)], VEHICLES), "deck-acceleration");
    assert_eq!((alone[0].status, alone[1].status), (Status::Fulfilled, Status::NotJudged));
    let reason = alone[1].reason.as_deref().expect("a reason");
    assert!(reason.contains("moving forces on a smooth rail"), "{reason}");
}

#[test]
fn what_is_not_known_is_not_judged_and_says_what_to_give() {
    let criteria = Criteria::bundled(DEFAULT).expect("bundled");
    let results = deck(&[(200.0, 3.0)], FORCES);
    let no_track = Facts { track: None, ..facts("ballast") };
    let found = &verdict(&criteria, &no_track, &results, "deck-acceleration")[0];
    assert_eq!((found.status, found.value), (Status::NotJudged, Some(3.0)));
    assert!(found.reason.as_deref().is_some_and(|reason| reason.contains("type of track is not known")));
    let found = &verdict(&criteria, &facts("ballast"), &results, "twist")[0];
    assert!(found.status == Status::NotJudged && found.reason.as_deref().is_some_and(|r| r.contains("run in space")));
    let mut short = results.clone();
    short.missing.push(Missing {
        quantity: "body.comfort-n-mv".into(),
        filter: "wb-en12299".into(),
        statistic: None,
        reason: "N_MV of EN 12299 needs 300 s; the record has 8".into(),
    });
    let found = &verdict(&criteria, &facts("ballast"), &short, "comfort-n-mv")[0];
    assert_eq!(found.reason.as_deref(), Some("N_MV of EN 12299 needs 300 s; the record has 8"));
    // Without frequencies the cut-off is 30 Hz, and the word is said.
    let mut assumed = results;
    assumed.rows.push((0, peak("deck.acceleration", Statistic::AbsMax, "butterworth-4-30Hz-zero", 2.0)));
    let unknown = Facts { track: Some("ballast".into()), ..Facts::default() };
    let found = &verdict(&criteria, &unknown, &assumed, "deck-acceleration")[0];
    assert!(
        found.filter_assumed
            && found.value == Some(2.0)
            && found.reason.as_deref().is_some_and(|r| r.contains("assumed"))
    );
}

#[test]
fn facts_of_the_user_overrule_those_of_the_program() {
    let text = r#"{ "$comment": "free", "facts": { "third_mode_hz": 50, "track": "ballast" }, "criteria": [] }"#;
    let criteria = Criteria::read([("en1990-2002", text_of("en1990-2002")), ("mine.json", text)]).expect("facts");
    let mut results = deck(&[(200.0, 3.0)], FORCES);
    results.rows.push((0, peak("deck.acceleration", Statistic::AbsMax, "butterworth-4-50Hz-zero", 3.6)));
    let judged = judge(&criteria, &facts("ballastless"), &results);
    assert_eq!(judged.facts.modes_from.as_deref(), Some("given by the user"));
    assert_eq!((judged.verdicts[0].status, judged.verdicts[0].value), (Status::Exceeded, Some(3.6)));
    assert_eq!(judged.exceeded().count(), 1);
}

#[test]
fn the_limit_of_a_wheel_load_follows_speed_and_static_load() {
    let criteria = Criteria::bundled(&["en14363-2016"]).expect("bundled");
    let mut results = Results::default();
    for (i, (speed, q, q0)) in [(160.0, 199e3, 115e3), (250.0, 179e3, 80e3)].into_iter().enumerate() {
        results.runs.push(run(&format!("r{i}"), speed, VEHICLES));
        let load = peak("wheel.load", Statistic::Max, "butterworth-4-20Hz-zero", q);
        results.rows.push((i, Peak { static_value: Some(q0), unit: "N".into(), ..load }));
    }
    let found = &verdict(&criteria, &Facts::default(), &results, "wheel-load")[0];
    assert_eq!((found.status, found.limit, found.value), (Status::Exceeded, Some(170e3), Some(179e3)));
}

#[test]
fn criteria_name_the_filters_that_a_run_must_make() {
    let criteria = Criteria::bundled(DEFAULT).expect("bundled");
    let wanted = criteria.wanted(&facts("ballast"));
    let of = |quantity: &str| -> Vec<String> {
        wanted.iter().filter(|one| one.quantity == quantity).map(|one| one.filter.label()).collect()
    };
    assert_eq!(of("deck.acceleration"), ["butterworth-4-36Hz-zero", "raw"]);
    assert_eq!(of("wheel.unloading"), ["butterworth-4-20Hz-zero", "raw", "mean-2m"]);
    assert_eq!(of("deck.twist"), ["raw"]);
}

#[test]
fn amplification_is_that_at_the_place_of_the_greatest_displacement() {
    let criteria = Criteria::bundled(&["en1991-2-2003"]).expect("bundled");
    let mut results = Results { runs: vec![run("r0", 200.0, FORCES)], ..Results::default() };
    for (place, value, statically) in [("0.1L", 0.004, 0.001), ("0.5L", -0.012, 0.008)] {
        let row = peak("deck.displacement", Statistic::AbsMax, "raw", value);
        results.rows.push((0, Peak { static_value: Some(statically), place: place.into(), ..row }));
    }
    let found = &verdict(&criteria, &facts("ballast"), &results.with_amplification(), "phi")[0];
    assert_eq!((found.status, found.place.as_deref()), (Status::Informative, Some("deck 0.5L")));
    assert!((found.value.expect("a value") - 0.5).abs() < 1e-12);
}

#[test]
fn a_users_file_names_project_and_checker() {
    let text = r#"{ "people": { "project": "Line 7", "checker": "A. N. Other" } }"#;
    let criteria = Criteria::read([("mine.json", text)]).expect("people");
    assert_eq!(criteria.people.len(), 2);
    let wrong = Criteria::read([("mine.json", r#"{ "people": { "project": 7 } }"#)]).expect_err("a number");
    assert_eq!(wrong[0].to_string(), "mine.json: $.people.project: must be a text: 7");
}
