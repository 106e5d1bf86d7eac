//! A car alone on rigid rails, without a track: Newmark's steps with the ports and Newton's method of the product.

use std::sync::Arc;

use nalgebra::{DMatrix, DVector};
use ttb_dynamics::newmark::{Motion, Newmark};
use ttb_train_track::space::axle::{Lever, PORTS, Place};
use ttb_train_track::space::car::{AXLES, Car, CarStep, DOFS, FIRST_WHEELSET, OF_BODY};
use ttb_train_track::space::newton::{CarPorts, Of, solve};
use ttb_wheel_rail::contact::Contact;

/// Arms of an axle on rails that neither sway nor roll.
pub fn lever(car: &Car) -> Lever {
    Lever { radius: car.radius, head: 0.0, rail: 0.75 }
}

/// How deep a wheelset in the middle of the track stands under the load of both wheels, m.
pub fn depth(car: &Car, contact: &Contact, load: f64) -> f64 {
    let down = |z: f64| {
        let (mut s, mut f) = ([0.0; PORTS], [0.0; PORTS]);
        s[1] = z;
        lever(car).forces(contact, &s, &[0.0; PORTS], &Place { speed: 1.0, ..Place::default() }, &mut f);
        -f[1]
    };
    let (mut low, mut high) = (-1e-3, 1e-3);
    for _ in 0..100 {
        let middle = 0.5 * (low + high);
        if down(middle) < load { low = middle } else { high = middle }
    }
    low
}

/// Degree of freedom of port `k` of the wheelsets, and its place among the ports of the car.
fn port(k: usize) -> [usize; 2] {
    [FIRST_WHEELSET + k, k / OF_BODY * PORTS + k % OF_BODY]
}

/// A car alone on rigid rails.
pub struct Alone {
    pub car: Car,
    step: CarStep,
    newmark: Newmark,
    pub ports: Vec<CarPorts>,
    pub motion: Motion,
    /// Forces beside its weight.
    pub extra: [f64; DOFS],
    free: [f64; DOFS],
}

impl Alone {
    /// In the middle of straight, even track, its wheelsets pressed by `load`, N, each; its links are linear.
    pub fn new(car: Car, contact: Contact, speed: f64, load: f64, h: f64) -> Self {
        let newmark = Newmark::new(0.5, 0.25, h);
        let z = depth(&car, &contact, load);
        let mut ports = CarPorts::new(Arc::new(contact), lever(&car), Vec::new());
        ports.places = [Place { speed, ..Place::default() }; AXLES];
        let mut motion = Motion::rest(DOFS);
        for axle in 0..AXLES {
            let [dof, at] = port(OF_BODY * axle + 1);
            (motion.u[dof], ports.motion[0][at], ports.f[at]) = (z, z, -load);
        }
        let step = CarStep::new(&car, &newmark, speed).unwrap();
        Self { car, step, newmark, ports: vec![ports], motion, extra: [0.0; DOFS], free: [0.0; DOFS] }
    }

    /// A whole car, at rest under its weight.
    pub fn at_rest(car: Car, contact: Contact, speed: f64, h: f64) -> Self {
        let load = car.weight.iter().sum::<f64>() / AXLES as f64;
        let mut alone = Self::new(car, contact, speed, load, h);
        // Body and bogies on wheelsets that are held.
        let (k, n) = (&alone.car.stiffness, FIRST_WHEELSET);
        let p = DVector::from_fn(n, |i, _| {
            alone.car.weight[i] - (n..DOFS).map(|j| k[(i, j)] * alone.motion.u[j]).sum::<f64>()
        });
        let u = DMatrix::from_fn(n, n, |i, j| k[(i, j)]).cholesky().unwrap().solve(&p);
        alone.motion.u[..n].copy_from_slice(u.as_slice());
        alone
    }

    /// Wheelsets that bodies of no weight guide, displaced by `y` m.
    pub fn wheelsets(car: Car, contact: Contact, speed: f64, curvature: f64, load: f64, y: f64) -> Self {
        let mut alone = Self::new(car, contact, speed, load, 1e-3);
        alone.extra = alone.car.weight.map(|weight| -weight);
        for axle in 0..AXLES {
            let [dof, at] = port(OF_BODY * axle);
            alone.extra[dof + 1] += load;
            (alone.motion.u[dof], alone.ports[0].motion[0][at]) = (y, y);
            alone.ports[0].places[axle].curvature = curvature;
        }
        alone
    }

    /// One step; what the axles meet at its end stands in `ports[0].places`.
    pub fn advance(&mut self) {
        let (newmark, old) = (&self.newmark, &self.motion);
        self.step.free(&self.car, newmark, [&old.u, &old.v, &old.a], &self.extra, &mut self.free);
        let ports = &mut self.ports[0];
        ports.set_car(&self.step.compliance);
        for k in 0..AXLES * OF_BODY {
            let [dof, at] = port(k);
            ports.free[0][at] = self.free[dof];
            ports.free[1][at] = newmark.a[1] * self.free[dof] - newmark.damping(old.u[dof], old.v[dof], old.a[dof]);
        }
        let of = Of { a1: newmark.a[1], gamma: newmark.gamma, h: newmark.h, rails_move: true };
        assert!(ports.prepare(&of));
        solve(&mut self.ports, &of).unwrap();
        let mut new = Motion::rest(DOFS);
        let f = &self.ports[0].f;
        self.step.press(&self.free, |k| f[port(k)[1]], &mut new.u);
        newmark.finish_all(&self.motion, &mut new);
        self.motion = new;
    }

    /// Lateral displacement of the leading wheelset, m.
    pub fn y(&self) -> f64 {
        self.motion.u[FIRST_WHEELSET]
    }
}
