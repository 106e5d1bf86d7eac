//! Forces of one patch and their derivatives.
//!
//! ```text
//! δ = ζ + ρ u_c − g(D)                                 vertical approach;  ρ roll of the wheel against the rail
//! cos γ = 1/√(1 + g′²),   N = (δ cos γ/G)^{3/2} for δ > 0, else no contact
//! Ω = v/r0 + θ̇                                         r = r0 + (r − r0)(D)
//! ξ_x = [v − Ω r − (ψ̇ + v κ) u_c]/v
//! ξ_y = [η − r φ̇ − v (r/r0) ψ]/(v cos γ)               η lateral velocity of the wheel against the rail's head
//! ξ_s = (Ω g′ + ψ̇) cos γ/v
//! T_x = −G_s c₁₁ N^{2/3} ξ_x,   T_y = −G_s (c₂₂ N^{2/3} ξ_y + c₂₃ N ξ_s),   saturated (module `creep`)
//! F_y = N cos γ g′ + T_y cos γ,   F_z = −N cos γ + T_y g′ cos γ                       on the wheel, y outwards
//! ```
//!
//! c₁₁ = a₁b₁C₁₁, c₂₂ = a₁b₁C₂₂, c₂₃ = (a₁b₁)^{3/2}C₂₃. At standstill creepages divide by 0.1 m/s.

use crate::creep::{Creep, shen};
use crate::fastsim::{Patch, STRIPS, fastsim};
use crate::kalker::Coefficients;

/// What the forces of a wheel depend on, y outwards: D, ζ, ρ, θ̇, ψ̇, ψ, η, φ̇.
///
/// | | | unit |
/// |---|---|---|
/// | D | outward displacement of the wheel relative to its rail | m |
/// | ζ | vertical displacement of the wheel's centre, minus the rail's and the irregularity, plus φ_r y_r | m |
/// | ρ | φ_w − φ_r: roll, field side down | rad |
/// | θ̇ | spin beyond v/r0 | rad/s |
/// | ψ̇, ψ | yaw: front outwards | rad/s, rad |
/// | η | ẏ_w − v̇_r − φ̇_r h_h | m/s |
/// | φ̇ | roll rate of the wheelset | rad/s |
pub type Motion = [f64; 8];

/// F_y, F_z, Σ u_c F_z, Σ r F_y, Σ u_c T_x, Σ r T_x of a wheel; N and N m.
pub type Forces = [f64; 6];

/// Derivatives of [`Forces`] (rows) by [`Motion`].
pub type Gradient = [[f64; 8]; 6];

/// How the train runs.
#[derive(Clone, Copy, Debug)]
pub struct Running {
    /// v, m/s.
    pub speed: f64,
    /// κ of the track, positive towards the outside of this wheel, 1/m.
    pub curvature: f64,
}

/// Creepages divide by no smaller speed than this, m/s.
const LEAST_SPEED: f64 = 0.1;

/// The table's values of one region at D, and their derivatives by D.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Column {
    /// g, g′, g″.
    pub distance: [f64; 3],
    /// u_c.
    pub across: [f64; 2],
    /// r.
    pub radius: [f64; 2],
    /// G.
    pub hertz: [f64; 2],
    /// c₁₁, c₂₂, c₂₃.
    pub creep: [[f64; 2]; 3],
    /// a₁ and b₁.
    pub axes: [f64; 2],
}

/// What is the same for all patches of a wheel.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Law {
    pub creep: Creep,
    pub friction: f64,
    pub shear: f64,
    pub radius: f64,
}

/// One patch.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Contacting {
    /// N, N; 0 without contact.
    pub normal: f64,
    /// Force on the wheel across, y outwards, N.
    pub across: f64,
    /// Force on the wheel downwards, N.
    pub down: f64,
    /// T_x on the wheel, N.
    pub along: f64,
    /// T_y in the tangent plane, y outwards, N.
    pub tangential: f64,
    /// u_c, m.
    pub place: f64,
    /// r, m.
    pub radius: f64,
    /// g′ = −tan γ.
    pub slope: f64,
    /// ξ_x, ξ_y, ξ_s.
    pub creepages: [f64; 3],
}

