//! What the physics in space is built from, beside what a plane run needs.
//!
//! ```text
//! x ahead, y to the right, z down        φ about x: right side down     ψ about z: front to the right     θ: front down
//! a point p = (X, Y, Z) of a body:       δx = −ψ Y,   δy = y + ψ X − φ Z,   δz = z + φ Y + θ X
//! ```
//!
//! Vertical stiffness, damping and masses of cars and track stand in the plane keys only, summed over both sides: a side has
//! half of them. So a plane and a spatial run of one scenario cannot contradict each other.

use serde::{Deserialize, Serialize};

use crate::ground::GroundSeries;
use crate::types::{Creep, ProfileShape, Spring};

use super::Profile;

/// The part of a train–track specification that only a run in space has.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SpaceSpec {
    /// One a car, from the front.
    pub cars: Vec<SpaceCar>,
    /// Rails, fasteners, sleepers: what the plane track does not say.
    pub track: SpaceTrack,
    /// Wheel–rail contact.
    pub contact: SpaceContact,
    /// Lateral and twist components; the level is the plane irregularity.
    pub irregularity: SpaceIrregularity,
    /// Points of a curve (x in m, curvature in 1/m, cant angle in rad), x rising; linear between, constant outside; both are
    /// positive in a curve to the right with its right side lowered. Empty: straight.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub curve: Vec<[f64; 3]>,
    /// Cross wind.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub wind: Option<WindSpec>,
    /// Motion of the ground under all supports beside the bridge.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub ground: Option<GroundSeries>,
}

/// A car as bodies and links.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SpaceCar {
    /// Radius of the wheels at the taping line r0, m.
    pub wheel_radius: f64,
    /// Body, leading bogie, trailing bogie, wheelsets from the front.
    pub bodies: Vec<SpaceBody>,
    /// Springs, dampers and stops between them.
    pub links: Vec<SpaceLink>,
}

/// A rigid body.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SpaceBody {
    /// Mass, kg.
    pub mass: f64,
    /// I_x (roll), I_y (pitch; of a wheelset its spin), I_z (yaw) about the centre of gravity, kg m².
    pub inertia: [f64; 3],
    /// Centre of gravity, m ahead of the car's middle.
    pub x: f64,
    /// Its height above the rail's top, m.
    pub height: f64,
}

/// A link between points of two bodies.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SpaceLink {
    /// Positions in [`SpaceCar::bodies`].
    pub between: [usize; 2],
    /// The two points (X, Y, Z) relative to the bodies' centres, m.
    pub at: [[f64; 3]; 2],
    /// What acts there.
    pub law: LinkLaw,
}

/// Force of a link over the motion d of the first point relative to the second one.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "type", rename_all = "kebab-case")]
pub enum LinkLaw {
    /// Springs and dashpots along x, y, z: N/m, N s/m.
    Linear {
        /// Stiffness along x, y, z.
        stiffness: [f64; 3],
        /// Damping along x, y, z.
        damping: [f64; 3],
    },
    /// A spring and a dashpot between the rotations about an axis: N m/rad, N m s/rad.
    Rotation {
        /// 0 roll, 1 pitch, 2 yaw.
        axis: usize,
        /// Stiffness.
        stiffness: f64,
        /// Damping.
        damping: f64,
    },
    /// A damper whose rate falls at a blow-off force, with a spring in series.
    Damper {
        /// 0 along x, 1 along y, 2 along z.
        axis: usize,
        /// Rate below the blow-off force, N s/m.
        damping: f64,
        /// From this force on the rate is `beyond`, N; none: nowhere.
        blow_off: Option<f64>,
        /// Rate above the blow-off force, N s/m.
        beyond: f64,
        /// Stiffness in series, N/m; none: rigid.
        series: Option<f64>,
    },
    /// A stop: force over |d|, zero up to the first point, on the last slope behind the last point.
    Stop {
        /// 0 along x, 1 along y, 2 along z.
        axis: usize,
        /// Points (m, N), both rising, the first with force 0.
        points: Vec<[f64; 2]>,
    },
}

/// One rail and its supports, beside the half of the plane track's values.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SpaceTrack {
    /// Lateral bending stiffness EI_z of a rail, N m².
    pub lateral_bending_stiffness: f64,
    /// Torsional stiffness GJ of a rail, N m².
    pub torsional_stiffness: f64,
    /// Polar inertia ρI_p of a rail, kg m.
    pub polar_inertia: f64,
    /// Running surface above the rail's axis h_h, m.
    pub head_height: f64,
    /// Foot below the rail's axis h_f, m.
    pub foot_height: f64,
    /// Half the distance of the rails' axes y_r, m.
    pub half_distance: f64,
    /// Distance of the rails' inner faces 14 mm below their top, m.
    pub gauge: f64,
    /// Inclination of the rails towards each other, 1/40 = 0.025.
    pub inclination: f64,
    /// Lateral fastener of a rail, N/m, N s/m.
    pub lateral: Spring,
    /// Fastener about the rail's axis, N m/rad, N m s/rad.
    pub rolling: Spring,
    /// Sleepers, where the plane track has some.
    pub sleeper: Option<SpaceSleeper>,
}

/// A sleeper as a rigid body.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SpaceSleeper {
    /// Roll inertia, kg m².
    pub roll_inertia: f64,
    /// Half the distance y_b of the two vertical springs of the ballast, m.
    pub half_distance: f64,
    /// Lateral ballast of a sleeper, N/m, N s/m.
    pub lateral: Spring,
}

