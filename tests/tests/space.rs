//! Whole runs in space: R1 against its printed values.

use ttb_record::Table as Record;
use ttb_scenario::types::{ProfileCurve, ProfilePiece, ProfileShape};
use ttb_scenario::{Checked, from_str};
use ttb_tests::{examples, library_run};

/// R1 as a train in space: two wheels an axle that share its contact, level profiles over the rails' axes.
fn r1() -> Checked {
    let text = std::fs::read_to_string(examples().join("r1.json")).expect("r1.json");
    let mut scenario: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    scenario["contact"] = serde_json::json!({ "wheel_radius": 0.46 });
    scenario["space"] = serde_json::json!({});
    let mut checked = from_str(&scenario.to_string(), &examples(), "r1.json").unwrap_or_else(|e| panic!("{e}"));
    let space = checked.train_track.space.as_mut().expect("in space");
    // 2 (δ/G′)^{3/2} = (δ/G)^{3/2}, G of a worn tread.
    space.contact.hertz_constant = Some(3.86e-8 * 0.46_f64.powf(-0.115) * 2_f64.powf(2.0 / 3.0));
    let piece = |from, to, c: &[f64]| ProfilePiece { from, to, curve: ProfileCurve::Polynomial(c.to_vec()) };
    space.contact.wheel = ProfileShape::PiecesMm(vec![piece(-20.0, 60.0, &[0.0])]);
    // Between points of the table, so that both corners of the narrow head weigh the same.
    const EDGE: f64 = 10.0125;
    space.contact.rail = ProfileShape::PiecesMm(vec![
        piece(-12.0, -EDGE, &[-20.0 * EDGE, -20.0]),
        piece(-EDGE, EDGE, &[0.0]),
        piece(EDGE, 12.0, &[-20.0 * EDGE, 20.0]),
    ]);
    space.track.inclination = 0.0;
    // 14 mm below the top the side stands 0.7 mm further out.
    space.track.gauge = 2.0 * (space.track.half_distance - 1e-3 * (EDGE + 0.7));
    checked
}

#[test]
fn r1_in_space_has_its_printed_digits() {
    let table = library_run(&r1());
    let source = "two independent programs that agree on every printed digit (docs/theory.md 15); in space a third one";
    let mut record = Record::new("R1 in space, irregular, 1 ms", source, "-p ttb-tests --test space");
    for (what, column, scale, printed, tolerance) in [
        ("mid-span displacement, mm", "point[mid].displacement", 1e3, [None, Some(0.65235)], 2e-5),
        ("mid-span acceleration, m/s²", "point[mid].acceleration", 1.0, [Some(-0.17649), Some(0.12999)], 6e-5),
        ("car body acceleration, m/s²", "car[1].acceleration", 1.0, [Some(-0.10934), Some(0.11819)], 6e-5),
        ("front wheelset, kN", "wheel[1].contact_force", 1e-3, [Some(109.188), Some(176.842)], 6e-6),
    ] {
        let (low, high) = table.range(column);
        for (name, computed, printed) in [("least", low, printed[0]), ("greatest", high, printed[1])] {
            if let Some(printed) = printed {
                record.row(format!("{what}, {name}"), printed, scale * computed, tolerance);
            }
        }
    }
    record.finish();
    let (low, high) = table.range("wheel[1].lateral_displacement");
    assert!(low.abs().max(high.abs()) < 1e-12, "{low} … {high} m to the side");
}
