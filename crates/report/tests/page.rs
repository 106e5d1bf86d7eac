//! The page of hand-made results: complete, self-contained, of the promised size.

use std::collections::BTreeSet;
use std::f64::consts::PI;

use ttb_assessment::{Basis, Criteria, Facts, Loads, Peak, PlaceKind, Rail, Results, Run, Statistic, Verdicts, judge};
use ttb_report::{Bridge, Envelope, History, Input, ModeShape, Passage, Property, SpaceTime, Train, render};

const FORCES: Basis = Basis { loads: Loads::Forces, rail: Rail::Smooth };
const FILTER: &str = "butterworth-4-32Hz-zero";

/// Ten trains at 57 speeds, a resonance each.
fn results() -> Results {
    let mut results = Results::default();
    for train in 1..=10 {
        for i in 0..57 {
            let (at, v) = (results.runs.len(), 140.0 + 5.0 * f64::from(i));
            results.runs.push(Run {
                run_id: format!("{:016x}", 1_000_003 * at as u64 + 7),
                train: format!("HSLM-A{train}"),
                speed_km_h: Some(v),
                variant: String::new(),
                seed: "smooth".into(),
                basis: FORCES,
                refined: i % 20 == 19,
            });
            let from_resonance = v - 200.0 - 16.0 * f64::from(train);
            let peak = |width: f64| 1.0 + (4.5 - 0.2 * f64::from(train)) / (1.0 + (from_resonance / width).powi(2));
            let deck = |quantity: &'static str, filter: &'static str, value: f64, unit: &'static str| Peak {
                place: "0.5L".into(),
                x: Some(12.5),
                filter: filter.into(),
                unit: unit.into(),
                time: Some(2.5),
                static_value: (quantity == "deck.displacement").then_some(5e-3),
                ..Peak::raw(quantity, PlaceKind::Deck, Statistic::AbsMax, value)
            };
            results.rows.push((at, deck("deck.acceleration", FILTER, peak(8.0), "m/s2")));
            results.rows.push((at, deck("deck.acceleration", "raw", 1.3 * peak(8.0), "m/s2")));
            results.rows.push((at, deck("deck.displacement", "raw", 3e-3 * peak(12.0), "m")));
        }
    }
    results
}

fn facts() -> Facts {
    Facts {
        n0_hz: Some(3.5543),
        third_mode_hz: Some(32.0),
        modes_from: Some("closed form".into()),
        track: Some("ballast".into()),
        spans_m: Some(vec![25.0, 25.0]),
        ..Facts::default()
    }
}

fn nothing<'a>(results: &'a Results, verdicts: &'a Verdicts) -> Input<'a> {
    Input {
        title: "Two spans of 25 m <first draft> & more".into(),
        people: vec![],
        version: "0.1.0".into(),
        date: "2026-01-01".into(),
        hash: None,
        verdicts,
        results,
        bridge: None,
        given: Vec::new(),
        trains: vec![],
        envelopes: vec![],
        passages: vec![],
        changes: vec![],
        more_changes: String::new(),
        losses: None,
        comfort: vec![],
        commands: vec![],
        files: vec![],
        warnings: vec![],
    }
}

fn bridge(line: &[f64]) -> Bridge {
    let mode = |n: i32| ModeShape {
        frequency: 3.5543 * f64::from(n * n),
        damping: Some(0.01),
        shape: line.iter().map(|x| [*x, (PI * f64::from(n) * x / 25.0).sin()]).collect(),
    };
    let property = |name: &str, value: &str, unit: &str| Property {
        name: name.into(),
        value: value.into(),
        unit: unit.into(),
        source: "scenario".into(),
    };
    Bridge {
        length: 50.0,
        bearings: vec![0.0, 25.0, 50.0],
        points: vec![("mid-1".into(), 12.5), ("mid-2".into(), 37.5)],
        properties: vec![
            property("bending stiffness, span 1", "3e10", "N m²"),
            property("mass, span 1", "15000", "kg/m"),
        ],
        modes: (1..=3).map(mode).collect(),
    }
}

