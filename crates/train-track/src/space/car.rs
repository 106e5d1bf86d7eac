//! A car of 35 degrees of freedom.
//!
//! ```text
//! q = (y, z, φ, θ, ψ) of body, leading bogie, trailing bogie, wheelsets 1 … 4
//! a point p = (X, Y, Z) of a body:  δx = −ψY,  δy = y + ψX − φZ,  δz = z + φY + θX
//! K = Σ k rᵀr,  C = Σ c rᵀr,   r = row_A(p_A) − row_B(p_B) of every link;  M diagonal, weight g m on every z
//! gyroscopic moments of an axle, Ω = v/r0:  C_φψ += I_wy Ω,  C_ψφ −= I_wy Ω
//! K̂ = K + a₀M + a₁C;   q_free = K̂⁻¹ p,   q₁ = q_free + K̂⁻¹ Rᵀ f,   Y = R K̂⁻¹ Rᵀ
//! ```
//!
//! R picks the ports: all motions of the wheelsets, and the stretch of every link that is not linear. The term −θZ of δx is
//! left out: nothing balances it without a motion along x, and it would stiffen the bogies' pitch.

use nalgebra::DMatrix;
use ttb_dynamics::newmark::Newmark;
use ttb_scenario::GRAVITY;
use ttb_scenario::spec::{LinkLaw, SpaceCar, SpaceLink};

use super::element::Element;

/// Degrees of freedom of a car.
pub const DOFS: usize = 35;
/// Axles of a car.
pub const AXLES: usize = 4;
/// Degrees of freedom of a body: y, z, φ, θ, ψ.
pub const OF_BODY: usize = 5;
/// First degree of freedom of the first wheelset.
pub const FIRST_WHEELSET: usize = 3 * OF_BODY;
/// Ports of the wheelsets.
pub const WHEELSET_PORTS: usize = AXLES * OF_BODY;

/// Motion of a point by the degrees of freedom.
pub type Row = [f64; DOFS];

/// Matrices of one kind of car.
#[derive(Clone, Debug)]
pub struct Car {
    /// Diagonal of M.
    pub mass: Row,
    /// K.
    pub stiffness: DMatrix<f64>,
    /// C without gyroscopic moments.
    pub damping: DMatrix<f64>,
    /// Weight of every degree of freedom, N.
    pub weight: Row,
    /// Links that are not linear, with the row of their stretch.
    pub elements: Vec<(Row, Element)>,
    /// r0, m.
    pub radius: f64,
    /// Spin inertia of a wheelset, kg m².
    pub spin_inertia: f64,
    /// Centres of the bodies, m ahead of the car's middle and above the rail.
    pub centres: Vec<[f64; 2]>,
}

/// Row of the motion of a point along an axis: 0 x, 1 y, 2 z.
pub fn point_row(body: usize, [x, y, z]: [f64; 3], axis: usize) -> Row {
    let mut row = [0.0; DOFS];
    let at = OF_BODY * body;
    match axis {
        0 => row[at + 4] = -y,
        1 => (row[at], row[at + 4], row[at + 2]) = (1.0, x, -z),
        _ => (row[at + 1], row[at + 2], row[at + 3]) = (1.0, y, x),
    }
    row
}

fn rotation_row(body: usize, axis: usize) -> Row {
    let mut row = [0.0; DOFS];
    row[OF_BODY * body + [2, 3, 4][axis.min(2)]] = 1.0;
    row
}

fn difference(a: Row, b: Row) -> Row {
    std::array::from_fn(|i| a[i] - b[i])
}

fn add(matrix: &mut DMatrix<f64>, row: &Row, factor: f64) {
    if factor == 0.0 {
        return;
    }
    for (i, a) in row.iter().enumerate().filter(|(_, a)| **a != 0.0) {
        for (j, b) in row.iter().enumerate().filter(|(_, b)| **b != 0.0) {
            matrix[(i, j)] += factor * a * b;
        }
    }
}

impl Car {
    /// Assembles the matrices.
    ///
    /// # Errors
    /// A car that has not seven bodies, or a link to a body that is not there.
    pub fn new(data: &SpaceCar) -> Result<Self, String> {
        if data.bodies.len() != 3 + AXLES {
            let found = data.bodies.len();
            return Err(format!("a car in space has 7 bodies: body, 2 bogies, 4 wheelsets; {found} are given"));
        }
        let (mut mass, mut weight) = ([0.0; DOFS], [0.0; DOFS]);
        for (b, body) in data.bodies.iter().enumerate() {
            let [ix, iy, iz] = body.inertia;
            mass[OF_BODY * b..OF_BODY * (b + 1)].copy_from_slice(&[body.mass, body.mass, ix, iy, iz]);
            weight[OF_BODY * b + 1] = GRAVITY * body.mass;
        }
        let mut car = Self {
            mass,
            weight,
            stiffness: DMatrix::zeros(DOFS, DOFS),
            damping: DMatrix::zeros(DOFS, DOFS),
            elements: Vec::new(),
            radius: data.wheel_radius,
            spin_inertia: data.bodies[3].inertia[1],
            centres: data.bodies.iter().map(|body| [body.x, body.height]).collect(),
        };
        for (i, link) in data.links.iter().enumerate() {
            if link.between.iter().any(|body| *body >= data.bodies.len()) {
                return Err(format!("link {} of a car joins bodies that the car does not have", i + 1));
            }
            car.join(link);
        }
        Ok(car)
    }

