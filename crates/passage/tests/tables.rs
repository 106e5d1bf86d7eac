//! Peaks under moving trains against tables that two other programs computed.

mod common;

use common::{b15, b25, beams, close, modal, output, peak, run, train, with_forces};
use ttb_passage::{Heading, ModalBridge, Passage, Quantity, Settings, statics};
use ttb_trains::{Signature, load_model};

#[test]
fn frequencies_of_a_simple_beam_are_those_of_the_closed_form() {
    let bridge = modal(&b25());
    for (j, found) in (1..=3).zip(bridge.frequencies()) {
        close(found, 3.554308 * f64::from(j * j), 1e-5, "frequency");
    }
    assert_eq!(bridge.modes().len(), 3);
    close(modal(&b15()).frequencies().next().unwrap(), 5.0, 1e-6, "B15");
    // Without a number: those up to 1.2 times the third or 36 Hz (1.38 j² Hz for 60 m).
    assert_eq!(modal(&beams(&[[25.0, 15e3, 30e9]], false, 0.01, None)).modes().len(), 3);
    assert_eq!(modal(&beams(&[[60.0, 20e3, 200e9]], false, 0.01, None)).modes().len(), 5);
}

#[test]
fn peaks_at_mid_span_are_those_of_the_table() {
    let (b25, b15) = (modal(&b25()), modal(&b15()));
    let rows = [
        (&b25, "12.5", "hslm-a1", 150.0, 7.6395, 1.011),
        (&b25, "12.5", "hslm-a1", 230.0, 17.8245, 6.215),
        (&b25, "12.5", "hslm-a3", 250.0, 26.9467, 10.057),
        (&b25, "12.5", "hslm-a8", 300.0, 25.4784, 10.898),
        (&b25, "12.5", "ice2", 350.0, 34.3362, 14.558),
        (&b15, "7.5", "talgo350", 236.5, 18.495, 15.970),
        (&b15, "7.5", "ice2", 300.0, 7.052, 5.660),
    ];
    for (bridge, place, name, speed, w, a) in rows {
        let response = run(bridge, name, speed);
        let what = format!("{name} at {speed} km/h");
        close(1e3 * peak(bridge, &response, Quantity::Displacement, place), w, 2e-3, &what);
        close(peak(bridge, &response, Quantity::Acceleration, place), a, 3e-3, &what);
    }
}

#[test]
fn accelerations_along_the_deck_are_those_of_the_table() {
    let bridge = modal(&b25());
    let response = run(&bridge, "hslm-a3", 250.0);
    let row = [1.631, 3.204, 4.663, 5.964, 7.076, 8.003, 8.841, 9.486, 9.900, 10.057];
    for (i, expected) in (1..).zip(row) {
        let place = (25.0 * f64::from(i) / 20.0).to_string();
        close(peak(&bridge, &response, Quantity::Acceleration, &place), expected, 3e-3, &place);
    }
}

#[test]
fn static_answers_are_those_of_influence_lines() {
    let bridge = with_forces(&b25());
    let outputs = bridge.outputs();
    let [w, m] = [Quantity::Displacement, Quantity::Moment].map(|q| output(outputs, q, "12.5"));
    let d2 = Passage::new(&bridge, &train("en15528-d2x6"), Heading::Forward, None);
    let largest = |list: &[ttb_passage::Extreme], quantity| {
        let of = outputs.iter().zip(list).filter(|(o, _)| o.quantity == quantity);
        of.map(|(_, e)| e.max).fold(0.0, f64::max)
    };
    close(1e3 * d2.statics()[w].max, 11.2539, 1e-4, "w of D2");
    close(1e-6 * d2.statics()[m].max, 5.0049, 1e-4, "M of D2 at mid-span");
    // 13.6 m is between two deck points.
    close(1e-6 * largest(d2.statics(), Quantity::Moment), 5.0830, 3e-3, "largest M of D2");
    let lm71 = statics::extremes(&bridge, &load_model("lm71").unwrap());
    close(1e-3 * lm71[m].max, 8935.2, 1e-4, "M of LM71");
    close(1e3 * lm71[w].max, 18.7155, 1e-4, "w of LM71");
    // Shear at the end and reaction of one force at the end: the force itself.
    let unit = bridge.influence(output(outputs, Quantity::Reaction, "0"), 0.0);
    assert!((unit - 1.0).abs() < 1e-9, "{unit}");
    let shear = bridge.influence(output(outputs, Quantity::Shear, "0"), 0.01);
    assert!((shear - (1.0 - 0.01 / 25.0)).abs() < 1e-9, "{shear}");
    // PL/4 under a force at mid-span, and the triangle beside it.
    for (x, expected) in [(12.5, 6.25), (12.4, 6.2), (1.0, 0.5), (24.0, 0.5)] {
        let found = bridge.influence(m, x);
        assert!((found - expected).abs() < 1e-9, "{x}: {found}");
    }
}

