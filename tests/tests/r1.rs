//! The full case R1, one ICE 3 trailer over a bridge of 32.5 m: library run against the printed values of two
//! independent codes, against the monolithic solution, and against the run through the FMUs.

use std::collections::HashMap;
use std::process::Command;

use ttb_record::Table as Record;
use ttb_scenario::{Checked, Setting, load_with};
use ttb_tests::{Table, example, examples, library_run, ttb};

/// Printed peaks: mid-span mm (t s), mid-span acceleration, car acceleration, contact force of wheel 1 in kN.
struct Printed {
    displacement: f64,
    acceleration: [f64; 2],
    car: [f64; 2],
    wheel: [f64; 2],
}

fn check(case: &str, table: &Table, printed: &Printed) {
    let source = "two independent programs that agree on every printed digit (docs/theory.md 15)";
    let mut record = Record::new(&format!("R1, {case}"), source, "-p ttb-tests --test r1");
    let mut near =
        |what: &str, computed: f64, printed: f64, tolerance: f64| record.row(what, printed, computed, tolerance);
    near("mid-span displacement, mm", 1e3 * table.range("point[mid].displacement").1, printed.displacement, 2e-4);
    let (low, high) = table.range("point[mid].acceleration");
    near("mid-span acceleration, greatest, m/s²", high, printed.acceleration[0], 2e-3);
    near("mid-span acceleration, least, m/s²", low, printed.acceleration[1], 2e-3);
    let (low, high) = table.range("car[1].acceleration");
    near("car body acceleration, greatest, m/s²", high, printed.car[0], 2e-3);
    near("car body acceleration, least, m/s²", low, printed.car[1], 2e-3);
    let (low, high) = table.range("wheel[1].contact_force");
    near("front wheelset, least force, kN", low / 1e3, printed.wheel[0], 2e-4);
    near("front wheelset, greatest force, kN", high / 1e3, printed.wheel[1], 2e-4);
    record.finish();
}

fn with_step(name: &str, step: f64) -> Checked {
    let mut checked = example(name);
    (checked.train_track.step, checked.bridge.step) = (step, step);
    checked
}

#[test]
fn irregular_at_1_ms() {
    let table = library_run(&with_step("r1.json", 1e-3));
    check(
        "irregular, 1 ms",
        &table,
        &Printed {
            displacement: 0.65235,
            acceleration: [0.12999, -0.17649],
            car: [0.11819, -0.10934],
            wheel: [109.188, 176.842],
        },
    );
}

#[test]
fn irregular_at_50_us() {
    let table = library_run(&with_step("r1.json", 5e-5));
    check(
        "irregular, 0.05 ms",
        &table,
        &Printed {
            displacement: 0.65229,
            acceleration: [0.12792, -0.17493],
            car: [0.11804, -0.10921],
            wheel: [109.728, 176.012],
        },
    );
}

#[test]
fn smooth_at_50_us() {
    let table = library_run(&with_step("r1-smooth.json", 5e-5));
    check(
        "smooth, 0.05 ms",
        &table,
        &Printed {
            displacement: 0.65260,
            acceleration: [0.08423, -0.09196],
            car: [0.00802, -0.01176],
            wheel: [141.305, 144.596],
        },
    );
}

#[test]
fn linear_hertz_at_50_us() {
    let table = library_run(&with_step("r1-linear.json", 5e-5));
    check(
        "linear contact, 0.05 ms",
        &table,
        &Printed {
            displacement: 0.65229,
            acceleration: [0.12819, -0.17521],
            car: [0.11805, -0.10919],
            wheel: [109.668, 176.015],
        },
    );
}

/// Largest difference of two histories, relative to the largest value.
fn difference(a: &[f64], b: &[f64]) -> f64 {
    assert_eq!(a.len(), b.len());
    let scale = a.iter().fold(0.0_f64, |s, x| s.max(x.abs()));
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) / scale
}

