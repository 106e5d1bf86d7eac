//! The track against closed forms: a rail on a Winkler foundation (docs/theory.md 15).

mod common;

use common::{spec, started, value};
use ttb_record::Table;
use ttb_scenario::spec::TrainTrackSpec;
use ttb_scenario::types::{Rail, Spring, Support};

const COMMAND: &str = "-p ttb-train-track --test track";
const EI: f64 = 6.6238e6;
const MASS: f64 = 60.64;
const FOUNDATION: f64 = 5e7;
const SPACING: f64 = 0.15;
const W0: f64 = 1.172_062e-3;
const V_CRITICAL: f64 = 774.738;

/// Four axles of 100 kN, far enough apart not to feel each other, on one CHN60 rail.
fn winkler(speed: f64, shear: Option<f64>) -> TrainTrackSpec {
    let mut spec = spec();
    let car = &mut spec.cars[0];
    (car.bogie_distance, car.wheelbase, car.length) = (30.0, 15.0, 50.0);
    (car.bogie_mass, car.wheelset_mass) = (2000.0, 1000.0);
    car.body_mass = 4.0 * (1e5 / 9.81 - 2000.0);
    spec.track.rail = Rail { bending_stiffness: EI, mass: MASS, shear_stiffness: shear, rotary_inertia: 0.0 };
    let damping = 0.02 * 2.0 * (FOUNDATION * MASS).sqrt() * SPACING;
    spec.track.support = Support::SingleLayer { fastener: Spring { stiffness: FOUNDATION * SPACING, damping } };
    (spec.track.spacing, spec.elements_per_bay, spec.bays) = (SPACING, 1, 1000);
    spec.on_bridge = vec![500];
    (spec.front_wheel, spec.speed) = (60.0, vec![[0.0, speed]]);
    spec
}

#[test]
fn a_standing_wheel_deflects_the_rail_as_winkler_says() {
    let mut instance = started(winkler(0.0, None));
    let source = "Hetényi, Beams on Elastic Foundation, 1946: P/√(64 k³ EI)^½; CHN60 under 100 kN on 50 MN/m²";
    let mut table = Table::new("rail on a Winkler foundation, deflection in m", source, COMMAND);
    for wheel in 1..=4 {
        let w = value(&mut instance, &format!("wheel[{wheel}].rail_displacement"));
        table.row(format!("wheel {wheel}"), W0, w, 2e-3);
        assert!((value(&mut instance, &format!("wheel[{wheel}].contact_force")) - 1e5).abs() < 1e-3);
    }
    table.finish();
}

#[test]
fn shear_softens_the_rail_as_the_closed_form_says() {
    // EI w'''' − (EI k/GA) w'' + k w = P (δ − EI/GA δ''), by Fourier transform:
    // w₀ = P/(2√(kEI)) · (1 + √(kEI)/GA) / √(2√(k/EI) + k/GA).
    let ga = 8e7;
    let s = (FOUNDATION * EI).sqrt();
    let exact = 1e5 / (2.0 * s) * (1.0 + s / ga) / (2.0 * (FOUNDATION / EI).sqrt() + FOUNDATION / ga).sqrt();
    let mut instance = started(winkler(0.0, Some(ga)));
    let w = value(&mut instance, "wheel[1].rail_displacement");
    let source = "P/(2√(kEI)) · (1 + √(kEI)/GA)/√(2√(k/EI) + k/GA), by Fourier transform";
    let mut table = Table::new("rail soft in shear on a Winkler foundation, deflection in m", source, COMMAND);
    table.row("GA = 80 MN", exact, w, 5e-3);
    table.finish();
    assert!(exact > 1.03 * W0);
}

#[test]
fn a_running_wheel_deflects_it_more_by_the_speed_ratio() {
    let source = "1/√(1 − (v/v_cr)²), v_cr = 774.738 m/s";
    let mut table = Table::new("running wheel on a Winkler foundation, over the standing one", source, COMMAND);
    for v in [100.0, 300.0] {
        let mut instance = started(winkler(v, None));
        let h = 1e-3 * 100.0 / v * 0.2;
        let steps = (60.0 / (v * h)) as usize;
        let (mut sum, mut count) = (0.0, 0.0);
        for n in 0..steps {
            instance.step(n as f64 * h, h).unwrap();
            if n > steps / 2 {
                sum += value(&mut instance, "wheel[1].rail_displacement");
                count += 1.0;
            }
        }
        let exact = 1.0 / (1.0 - (v / V_CRITICAL).powi(2)).sqrt();
        let ratio = sum / count / W0;
        table.row(format!("{v} m/s"), exact, ratio, 0.01);
    }
    table.finish();
}