#[test]
fn laws_of_linear_bridges_hold() {
    let bridge = with_forces(&b25());
    let ice2 = train("ice2");
    let at = |train: &ttb_trains::ForceTrain, heading, speed: f64| {
        Passage::new(&bridge, train, heading, None).at(speed / 3.6)
    };
    let one = at(&ice2, Heading::Forward, 200.0);
    // Double loads, double everything.
    let mut double = ice2.clone();
    double.axles.iter_mut().for_each(|axle| axle.load *= 2.0);
    for (a, b) in one.extremes.iter().zip(&at(&double, Heading::Forward, 200.0).extremes) {
        assert!((b.max - 2.0 * a.max).abs() <= 1e-6 * a.max.abs() + 1e-12, "{a:?} {b:?}");
    }
    // A symmetric train backwards over a symmetric span: the same at mid-span.
    let back = at(&ice2, Heading::Backward, 200.0);
    for quantity in [Quantity::Displacement, Quantity::Acceleration, Quantity::Moment] {
        let [a, b] = [&one, &back].map(|r| peak(&bridge, r, quantity, "12.5"));
        close(b, a, 1e-9, "backwards");
        // and mirrored elsewhere
        close(peak(&bridge, &back, quantity, "20"), peak(&bridge, &one, quantity, "5"), 1e-6, "mirrored");
    }
    // φ′ vanishes as the speed does.
    let passage = Passage::new(&bridge, &ice2, Heading::Forward, Some(0.5));
    let slow = passage.at(2.0);
    for quantity in [Quantity::Displacement, Quantity::Moment] {
        let i = output(bridge.outputs(), quantity, "12.5");
        close(slow.extremes[i].max, passage.statics()[i].max, 3e-3, "slow");
    }
    // Twice mass and stiffness: the same frequencies, half the motion, the same moment.
    let heavy = ttb_passage::Settings { forces: true, stiffness: 2.0, mass: 2.0, ..Default::default() };
    let heavy = ttb_passage::ModalBridge::new(&b25(), &heavy).unwrap();
    let response = Passage::new(&heavy, &ice2, Heading::Forward, None).at(200.0 / 3.6);
    for (quantity, factor) in [(Quantity::Displacement, 0.5), (Quantity::Acceleration, 0.5), (Quantity::Moment, 1.0)] {
        let [a, b] = [(&bridge, &one), (&heavy, &response)].map(|(b, r)| peak(b, r, quantity, "12.5"));
        close(b, factor * a, 1e-5, "heavy");
    }
}

#[test]
fn a_refined_resonance_is_where_coaches_meet_the_first_frequency() {
    let bridge = modal(&b25());
    let f1 = bridge.frequencies().next().unwrap();
    let midspan = [Quantity::Displacement, Quantity::Acceleration].map(|q| output(bridge.outputs(), q, "12.5"));
    for (name, d, i) in [("hslm-a1", 18.0, 1.0), ("hslm-a10", 27.0, 1.0), ("hslm-a5", 22.0, 1.0)] {
        let train = train(name);
        let passage = Passage::new(&bridge, &train, Heading::Forward, None);
        let v = f1 * d / i;
        for (output, tolerance) in midspan.into_iter().zip([6e-3, 1e-2]) {
            let at = |v: f64| passage.at(v).extremes[output].largest().0.abs();
            let speeds = (-60..=60).map(|k| v * (1.0 + 0.0005 * f64::from(k)));
            let best = speeds.max_by(|a, b| at(*a).total_cmp(&at(*b))).unwrap();
            assert!((best / v - 1.0).abs() <= tolerance, "{name}: {:.2} km/h, {:.2}", 3.6 * best, 3.6 * v);
        }
        assert!(!Signature::new(&train, 0.01).resonances([4.5, 40.0]).is_empty());
    }
}

