//! Simply supported girders, cross-sections.

mod sound;

use ttb_generate::measure::{degrees_of_freedom, mass};
use ttb_generate::{CableStayed, Viaduct, cable_stayed, simple_span, viaduct};
use ttb_scenario::types::Frame;

#[test]
fn a_span_and_viaducts_are_sound_at_every_size() {
    for (spans, dofs) in [(1, 2_000), (1, 12_000), (10, 12_000), (10, 120_000), (56, 120_000), (56, 1_200_000)] {
        let asked = Viaduct { spans, dofs, ..Viaduct::default() };
        let model = viaduct(&asked).unwrap();
        let found = degrees_of_freedom(&model);
        let aspect = sound::worst_aspect(&model);
        println!("{spans} spans, {dofs}: {found} dof, aspect {aspect:.2}");
        assert!((found as f64 / dofs as f64 - 1.0).abs() < 0.05, "{spans}, {dofs}: {found}");
        assert!(aspect < 8.1, "{spans}, {dofs}: {aspect}");
        sound::references(&model);
        sound::connected(&model);
        let joints: Vec<f64> = (1..spans).map(|i| 32.0 * i as f64).collect();
        sound::no_twins(&model, &joints);
        sound::symmetric(&model);
        // the mass does not depend on the mesh: section, cross-beams at 0, 4, …, 32 m, track
        let trough = asked.trough();
        let concrete = 32.0 * trough.area(3.5) + 9.0 * trough.cross_beam_volume();
        let expected = spans as f64 * (concrete * 26e3 + 32.0 * 67.9e3) / 9.81;
        assert!((mass(&model, |_| true) / expected - 1.0).abs() < 1e-5);
    }
}

#[test]
fn fifty_six_spans_carry_three_thousand_supports() {
    let model = viaduct(&Viaduct { spans: 56, ..Viaduct::default() }).unwrap();
    assert!((model.deck.length / 0.6 / 3000.0 - 1.0).abs() < 0.01);
}

#[test]
fn a_span_of_other_dimensions_is_sound_too() {
    for (length, width, depth) in [(10.0, 6.5, 1.2), (25.0, 8.0, 2.5), (60.0, 14.0, 5.0)] {
        let model = simple_span(length, width, depth, 20_000).unwrap();
        sound::references(&model);
        sound::connected(&model);
        sound::no_twins(&model, &[]);
        sound::symmetric(&model);
        assert!(sound::worst_aspect(&model) < 6.0);
        assert_eq!(model.deck.length, length);
    }
    assert!(simple_span(1.0, 2.0, 0.1, 20_000).unwrap_err().0.len() == 4);
}

/// A slender beam: π/2 √(EI/(m L⁴)); about 5 Hz is usual for 32 m.
#[test]
fn the_span_of_32_m_has_a_frequency_of_about_5_hz() {
    let trough = Viaduct::default().trough();
    let m = (trough.area(3.5) + trough.cross_beam_volume() / 4.0) * 26e3 / 9.81 + 67.9e3 / 9.81;
    let hz = 0.5 * std::f64::consts::PI * (3.45e10 * trough.inertia(3.5) / m).sqrt() / 32.0_f64.powi(2);
    println!("A {:.3} m2, I {:.3} m4, {m:.0} kg/m, {hz:.2} Hz", trough.area(3.5), trough.inertia(3.5));
    assert!((4.0..6.5).contains(&hz), "{hz} Hz");
}

/// The plane frame's girder was estimated from a floor and two webs without flanges and cross-beams and its area trimmed
/// to the mass: 11.8 m² and 14 m⁴. Here cross-beams take part of the mass, so that the area along the bridge is smaller;
/// flanges raise the second moment.
#[test]
fn the_shells_have_nearly_the_plane_frames_cross_section() {
    let model = cable_stayed(&CableStayed::default()).unwrap();
    let frame: Frame = serde_json::from_str(include_str!("../../scenario/data/bridges/cable-stayed-224.json")).unwrap();
    let girder = frame.sections.iter().find(|s| s.name == "girder").unwrap();
    // from the mesh: shells of the main girder that cross the section at x = 90.2 m
    let thickness = |name: &str| model.shell_sections.iter().find(|s| s.name == name).map_or(0.0, |s| s.thickness);
    let at = ttb_generate::measure::coordinates(&model);
    let mut parts = Vec::new();
    for group in model.shells.iter().filter(|g| g.section.starts_with("girder")) {
        for element in &group.elements {
            let p: Vec<[f64; 3]> = element.iter().map(|node| at[node]).collect();
            if p[0][0] < 90.2 && p[1][0] > 90.2 {
                let (a, b, t) = (p[0], p[3], thickness(&group.section));
                let (wide, high) = ((a[1] - b[1]).abs(), (a[2] - b[2]).abs());
                let area = t * (wide + high);
                parts.push((
                    area,
                    0.5 * (a[2] + b[2]),
                    area * (high * high + if wide > 0.0 { t * t } else { 0.0 }) / 12.0,
                ));
            }
        }
    }
    let area: f64 = parts.iter().map(|part| part.0).sum();
    let centre = parts.iter().map(|part| part.0 * part.1).sum::<f64>() / area;
    let inertia: f64 = parts.iter().map(|(a, z, own)| own + a * (z - centre).powi(2)).sum();
    println!("A {area:.3} (frame {}), I {inertia:.3} (frame {}), centre {centre:.3}", girder.area, girder.inertia);
    assert!((area / girder.area - 1.0).abs() < 0.10, "{area}");
    assert!((inertia / girder.inertia - 1.0).abs() < 0.07, "{inertia}");
    // with cross-beams: the mass per metre
    let per_metre = mass(&model, |s| s.starts_with("girder")) / 224.0;
    assert!((per_metre / girder.mass - 1.0).abs() < 0.03, "{per_metre}");
}
