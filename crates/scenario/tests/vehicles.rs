//! Vehicles of bodies, wheels and links: closed forms, static loads, and everything that is wrong at once.

use std::path::Path;

use serde_json::{Value, json};
use ttb_scenario::types::Vehicle;
use ttb_scenario::vehicle::{Equations, of_car};
use ttb_scenario::{Checked, GRAVITY, Problems, bundled, from_str, from_str_using};

fn scenario(train: Value) -> String {
    let span = json!({ "length": 25, "first_frequency": 4, "mass": 15000 });
    let bridge = json!({ "structure": { "type": "beams", "spans": [span] }, "damping": { "type": "none" } });
    json!({ "train": train, "bridge": bridge }).to_string()
}

fn check(train: Value) -> Result<Checked, Problems> {
    from_str(&scenario(train), Path::new(""), "f")
}

fn vehicle(value: Value) -> Vehicle {
    serde_json::from_value(value).unwrap()
}

/// K by hand: [[k, −k], [−k, k]].
#[test]
fn a_quarter_car_has_two_masses_and_a_spring() {
    let found = Equations::new(&vehicle(json!({
        "bodies": [{ "name": "body", "mass": 9000, "x": 1 }], "wheels": [{ "x": 1, "mass": 800 }],
        "links": [{ "between": ["body", "wheel1"], "stiffness": 5e5, "damping": 2e4 }]
    })))
    .unwrap();
    assert_eq!(found.freedoms, ["body bounce", "wheel1"]);
    assert_eq!((found.mass.as_slice(), found.loads.as_slice()), (&[9000.0, 800.0][..], &[9800.0 * GRAVITY][..]));
    assert_eq!(found.stiffness, [5e5, -5e5, -5e5, 5e5]);
    assert_eq!(found.damping, [2e4, -2e4, -2e4, 2e4]);
}

/// A body on two springs at a and b from its centre of gravity: P = mg b/(a+b), mg a/(a+b).
#[test]
fn a_body_off_the_centre_loads_the_nearer_axle() {
    let wagon = json!({
        "bodies": [{ "name": "body", "mass": 20000, "inertia": 1e5, "x": 4 }],
        "wheels": [{ "x": 2, "mass": 1500 }, { "x": 11, "mass": 1500, "load": 1000 }], "length": 14,
        "links": [
            { "between": ["body", "wheel1"], "stiffness": 2e6 }, { "between": ["wheel2", "body"], "stiffness": 3e6 }
        ]
    });
    let loads = Equations::new(&vehicle(wagon)).unwrap().loads;
    let expected =
        [2e4 * GRAVITY * 7.0 / 9.0 + 1500.0 * GRAVITY, 2e4 * GRAVITY * 2.0 / 9.0 + 1500.0 * GRAVITY + 1000.0];
    assert!(loads.iter().zip(expected).all(|(a, b)| (a / b - 1.0).abs() < 1e-12), "{loads:?} {expected:?}");
}

#[test]
fn the_bundled_cars_written_as_bodies_carry_their_axle_loads() {
    for car in bundled::cars("ice3").unwrap() {
        let found = Equations::new(&of_car(&car)).unwrap();
        assert_eq!(found.mass.len(), 10);
        assert!(found.loads.iter().all(|load| (load / car.axle_load() - 1.0).abs() < 1e-12), "{:?}", found.loads);
    }
}

#[test]
fn an_articulated_set_is_a_vehicle_of_a_train() {
    let coach = |name: &str, x: f64| json!({ "name": name, "mass": 28000, "inertia": 9e5, "x": x });
    let bogie = |name: &str, x: f64| json!({ "name": name, "mass": 3000, "inertia": 2500, "x": x });
    let mut links = vec![];
    for (coach, bogie, x) in [("a", "p", 3.0), ("a", "q", 20.5), ("b", "q", 21.5), ("b", "r", 39.0)] {
        links.push(json!({ "between": [coach, bogie], "x": x, "stiffness": 6e5, "damping": 3e4 }));
    }
    let mut wheels = vec![];
    for (name, x) in [("p", 3.0), ("q", 21.0), ("r", 39.0)] {
        for arm in [-1.5, 1.5] {
            wheels.push(json!({ "x": x + arm, "mass": 1600 }));
            links
                .push(json!({ "between": [name, format!("wheel{}", wheels.len())], "stiffness": 2e6, "damping": 1e4 }));
        }
    }
    let bodies = [coach("a", 11.75), coach("b", 30.25), bogie("p", 3.0), bogie("q", 21.0), bogie("r", 39.0)];
    let set = json!({ "bodies": bodies, "wheels": wheels, "links": links, "length": 42 });
    let found = check(json!({ "cars": [set, "manchester"], "speed": { "m_s": 60 } })).unwrap_or_else(|p| panic!("{p}"));
    assert!(found.train_track.cars.is_empty() && found.train_track.consist().len() == 2);
    assert_eq!(found.train_track.axle_count(), 10);
    let weight: f64 = found.train_track.vehicles[0].axles().iter().map(|[load, _]| load).sum();
    assert!((weight / (GRAVITY * (2.0 * 28000.0 + 3.0 * 3000.0 + 6.0 * 1600.0)) - 1.0).abs() < 1e-12);
    let offsets = found.train_track.offsets();
    assert_eq!(&offsets[..6], [0.0, 3.0, 18.0, 21.0, 36.0, 39.0]);
}

