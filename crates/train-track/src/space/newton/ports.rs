//! Ports of one car: compliances, forces, motions.

use std::sync::Arc;

use ttb_wheel_rail::contact::Contact;

use super::super::axle::{Lever, PORTS, Place, RAIL_PORTS, RAILS, TURNS};
use super::super::car::{AXLES, OF_BODY, WHEELSET_PORTS};
use super::super::element::Element;
use super::super::lu::Lu;
use super::ARM;
use super::secants::Secants;

/// Compliance of the rails between two axles: rows and columns are the rail ports.
pub type RailBlock = [[f64; RAIL_PORTS]; RAIL_PORTS];

/// What two axles of different cars have to do with each other through the rails.
#[derive(Clone, Copy, Debug)]
pub struct Neighbour {
    /// Axle of this car, and axle of the train.
    pub axles: [usize; 2],
    /// Compliance.
    pub block: RailBlock,
}

/// Ports of one car.
#[derive(Clone, Debug)]
pub struct CarPorts {
    /// Number of ports n.
    pub n: usize,
    /// Y_s and Y_r by rows, n × n.
    pub position: Vec<f64>,
    /// See `position`.
    pub rate: Vec<f64>,
    /// c_loc of every port: all that Y_s has more than Y_r where the rails' ports have rates.
    pub(super) local: Vec<f64>,
    /// s_free and ṡ_free.
    pub free: [Vec<f64>; 2],
    /// f.
    pub f: Vec<f64>,
    /// s and ṡ.
    pub motion: [Vec<f64>; 2],
    /// Wheel–rail contact of the car.
    pub contact: Arc<Contact>,
    /// Its arms.
    pub lever: Lever,
    /// Its links that are not linear.
    pub elements: Vec<Element>,
    /// (x, ẋ) of each before and after the step.
    pub inner: [Vec<[f64; 2]>; 2],
    /// Places of its axles.
    pub places: [Place; AXLES],
    /// Axles of other cars that it feels.
    pub neighbours: Vec<Neighbour>,
    pub(super) lu: Lu,
    pub(super) secants: Secants,
    /// F(s, ṡ) and f − F.
    pub(super) answered: Vec<f64>,
    pub(super) residual: Vec<f64>,
    /// Corrections of f, s and ṡ.
    pub(super) change: [Vec<f64>; 3],
    /// Whether J is no longer that of the step's begin.
    pub(super) renewed: bool,
    /// f, s and ṡ of the step's begin, and s_free and ṡ_free of its end while they are approached in stages.
    pub(super) begun: [Vec<f64>; 3],
    pub(super) target: [Vec<f64>; 2],
    /// Where the stages begin.
    pub(super) start: [Vec<f64>; 2],
    /// What neighbours moved its ports by when they were looked at last.
    pub(super) met: Vec<f64>,
}

impl CarPorts {
    /// At rest.
    pub fn new(contact: Arc<Contact>, lever: Lever, elements: Vec<Element>) -> Self {
        let n = AXLES * PORTS + elements.len();
        let zeros = || vec![0.0; n];
        let inner = vec![[0.0; 2]; elements.len()];
        Self {
            n,
            position: vec![0.0; n * n],
            rate: vec![0.0; n * n],
            local: zeros(),
            free: [zeros(), zeros()],
            f: zeros(),
            motion: [zeros(), zeros()],
            contact,
            lever,
            elements,
            inner: [inner.clone(), inner],
            places: [Place::default(); AXLES],
            neighbours: Vec::new(),
            lu: Lu::new(n),
            secants: Secants::new(n),
            answered: zeros(),
            residual: zeros(),
            change: [zeros(), zeros(), zeros()],
            renewed: false,
            begun: [zeros(), zeros(), zeros()],
            target: [zeros(), zeros()],
            start: [zeros(), zeros()],
            met: zeros(),
        }
    }

    /// Weight of a port's force, or with its inverse of its motion, against others.
    pub(super) fn arm(port: usize) -> f64 {
        if port < AXLES * PORTS && TURNS[port % PORTS] { ARM } else { 1.0 }
    }

    /// Forces on the rails under an axle of the car.
    pub fn on_rails(&self, axle: usize) -> [f64; RAIL_PORTS] {
        RAILS.map(|(port, sign)| sign * self.f[axle * PORTS + port])
    }

    /// Takes the free motion of the rails under an axle, and its rates, into s_free and ṡ_free, which have the wheelset's.
    pub fn meet_rails(&mut self, axle: usize, motion: [[f64; RAIL_PORTS]; 2]) {
        for (free, rails) in self.free.iter_mut().zip(motion) {
            let free = &mut free[axle * PORTS..(axle + 1) * PORTS];
            for ((port, sign), rail) in RAILS.into_iter().zip(rails) {
                free[port] = if port < OF_BODY { free[port] + sign * rail } else { rail };
            }
        }
    }

    /// Puts the car's own compliance (wheelsets, then elements) into Y_s and Y_r, the rails' parts zero.
    pub fn set_car(&mut self, compliance: &[f64]) {
        let (n, own) = (self.n, WHEELSET_PORTS + self.elements.len());
        let port = |k: usize| match k.checked_sub(WHEELSET_PORTS) {
            None => k / OF_BODY * PORTS + k % OF_BODY,
            Some(element) => AXLES * PORTS + element,
        };
        self.position.fill(0.0);
        for i in 0..own {
            for j in 0..own {
                self.position[port(i) * n + port(j)] = compliance[i * own + j];
            }
        }
        self.rate.copy_from_slice(&self.position);
        self.local.fill(0.0);
    }

    /// Adds the rails' compliance between two axles of the car to Y_s and Y_r; `local` goes to the diagonal of Y_s.
    pub fn add_rails(
        &mut self,
        [i, j]: [usize; 2],
        block: &RailBlock,
        local: Option<&[f64; RAIL_PORTS]>,
        moving: bool,
    ) {
        for ((row, sign), values) in RAILS.into_iter().zip(block) {
            let from = (i * PORTS + row) * self.n + j * PORTS;
            for ((column, other), value) in RAILS.into_iter().zip(values) {
                let value = sign * other * value;
                self.position[from + column] += value;
                if moving {
                    self.rate[from + column] += value;
                }
            }
        }
        for ((port, _), local) in RAILS.into_iter().zip(local.into_iter().flatten()) {
            let port = i * PORTS + port;
            self.local[port] = *local;
            self.position[port * self.n + port] += local;
        }
    }
}
