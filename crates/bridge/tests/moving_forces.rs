//! Forces over simple beams against answers known from elsewhere (docs/theory.md 15).

mod common;

use common::{Train, beams, get, span};
use ttb_record::Table;
use ttb_scenario::spec::BridgeSpec;
use ttb_scenario::types::Damping;

const COMMAND: &str = "-p ttb-bridge --test moving_forces";

/// Greatest |displacement| in m and |acceleration| in m/s² of the point `mid`.
fn peaks(train: &Train, spec: &BridgeSpec, end: f64) -> (f64, f64) {
    let (mut w, mut a) = (0.0_f64, 0.0_f64);
    train.run(spec, end, |_, bridge| {
        w = w.max(get(bridge, "point[mid].displacement").abs());
        a = a.max(get(bridge, "point[mid].acceleration").abs());
    });
    (w, a)
}

#[test]
fn a_moving_force_amplifies_as_fryba_says() {
    let source = "Frýba, Vibration of Solids and Structures, 1999; series of 100 modes. Mid-span, over the static value, while \
                  the force is on the beam; α = πv/(Lω₁)";
    let mut table = Table::new("moving force over a simple beam, amplification", source, COMMAND);
    for (alpha, expected) in [(0.2, 1.06527), (0.3, 1.41049), (0.5, 1.70545), (0.617, 1.73167), (1.0, 1.54807)] {
        let (length, ei, m, force) = (25.0, 30e9, 15e3, 100e3);
        let omega1 = (std::f64::consts::PI / length).powi(2) * f64::sqrt(ei / m);
        let speed = alpha * length * omega1 / std::f64::consts::PI;
        let passage = length / speed;
        let spec = beams(vec![span(length, ei, m, 50)], 50, passage / 2000.0);
        let (w, _) = peaks(&Train { axles: vec![(0.0, force)], speed }, &spec, passage);
        table.row(format!("α = {alpha}"), expected, w / (force * length.powi(3) / (48.0 * ei)), 0.005);
    }
    table.finish();
}

#[test]
fn yang_and_yaus_moving_force() {
    // L = 25 m, EI = 2.87e9 · 2.90, m = 2303 kg/m, 5750 kg at 27.78 m/s: 2.396826 mm with 200 modes, at 0.37639 s.
    let spec = beams(vec![span(25.0, 2.87e9 * 2.90, 2303.0, 50)], 50, 25.0 / 27.78 / 4000.0);
    let train = Train { axles: vec![(0.0, 5750.0 * 9.81)], speed: 27.78 };
    let (mut peak, mut at) = (0.0, 0.0);
    train.run(&spec, 25.0 / 27.78, |t, bridge| {
        let w = get(bridge, "point[mid].displacement");
        if w > peak {
            (peak, at) = (w, t);
        }
    });
    let source = "Yang and Yau, J. Struct. Eng. 123, 1997; series of 200 modes";
    let mut table = Table::new("moving force over a beam of 25 m", source, COMMAND);
    table.row("peak, mm", 2.396826, 1e3 * peak, 0.005);
    table.row("its time, s", 0.37639, at, 0.01);
    table.finish();
}

/// Axles of an HSLM-A train, m behind the first and N (EN 1991-2, figure 6.12): `coaches` intermediate coaches of
/// length `d`, bogie axle spacing `b`, force `p` in kN.
fn hslm(coaches: usize, d: f64, b: f64, p: f64) -> Vec<(f64, f64)> {
    let c0 = 17.0 + 3.525 / 2.0;
    let length = c0 + (coaches as f64 + 2.0) * d + 3.525 / 2.0 + 17.0;
    let front = [0.0, 3.0, 14.0, 17.0, 20.525, 20.525 + b];
    let rear = front.iter().map(|x| length - x);
    let bogies = (1..=coaches + 1).flat_map(|i| [c0 + i as f64 * d - 0.5 * b, c0 + i as f64 * d + 0.5 * b]);
    let axles: Vec<_> = front.into_iter().chain(bogies).chain(rear).map(|x| (x, 1e3 * p)).collect();
    assert_eq!(axles.len(), 2 * coaches + 14);
    axles
}

fn ice2() -> Vec<(f64, f64)> {
    let power = [0.0, 3.0, 11.46, 14.46, 336.06, 339.06, 347.52, 350.52].map(|x| (x, 195e3));
    let coaches = (0..12).flat_map(|i| [0.0, 2.5, 19.0, 21.5].map(|x| (19.31 + 26.4 * f64::from(i) + x, 112e3)));
    power.into_iter().chain(coaches).collect()
}

#[test]
fn trains_of_forces_over_a_25_m_beam() {
    // L = 25 m, m = 15 t/m, EI = 30e9 N m², ζ = 1 %, three modes.
    let cases = [
        ("HSLM A1 at 150 km/h", hslm(18, 18.0, 2.0, 170.0), 150.0, 7.6395, 1.011),
        ("HSLM A1 at 230 km/h", hslm(18, 18.0, 2.0, 170.0), 230.0, 17.8245, 6.215),
        ("HSLM A3 at 250 km/h", hslm(16, 20.0, 2.0, 180.0), 250.0, 26.9467, 10.057),
        ("HSLM A8 at 300 km/h", hslm(12, 25.0, 2.5, 190.0), 300.0, 25.4784, 10.898),
        ("ICE-2 at 350 km/h", ice2(), 350.0, 34.3362, 14.558),
    ];
    let mut spec = beams(vec![span(25.0, 30e9, 15e3, 50)], 50, 1e-3);
    spec.modes = Some(3);
    spec.damping = Damping::Modal { ratio: 0.01, modes: 3 };
    let source = "EN 1991-2 (trains), independent modal solution with three modes; L 25 m, 15 t/m, EI 30 GN m², ζ 1 %";
    let mut table = Table::new("trains of forces over a beam", source, COMMAND);
    for (name, axles, kmh, w_mm, a) in cases {
        let last = axles.iter().fold(0.0_f64, |m, (x, _)| m.max(*x));
        let speed = kmh / 3.6;
        let (w, acceleration) = peaks(&Train { axles, speed }, &spec, (last + 30.0) / speed);
        table.row(format!("{name}, mm"), w_mm, 1e3 * w, 0.01);
        table.row(format!("{name}, m/s²"), a, acceleration, 0.03);
    }
    table.finish();
}