fn passage(run_id: &str, line: &[f64]) -> Passage {
    let time: Vec<f64> = (0..4000).map(|i| 1e-3 * f64::from(i)).collect();
    let wave = |f: f64| time.iter().map(|t| 4.0 * (2.0 * PI * f * t).sin() * (-t).exp()).collect::<Vec<f64>>();
    let (slow, fast) = (wave(4.0), wave(20.0));
    let row = |i: i32| line.iter().map(|x| (f64::from(i) * 0.3).sin() * (x / 8.0).sin()).collect();
    Passage {
        run_id: run_id.into(),
        title: "deck-acceleration: HSLM-A1 at 215 km/h".into(),
        histories: vec![History {
            title: "Acceleration at mid-1".into(),
            unit: "m/s2".into(),
            raw: slow.iter().zip(&fast).map(|(a, b)| a + 0.4 * b).collect(),
            filtered: slow,
            time,
            filter: FILTER.into(),
            cut_off: Some(32.0),
        }],
        space_time: Some(SpaceTime {
            x: line.to_vec(),
            time: (0..120).map(|i| 0.03 * f64::from(i)).collect(),
            values: (0..120).map(row).collect(),
            paths: vec![[[0.2, 0.0], [1.1, 50.0]]],
        }),
    }
}

fn train(k: i32) -> Train {
    let bell = |i: i32| [4.0 + 0.2 * f64::from(i), 5e6 / (1.0 + (0.2 * f64::from(i) - 10.0 - f64::from(k)).powi(2))];
    Train {
        name: format!("HSLM-A{k}"),
        axles: (0..50).map(|i| [f64::from(i / 2) * 18.0 + f64::from(i % 2) * 2.0, 170e3]).collect(),
        signature: (0..200).map(bell).collect(),
        spacings: vec![17.0 + f64::from(k)],
        starts_at: 0.0,
        source: "EN 1991-2:2003, 6.4.6.1.1".into(),
    }
}

fn everything<'a>(results: &'a Results, verdicts: &'a Verdicts) -> Input<'a> {
    let line: Vec<f64> = (0..=40).map(|i| 1.25 * f64::from(i)).collect();
    let arch = |a: f64| line.iter().map(|x| a * (PI * x / 25.0).sin().abs()).collect();
    let run_id = results.runs[0].run_id.clone();
    Input {
        people: vec![["project".into(), "Line 7".into()], ["checker".into(), "A. N. Other".into()]],
        hash: Some("0123456789abcdef".into()),
        bridge: Some(bridge(&line)),
        trains: (1..=10).map(train).collect(),
        envelopes: vec![Envelope {
            run_id: run_id.clone(),
            quantity: "deck.acceleration".into(),
            filter: "raw".into(),
            min: arch(-3.0),
            max: arch(3.3),
            x: line.clone(),
        }],
        passages: vec![passage(&run_id, &line)],
        commands: vec!["ttb sweep MY.json --trains hslm-a -o DIR".into(), "ttb report DIR".into()],
        files: vec![["peaks.csv".into(), "one value a row".into()]],
        ..nothing(results, verdicts)
    }
}

fn page() -> String {
    let results = results();
    let criteria = Criteria::bundled(&["en1990-2002", "en1991-2-2003"]).expect("bundled");
    let verdicts = judge(&criteria, &facts(), &results);
    render(&everything(&results, &verdicts)).expect("a page")
}

#[test]
fn the_page_answers_first_and_asks_nothing_of_a_network() {
    let page = page();
    if let Ok(path) = std::env::var("TTB_REPORT_PAGE") {
        std::fs::write(path, &page).expect("a file for a browser");
    }
    let sentence = page.find("Exceeded: deck-acceleration (forces, smooth rail)").expect("the answer");
    assert!(sentence < page.find("<h2>").expect("a section"));
    assert!(page.contains("Governed by deck-acceleration: HSLM-A1 at 215 km&#x2f;h"), "the governing train");
    assert!(page.contains("(secondary)") && page.contains("Not judged, and why"));
    assert!(page.contains("Two spans of 25 m &lt;first draft&gt; &amp; more"), "texts are escaped");
    for request in ["http://", "https://", "src=", "@import", "url("] {
        assert!(!page.contains(request), "{request}");
    }
    assert!(page.trim_start().starts_with("<!DOCTYPE html>"));
    assert!(page.len() < 3_000_000, "{} bytes", page.len());
}

#[test]
fn equal_inputs_give_equal_pages_and_every_run_is_one_of_the_results() {
    let page = page();
    assert_eq!(page, self::page());
    let known: BTreeSet<String> = results().runs.into_iter().map(|run| run.run_id).collect();
    let shown = page.split("<code class=\"run\">").skip(1).filter_map(|rest| rest.split('<').next());
    let shown: Vec<&str> = shown.collect();
    assert!(!shown.is_empty() && shown.iter().all(|id| known.contains(*id)), "{shown:?}");
}

#[test]
fn a_page_without_anything_is_complete_too() {
    let results = Results::default();
    let verdicts = judge(&Criteria::bundled(&["en1990-2002"]).expect("bundled"), &Facts::default(), &results);
    let page = render(&nothing(&results, &verdicts)).expect("a page");
    assert!(page.contains("No criterion with a limit could be judged") && page.contains("Not judged, and why"));
}