#[test]
fn everything_wrong_with_a_vehicle_is_told_at_once() {
    let broken = json!({
        "bodies": [
            { "name": "a", "mass": 1000, "inertia": 500, "x": 2 }, { "name": "a", "mass": -1, "x": 20 },
            { "name": "c", "mass": 10, "x": 1, "freedoms": ["pitch"] }
        ],
        "wheels": [{ "x": 3, "mass": 100 }, { "x": 1 }], "length": 10,
        "links": [{ "between": ["a", "wheel1"], "stiffness": 1e5 }, { "between": ["d", "wheel2"], "stiffness": 1e5 }]
    });
    let found = check(json!({ "cars": [broken], "speed": { "m_s": 60 } })).unwrap_err();
    let paths: Vec<&str> = found.0.iter().map(|p| p.path.as_str()).collect();
    for expected in [
        "$.train.cars[0].bodies[1].mass",
        "$.train.cars[0].bodies[1].name",
        "$.train.cars[0].bodies[1].x",
        "$.train.cars[0].bodies[2].inertia",
        "$.train.cars[0].wheels[1].x",
        "$.train.cars[0].wheels[1].mass",
        "$.train.cars[0].links[1].between[0]",
        "$.train.cars[0].links",
    ] {
        assert!(paths.contains(&expected), "{expected}\n{found}");
    }
    let hanging = found.0.iter().find(|p| p.path == "$.train.cars[0].links").unwrap();
    assert!(hanging.value.contains("a pitch is not held"), "{found}");
}

#[test]
fn forces_alone_are_a_list_or_a_name_and_not_beside_cars() {
    let axles = [[0.0, 170e3], [3.0, 170e3]];
    let list = check(json!({ "forces": axles, "speed": { "m_s": 60 } })).unwrap_or_else(|p| panic!("{p}"));
    assert_eq!((list.train_track.axle_count(), list.axle_load), (2, 170e3));
    let named = scenario(json!({ "forces": "two", "speed": { "m_s": 60 } }));
    let look_up = |name: &str, _: &Path| if name == "two" { Ok(axles.to_vec()) } else { Err("no such train".into()) };
    let named = from_str_using(&named, Path::new(""), "f", &[], &look_up).unwrap_or_else(|p| panic!("{p}"));
    assert_eq!(named.hash, list.hash);
    let problems = |train: Value| {
        check(train).unwrap_err().0.iter().map(|p| format!("{}: {}", p.path, p.rule)).collect::<Vec<_>>()
    };
    assert_eq!(
        problems(json!({ "forces": axles, "cars": ["ice3"], "speed": { "m_s": 60 } })),
        ["$.train: a train has either cars or forces"]
    );
    assert_eq!(problems(json!({ "speed": { "m_s": 60 } })), ["$.train.cars: a train has either cars or forces"]);
    assert_eq!(
        problems(json!({ "forces": [[1, 5], [0, -5]], "speed": { "m_s": 60 } })),
        [
            "$.train.forces[0][0]: axles must be listed from the first one, which is at 0, backwards",
            "$.train.forces[1][0]: axles must be listed from the first one, which is at 0, backwards",
            "$.train.forces[1][1]: the force of an axle must be greater than 0",
        ]
    );
}

/// The scenario of [`check`] with the key `space`.
fn in_space(cars: Value, space: Value) -> Result<Checked, Problems> {
    let train = json!({ "cars": cars, "speed": { "km_h": 200 } });
    let mut whole: Value = serde_json::from_str(&scenario(train)).unwrap();
    whole["space"] = space;
    from_str(&whole.to_string(), Path::new(""), "f")
}

