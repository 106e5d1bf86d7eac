//! A deck in space and a track on it, with three ports a support: F_z, F_y, M_x. Motions q = (d_z, d_y, φ) of all supports,
//! component by component.
//!
//! ```text
//! deck     M q̈ + K q = f                  trapezoidal rule; K joins sway and twist, and neighbours
//! track    f = k (p(t) − q) − c q̇         p: motion of the track's base, known
//! whole    M q̈ + c q̇ + (K + k) q = k p    the monolithic solution by the same rule
//! ```

#![allow(dead_code, reason = "every test takes what it needs")]

use ttb_contract::{Component, Failure, Port, Ports, Subsystem};

/// Supports, and forces.
pub const SUPPORTS: usize = 2;
pub const N: usize = 3 * SUPPORTS;
/// Scale of the forces, N.
pub const AXLE_LOAD: f64 = 1e5;

const MASS: [f64; 3] = [6e3, 5e3, 9e3];
/// Stiffness and damping of the track, N/m and N·m/rad, N s/m and N·m s/rad.
const TRACK: [[f64; 2]; 3] = [[4e7, 4e4], [1e7, 2e4], [3e6, 1e4]];

/// Of the port `i`: its component.
fn component(i: usize) -> usize {
    i / SUPPORTS
}

/// K of the deck.
fn stiffness(i: usize, j: usize) -> f64 {
    let own = [3e8, 1e8, 4e7][component(i)];
    match (i % SUPPORTS == j % SUPPORTS, component(i) == component(j)) {
        (true, true) => own,
        (true, false) if component(i) + component(j) == 3 => -8e6,
        (false, true) => -0.3 * own,
        _ => 0.0,
    }
}

/// p of the port `i`.
fn base(i: usize, t: f64) -> f64 {
    let amplitude = [2e-3, 1e-3, 4e-3][component(i)];
    amplitude * (1.0 - (25.0 * t + i as f64).cos() * (-3.0 * t).exp())
}

/// Ports whose moments are counted in units of `unit` N·m, rotations in such units that both make joules.
pub fn ports(unit: f64) -> Ports {
    let of = |component: Component| (1..=SUPPORTS).map(move |support| Port::new(support, component, AXLE_LOAD));
    let list = Component::ALL.into_iter().flat_map(of);
    let scaled = |port: Port| match port.component {
        Component::Roll => Port { scale: port.scale / unit, ..port },
        _ => port,
    };
    Ports::new(list.map(scaled).collect(), 0).expect("ports in order")
}

/// Solves A x = b.
fn solve(mut a: Vec<Vec<f64>>, mut b: Vec<f64>) -> Vec<f64> {
    let n = b.len();
    for k in 0..n {
        for i in k + 1..n {
            let factor = a[i][k] / a[k][k];
            (k..n).for_each(|j| a[i][j] -= factor * a[k][j]);
            b[i] -= factor * b[k];
        }
    }
    for k in (0..n).rev() {
        b[k] = (b[k] - (k + 1..n).map(|j| a[k][j] * b[j]).sum::<f64>()) / a[k][k];
    }
    b
}

/// One step of M q̈ + c q̇ + K q = f by the trapezoidal rule, f at both ends.
fn step(
    q: &mut [f64],
    v: &mut [f64],
    h: f64,
    k: &dyn Fn(usize, usize) -> f64,
    c: &dyn Fn(usize) -> f64,
    f: [&[f64]; 2],
) {
    let m = |i: usize| MASS[component(i)];
    let n = q.len();
    // With v₁ = 2 (q₁ − q)/h − v: (4M/h² + 2c/h + K) q₁ = f₁ + f − K q + M (4q/h² + 4v/h) + c 2q/h
    let row = |i: usize| -> Vec<f64> {
        (0..n).map(|j| k(i, j) + if i == j { 4.0 * m(i) / (h * h) + 2.0 * c(i) / h } else { 0.0 }).collect()
    };
    let right = |i: usize| {
        let elastic: f64 = (0..n).map(|j| k(i, j) * q[j]).sum();
        f[0][i] + f[1][i] - elastic + m(i) * (4.0 * q[i] / (h * h) + 4.0 * v[i] / h) + 2.0 * c(i) * q[i] / h
    };
    let end = solve((0..n).map(row).collect(), (0..n).map(right).collect());
    for i in 0..n {
        v[i] = 2.0 * (end[i] - q[i]) / h - v[i];
        q[i] = end[i];
    }
}

