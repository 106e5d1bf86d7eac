//! Filters against scipy 1.17.1 (`butter(…, output="sos")`, `sosfilt`, `sosfiltfilt`, `numpy.percentile`) and closed forms.
//! `data/butterworth.json` has a record and what scipy makes of it, every twentieth value.

use std::f64::consts::FRAC_1_SQRT_2;

use serde_json::Value;
use ttb_assessment::filter::sliding_mean;
use ttb_assessment::{Butterworth, Filter, Phase, SignalError, percentile};

fn reference() -> Value {
    serde_json::from_str(include_str!("data/butterworth.json")).expect("JSON")
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().expect("a list").iter().map(|v| v.as_f64().expect("a number")).collect()
}

fn close(found: &[f64], expected: &[f64]) {
    assert_eq!(found.len(), expected.len());
    for (i, (f, e)) in found.iter().zip(expected).enumerate() {
        assert!((f - e).abs() <= 1e-9, "value {i}: {f}, scipy {e}");
    }
}

fn every_twentieth(signal: &[f64]) -> Vec<f64> {
    signal.iter().copied().step_by(20).collect()
}

#[test]
fn butterworth_filters_are_those_of_scipy() {
    let data = reference();
    let (signal, rate) = (numbers(&data["signal"]), data["rate"].as_f64().expect("rate"));
    for case in data["butterworth"].as_array().expect("cases") {
        let (order, cut_off_hz) =
            (case["order"].as_u64().expect("order") as usize, case["cut_off"].as_f64().expect("Hz"));
        for (phase, key) in [(Phase::Zero, "zero"), (Phase::Causal, "causal")] {
            let filter = Filter::Butterworth { order, cut_off_hz, phase };
            let filtered = filter.apply(&signal, rate, 0.0).expect("a filter");
            close(&every_twentieth(&filtered), &numbers(&case[key]));
            close(&[filtered[signal.len() - 1]], &[case[format!("{key}_last")].as_f64().expect("last")]);
        }
        if order % 2 == 0 {
            let filter = Butterworth::new(order, cut_off_hz, rate, Phase::Zero).expect("a filter");
            for (found, expected) in
                filter.cascade().sections().iter().zip(case["sections"].as_array().expect("rows")).skip(1)
            {
                let expected = numbers(expected);
                close(&found.a, &expected[4..]);
            }
        }
    }
    let compensated = Filter::Butterworth { order: 4, cut_off_hz: 30.0, phase: Phase::Compensated };
    close(&every_twentieth(&compensated.apply(&signal, rate, 0.0).expect("a filter")), &numbers(&data["compensated"]));
    assert!((Butterworth::compensated_cut_off(4, 30.0) - 33.494_09).abs() < 5e-6);
}

#[test]
fn gains_are_those_of_the_closed_form() {
    let filter = Butterworth::new(4, 30.0, 1000.0, Phase::Causal).expect("a filter");
    for (f, gain) in [(5.0, 0.9999997), (20.0, 0.9812854), (30.0, FRAC_1_SQRT_2), (40.0, 0.2991340), (60.0, 0.0601866)]
    {
        assert!((filter.gain(f) - gain).abs() < 5e-8, "{f} Hz: {}", filter.gain(f));
    }
    let tan = |f: f64| (std::f64::consts::PI * f / 1000.0).tan();
    for (order, f) in [(1, 12.0), (3, 45.0), (7, 29.0)] {
        let gain = Butterworth::new(order, 30.0, 1000.0, Phase::Zero).expect("a filter").gain(f);
        let expected = 1.0 / (1.0 + (tan(f) / tan(30.0)).powi(2 * order as i32));
        assert!((gain - expected).abs() < 1e-12, "order {order}, {f} Hz: {gain}, {expected}");
    }
}

