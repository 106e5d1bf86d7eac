//! M, C and K of cars, both rails, sleepers and bridge as one dense system.
//!
//! ```text
//! cars 35 each;  rail σ, node n: w, θ, v, ψ, φ;  sleepers y, z, φ;  bridge: its own degrees of freedom
//! a spring–dashpot with the row v:  K += k v vᵀ,  C += c v vᵀ
//! fastener of rail σ at Y = σ y_r over (y, z, φ) of sleeper or deck:   w − z − φ Y,   v − φ_r h_f − y,   φ_r − φ
//! ballast under a sleeper: k/2 at each of ±y_b over the deck;  lateral ballast y − d_y
//! ```
//!
//! Each rail stands for itself: no sums and differences of both.

use nalgebra::DMatrix;
use ttb_bridge::space::assemble_for;
use ttb_contract::Component;
use ttb_dynamics::beam::Beam;
use ttb_scenario::spec::{BridgeSpec, SpaceSpec, StructureSpec, TrainTrackSpec};
use ttb_scenario::types::{Spring, Support};
use ttb_train_track::space::car::{Car, DOFS};

use crate::assembly::Row;
use crate::whole::law;

/// Degrees of freedom of a rail's node.
const NODE: usize = 5;
/// Degrees of freedom of a sleeper.
const SLEEPER: usize = 3;
/// −1 for the left rail, 1 for the right one.
pub const SIDES: [f64; 2] = [-1.0, 1.0];

/// The whole system.
pub struct System {
    /// M, C, K.
    pub m: DMatrix<f64>,
    /// See `m`.
    pub c: DMatrix<f64>,
    /// See `m`.
    pub k: DMatrix<f64>,
    /// First degree of freedom of the rails.
    pub rails: usize,
    /// Monitored points of the bridge.
    pub points: Vec<Row>,
    /// Vertical and lateral bending of one rail, and its GJ.
    beams: [Beam; 2],
    torsion: f64,
    from: f64,
    element: f64,
    elements: usize,
}

/// Both rails' rows at one place, (w, v, φ) each, and their local compliances.
pub struct Under {
    /// By rail.
    pub rows: [[Row; 3]; 2],
    /// c_loc of w, v and φ of one rail.
    pub local: [f64; 3],
}

impl System {
    /// Assembles; `speed` is that of the gyroscopic moments.
    ///
    /// # Errors
    /// A bridge that is not of finite elements, a track of three layers, links that are not linear.
    pub fn new(spec: &TrainTrackSpec, space: &SpaceSpec, cars: &[Car], bridge: &BridgeSpec) -> Result<Self, String> {
        let StructureSpec::FiniteElements(model) = &bridge.structure else {
            return Err("the plain solver in space knows bridges of finite elements only".into());
        };
        if cars.iter().any(|car| !car.elements.is_empty()) {
            return Err("the plain solver in space knows linear links only".into());
        }
        let assembled = assemble_for(model, &bridge.supports, &Component::ALL, &bridge.points);
        let assembled = assembled.map_err(|e| e.to_string())?;
        let pencil = assembled.equations.finish().map_err(|e| e.to_string())?;
        let damping = law(&bridge.damping, &pencil).map_err(|e| e.to_string())?;
        let (rail, track) = (&spec.track.rail, &space.track);
        let one = |bending_stiffness: f64| Beam {
            bending_stiffness,
            mass: 0.5 * rail.mass,
            shear_stiffness: None,
            rotary_inertia: 0.0,
        };
        if rail.shear_stiffness.is_some() || rail.rotary_inertia != 0.0 {
            return Err("the plain solver in space knows slender rails only".into());
        }
        let elements = spec.bays * spec.elements_per_bay;
        let rails = DOFS * cars.len();
        let sleepers = rails + 2 * NODE * (elements + 1);
        let deck = sleepers
            + match &spec.track.support {
                Support::SingleLayer { .. } => 0,
                Support::TwoLayer { .. } => SLEEPER * (spec.bays + 1),
                Support::ThreeLayer { .. } => return Err("the plain solver in space knows no third layer".into()),
            };
        let order = deck + pencil.ndof();
        let place = |row: &Vec<(u32, f64)>| -> Row { row.iter().map(|(i, n)| (deck + *i as usize, *n)).collect() };
        let mut system = Self {
            m: DMatrix::zeros(order, order),
            c: DMatrix::zeros(order, order),
            k: DMatrix::zeros(order, order),
            rails,
            points: assembled.monitors.iter().map(place).collect(),
            beams: [one(0.5 * rail.bending_stiffness), one(track.lateral_bending_stiffness)],
            torsion: track.torsional_stiffness,
            from: spec.from,
            element: spec.track.spacing / spec.elements_per_bay as f64,
            elements,
        };
        for (n, car) in cars.iter().enumerate() {
            let damping = car.damping_at(spec.speed[0][1]);
            for i in 0..DOFS {
                system.m[(DOFS * n + i, DOFS * n + i)] = car.mass[i];
            }
            system.k.view_mut((DOFS * n, DOFS * n), (DOFS, DOFS)).copy_from(&car.stiffness);
            system.c.view_mut((DOFS * n, DOFS * n), (DOFS, DOFS)).copy_from(&damping);
        }
        system.rails(track.polar_inertia);
        let raw = pencil.raw();
        for (column, ends) in raw.starts.windows(2).enumerate() {
            for at in ends[0] as usize..ends[1] as usize {
                let (i, j) = (deck + raw.rows[at] as usize, deck + column);
                for (i, j) in if i == j { vec![(i, j)] } else { vec![(i, j), (j, i)] } {
                    system.m[(i, j)] += raw.m[at];
                    system.k[(i, j)] += raw.k[at];
                    system.c[(i, j)] += damping.alpha * raw.m[at] + damping.beta * raw.k[at];
                }
            }
        }
        let supports = bridge.supports.len();
        for support in 0..=spec.bays {
            // (y, z, φ) of the deck: at rest beside the bridge.
            let under = match spec.on_bridge.binary_search(&support) {
                Ok(i) => [supports + i, i, 2 * supports + i].map(|row| place(&assembled.supports[row])),
                Err(_) => Default::default(),
            };
            system.support(spec, space, support, sleepers, &under);
        }
        Ok(system)
    }

