//! Whole runs in space: R1 against its printed values, three forces a support against one system solved at once.

use ttb_record::Table as Record;
use ttb_reference::space::Whole;
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

#[test]
fn r1_in_space_is_the_plane_run() {
    let mut plane = ttb_tests::example("r1.json");
    let mut space = r1();
    for checked in [&mut plane, &mut space] {
        checked.scenario.coupling.tolerance = 1e-13;
    }
    let (plane, space) = (library_run(&plane), library_run(&space));
    for (name, of) in [
        ("point[mid].displacement", None),
        ("point[mid].acceleration", None),
        // Of a body 0.45 m below its place without weight, times 4/h²: both runs have their rounding.
        ("car[1].acceleration", Some(9.81)),
        ("car[1].pitch_acceleration", None),
        ("wheel[1].contact_force", None),
        ("wheel[4].contact_force", None),
        ("wheel[2].rail_displacement", None),
    ] {
        let [own, known] = [&space, &plane].map(|table| table.column(name));
        let scale = of.unwrap_or_else(|| known.iter().fold(0.0_f64, |most, x| most.max(x.abs())));
        let off = own.iter().zip(known).fold(0.0_f64, |most, (a, b)| most.max((a - b).abs())) / scale;
        assert!(off < 1e-9, "{name}: {off:e}");
    }
}

/// A car over a girder beside whose axis it runs, on waves that bring flanges to the rails.
fn over_a_girder(track: &str, bays: usize) -> Checked {
    let text = format!(
        r#"{{"title": "a girder", "train": {{"cars": ["ice3-trailer"], "front_wheel": 24, "speed": {{"m_s": 60}},
            "pre_roll": 0}},
            "space": {{"irregularity": {{"type": "harmonics", "alignment": [{{"amplitude": 9e-3, "wavelength": 14}}],
            "cross_level": [{{"amplitude": 2e-3, "wavelength": 9}}], "gauge": [{{"amplitude": 1e-3, "wavelength": 7}}],
            "origin": 25, "ramp": {{"start": 25, "length": 6}}}}}},
            "irregularity": {{"type": "harmonics", "waves": [{{"amplitude": 1e-3, "wavelength": 11}}], "origin": 25,
            "ramp": {{"start": 25, "length": 6}}}},
            "track": {{"type": "{track}", "from": 0, "bays": {bays}, "elements_per_bay": 1}},
            "bridge": {{"at": 31, "structure": {{"type": "finite-elements", "model": "bridges/girder-beam.json"}},
            "damping": {{"type": "rayleigh", "ratio": 0.02, "at": {{"first_times": 4}}}},
            "points": [{{"name": "mid", "x": 16}}, {{"name": "sway", "x": 16, "direction": "y"}}]}},
            "time": {{"step": 0.001, "end": 0.3}}, "coupling": {{"tolerance": 1e-11}}}}"#
    );
    from_str(&text, &examples(), "girder.json").unwrap_or_else(|problems| panic!("{problems}"))
}

/// Histories of both within 1e-9 of their greatest value.
fn compare_with_one_system(checked: &Checked) {
    let table = library_run(checked);
    let mut whole = Whole::new(&checked.train_track, &checked.bridge).expect("a case that the plain solver knows");
    let mut found = vec![Vec::new(); NAMES.len()];
    for step in 0..table.time.len() {
        if step > 0 {
            whole.advance().expect("a step");
        }
        let ([down, _], [across, fast]) = (whole.point(0), whole.point(1));
        let ([y, q], body, axle) = (whole.wheel(1, 1), whole.car(0, 0)[1], whole.car(0, 15)[0]);
        let all = [down, across, fast, body, axle, y, q];
        found.iter_mut().zip(all).for_each(|(column, value)| column.push(value));
    }
    for (name, own) in NAMES.iter().zip(&found) {
        let hybrid = table.column(name);
        let scale = own.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
        // At rest the product tells the forces with creep, which begins with the first step.
        let off = hybrid.iter().zip(own).skip(1).fold(0.0_f64, |most, (a, b)| most.max((a - b).abs())) / scale;
        assert!(off < 1e-9, "{name}: the coupled run and the one system differ by {off:e} of {scale}");
    }
    let (_, most) = table.range("wheel[2].right.lateral_offset");
    assert!(most > 6.2e-3, "no flange was reached: {most} m");
}

const NAMES: [&str; 7] = [
    "point[mid].displacement",
    "point[sway].displacement",
    "point[sway].acceleration",
    "car[1].acceleration_y",
    "wheel[1].lateral_displacement",
    "wheel[2].right.lateral_force",
    "wheel[2].right.vertical_force",
];

#[test]
fn three_forces_a_support_give_the_solution_of_one_system() {
    compare_with_one_system(&over_a_girder("slab", 100));
}

#[test]
fn also_on_sleepers() {
    compare_with_one_system(&over_a_girder("ballast-two-layer", 119));
}