/// Wheel–rail contact in space.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SpaceContact {
    /// Wheel profile: s outwards from the taping line, z down, mm.
    pub wheel: ProfileShape,
    /// Rail head profile, upright: u outwards from its axis, z down from its top, mm.
    pub rail: ProfileShape,
    /// Distance of the wheels' inner faces, m.
    pub back_to_back: f64,
    /// Half the distance of the wheels' taping lines, m.
    pub taping_line: f64,
    /// Coefficient of friction μ.
    pub friction: f64,
    /// Law of creep.
    pub creep: Creep,
    /// ε of the soft minimum, m.
    pub softness: f64,
    /// Fixed Hertz constant G of one wheel, m/N^{2/3}; none: Hertz's theory in every place.
    pub hertz_constant: Option<f64>,
    /// Young's modulus of wheel and rail, N/m².
    pub modulus: f64,
    /// Poisson's ratio of wheel and rail.
    pub poisson: f64,
}

/// Components of the irregularity beside the level; the random ones share its seed and have phases of their own.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SpaceIrregularity {
    /// (a_L + a_R)/2, to the right.
    pub alignment: Profile,
    /// r_R − r_L.
    pub cross_level: Profile,
    /// a_R − a_L.
    pub gauge: Profile,
}

/// Cross wind on the cars' bodies.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct WindSpec {
    /// Speed U across the track, m/s, positive to the right.
    pub speed: WindSpeed,
    /// Density of the air ρ, kg/m³.
    pub density: f64,
    /// Reference area of a car A, m².
    pub area: f64,
    /// Reference length ℓ of the moment, m.
    pub length: f64,
    /// Height above the rail's top of the point that the moment is about, m.
    pub height: f64,
    /// Rows (angle β in rad, side force, lift, roll moment), β rising from 0; linear between, constant behind the last.
    pub coefficients: Vec<[f64; 4]>,
}

/// Wind speed over time or place; linear between its points, constant outside.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum WindSpeed {
    /// Points (s, m/s): the same on all cars.
    Time(Vec<[f64; 2]>),
    /// Points (m along the track, m/s): a gust that the train drives through.
    Place(Vec<[f64; 2]>),
}

impl WindSpeed {
    /// U at time `t`, s, and abscissa `x`, m.
    #[must_use]
    pub fn at(&self, t: f64, x: f64) -> f64 {
        let [speed] = match self {
            Self::Time(points) => between(points, t),
            Self::Place(points) => between(points, x),
        };
        speed
    }
}

impl WindSpec {
    /// Force F_y, force F_z and moment M_x about the centre of gravity of a body at `height` above the rail's top, at its
    /// abscissa `x`, m, time `t`, s, and speed `v`, m/s.
    ///
    /// ```text
    /// U_r² = v² + U²,  β = atan(|U|/v),  q = ρ U_r² A/2:   F_y = ±q C_side,  F_z = −q C_lift,  M_x = ±q ℓ C_roll − (h − h_m) F_y
    /// ```
    #[must_use]
    pub fn forces(&self, t: f64, x: f64, v: f64, height: f64) -> [f64; 3] {
        let across = self.speed.at(t, x);
        let (side, angle) = (across.signum(), libm::atan2(across.abs(), v));
        let pressure = 0.5 * self.density * (v * v + across * across) * self.area;
        let [drag, lift, roll] = self.coefficient(angle);
        let force = side * pressure * drag;
        if across == 0.0 {
            return [0.0, -pressure * lift, 0.0];
        }
        [force, -pressure * lift, side * pressure * self.length * roll - (height - self.height) * force]
    }

    /// Side force, lift and roll moment at an angle.
    fn coefficient(&self, angle: f64) -> [f64; 3] {
        between(&self.coefficients, angle)
    }
}

/// Values of rows (abscissa, values) at an abscissa: linear in between, constant outside, 0 without rows.
fn between<const N: usize, const M: usize>(rows: &[[f64; N]], at: f64) -> [f64; M] {
    let after = rows.partition_point(|row| row[0] <= at);
    let value = |column: usize| match (after.checked_sub(1).map(|i| rows[i]), rows.get(after)) {
        (Some(low), Some(high)) => low[column] + (high[column] - low[column]) * (at - low[0]) / (high[0] - low[0]),
        (Some(row), None) | (None, Some(&row)) => row[column],
        (None, None) => 0.0,
    };
    std::array::from_fn(|i| value(i + 1))
}

impl SpaceSpec {
    /// Curvature κ, 1/m, and cant angle, rad, at an abscissa.
    #[must_use]
    pub fn curve_at(&self, x: f64) -> [f64; 2] {
        between(&self.curve, x)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// At β = 45° the relative wind is √2 times the train's; the wind from the left presses to the right and lifts.
    #[test]
    fn wind_presses_to_leeward_about_the_right_point() {
        let coefficients = vec![[0.0, 0.0, 0.1, 0.0], [std::f64::consts::FRAC_PI_2, 2.0, 0.3, 1.0]];
        let speed = WindSpeed::Place(vec![[100.0, 0.0], [150.0, 30.0]]);
        let wind = WindSpec { speed, density: 1.25, area: 60.0, length: 3.0, height: 0.0, coefficients };
        let q = 0.5 * 1.25 * 1800.0 * 60.0;
        let [side, down, roll] = wind.forces(0.0, 170.0, 30.0, 1.5);
        assert!((side / q - 1.0).abs() < 1e-12 && (down / q + 0.2).abs() < 1e-12, "{side} {down}");
        assert!((roll - (q * 3.0 * 0.5 - 1.5 * q)).abs() < 1e-6, "{roll}");
        let half = wind.speed.at(0.0, 125.0);
        assert!((half - 15.0).abs() < 1e-12);
        let against = WindSpec { speed: WindSpeed::Time(vec![[0.0, -30.0]]), ..wind };
        let [left, _, other] = against.forces(5.0, 0.0, 30.0, 1.5);
        assert!((left + side).abs() < 1e-9 && (other + roll).abs() < 1e-6);
    }
}
