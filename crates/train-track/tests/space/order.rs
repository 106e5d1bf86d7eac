//! Order of the steps: a car on rigid rails over waves, against Runge and Kutta's method on the equations of motion.
//!
//! ```text
//! M q̈ = w + F(q, q̇, t) − K q − C q̇         F of all wheels, at the places where the axles are at t
//! ```
//!
//! The method is explicit, of order four, with short steps, and has nothing of Newmark's steps, ports, compliances and Newton's
//! method. The forces of a contact are the product's.

use std::f64::consts::PI;

use nalgebra::{DMatrix, DVector};
use ttb_train_track::space::axle::{PORTS, Place};
use ttb_train_track::space::car::{AXLES, Car, DOFS, FIRST_WHEELSET, OF_BODY};
use ttb_wheel_rail::contact::Contact;
use ttb_wheel_rail::creep::Creep as Law;

use super::alone::{Alone, lever};
use super::stability::settings;
use super::*;

const SPEED: f64 = 40.0;
/// End of the runs, s.
const END: f64 = 1.5;

/// Alignment of 1 mm over 30 m with cross-level of 2 mm over 12 m, which grow over 20 m in front of the train.
fn places(car: &Car, t: f64) -> [Place; AXLES] {
    std::array::from_fn(|axle| {
        let x = SPEED * t + car.centres[3 + axle][0] - 12.0;
        let s = (x / 20.0).clamp(0.0, 1.0);
        // Sixth order: as smooth as the steps to be tried.
        let grown = s.powi(4) * (35.0 - 84.0 * s + 70.0 * s * s - 20.0 * s.powi(3));
        let wave = |amplitude: f64, length: f64| grown * amplitude * (2.0 * PI * x / length).sin();
        let (lateral, twist) = (wave(1e-3, 30.0), wave(2e-3, 12.0));
        let irregularity = [[lateral, -0.5 * twist], [lateral, 0.5 * twist]];
        Place { irregularity, speed: SPEED, ..Place::default() }
    })
}

/// Motion of the leading wheelset and of the body across the track at steps of 1 ms.
type Histories = [Vec<f64>; 2];

fn look(histories: &mut Histories, q: &[f64]) {
    histories[0].push(q[FIRST_WHEELSET]);
    histories[1].push(q[0]);
}

/// By the product, with steps of 1 ms divided by `parts`.
fn newmark(car: &Car, contact: &Contact, parts: usize) -> Histories {
    let h = 1e-3 / parts as f64;
    let mut alone = Alone::at_rest(car.clone(), contact.clone(), SPEED, h);
    let mut histories = Histories::default();
    for n in 1..=(END / h).round() as usize {
        alone.ports[0].places = places(car, n as f64 * h);
        alone.advance();
        if n % parts == 0 {
            look(&mut histories, &alone.motion.u);
        }
    }
    histories
}

/// By Runge and Kutta's method, with steps of 1 ms divided by `parts`.
fn runge_kutta(car: &Car, contact: &Contact, parts: usize) -> Histories {
    let (h, lever, damping) = (1e-3 / parts as f64, lever(car), car.damping_at(SPEED));
    // K and C beside each other: one product a call.
    let matrices = DMatrix::from_fn(DOFS, 2 * DOFS, |i, j| match j.checked_sub(DOFS) {
        None => car.stiffness[(i, j)],
        Some(j) => damping[(i, j)],
    });
    let rate = |t: f64, x: &DVector<f64>| {
        let mut p = DVector::from_column_slice(&car.weight) - &matrices * x;
        for (axle, place) in places(car, t).iter().enumerate() {
            let (at, mut f) = (FIRST_WHEELSET + OF_BODY * axle, [0.0; PORTS]);
            let [mut s, mut v] = [[0.0; PORTS]; 2];
            s[..OF_BODY].copy_from_slice(&x.as_slice()[at..at + OF_BODY]);
            v[..OF_BODY].copy_from_slice(&x.as_slice()[DOFS + at..DOFS + at + OF_BODY]);
            lever.forces(contact, &s, &v, place, &mut f);
            (0..OF_BODY).for_each(|k| p[at + k] += f[k]);
        }
        DVector::from_fn(2 * DOFS, |i, _| match i.checked_sub(DOFS) {
            None => x[DOFS + i],
            Some(i) => p[i] / car.mass[i],
        })
    };
    let mut x = DVector::zeros(2 * DOFS);
    let start = Alone::at_rest(car.clone(), contact.clone(), SPEED, h).motion.u;
    x.as_mut_slice()[..DOFS].copy_from_slice(&start);
    let mut histories = Histories::default();
    for n in 0..(END / h).round() as usize {
        let t = n as f64 * h;
        let k1 = rate(t, &x);
        let k2 = rate(t + 0.5 * h, &(&x + &k1 * (0.5 * h)));
        let k3 = rate(t + 0.5 * h, &(&x + &k2 * (0.5 * h)));
        let k4 = rate(t + h, &(&x + &k3 * h));
        x += (k1 + (k2 + k3) * 2.0 + k4) * (h / 6.0);
        if (n + 1) % parts == 0 {
            look(&mut histories, x.as_slice());
        }
    }
    histories
}

/// Greatest difference over the greatest value.
fn difference(a: &[f64], b: &[f64]) -> f64 {
    assert_eq!(a.len(), b.len());
    let peak = b.iter().fold(0.0_f64, |peak, x| peak.max(x.abs()));
    a.iter().zip(b).fold(0.0_f64, |most, (a, b)| most.max((a - b).abs())) / peak
}

#[test]
fn steps_of_a_car_in_space_have_order_two() {
    let mut data = of_benchmark("manchester");
    // Its stops are not reached.
    data.links.retain(|link| !matches!(link.law, LinkLaw::Stop { .. }));
    let car = Car::new(&data).unwrap();
    let own = space(&mut spec("manchester", SPEED)).clone();
    let geometry = ttb_train_track::space::spec::geometry(&own.contact, &own.track).unwrap();
    let contact = Contact::new(geometry, &settings(Law::Shen)).unwrap();
    let reference = runge_kutta(&car, &contact, 20);
    let errors = [1, 2, 4].map(|parts| {
        let found = newmark(&car, &contact, parts);
        [0, 1].map(|k| difference(&found[k], &reference[k]))
    });
    let source = "errors against Runge–Kutta steps of 0.05 ms: log₂ of their quotient, as steps are halved";
    let mut table = Table::new("order of the steps of a car in space", source, crate::COMMAND);
    for (k, name) in ["leading wheelset, y", "body, y"].into_iter().enumerate() {
        for (i, steps) in ["1 and 0.5 ms", "0.5 and 0.25 ms"].into_iter().enumerate() {
            let order = (errors[i][k] / errors[i + 1][k]).log2();
            // Errors of 1e-6 of the peak have no more digits than this.
            table.row(format!("{name}, {steps}"), 2.0, (1e3 * order).round() / 1e3, 0.05);
        }
        assert!(errors[0][k] < 1e-4, "{name}: {} of its peak at 1 ms", errors[0][k]);
    }
    table.finish();
}