impl Contacting {
    /// Adds the patch to the forces of its wheel.
    pub(crate) fn add_to(&self, total: &mut Forces) {
        let Self { across, down, along, place, radius, .. } = *self;
        let own = [across, down, place * down, radius * across, place * along, radius * along];
        total.iter_mut().zip(own).for_each(|(total, own)| *total += own);
    }
}

/// One patch; with `gradient` its derivatives are added there.
pub(crate) fn patch(
    column: &Column,
    law: &Law,
    motion: &Motion,
    running: Running,
    gradient: Option<&mut Gradient>,
) -> Contacting {
    let [_, lift, roll, pitch_rate, yaw_rate, yaw, slide, roll_rate] = *motion;
    let [g, slope, bend] = column.distance;
    let ([u, du], [r, dr]) = (column.across, column.radius);
    let approach = lift + roll * u - g;
    if approach.is_nan() || approach <= 0.0 {
        // NaN must not pass for a wheel without contact.
        let normal = if approach.is_nan() { f64::NAN } else { 0.0 };
        return Contacting { normal, down: -normal, place: u, radius: r, slope, ..Contacting::default() };
    }
    let cos = 1.0 / (1.0 + slope * slope).sqrt();
    let [hertz, dhertz] = column.hertz;
    let root = (approach * cos / hertz).sqrt(); // N^{1/3}
    let n = root * root * root;

    let Running { speed: v, curvature } = running;
    let per = 1.0 / v.max(LEAST_SPEED);
    let spin = v / law.radius + pitch_rate; // Ω
    let xi_x = (v - spin * r - (yaw_rate + v * curvature) * u) * per;
    let xi_y = (slide - r * roll_rate - v * (r / law.radius) * yaw) * per / cos;
    let xi_s = (spin * slope + yaw_rate) * cos * per;
    let creepages = [xi_x, xi_y, xi_s];

    let [c11, c22, c23] = column.creep;
    let (area, shear) = (root * root, law.shear);
    let linear = [-shear * c11[0] * area * xi_x, -shear * (c22[0] * area * xi_y + c23[0] * n * xi_s)];
    let limit = law.friction * n;
    let (u_size, [factor, dfactor]) = match law.creep {
        Creep::None => (0.0, [0.0, 0.0]),
        Creep::Linear => (0.0, [1.0, 0.0]),
        Creep::Shen | Creep::Fastsim if limit > 0.0 => {
            let size = (linear[0] * linear[0] + linear[1] * linear[1]).sqrt() / limit;
            (size, shen(size))
        }
        Creep::Shen | Creep::Fastsim => (0.0, [0.0, 0.0]),
    };
    let simplified = |normal: f64, creepages: [f64; 3]| {
        let root = libm::cbrt(normal);
        let [a1, b1] = column.axes;
        let kalker = Coefficients {
            c11: c11[0] / (a1 * b1),
            c22: c22[0] / (a1 * b1),
            c23: c23[0] / (a1 * b1 * (a1 * b1).sqrt()),
        };
        let patch = Patch { along: a1 * root, across: b1 * root, normal, friction: law.friction, shear, kalker };
        fastsim(&patch, creepages, STRIPS)
    };
    let simple = law.creep == Creep::Fastsim && limit > 0.0;
    let [tx, ty] = if simple { simplified(n, creepages) } else { linear.map(|t| factor * t) };
    let contact = Contacting {
        normal: n,
        across: (n * slope + ty) * cos,
        down: (ty * slope - n) * cos,
        along: tx,
        tangential: ty,
        place: u,
        radius: r,
        slope,
        creepages,
    };
    let Some(gradient) = gradient else { return contact };

    // Derivatives by the motion; [0] by D.
    let dcos = -slope * bend * cos * cos * cos;
    let dn_approach = 1.5 * n / approach;
    let mut dn = [0.0; 8];
    dn[0] = dn_approach * (roll * du - slope) + 1.5 * n * (dcos / cos - dhertz / hertz);
    (dn[1], dn[2]) = (dn_approach, dn_approach * u);
    let mut dx = [0.0; 8];
    dx[0] = -(spin * dr + (yaw_rate + v * curvature) * du) * per;
    (dx[3], dx[4]) = (-r * per, -u * per);
    let mut dy = [0.0; 8];
    dy[0] = -dr * (roll_rate + v / law.radius * yaw) * per / cos - xi_y * dcos / cos;
    (dy[5], dy[6], dy[7]) = (-v * (r / law.radius) * per / cos, per / cos, -r * per / cos);
    let mut ds = [0.0; 8];
    ds[0] = spin * bend * cos * per + xi_s * dcos / cos;
    (ds[3], ds[4]) = (slope * cos * per, cos * per);

    let mut dt = [[0.0; 8]; 2];
    if simple {
        // FASTSIM by differences; its dependence on D through the axes is left out, which costs Newton some accuracy only.
        const SMALL: f64 = 1e-6;
        let by = |from: [f64; 2], to: [f64; 2], step: f64| [(to[0] - from[0]) / step, (to[1] - from[1]) / step];
        let here = [tx, ty];
        let by_n = by(here, simplified(n * (1.0 + SMALL), creepages), n * SMALL);
        let scale = [1.0, 1.0, 1.0 / (column.axes[1] * root)].map(|unit: f64| unit * SMALL * 0.1);
        let by_creep: [[f64; 2]; 3] = std::array::from_fn(|i| {
            let mut moved = creepages;
            moved[i] += scale[i];
            by(here, simplified(n, moved), scale[i])
        });
        for k in 0..2 {
            for j in 0..8 {
                dt[k][j] = by_n[k] * dn[j] + by_creep[0][k] * dx[j] + by_creep[1][k] * dy[j] + by_creep[2][k] * ds[j];
            }
        }
    } else {
        let darea = 2.0 / 3.0 * area / n;
        for j in 0..8 {
            let by_d = if j == 0 { 1.0 } else { 0.0 };
            let lx = -shear * (c11[0] * (area * dx[j] + darea * dn[j] * xi_x) + by_d * c11[1] * area * xi_x);
            let ly = -shear
                * (c22[0] * (area * dy[j] + darea * dn[j] * xi_y)
                    + c23[0] * (n * ds[j] + dn[j] * xi_s)
                    + by_d * (c22[1] * area * xi_y + c23[1] * n * xi_s));
            let du = if u_size > 0.0 {
                (linear[0] * lx + linear[1] * ly) / (u_size * limit * limit) - u_size * dn[j] / n
            } else {
                0.0
            };
            dt[0][j] = factor * lx + linear[0] * dfactor * du;
            dt[1][j] = factor * ly + linear[1] * dfactor * du;
        }
    }
    for j in 0..8 {
        let (by_slope, by_cos, by_u, by_r) = if j == 0 { (bend, dcos, du, dr) } else { (0.0, 0.0, 0.0, 0.0) };
        let across = (dn[j] * slope + n * by_slope + dt[1][j]) * cos + (n * slope + ty) * by_cos;
        let down = (dt[1][j] * slope + ty * by_slope - dn[j]) * cos + (ty * slope - n) * by_cos;
        let along = dt[0][j];
        let own = [
            across,
            down,
            u * down + by_u * contact.down,
            r * across + by_r * contact.across,
            u * along + by_u * tx,
            r * along + by_r * tx,
        ];
        gradient.iter_mut().zip(own).for_each(|(row, own)| row[j] += own);
    }
    contact
}
