//! One system for cars, track and bridge: triplets of M, C and K, and where everything is.
//!
//! Every spring–dashpot is a row v with K += k v vᵀ, C += c v vᵀ; the base springs join the track to the deck through the
//! deck's shape functions. Degrees of freedom: 10 a car, then rail nodes (w, θ), then sleepers and ballast masses support by
//! support, then bridge nodes (w, θ; bearings left out).

use ttb_dynamics::beam::Beam;
use ttb_scenario::spec::{BridgeSpec, StructureSpec, TrainTrackSpec};
use ttb_scenario::types::{Damping, RayleighAt, Spring, Support};

/// A sparse row.
pub type Row = Vec<(usize, f64)>;

/// A symmetric matrix as triplets, both triangles.
#[derive(Clone, Debug, Default)]
pub struct Matrix(pub Vec<(usize, usize, f64)>);

impl Matrix {
    /// += factor v vᵀ.
    pub fn add_row(&mut self, factor: f64, v: &Row) {
        for (i, a) in v {
            self.0.extend(v.iter().map(|(j, b)| (*i, *j, factor * a * b)));
        }
    }
    /// += an element matrix at degrees of freedom, fixed ones left out.
    pub fn add_element(&mut self, dofs: [Option<usize>; 4], matrix: [[f64; 4]; 4]) {
        for (i, row) in dofs.iter().zip(matrix) {
            for (j, value) in dofs.iter().zip(row) {
                if let (Some(i), Some(j)) = (i, j) {
                    self.0.push((*i, *j, value));
                }
            }
        }
    }
    /// y += A x.
    pub fn multiply_add(&self, x: &[f64], y: &mut [f64]) {
        self.0.iter().for_each(|(i, j, a)| y[*i] += a * x[*j]);
    }
}

/// The whole system.
#[derive(Clone, Debug)]
pub struct System {
    /// Number of degrees of freedom.
    pub order: usize,
    /// Mass, damping, stiffness.
    pub m: Matrix,
    /// Damping.
    pub c: Matrix,
    /// Stiffness.
    pub k: Matrix,
    rail: Beam,
    rail_start: usize,
    rail_from: f64,
    rail_element: f64,
    rail_elements: usize,
    deck: Vec<DeckElement>,
}

#[derive(Clone, Copy, Debug)]
struct DeckElement {
    from: f64,
    length: f64,
    beam: Beam,
    dofs: [Option<usize>; 4],
}

impl System {
    /// Assembles train, track and a bridge of beams.
    ///
    /// # Errors
    /// A bridge or damping this plain solver does not know.
    pub fn new(train_track: &TrainTrackSpec, bridge: &BridgeSpec) -> Result<Self, String> {
        let (m, c, k) = (Matrix::default(), Matrix::default(), Matrix::default());
        let data = &train_track.track.rail;
        let rail = Beam {
            bending_stiffness: data.bending_stiffness,
            mass: data.mass,
            shear_stiffness: data.shear_stiffness,
            rotary_inertia: data.rotary_inertia,
        };
        let per_bay = train_track.elements_per_bay;
        let rail_elements = train_track.bays * per_bay;
        let mut system = Self {
            order: 0,
            m,
            c,
            k,
            rail,
            rail_start: 10 * train_track.cars.len(),
            rail_from: train_track.from,
            rail_element: train_track.track.spacing / per_bay as f64,
            rail_elements,
            deck: Vec::new(),
        };
        system.cars(train_track);
        let layers_start = system.rail_start + 2 * (rail_elements + 1);
        for e in 0..rail_elements {
            let dofs = [0, 1, 2, 3].map(|i| Some(system.rail_start + 2 * e + i));
            system.k.add_element(dofs, rail.stiffness(system.rail_element));
            system.m.add_element(dofs, rail.mass_matrix(system.rail_element));
        }
        let layers = match &train_track.track.support {
            Support::SingleLayer { .. } => 0,
            Support::TwoLayer { .. } => 1,
            Support::ThreeLayer { .. } => 2,
        };
        system.bridge(bridge, layers_start + layers * (train_track.bays + 1))?;
        system.supports(train_track, bridge, layers_start, layers);
        Ok(system)
    }

    fn spring(&mut self, spring: &Spring, v: &Row) {
        self.k.add_row(spring.stiffness, v);
        self.c.add_row(spring.damping, v);
    }

    fn cars(&mut self, spec: &TrainTrackSpec) {
        for (n, car) in spec.cars.iter().enumerate() {
            let (o, lc, lt) = (10 * n, 0.5 * car.bogie_distance, 0.5 * car.wheelbase);
            let masses =
                [car.body_mass, car.body_inertia, car.bogie_mass, car.bogie_inertia, car.bogie_mass, car.bogie_inertia];
            masses
                .iter()
                .chain(&[car.wheelset_mass; 4])
                .enumerate()
                .for_each(|(i, m)| self.m.0.push((o + i, o + i, *m)));
            let secondary = Spring { stiffness: car.secondary_stiffness, damping: car.secondary_damping };
            let primary = Spring { stiffness: car.primary_stiffness, damping: car.primary_damping };
            self.spring(&secondary, &vec![(o, 1.0), (o + 1, lc), (o + 2, -1.0)]);
            self.spring(&secondary, &vec![(o, 1.0), (o + 1, -lc), (o + 4, -1.0)]);
            for (bogie, wheel, arm) in [(2, 6, lt), (2, 7, -lt), (4, 8, lt), (4, 9, -lt)] {
                self.spring(&primary, &vec![(o + bogie, 1.0), (o + bogie + 1, arm), (o + wheel, -1.0)]);
            }
        }
    }

