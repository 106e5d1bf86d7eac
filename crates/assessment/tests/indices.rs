//! Weightings and indices against scipy 1.17.1 (`bilinear`, `lfilter`), the Python package rainflow, and closed forms.

use std::f64::consts::PI;

use serde_json::Value;
use ttb_assessment::filter::Weighting;
use ttb_assessment::index::{
    block_rms, lines, losses, n_mv, peak_to_peak, rainflow, rms, running_rms, sperling, sperling_continuous,
};

const RATE: f64 = 1000.0;

fn reference() -> Value {
    serde_json::from_str(include_str!("data/weightings.json")).expect("JSON")
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().expect("a list").iter().map(|v| v.as_f64().expect("a number")).collect()
}

/// a = 0.30 sin 2π1.2t + 0.10 sin 2π8t + 0.05 sin 2π20t, m/s².
fn three_tones(seconds: usize) -> Vec<f64> {
    let tone = |t: f64, (amplitude, f): (f64, f64)| amplitude * (2.0 * PI * f * t).sin();
    (0..seconds * RATE as usize)
        .map(|i| [(0.30, 1.2), (0.10, 8.0), (0.05, 20.0)].map(|one| tone(i as f64 / RATE, one)).iter().sum())
        .collect()
}

const CURVES: [Weighting; 4] = [Weighting::Wk, Weighting::WbEn12299, Weighting::WbIso8041, Weighting::Wd];

#[test]
fn weightings_are_those_of_scipy() {
    let (data, signal) = (reference(), three_tones(6));
    for curve in CURVES {
        let expected = &data[curve.label()];
        let weighted = curve.apply(&signal, RATE).expect("weighted");
        for (found, expected) in weighted.iter().step_by(500).zip(numbers(&expected["values"])) {
            assert!((found - expected).abs() < 1e-9, "{curve:?}: {found}, {expected}");
        }
        let value = |key: &str| expected[key].as_f64().expect("a number");
        assert!((rms(&weighted) - value("rms")).abs() < 1e-9);
        assert!((running_rms(&weighted, RATE, 1.0).expect("1 s").0 - value("mtvv")).abs() < 1e-9);
        assert!((running_rms(&weighted, RATE, 5.0).expect("5 s").0 - value("c5")).abs() < 1e-9);
        for (f, expected) in [1.0, 4.0, 8.0, 16.0, 31.5].into_iter().zip(numbers(&expected["analog"])) {
            assert!((curve.gain(f) - expected).abs() < 1e-9, "{curve:?} at {f} Hz");
        }
    }
}

#[test]
fn gains_of_the_weightings_are_those_of_the_tables() {
    // Wk at the exact thirds of an octave; the ISO table (0.482, 0.967, 1.036, 0.768, 0.405) is met at the nominal ones.
    for (f, gain) in [(1.0, 0.4825), (3.98107, 0.9648), (7.94328, 1.0374), (15.84893, 0.7743), (31.62278, 0.4031)] {
        assert!((Weighting::Wk.gain(f) - gain).abs() < 6e-5, "{f} Hz: {}", Weighting::Wk.gain(f));
    }
    for (f, gain) in [(1.0, 0.482), (4.0, 0.967), (8.0, 1.036), (16.0, 0.768), (31.5, 0.405)] {
        assert!((Weighting::Wk.gain(f) - gain).abs() < 1e-3, "{f} Hz: {}", Weighting::Wk.gain(f));
    }
    for (curve, gains) in [
        (Weighting::WbEn12299, [0.3911, 0.8218, 1.0559, 0.9183, 0.5309]),
        (Weighting::WbIso8041, [0.3853, 0.8891, 1.0251, 0.8103, 0.4923]),
    ] {
        for (f, gain) in [1.0, 4.0, 8.0, 16.0, 31.5].into_iter().zip(gains) {
            assert!((curve.gain(f) - gain).abs() < 6e-5, "{curve:?} {f} Hz: {}", curve.gain(f));
        }
    }
}

#[test]
fn the_weighted_rms_of_three_tones_is_that_of_their_lines() {
    let signal = three_tones(15);
    for (curve, expected) in
        [(Weighting::Wk, 0.128144), (Weighting::WbEn12299, 0.115676), (Weighting::WbIso8041, 0.112198)]
    {
        let weighted = curve.apply(&signal, RATE).expect("weighted");
        let settled = rms(&weighted[10_000..]);
        assert!((settled / expected - 1.0).abs() < 1e-3, "{curve:?}: {settled}");
    }
}

#[test]
fn a_weighting_of_a_coarse_record_is_refused() {
    let error = Weighting::Wk.apply(&[0.0; 100], 200.0).expect_err("refused").to_string();
    assert!(error.contains("at least 1000 values a second; the record has 200"), "{error}");
    assert!(Weighting::Wk.apply(&[0.0; 10], 1.0 / 0.001).is_ok());
}