    fn join(&mut self, link: &SpaceLink) {
        let [a, b] = link.between;
        let along = |axis| difference(point_row(a, link.at[0], axis), point_row(b, link.at[1], axis));
        match &link.law {
            LinkLaw::Linear { stiffness, damping } => {
                for axis in 0..3 {
                    add(&mut self.stiffness, &along(axis), stiffness[axis]);
                    add(&mut self.damping, &along(axis), damping[axis]);
                }
            }
            LinkLaw::Rotation { axis, stiffness, damping } => {
                let row = difference(rotation_row(a, *axis), rotation_row(b, *axis));
                add(&mut self.stiffness, &row, *stiffness);
                add(&mut self.damping, &row, *damping);
            }
            LinkLaw::Damper { axis, damping, blow_off: None, series: None, .. } => {
                add(&mut self.damping, &along(*axis), *damping);
            }
            LinkLaw::Damper { axis, damping, blow_off, beyond, series } => {
                let element = Element::damper(*damping, *blow_off, *beyond, *series);
                self.elements.push((along(*axis), element));
            }
            LinkLaw::Stop { axis, points } => self.elements.push((along(*axis), Element::stop(points))),
        }
    }

    /// Number of ports beside the rails': wheelsets, then links that are not linear.
    pub fn ports(&self) -> usize {
        WHEELSET_PORTS + self.elements.len()
    }

    /// Row of a port.
    pub fn port_row(&self, port: usize) -> Row {
        if port >= WHEELSET_PORTS {
            return self.elements[port - WHEELSET_PORTS].0;
        }
        let mut row = [0.0; DOFS];
        row[FIRST_WHEELSET + port] = 1.0;
        row
    }

    /// C with the gyroscopic moments at the spin Ω = v/r0.
    pub fn damping_at(&self, speed: f64) -> DMatrix<f64> {
        let mut damping = self.damping.clone();
        let moment = self.spin_inertia * speed / self.radius;
        for axle in 0..AXLES {
            let at = FIRST_WHEELSET + OF_BODY * axle;
            damping[(at + 2, at + 4)] += moment;
            damping[(at + 4, at + 2)] -= moment;
        }
        damping
    }
}

/// A kind of car for one step size.
#[derive(Clone, Debug)]
pub struct CarStep {
    /// K̂⁻¹ by rows.
    inverse: Vec<f64>,
    /// C with gyroscopic moments, by rows.
    damping: Vec<f64>,
    /// K̂⁻¹ Rᵀ by rows, 35 × ports.
    answer: Vec<f64>,
    /// Y = R K̂⁻¹ Rᵀ by rows.
    pub compliance: Vec<f64>,
    ports: usize,
}

impl CarStep {
    /// For one step size and the speed of the gyroscopic moments.
    ///
    /// # Errors
    /// A matrix without inverse, as a message.
    pub fn new(car: &Car, newmark: &Newmark, speed: f64) -> Result<Self, String> {
        let damping = car.damping_at(speed);
        let mass = DMatrix::from_fn(DOFS, DOFS, |i, j| if i == j { newmark.a[0] * car.mass[i] } else { 0.0 });
        let effective = &car.stiffness + mass + newmark.a[1] * &damping;
        let inverse = effective.try_inverse().ok_or("a car's Newmark matrix is singular: check its masses")?;
        let ports = car.ports();
        let rows = DMatrix::from_fn(DOFS, ports, |i, port| car.port_row(port)[i]);
        let answer = &inverse * &rows;
        let compliance = rows.transpose() * &answer;
        // nalgebra stores by columns.
        let by_rows = |m: DMatrix<f64>| m.transpose().as_slice().to_vec();
        Ok(Self {
            inverse: by_rows(inverse),
            damping: by_rows(damping),
            answer: by_rows(answer),
            compliance: by_rows(compliance),
            ports,
        })
    }

    /// q_free = K̂⁻¹ p of a car from its old motion and `extra` forces.
    pub fn free(&self, car: &Car, newmark: &Newmark, [u, v, a]: [&[f64]; 3], extra: &Row, free: &mut [f64]) {
        let (mut p, mut moved) = ([0.0; DOFS], [0.0; DOFS]);
        for i in 0..DOFS {
            moved[i] = newmark.damping(u[i], v[i], a[i]);
            p[i] = car.weight[i] + extra[i] + car.mass[i] * newmark.inertia(u[i], v[i], a[i]);
        }
        for (p, row) in p.iter_mut().zip(self.damping.chunks_exact(DOFS)) {
            *p += dot(row, &moved);
        }
        for (free, row) in free.iter_mut().zip(self.inverse.chunks_exact(DOFS)) {
            *free = dot(row, &p);
        }
    }

    /// q₁ = q_free + K̂⁻¹ Rᵀ f.
    pub fn press(&self, free: &[f64], forces: impl Fn(usize) -> f64, q: &mut [f64]) {
        for ((q, free), row) in q.iter_mut().zip(free).zip(self.answer.chunks_exact(self.ports)) {
            *q = free + row.iter().enumerate().map(|(port, a)| a * forces(port)).sum::<f64>();
        }
    }
}

/// Σ a b.
pub fn dot(a: &[f64], b: &[f64]) -> f64 {
    let (a4, rest_a) = a.as_chunks::<4>();
    let (b4, rest_b) = b.as_chunks::<4>();
    let mut sums = [0.0; 4];
    for (a, b) in a4.iter().zip(b4) {
        (0..4).for_each(|k| sums[k] += a[k] * b[k]);
    }
    let rest: f64 = rest_a.iter().zip(rest_b).map(|(a, b)| a * b).sum();
    (sums[0] + sums[2]) + (sums[1] + sums[3]) + rest
}