    fn bridge(&mut self, spec: &BridgeSpec, start: usize) -> Result<(), String> {
        let StructureSpec::Beams { spans, continuous: false } = &spec.structure else {
            return Err("the reference solver knows simply supported beams only".into());
        };
        let Damping::Rayleigh { ratio, at: RayleighAt::FirstTimes(times) } = spec.damping else {
            return Err(
                "the reference solver knows Rayleigh damping at the first frequency and a multiple of it only".into()
            );
        };
        let (mut next, mut from, mut first) = (start, 0.0, f64::INFINITY);
        for span in spans {
            let (beam, l) = (
                Beam {
                    bending_stiffness: span.bending_stiffness,
                    mass: span.mass,
                    shear_stiffness: span.shear_stiffness,
                    rotary_inertia: 0.0,
                },
                span.length / span.elements as f64,
            );
            // ω₁ = (π/L)² √(EI/m), the closed form.
            first =
                first.min((std::f64::consts::PI / span.length).powi(2) * (span.bending_stiffness / span.mass).sqrt());
            // θ₀, (w, θ) of the inner nodes, θ of the last.
            let dof = |node: usize, rotation: bool| match (node, rotation) {
                (0, false) => None,
                (n, false) if n == span.elements => None,
                (0, true) => Some(next),
                (n, true) if n == span.elements => Some(next + 2 * n - 1),
                (n, rotation) => Some(next + 2 * n - 1 + usize::from(rotation)),
            };
            for e in 0..span.elements {
                let dofs = [dof(e, false), dof(e, true), dof(e + 1, false), dof(e + 1, true)];
                self.deck.push(DeckElement { from: from + e as f64 * l, length: l, beam, dofs });
            }
            next += 2 * span.elements;
            from += span.length;
        }
        let (w1, w2) = (first, times * first);
        let (alpha, beta) = (2.0 * ratio * w1 * w2 / (w1 + w2), 2.0 * ratio / (w1 + w2));
        for e in self.deck.clone() {
            let (k, m) = (e.beam.stiffness(e.length), e.beam.mass_matrix(e.length));
            self.k.add_element(e.dofs, k);
            self.m.add_element(e.dofs, m);
            self.c.add_element(
                e.dofs,
                std::array::from_fn(|i| std::array::from_fn(|j| alpha * m[i][j] + beta * k[i][j])),
            );
        }
        self.order = next;
        Ok(())
    }

    fn supports(&mut self, spec: &TrainTrackSpec, bridge: &BridgeSpec, layers_start: usize, layers: usize) {
        for support in 0..=spec.bays {
            let rail = self.rail_start + 2 * support * spec.elements_per_bay;
            let (sleeper, ballast) = (layers_start + layers * support, layers_start + layers * support + 1);
            let (lowest, base) = match &spec.track.support {
                Support::SingleLayer { fastener } => (rail, *fastener),
                Support::TwoLayer { pad, sleeper_mass, ballast } => {
                    self.spring(pad, &vec![(rail, 1.0), (sleeper, -1.0)]);
                    self.m.0.push((sleeper, sleeper, *sleeper_mass));
                    (sleeper, *ballast)
                }
                Support::ThreeLayer { pad, sleeper_mass, ballast: upper, ballast_mass, shear, sub_ballast } => {
                    self.spring(pad, &vec![(rail, 1.0), (sleeper, -1.0)]);
                    self.spring(upper, &vec![(sleeper, 1.0), (ballast, -1.0)]);
                    self.m.0.extend([(sleeper, sleeper, *sleeper_mass), (ballast, ballast, *ballast_mass)]);
                    if let (Some(shear), true) = (shear, support > 0) {
                        self.spring(shear, &vec![(ballast - layers, 1.0), (ballast, -1.0)]);
                    }
                    (ballast, *sub_ballast)
                }
            };
            let mut v = vec![(lowest, 1.0)];
            if let Some(i) = spec.on_bridge.iter().position(|s| *s == support) {
                v.extend(self.deck_row(bridge.supports[i]).into_iter().map(|(dof, n)| (dof, -n)));
            }
            self.spring(&base, &v);
        }
    }

    /// Deflection of the deck at `x` m from the bridge's begin.
    pub fn deck_row(&self, x: f64) -> Row {
        let found = self.deck.iter().rev().find(|e| e.from <= x + 1e-9).or(self.deck.first());
        found.map_or_else(Vec::new, |e| {
            let shape = e.beam.shape((x - e.from) / e.length, e.length);
            e.dofs.iter().zip(shape).filter_map(|(dof, n)| dof.map(|dof| (dof, n))).collect()
        })
    }

    /// Deflection of the rail at abscissa `x`, and c_loc there.
    pub fn rail_row(&self, x: f64) -> (Row, f64) {
        let s = (x - self.rail_from) / self.rail_element;
        let e = (s.max(0.0) as usize).min(self.rail_elements - 1);
        let (xi, l) = (s - e as f64, self.rail_element);
        let row =
            self.rail.shape(xi, l).into_iter().enumerate().map(|(i, n)| (self.rail_start + 2 * e + i, n)).collect();
        (row, self.rail.local_compliance(xi, l))
    }
}