#[test]
fn histories_have_the_extremes_of_the_passage_and_take_filters() {
    let bridge = with_forces(&b25());
    let passage = Passage::new(&bridge, &train("hslm-a3"), Heading::Forward, None);
    let (speed, response) = (250.0 / 3.6, passage.at(250.0 / 3.6));
    let histories = passage.histories(speed);
    for quantity in Quantity::ALL {
        let place = if quantity == Quantity::Reaction { "0" } else { "12.5" };
        let i = output(bridge.outputs(), quantity, place);
        let found = ttb_passage::Extreme::of(&histories.output(i), histories.h);
        close(found.max, response.extremes[i].max, 1e-6, "history");
        close(found.min, response.extremes[i].min, 1e-6, "history");
    }
    let accelerations = |factor: f64| {
        let filter = |_: f64, all: &mut [Vec<f64>]| -> Result<(), ()> {
            all.iter_mut().flatten().for_each(|a| *a *= factor);
            Ok(())
        };
        histories.accelerations(filter).expect("nothing fails")
    };
    let (whole, half) = (accelerations(1.0), accelerations(0.5));
    assert_eq!(whole, response.extremes[bridge.positions()..]);
    for (a, b) in whole.iter().zip(half) {
        assert!((0.5 * a.max - b.max).abs() < 1e-12 && (0.5 * a.min - b.min).abs() < 1e-12);
    }
}

#[test]
fn a_bridge_without_modes_has_static_answers_and_rests() {
    let spec = b25();
    let settings = Settings { forces: true, ..Settings::default() };
    let statics = ModalBridge::of_statics(&spec, &settings).expect("a bridge");
    let (train, modal) = (train("hslm-a3"), with_forces(&spec));
    let passage = Passage::new(&statics, &train, Heading::Forward, None);
    let with_modes = Passage::new(&modal, &train, Heading::Forward, None);
    for (alone, beside) in passage.statics().iter().zip(with_modes.statics()) {
        // The rows of the two lie at other distances.
        let near = |a: f64, b: f64| (a - b).abs() <= 1e-3 * beside.max.max(-beside.min);
        assert!(near(alone.max, beside.max) && near(alone.min, beside.min), "{alone:?} {beside:?}");
    }
    let response = passage.at(60.0);
    assert_eq!(response.extremes.len(), statics.outputs().len());
}

/// HSLM-A at 101 speeds: `cargo test --release -p ttb-passage --test tables -- --ignored --nocapture`.
#[test]
#[ignore = "a measurement"]
fn a_thousand_passages_take_less_than_two_seconds() {
    for (bridge, what) in [(modal(&b25()), "w and a"), (with_forces(&b25()), "with moments, shears, reactions")] {
        let cpu = || {
            let now = rustix::time::clock_gettime(rustix::time::ClockId::ProcessCPUTime);
            now.tv_sec as f64 + 1e-9 * now.tv_nsec as f64
        };
        let begin = cpu();
        let mut steps = 0;
        let mut tables = 0.0;
        for train in ttb_trains::find("hslm-a").unwrap() {
            let before = cpu();
            let passage = Passage::new(&bridge, &train, Heading::Forward, None);
            tables += cpu() - before;
            for i in 0..=100 {
                steps += passage.at((100.0 + 3.2 * f64::from(i)) / 3.6).steps;
            }
        }
        let seconds = cpu() - begin;
        let step = 1e9 * (seconds - tables) / steps as f64;
        println!("{what}: {seconds:.3} s of CPU, tables {tables:.3} s, {steps} steps of {step:.1} ns");
        // Moments, shears and reactions are measured beside what is asked for.
        assert!(seconds < 2.0 || what != "w and a", "{seconds}");
    }
}
