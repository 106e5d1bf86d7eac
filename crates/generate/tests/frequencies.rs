//! How the generated bridges move: lowest modes, deflection under the train.

mod equations;

use equations::{Equations, assemble};
use ttb_bridge::space as assembled;
use ttb_generate::{CableStayed, Viaduct, cable_stayed, viaduct};
use ttb_sparse::Layout;
use ttb_sparse::modes::{Modes, lowest};

/// Largest motions along x, y, z of the floor's axis and of the difference of z between the webs, by mode.
fn describe(e: &Equations, modes: &Modes) -> Vec<(f64, [f64; 4])> {
    let floor: Vec<(u32, [f64; 3])> = e.at.iter().filter(|(_, p)| p[2] == 0.0).map(|(n, p)| (*n, *p)).collect();
    let one = |u: &Vec<f64>| {
        let mut most = [0.0_f64; 4];
        for (node, p) in &floor {
            let motion = e.motion(*node, u);
            if p[1] == 0.0 {
                (0..3).for_each(|k| most[k] = most[k].max(motion[k].abs()));
            } else if p[1].abs() > 4.8 {
                most[3] = most[3].max((motion[2]).abs());
            }
        }
        most.map(|v| v * 1e3)
    };
    modes.frequencies().zip(modes.shapes.iter().map(one)).collect()
}

/// Lowest modes as (Hz, largest motions), printed.
fn modes(e: &Equations, count: usize) -> Vec<(f64, [f64; 4])> {
    let modes = lowest(&e.pencil, &e.pencil.factor(1.0, 0.0, 0.0).unwrap(), count).unwrap();
    let found = describe(e, &modes);
    for (hz, [x, y, z, webs]) in &found {
        println!("{hz:.3} Hz: x {x:.2} y {y:.2} z {z:.2} webs {webs:.2}");
    }
    found
}

/// The plane frame's frequencies are those in its source. Its stiffnesses are other estimates of the same bridge, and it
/// knows neither shear, which the shells feel the more the shorter the waves, nor cross-beams: 8 %. (The third, 1.78 Hz on
/// the mesh of 120,000, is 6 % below.)
#[test]
fn the_vertical_frequencies_are_nearly_those_of_the_plane_frame() {
    let model = cable_stayed(&CableStayed { dofs: 12_000, ..CableStayed::default() }).unwrap();
    let found = modes(&assemble(&model), 9);
    let vertical: Vec<f64> = found.iter().filter(|(_, most)| most[2] > most[1]).map(|(hz, _)| *hz).collect();
    for (found, frame) in vertical.iter().zip([0.80, 1.32, 1.90, 2.38]) {
        assert!((found / frame - 1.0).abs() < 0.08, "{found} Hz, plane frame {frame} Hz");
    }
    assert!(vertical.len() >= 4, "{vertical:?}");
    assert!((0.75..0.90).contains(&found[0].0), "no sway or twist below the first vertical frequency");
}

/// The train's axles on the track's axis, the first before the tower: of the order of a four-thousandth of the span, and the
/// coarse mesh is nearly as soft as a finer one.
#[test]
fn the_deflection_under_the_train_hardly_depends_on_the_mesh() {
    let deflection = |dofs: usize| {
        let e = assemble(&cable_stayed(&CableStayed { dofs, ..CableStayed::default() }).unwrap());
        let mut u = vec![0.0; e.pencil.ndof()];
        let places: Vec<f64> = (36..=140).step_by(4).map(f64::from).collect();
        let nodes: Vec<u32> = places.iter().map(|x| e.node([*x, 0.0, 0.0])).collect();
        for car in 0..8 {
            let load = if car == 0 || car == 7 { 156.96e3 } else { 143.23e3 };
            for axle in [0.0, 2.5, 17.375, 19.875] {
                let x = 140.0 - 24.775 * f64::from(car) - axle;
                let after = places.partition_point(|place| *place <= x);
                if after == 0 {
                    continue; // before the first line
                }
                let part = 0.25 * (x - places[after - 1]);
                for (node, share) in [(after - 1, 1.0 - part), (after.min(nodes.len() - 1), part)] {
                    u[e.dofs[&nodes[node]][2].unwrap() as usize] += load * share;
                }
            }
        }
        let mut scratch = u.clone();
        e.pencil.factor(1.0, 0.0, 0.0).unwrap().solve_in_place(&mut u, &mut scratch);
        e.motion(e.node([88.0, 0.0, 0.0]), &u)[2] * 1e3
    };
    let (coarse, fine) = (deflection(12_000), deflection(30_000));
    println!("deflection at A: {coarse:.2} mm, finer mesh {fine:.2} mm");
    assert!((20.0..32.0).contains(&fine), "{fine} mm");
    assert!((coarse / fine - 1.0).abs() < 0.02, "{coarse} mm, {fine} mm");
}

/// Shear, and the floor's bending between the webs, take up to a fifth from the frequency of the slender beam.
#[test]
fn a_span_has_nearly_the_frequency_of_its_beam() {
    let asked = Viaduct { spans: 1, dofs: 3_000, ..Viaduct::default() };
    let trough = asked.trough();
    let m = (trough.area(3.5) + 9.0 / 32.0 * trough.cross_beam_volume()) * 26e3 / 9.81 + 67.9e3 / 9.81;
    let beam = 0.5 * std::f64::consts::PI * (3.45e10 * trough.inertia(3.5) / m).sqrt() / 32.0_f64.powi(2);
    let found = modes(&assemble(&viaduct(&asked).unwrap()), 3);
    let vertical = found.iter().find(|(_, most)| most[2] > most[1]).unwrap().0;
    assert!((0.8..1.0).contains(&(vertical / beam)), "{vertical} Hz, beam {beam} Hz");
}

/// The bridge's own assembly finds the same: mass and degrees of freedom counted here, a ground that carries the weight,
/// the same first frequency.
fn account(dofs: usize) -> f64 {
    let model = cable_stayed(&CableStayed { dofs, ..CableStayed::default() }).unwrap();
    let model_equations = assembled::assemble(&model, &[16.0, 88.0], &[]).unwrap();
    let layout = Layout { node_of: model_equations.node_of, place: model_equations.nodes, ..Layout::default() };
    let pencil = model_equations.equations.finish_with(&layout).unwrap();
    let factor = pencil.factor(1.0, 0.0, 0.0).unwrap();
    let mut scratch = vec![0.0; pencil.ndof()];
    let mut solve = |x: &mut [f64]| factor.solve_in_place(x, &mut scratch);
    let found = assembled::self_check(&model, assembled::Statics::Solved(&mut solve)).unwrap();
    println!("{found}");
    assert!(found.is_sound());
    assert_eq!(found.freedoms, ttb_generate::measure::degrees_of_freedom(&model));
    assert!((found.mass / ttb_generate::measure::mass(&model, |_| true) - 1.0).abs() < 1e-9);
    let frequencies: Vec<f64> = lowest(&pencil, &factor, 6).unwrap().frequencies().collect();
    println!("{frequencies:.3?} Hz, factor of {} entries", factor.entries());
    frequencies[0]
}

#[test]
fn the_bridges_own_assembly_agrees() {
    let here = assemble(&cable_stayed(&CableStayed { dofs: 12_000, ..CableStayed::default() }).unwrap());
    let first = modes(&here, 1)[0].0;
    assert!((account(12_000) / first - 1.0).abs() < 1e-6);
}

#[test]
fn the_example_has_the_coarse_models_first_frequency() {
    assert!((account(120_000) / 0.82 - 1.0).abs() < 0.01);
}
