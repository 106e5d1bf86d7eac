//! The cable-stayed bridge.

mod sound;

use std::time::Instant;

use ttb_generate::measure::{coordinates, degrees_of_freedom, mass};
use ttb_generate::{CableStayed, cable_stayed, text};
use ttb_scenario::types::{Model, Shells};

const SIZES: [usize; 3] = [12_000, 120_000, 1_200_000];

fn bridge(dofs: usize) -> Model {
    cable_stayed(&CableStayed { dofs, ..CableStayed::default() }).unwrap()
}

fn own(section: &str) -> bool {
    !section.starts_with("before") && !section.starts_with("after")
}

#[test]
fn the_bridge_weighs_what_the_paper_says_on_every_mesh() {
    for dofs in SIZES {
        let model = bridge(dofs);
        let weight = mass(&model, own) / 1e3;
        let parts = ["girder", "tower", "pier", "cable"].map(|p| (mass(&model, |s| s.starts_with(p)) / 1e3).round());
        println!("{dofs}: {weight:.1} t {parts:?}, with approaches {:.1} t", mass(&model, |_| true) / 1e3);
        assert!((weight / 11_800.0 - 1.0).abs() < 0.02, "{weight} t");
    }
}

#[test]
fn the_mesh_has_the_degrees_of_freedom_asked_for() {
    for dofs in [9_000, 12_000, 20_000, 33_000, 60_000, 120_000, 250_000, 500_000, 1_200_000] {
        let model = bridge(dofs);
        let found = degrees_of_freedom(&model);
        let aspect = sound::worst_aspect(&model);
        let shells: usize = model.shells.iter().map(|g| g.elements.len()).sum();
        println!("{dofs}: {found} dof, {} nodes, {shells} shells, aspect {aspect:.2}", model.nodes.len());
        assert!((found as f64 / dofs as f64 - 1.0).abs() < 0.05, "{dofs}: {found}");
        assert!(aspect < if dofs < 12_000 { 8.01 } else { 6.0 }, "{dofs}: aspect {aspect}");
    }
}

#[test]
fn every_mesh_is_sound() {
    for dofs in SIZES {
        let model = bridge(dofs);
        sound::references(&model);
        sound::connected(&model);
        sound::no_twins(&model, &[32.0, 224.0, 256.0]);
        sound::symmetric(&model);
    }
}

#[test]
fn an_eccentric_track_has_lines_of_its_own() {
    for track_y in [0.3, 1.0, -2.3] {
        let model = cable_stayed(&CableStayed { track_y, ..CableStayed::default() }).unwrap();
        sound::references(&model);
        sound::connected(&model);
        let aspect = sound::worst_aspect(&model);
        println!("y = {track_y}: aspect {aspect:.2}");
        assert!(aspect < 6.0);
        assert_eq!(model.deck.y, track_y);
        assert!(model.nodes.iter().any(|node| node.2 == track_y && node.3 == 0.0));
        assert!((degrees_of_freedom(&model) as f64 / 120_000.0 - 1.0).abs() < 0.05);
        // the strip with the track's load lies under the track
        let heavy = mass(&model, |s| s == "girder-floor-track") / mass(&cable_model(), |s| s == "girder-floor-track");
        assert!((heavy - 1.0).abs() < 1e-3, "{heavy}");
    }
}

fn cable_model() -> Model {
    bridge(120_000)
}

/// Of the girder between half a cable distance before the first and after the last cable of a side, the cables carry the
/// dead load.
#[test]
fn the_cables_carry_the_dead_load_of_the_girder_they_hold() {
    let model = bridge(120_000);
    let at = coordinates(&model);
    let lift: f64 = model
        .trusses
        .iter()
        .flat_map(|group| group.elements.iter().zip(group.tensions.iter().flatten()))
        .map(|(pair, tension)| {
            let (low, high) = (at[&pair[0]], at[&pair[1]]);
            let length = (0..3).map(|k| (high[k] - low[k]).powi(2)).sum::<f64>().sqrt();
            tension * (low[2] - high[2]) / length
        })
        .sum();
    // elements whose centre lies between 12 and 108 m from the tower, cross-beams at the ends by half
    let mut held = model.clone();
    let distance = |element: &[u32]| {
        let x = element.iter().map(|node| at[node][0]).sum::<f64>() / element.len() as f64;
        (x - 144.0).abs()
    };
    held.shells = Vec::new();
    for group in model.shells.iter().filter(|group| own(&group.section)) {
        let elements = group.elements.iter().filter(|e| (12.001..107.999).contains(&distance(e))).cloned().collect();
        held.shells.push(Shells { section: group.section.clone(), elements });
    }
    held.trusses.clear();
    held.beams.clear();
    let dead = mass(&held, |_| true) * 9.81;
    println!("lift {:.1} MN, dead load {:.1} MN", lift / 1e6, dead / 1e6);
    assert!((lift / dead - 1.0).abs() < 0.02, "{} of the dead load", lift / dead);
}

#[test]
fn the_same_numbers_give_the_same_file_and_it_reads_back() {
    let model = bridge(12_000);
    let written = text(&model);
    assert_eq!(written, text(&bridge(12_000)));
    assert_eq!(serde_json::from_str::<Model>(&written).unwrap(), model);
}

#[test]
fn numbers_that_make_no_bridge_are_refused_all_at_once() {
    let refused = cable_stayed(&CableStayed { track_y: 3.0, approach: 1.0, dofs: 10 }).unwrap_err();
    assert_eq!(refused.0.len(), 2, "{refused}");
    assert!(refused.to_string().contains("track_y must lie between"));
    let refused = cable_stayed(&CableStayed { dofs: 10, ..CableStayed::default() }).unwrap_err();
    assert!(refused.to_string().contains("at least"), "{refused}");
}

#[test]
fn a_million_degrees_of_freedom_take_less_than_three_seconds() {
    let start = Instant::now();
    let model = bridge(1_200_000);
    let made = start.elapsed();
    let length = text(&model).len();
    println!("made in {made:?}, written in {:?}, {:.1} MB", start.elapsed() - made, length as f64 / 1e6);
    assert!(cfg!(debug_assertions) || start.elapsed().as_secs_f64() < 3.0);
}