/// The monolithic solution after `steps` steps of `h`: q, q̇.
pub fn monolithic(steps: usize, h: f64) -> [Vec<f64>; 2] {
    let whole = |i: usize, j: usize| stiffness(i, j) + if i == j { TRACK[component(i)][0] } else { 0.0 };
    let load = |t: f64| -> Vec<f64> { (0..N).map(|i| TRACK[component(i)][0] * base(i, t)).collect() };
    let statics = (0..N).map(|i| (0..N).map(|j| whole(i, j)).collect()).collect();
    let (mut q, mut v) = (solve(statics, load(0.0)), vec![0.0; N]);
    for n in 0..steps {
        let ends = [load(n as f64 * h), load((n + 1) as f64 * h)];
        step(&mut q, &mut v, h, &whole, &|i| TRACK[component(i)][1], [&ends[0], &ends[1]]);
    }
    [q, v]
}

/// Either side.
pub struct Side {
    is_deck: bool,
    /// N·m to a unit of moment.
    unit: f64,
    stepping: bool,
    time: f64,
    input: Vec<f64>,
    rate: Vec<f64>,
    q: Vec<f64>,
    v: Vec<f64>,
    force: Vec<f64>,
    saved: (f64, Vec<f64>, Vec<f64>, Vec<f64>),
}

/// Track and deck whose moments are in units of `unit` N·m.
pub fn sides(unit: f64) -> [Side; 2] {
    [false, true].map(|is_deck| {
        let inputs = if is_deck { N } else { 2 * N };
        let zero = || vec![0.0; N];
        let (input, rate) = (vec![0.0; inputs], vec![0.0; inputs]);
        let saved = (0.0, zero(), zero(), zero());
        Side { is_deck, unit, stepping: false, time: 0.0, input, rate, q: zero(), v: zero(), force: zero(), saved }
    })
}

impl Side {
    fn unit(&self, i: usize) -> f64 {
        if component(i % N) == 2 { self.unit } else { 1.0 }
    }

    /// Displacement of the deck.
    pub fn motion(&self) -> [&[f64]; 2] {
        [&self.q, &self.v]
    }

    /// A deck that goes faster all at once.
    pub fn nudge(&mut self, speed: f64) {
        self.v.iter_mut().for_each(|v| *v += speed);
    }

    fn answer(&mut self, motion: &[f64]) {
        for i in 0..N {
            let [k, c] = TRACK[component(i)];
            self.force[i] = k * (base(i, self.time) - motion[i]) - c * motion[N + i];
        }
    }
}

impl Subsystem for Side {
    fn set_inputs(&mut self, values: &[f64], rates: Option<&[f64]>) -> Result<(), Failure> {
        let factor = |i: usize| if self.is_deck { self.unit(i) } else { self.unit(i).recip() };
        let input: Vec<f64> = values.iter().enumerate().map(|(i, x)| factor(i) * x).collect();
        let rate = rates.map(|rates| rates.iter().enumerate().map(|(i, x)| factor(i) * x).collect());
        (self.input, self.rate) = (input, rate.unwrap_or_else(|| vec![0.0; values.len()]));
        if !self.stepping {
            let input = self.input.clone();
            if self.is_deck {
                let statics = (0..N).map(|i| (0..N).map(|j| stiffness(i, j)).collect()).collect();
                self.q = solve(statics, input);
            } else {
                self.answer(&input);
            }
        }
        Ok(())
    }
    fn get_outputs(&mut self, outputs: &mut [f64]) -> Result<(), Failure> {
        if self.is_deck {
            (0..N).for_each(|i| (outputs[i], outputs[N + i]) = (self.unit(i) * self.q[i], self.unit(i) * self.v[i]));
        } else {
            (0..N).for_each(|i| outputs[i] = self.force[i] / self.unit(i));
        }
        Ok(())
    }
    fn exit_initialization(&mut self) -> Result<(), Failure> {
        self.stepping = true;
        Ok(())
    }
    fn step(&mut self, t: f64, h: f64, _may_restore: bool) -> Result<(), Failure> {
        self.time = t + h;
        let end: Vec<f64> = self.input.iter().zip(&self.rate).map(|(x, r)| x + h * r).collect();
        if self.is_deck {
            step(&mut self.q, &mut self.v, h, &stiffness, &|_| 0.0, [&self.input, &end]);
        } else {
            self.answer(&end);
        }
        Ok(())
    }
    fn save(&mut self) -> Result<(), Failure> {
        self.saved = (self.time, self.q.clone(), self.v.clone(), self.force.clone());
        Ok(())
    }
    fn restore(&mut self) -> Result<(), Failure> {
        (self.time, self.q, self.v, self.force) = self.saved.clone();
        Ok(())
    }
    fn can_interpolate(&self) -> bool {
        true
    }
    fn name(&self) -> &str {
        if self.is_deck { "deck" } else { "track" }
    }
}