    fn node(&self, side: usize, node: usize) -> usize {
        self.rails + NODE * (2 * node + side)
    }

    fn rails(&mut self, polar_inertia: f64) {
        let l = self.element;
        for (element, side) in (0..self.elements).flat_map(|e| [(e, 0), (e, 1)]) {
            let (a, b) = (self.node(side, element), self.node(side, element + 1));
            for (beam, at) in self.beams.into_iter().zip([0, 2]) {
                let dofs = [a + at, a + at + 1, b + at, b + at + 1];
                let (k, m) = (beam.stiffness(l), beam.mass_matrix(l));
                for (i, j) in (0..4).flat_map(|i| (0..4).map(move |j| (i, j))) {
                    self.k[(dofs[i], dofs[j])] += k[i][j];
                    self.m[(dofs[i], dofs[j])] += m[i][j];
                }
            }
            for (i, j, k, m) in [(a, a, 1.0, 2.0), (a, b, -1.0, 1.0), (b, a, -1.0, 1.0), (b, b, 1.0, 2.0)]
                .map(|(i, j, k, m)| (i + 4, j + 4, k, m))
            {
                self.k[(i, j)] += self.torsion / l * k;
                self.m[(i, j)] += polar_inertia * l / 6.0 * m;
            }
        }
    }

    fn spring(&mut self, spring: Spring, row: &Row) {
        for (i, a) in row {
            for (j, b) in row {
                self.k[(*i, *j)] += spring.stiffness * a * b;
                self.c[(*i, *j)] += spring.damping * a * b;
            }
        }
    }

    fn support(&mut self, spec: &TrainTrackSpec, space: &SpaceSpec, support: usize, sleepers: usize, deck: &[Row; 3]) {
        let half = |s: &Spring| Spring { stiffness: 0.5 * s.stiffness, damping: 0.5 * s.damping };
        let track = &space.track;
        let (pad, base) = match (&spec.track.support, &track.sleeper) {
            (Support::TwoLayer { pad, sleeper_mass, ballast }, Some(sleeper)) => {
                let at = sleepers + SLEEPER * support;
                let own: [Row; 3] = std::array::from_fn(|i| vec![(at + i, 1.0)]);
                for (i, m) in [*sleeper_mass, *sleeper_mass, sleeper.roll_inertia].into_iter().enumerate() {
                    self.m[(at + i, at + i)] += m;
                }
                let over = |y: f64| sum(&[(&own[1], 1.0), (&own[2], y), (&deck[1], -1.0), (&deck[2], -y)]);
                SIDES.iter().for_each(|side| self.spring(half(ballast), &over(side * sleeper.half_distance)));
                self.spring(sleeper.lateral, &sum(&[(&own[0], 1.0), (&deck[0], -1.0)]));
                (half(pad), own)
            }
            (Support::SingleLayer { fastener: pad }, _) => (half(pad), deck.clone()),
            (Support::TwoLayer { pad, .. } | Support::ThreeLayer { pad, .. }, _) => (half(pad), deck.clone()),
        };
        for (side, sign) in SIDES.into_iter().enumerate() {
            let node = self.node(side, support * spec.elements_per_bay);
            let [w, v, roll]: [Row; 3] = [0, 2, 4].map(|i| vec![(node + i, 1.0)]);
            self.spring(pad, &sum(&[(&w, 1.0), (&base[1], -1.0), (&base[2], -sign * track.half_distance)]));
            self.spring(track.lateral, &sum(&[(&v, 1.0), (&roll, -track.foot_height), (&base[0], -1.0)]));
            self.spring(track.rolling, &sum(&[(&roll, 1.0), (&base[2], -1.0)]));
        }
    }

    /// Both rails at abscissa `x`.
    pub fn under(&self, x: f64) -> Under {
        let s = (x - self.from) / self.element;
        let e = (s.max(0.0) as usize).min(self.elements - 1);
        let (xi, l) = (s - e as f64, self.element);
        let rows = [0, 1].map(|side| {
            let (a, b) = (self.node(side, e), self.node(side, e + 1));
            let bent = |field: usize| -> Row {
                let n = self.beams[field].shape(xi, l);
                [a, a + 1, b, b + 1].into_iter().zip(n).map(|(i, n)| (i + 2 * field, n)).collect()
            };
            [bent(0), bent(1), vec![(a + 4, 1.0 - xi), (b + 4, xi)]]
        });
        let [down, across] = self.beams.map(|beam| beam.local_compliance(xi, l));
        Under { rows, local: [down, across, xi * (1.0 - xi) * l / self.torsion] }
    }
}

/// Σ factor row.
pub fn sum(parts: &[(&Row, f64)]) -> Row {
    parts.iter().flat_map(|(row, factor)| row.iter().map(move |(i, n)| (*i, factor * n))).collect()
}