#[test]
fn mean_comfort_needs_five_minutes() {
    let error = n_mv(&[0.1; 8000], RATE).expect_err("8 s").to_string();
    assert_eq!(error, "N_MV of EN 12299 needs 300 s; the record has 8");
    // Sixty blocks whose rms is 1, 2, … 60: 95 % is 57.05.
    let blocks: Vec<f64> = (1..=60).flat_map(|k| vec![f64::from(k); 50]).collect();
    assert!((n_mv(&blocks, 10.0).expect("five minutes") - 6.0 * 57.05).abs() < 1e-9);
    assert_eq!(block_rms(&blocks, 10.0).expect("blocks").len(), 60);
}

#[test]
fn sperlings_index_of_three_tones() {
    let found = lines(&three_tones(5), RATE).expect("lines");
    assert_eq!((found.len(), found[0].frequency), (198, 0.6));
    for (f, amplitude, index) in [(1.2, 0.30, 2.26418), (8.0, 0.10, 1.74561), (20.0, 0.05, 1.07710)] {
        let line = found.iter().find(|line| (line.frequency - f).abs() < 1e-9).expect("a line");
        assert!((line.amplitude - amplitude).abs() < 1e-9);
        assert!((sperling(&[*line]) - index).abs() < 5e-6, "{f} Hz: {}", sperling(&[*line]));
    }
    assert!((sperling(&found) - 2.28057).abs() < 5e-6 && (sperling_continuous(&found) - 2.10668).abs() < 5e-6);
    assert!(lines(&[0.0; 1000], RATE).expect_err("1 s").to_string().contains("needs 2 s; the record has 1"));
    assert!(lines(&[0.0; 1000], 50.0).expect_err("coarse").to_string().contains("at least 80 values"));
}

#[test]
fn losses_of_contact_last_as_long_as_the_closed_form_says() {
    let (tau, rate) = (0.02, 1e6);
    let force = |t: f64| (1.0 - 1.5 * (-(t / tau).powi(2)).exp()).max(0.0);
    let forces: Vec<f64> = (-100_000..100_000).map(|i| force(f64::from(i) / rate)).collect();
    let found = losses(&forces);
    assert_eq!(found.len(), 1);
    let expected = 2.0 * tau * 1.5_f64.ln().sqrt();
    assert!((found[0].seconds(rate) / expected - 1.0).abs() < 1e-3);
    let count = |forces: &[f64]| losses(forces).iter().map(|loss| (loss.first, loss.count)).collect::<Vec<_>>();
    assert_eq!(count(&[0.0, -1.0, 2.0, 0.0, 1.0]), [(0, 2), (3, 1)]);
    assert!(count(&[1.0, 2.0]).is_empty() && count(&[]).is_empty());
}

#[test]
fn cycles_are_those_of_astm_e1049_and_of_the_package_rainflow() {
    let counted = |history: &[f64]| {
        let mut sums: Vec<(f64, f64)> = Vec::new();
        for cycle in rainflow(history) {
            match sums.iter_mut().find(|(range, _)| (range - cycle.range).abs() < 1e-9) {
                Some((_, count)) => *count += cycle.count,
                None => sums.push((cycle.range, cycle.count)),
            }
        }
        sums.sort_by(|a, b| a.0.total_cmp(&b.0));
        sums
    };
    let example = counted(&[-2.0, 1.0, -3.0, 5.0, -1.0, 3.0, -4.0, 4.0, -2.0]);
    assert_eq!(example, [(3.0, 0.5), (4.0, 1.5), (6.0, 0.5), (8.0, 1.0), (9.0, 0.5)]);
    let data = reference();
    let found = counted(&numbers(&data["series"]));
    let expected: Vec<Vec<f64>> = data["rainflow"].as_array().expect("rows").iter().map(numbers).collect();
    assert_eq!(found.len(), expected.len());
    for ((range, count), expected) in found.iter().zip(&expected) {
        assert!((range - expected[0]).abs() < 1e-9 && (count - expected[1]).abs() < 1e-12, "{range} {expected:?}");
    }
    assert!(rainflow(&[]).is_empty() && rainflow(&[1.0, 1.0]).is_empty());
    assert_eq!(rainflow(&[0.0, 1.0, 2.0]).len(), 1);
}

#[test]
fn peak_to_peak_leaves_out_short_peaks_and_looks_at_one_second() {
    let n = 3000;
    let mut signal = vec![0.0; n];
    // 2 for 100 ms, −1 for 100 ms half a second later, −9 for 20 ms, −5 for 100 ms two seconds later.
    signal[300..400].fill(2.0);
    signal[900..1000].fill(-1.0);
    signal[600..620].fill(-9.0);
    signal[2500..2600].fill(-5.0);
    let (value, at) = peak_to_peak(&signal, RATE, 0.05).expect("a value");
    assert_eq!(value, 5.0, "the last peak alone is more than both others together");
    assert!((2549..=2999).contains(&at));
    signal[2500..2600].fill(-2.0);
    assert_eq!(peak_to_peak(&signal, RATE, 0.05).expect("a value").0, 3.0);
    assert_eq!(peak_to_peak(&signal, RATE, 0.0).expect("a value").0, 11.0);
    assert_eq!(peak_to_peak(&signal[250..500], RATE, 0.05).expect("less than a second").0, 2.0);
    assert!(peak_to_peak(&signal[..10], RATE, 0.05).is_err());
}