#[test]
fn a_constant_stays_as_it_is_in_two_passes() {
    let filtered = Filter::Butterworth { order: 4, cut_off_hz: 20.0, phase: Phase::Zero };
    let filtered = filtered.apply(&[7.0; 40], 1000.0, 0.0).expect("a filter");
    assert!(filtered.iter().all(|value| (value - 7.0).abs() < 1e-9));
}

#[test]
fn a_record_that_has_no_meaning_is_refused_with_the_reason() {
    let zero = |order, cut_off_hz| Filter::Butterworth { order, cut_off_hz, phase: Phase::Zero };
    let error =
        |filter: Filter, signal: &[f64], rate| filter.apply(signal, rate, 0.1).expect_err("refused").to_string();
    assert!(error(zero(4, 30.0), &[0.0; 15], 1000.0).contains("16 values; the record has 15"));
    assert!(error(zero(4, 30.0), &[0.0; 50], 60.0).contains("at least 60 values a second"));
    assert!(error(zero(0, 30.0), &[0.0; 50], 1000.0).contains("from 1 to 20"));
    assert!(error(zero(4, -1.0), &[0.0; 50], 1000.0).contains("positive"));
    assert!(error(zero(4, 30.0), &[0.0, f64::NAN], 1000.0).contains("value 1 of the record is NaN"));
    assert!(matches!(sliding_mean(&[0.0; 3], 0.0, 2.0), Err(SignalError::OutOfRange { .. })));
}

#[test]
fn a_sliding_mean_of_a_straight_line_is_the_line_and_half_a_window_at_the_ends() {
    let way = 0.069;
    let line: Vec<f64> = (0..200).map(|i| 3.0 + 0.5 * way * f64::from(i)).collect();
    let mean = sliding_mean(&line, way, 2.0).expect("a mean");
    for i in 15..185 {
        assert!((mean[i] - line[i]).abs() < 1e-9);
    }
    // At the first value the window is 1 m long: the mean is the value half a metre on.
    assert!((mean[0] - (3.0 + 0.5 * 0.5)).abs() < 1e-9);
    // A tooth of one value, linear on both sides: area 1 × distance, seen whole over 2 m.
    let mut tooth = vec![0.0; 200];
    tooth[100] = 1.0;
    let mean = sliding_mean(&tooth, way, 2.0).expect("a mean");
    assert!((mean[100] - way / 2.0).abs() < 1e-12 && mean[60].abs() < 1e-12);
    assert_eq!(sliding_mean(&[4.0], way, 2.0).expect("one value"), [4.0]);
}

#[test]
fn percentiles_are_those_of_numpy() {
    let data = reference();
    let signal = numbers(&data["signal"]);
    for (q, expected) in data["percentiles"].as_object().expect("percentiles") {
        let found = percentile(&signal, q.parse().expect("a number")).expect("a percentile");
        assert!((found - expected.as_f64().expect("a number")).abs() < 1e-12, "{q} %");
    }
    let twenty: Vec<f64> = (1..=20).rev().map(f64::from).collect();
    assert!((percentile(&twenty, 95.0).expect("a percentile") - 19.05).abs() < 1e-12);
    assert_eq!(
        (percentile(&[], 50.0), percentile(&[1.0, f64::NAN], 50.0), percentile(&[1.0], 101.0)),
        (None, None, None)
    );
}

#[test]
fn labels_say_all_parameters() {
    let butterworth = Filter::Butterworth { order: 4, cut_off_hz: 30.0, phase: Phase::Zero };
    assert_eq!(butterworth.label(), "butterworth-4-30Hz-zero");
    assert_eq!(
        (Filter::Raw.label().as_str(), Filter::SlidingMean { length_m: 2.0 }.label().as_str()),
        ("raw", "mean-2m")
    );
    let read: Filter =
        serde_json::from_str(r#"{"type":"butterworth","order":4,"cut_off_hz":30,"phase":"zero"}"#).expect("a filter");
    assert_eq!(read, butterworth);
    assert!(serde_json::from_str::<Filter>(r#"{"type":"sliding-mean","length":2}"#).is_err());
}