#[test]
fn a_car_in_space_weighs_what_the_plane_one_does_and_a_side_has_half_of_its_springs() {
    use ttb_scenario::spec::LinkLaw;
    for name in ["manchester", "ice3-motor", "ice3-trailer", "emu-a", "emu-b"] {
        let checked = in_space(json!([name]), json!({})).unwrap_or_else(|problems| panic!("{problems}"));
        let (plane, space) = (&checked.train_track.cars[0], &checked.train_track.space.as_ref().unwrap().cars[0]);
        assert!(plane.space.is_none(), "the plane data stay plane");
        let mass: f64 = space.bodies.iter().map(|body| body.mass).sum();
        assert!((GRAVITY * mass / (4.0 * plane.axle_load()) - 1.0).abs() < 1e-14, "{name}");
        let vertical = |bodies: [usize; 2]| -> [f64; 2] {
            let between = space.links.iter().filter(|link| link.between == bodies);
            between.fold([0.0; 2], |[k, c], link| match &link.law {
                LinkLaw::Linear { stiffness, damping } => [k + stiffness[2], c + damping[2]],
                _ => [k, c],
            })
        };
        assert_eq!(vertical([0, 2]), [plane.secondary_stiffness, plane.secondary_damping], "{name}");
        assert_eq!(vertical([2, 6]), [plane.primary_stiffness, plane.primary_damping], "{name}");
        // A rigid motion, here roll about the rail's top, y = −h φ·(−1), strains no link between two bodies.
        for link in &space.links {
            let across = |end: usize| space.bodies[link.between[end]].height - link.at[end][2];
            assert!((across(0) - across(1)).abs() < 1e-12, "{name}: both ends of a link are at one height");
            let along = |end: usize| space.bodies[link.between[end]].x + link.at[end][0];
            assert!((along(0) - along(1)).abs() < 1e-12 && link.at[0][1] == link.at[1][1], "{name}");
        }
    }
}

#[test]
fn all_that_a_run_in_space_leaves_out_is_chosen_and_written_down() {
    let checked = in_space(json!(["manchester"]), json!({})).unwrap();
    let keys: Vec<&str> = checked.chosen.iter().map(|chosen| chosen.key.as_str()).collect();
    for key in ["space.contact", "space.track", "space.irregularity"] {
        assert!(keys.contains(&key), "{keys:?}");
    }
    let resolved = serde_json::to_value(&checked.scenario).unwrap();
    assert_eq!(resolved["space"]["contact"]["wheel"], "s1002");
    assert_eq!(resolved["space"]["track"]["lateral"]["stiffness"], 2e7);
    assert!(checked.bridge.space && checked.train_track.space.is_some());
    // What was chosen, given, is the same scenario.
    let again = from_str(&resolved.to_string(), Path::new(""), "f").unwrap();
    assert_eq!((again.train_track.space, again.hash), (checked.train_track.space, checked.hash));
}

#[test]
fn everything_wrong_in_space_is_told_at_once() {
    let problems = in_space(
        json!(["velaro-e", "manchester"]),
        json!({
            "contact": { "friction": 30, "creep": "shenn", "wheel": "s1002" },
            "curve": { "radius": 40, "begin": 0, "transition": 50 },
            "wind": { "area": 60, "length": 3, "coefficients": "missing.csv" },
            "irregularity": { "type": "spectrum", "spectrum": "fra-4", "seed": 1, "wavelengths": [30, 3] }
        }),
    );
    let text = problems.unwrap_err().to_string();
    for expected in [
        "$.train.cars[0]: a run in space needs a car's data in space: `velaro-e` has none; bundled cars with them: ice3",
        "$.space.contact.friction",
        "`shen`?",
    ] {
        assert!(text.contains(expected), "{expected}\n{text}");
    }
    let problems = in_space(
        json!(["manchester"]),
        json!({
            "curve": { "radius": 40, "begin": 0, "transition": 50 },
            "wind": { "area": 60, "length": 3, "coefficients": "missing.csv" },
            "irregularity": { "type": "spectrum", "spectrum": "fra-4", "seed": 1, "wavelengths": [30, 3] }
        }),
    );
    let text = problems.unwrap_err().to_string();
    for expected in [
        "$.space.curve.radius: a radius must have at least 150 m",
        "$.space.wind: must have exactly one of the keys over_time, over_place: neither",
        "$.space.wind.coefficients: the file cannot be read: missing.csv",
        "$.space.irregularity.wavelengths: wavelengths must be [shortest, longest]",
    ] {
        assert!(text.contains(expected), "{expected}\n{text}");
    }
}

#[test]
fn a_plane_run_refuses_what_belongs_to_space() {
    let mut car = serde_json::to_value(&bundled::cars("manchester").unwrap()[0]).unwrap();
    let text = check(json!({ "cars": [car], "speed": { "km_h": 200 } })).unwrap_err().to_string();
    assert!(text.contains("$.train.cars[0].space: belongs to a run in space"), "{text}");
    car.as_object_mut().unwrap().remove("space");
    let plane = check(json!({ "cars": [car], "speed": { "km_h": 200 } })).unwrap();
    let text = serde_json::to_string(&(&plane.train_track, &plane.bridge, &plane.scenario)).unwrap();
    assert!(!text.contains("\"space\"") && !text.contains("\"ground\":"), "{text}");
}