fn compare_with_monolithic(mut checked: Checked) {
    checked.scenario.coupling.tolerance = 1e-11;
    let table = library_run(&checked);
    let monolithic = ttb_reference::run(&checked.train_track, &checked.bridge).expect("monolithic run");
    let point = &checked.bridge.points[0].name;
    let pairs = [
        ("displacement", table.column(&format!("point[{point}].displacement")), &monolithic.points[0]),
        ("acceleration", table.column(&format!("point[{point}].acceleration")), &monolithic.point_accelerations[0]),
        ("car", table.column("car[1].acceleration"), &monolithic.cars[0]),
        ("wheel", table.column("wheel[3].contact_force"), &monolithic.wheels[2]),
    ];
    for (what, hybrid, monolithic) in pairs {
        let d = difference(hybrid, monolithic);
        assert!(d < 1e-7, "{what}: hybrid and monolithic differ by {d:e}");
    }
}

#[test]
fn the_hybrid_algorithm_gives_the_monolithic_solution() {
    compare_with_monolithic(example("r1.json"));
}

#[test]
fn also_with_three_layers_timoshenko_rail_local_compliance_and_a_light_bridge() {
    let mut checked = example("r1.json");
    let spec = &mut checked.train_track;
    let zhai = ttb_scenario::bundled::track("ballast-zhai").expect("bundled");
    spec.track.support = zhai.support;
    (spec.track.rail.shear_stiffness, spec.track.rail.rotary_inertia) = (Some(4e8), 0.5);
    spec.local_compliance = true;
    (spec.contact.wheels_per_axle, spec.end) = (2, 0.4);
    let ttb_scenario::spec::StructureSpec::Beams { spans, .. } = &mut checked.bridge.structure else { panic!("beams") };
    (spans[0].mass, spans[0].bending_stiffness) = (3000.0, 4.4e10);
    compare_with_monolithic(checked);
}

/// A run through the FMUs and one through the libraries give the same columns, to the bit.
fn is_the_library_run(name: &str, settings: &[&str]) {
    let folder = tempfile::tempdir().expect("temporary folder");
    let mut command = Command::new(ttb());
    command.arg("run").arg(examples().join(name)).arg("--output").arg(folder.path()).arg("--quiet");
    for setting in settings {
        command.args(["--set", setting]);
    }
    assert!(command.status().expect("ttb runs").success());
    let text = std::fs::read_to_string(folder.path().join("results.csv")).expect("results.csv");
    let mut lines = text.lines();
    let names: Vec<&str> = lines.next().expect("header").split(',').collect();
    let mut columns: HashMap<&str, Vec<f64>> = HashMap::new();
    for line in lines {
        for (name, field) in names.iter().zip(line.split(',')) {
            columns.entry(name).or_default().push(field.parse().expect("number"));
        }
    }
    let settings: Vec<Setting> = settings.iter().map(|text| text.parse().expect("a setting")).collect();
    let checked = load_with(&examples().join(name), &settings).unwrap_or_else(|problems| panic!("{problems}"));
    let table = library_run(&checked);
    // Times are written in their shortest form.
    let time: Vec<f64> = table.time.iter().map(|t| ttb_session::axis::shortest(*t)).collect();
    assert_eq!(columns["time"], time);
    let recorded = table.columns.iter().filter(|(name, _)| !name.starts_with("support["));
    assert_eq!(recorded.clone().count() + 1, names.len());
    for (name, values) in recorded {
        let bits = |v: &[f64]| v.iter().map(|x| x.to_bits()).collect::<Vec<_>>();
        assert!(bits(values) == bits(&columns[name.as_str()]), "{name} differs");
    }
}

#[test]
fn the_run_through_the_fmus_is_the_library_run_bit_for_bit() {
    is_the_library_run("r1.json", &[]);
}

/// Three forces and motions a support, creep and flanges.
#[test]
fn so_is_a_run_in_space() {
    is_the_library_run("space-manchester.json", &["time.end=1.3"]);
}
