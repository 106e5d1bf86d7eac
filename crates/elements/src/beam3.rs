//! Beam element in space: bending in two planes from [`Beam`], axial force, St Venant torsion, rigid offsets, hinges.
//!
//! The axis runs from end 1 to end 2, each end a rigid arm d away from its node; axis 3 = axis 1 × orientation vector,
//! axis 2 completes the three. The element's own degrees of freedom are p = [u₁, u₂, u₃, r₁, r₂, r₃] at both ends.
//!
//! ```text
//! p = T R q,   R: u = A (u_node + r_node × d),  r = A r_node,   A: global → own axes
//! plane 1–2: w = u₂, θ = +r₃     plane 1–3: w = u₃, θ = −r₂
//! K = (TR)ᵀ K_p (TR)             M = (TR)ᵀ M_p (TR)
//! ```
//!
//! T condenses released rotations statically, as in [`ttb_dynamics::frame`]; the same T serves K, M and the
//! interpolation. Torsional inertia is ρ(I₂ + I₃); bending has rotary inertia in a plane with shear area only, so that
//! without it the beam is Euler's and Bernoulli's.

use nalgebra::{Matrix3, SMatrix, SVector, Vector3};
use ttb_dynamics::beam::Beam;

use crate::error::{ElementError, exceeds, not_negative, positive};
use crate::matrices::{Matrices, Weights};

type Matrix12 = SMatrix<f64, 12, 12>;
type Row12 = SVector<f64, 12>;

/// Cross-section and material of a beam.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BeamSection {
    /// Young's modulus E, N/m².
    pub modulus: f64,
    /// Shear modulus G, N/m².
    pub shear_modulus: f64,
    /// Density ρ, kg/m³.
    pub density: f64,
    /// Area A of the cross-section, m².
    pub area: f64,
    /// I₂ about axis 2 (bending in the plane 1–3), m⁴.
    pub inertia_2: f64,
    /// I₃ about axis 3 (bending in the plane 1–2), m⁴.
    pub inertia_3: f64,
    /// Torsion constant, m⁴.
    pub torsion: f64,
    /// Shear area along axis 2, m²; `None`: Euler–Bernoulli in the plane 1–2.
    pub shear_area_2: Option<f64>,
    /// Shear area along axis 3, m²; `None`: Euler–Bernoulli in the plane 1–3.
    pub shear_area_3: Option<f64>,
    /// Non-structural mass, kg/m.
    pub added_mass: f64,
}

impl BeamSection {
    fn check(&self) -> Result<(), ElementError> {
        positive("modulus", self.modulus)?;
        positive("area", self.area)?;
        not_negative("shear modulus", self.shear_modulus)?;
        not_negative("density", self.density)?;
        not_negative("inertia_2", self.inertia_2)?;
        not_negative("inertia_3", self.inertia_3)?;
        not_negative("torsion constant", self.torsion)?;
        not_negative("added mass", self.added_mass)?;
        self.shear_area_2.map_or(Ok(()), |area| positive("shear area along 2", area))?;
        self.shear_area_3.map_or(Ok(()), |area| positive("shear area along 3", area))
    }

    fn bending(&self, inertia: f64, shear_area: Option<f64>) -> Beam {
        Beam {
            bending_stiffness: self.modulus * inertia,
            mass: self.density * self.area + self.added_mass,
            shear_stiffness: shear_area.map(|area| self.shear_modulus * area),
            rotary_inertia: shear_area.map_or(0.0, |_| self.density * inertia),
        }
    }

    /// Plane 1–2.
    fn plane_2(&self) -> Beam {
        self.bending(self.inertia_3, self.shear_area_2)
    }

    /// Plane 1–3.
    fn plane_3(&self) -> Beam {
        self.bending(self.inertia_2, self.shear_area_3)
    }
}

/// Places of w₁, θ₁, w₂, θ₂ among p, and the sign of θ there.
const PLANE_2: ([usize; 4], f64) = ([1, 5, 7, 11], 1.0);
const PLANE_3: ([usize; 4], f64) = ([2, 4, 8, 10], -1.0);

/// A straight beam element.
#[derive(Clone, Debug, PartialEq)]
pub struct Beam3 {
    section: BeamSection,
    /// Where the axis begins.
    begin: Vector3<f64>,
    length: f64,
    /// A: rows are axes 1, 2, 3.
    axes: Matrix3<f64>,
    /// TR.
    transformation: Matrix12,
}

impl Beam3 {
    /// Between nodes at `ends`; `offsets` lead from them to the axis (global, m), `releases` free the rotations about
    /// axes 1, 2, 3 at either end.
    ///
    /// # Errors
    /// No length, no orientation, a section that is none, or nothing against twisting.
    pub fn new(
        ends: [[f64; 3]; 2],
        orientation: [f64; 3],
        section: BeamSection,
        offsets: [[f64; 3]; 2],
        releases: [[bool; 3]; 2],
    ) -> Result<Self, ElementError> {
        section.check()?;
        let arms = offsets.map(Vector3::from);
        let (begin, end) = (Vector3::from(ends[0]) + arms[0], Vector3::from(ends[1]) + arms[1]);
        let (length, axes) = axes(begin, end, orientation)?;
        let mut rigid = Matrix12::zeros();
        for (node, arm) in arms.iter().enumerate() {
            let i = 6 * node;
            rigid.fixed_view_mut::<3, 3>(i, i).copy_from(&axes);
            rigid.fixed_view_mut::<3, 3>(i + 3, i + 3).copy_from(&axes);
            rigid.fixed_view_mut::<3, 3>(i, i + 3).copy_from(&(-axes * arm.cross_matrix()));
        }
        let mut release = Matrix12::identity();
        match [releases[0][0], releases[1][0]] {
            [false, false] => {}
            [true, true] => return Err(ElementError::Twists),
            [first, _] => {
                let (free, held) = if first { (3, 9) } else { (9, 3) };
                (release[(free, free)], release[(free, held)]) = (0.0, 1.0);
            }
        }
        hinge(&mut release, [releases[0][2], releases[1][2]], PLANE_2, &section.plane_2(), length);
        hinge(&mut release, [releases[0][1], releases[1][1]], PLANE_3, &section.plane_3(), length);
        Ok(Self { section, begin, length, axes, transformation: release * rigid })
    }

    /// Length l, m.
    pub fn length(&self) -> f64 {
        self.length
    }

    /// Axes 1, 2, 3 in global components.
    pub fn axes(&self) -> [[f64; 3]; 3] {
        [0, 1, 2].map(|i| self.axes.row(i).transpose().into())
    }

    /// K and consistent M.
    pub fn matrices(&self) -> Matrices {
        let (s, l) = (&self.section, self.length);
        let (mut k, mut m) = (Matrix12::zeros(), Matrix12::zeros());
        let mass = s.density * s.area + s.added_mass;
        let twist = s.density * (s.inertia_2 + s.inertia_3);
        for (first, stiffness, mass) in [(0, s.modulus * s.area, mass), (3, s.shear_modulus * s.torsion, twist)] {
            for (i, j) in [(first, first), (first, first + 6), (first + 6, first), (first + 6, first + 6)] {
                k[(i, j)] = if i == j { stiffness / l } else { -stiffness / l };
                m[(i, j)] = if i == j { mass * l / 3.0 } else { mass * l / 6.0 };
            }
        }
        for ((places, sign), plane) in [(PLANE_2, s.plane_2()), (PLANE_3, s.plane_3())] {
            let (bending, inertia) = (plane.stiffness(l), plane.mass_matrix(l));
            for a in 0..4 {
                for b in 0..4 {
                    let sign = if (a + b) % 2 == 1 { sign } else { 1.0 };
                    k[(places[a], places[b])] = sign * bending[a][b];
                    m[(places[a], places[b])] = sign * inertia[a][b];
                }
            }
        }
        let t = &self.transformation;
        let (k, m) = (t.transpose() * k * t, t.transpose() * m * t);
        // Column by column is row by row of a symmetric matrix.
        Matrices { n: 12, k: k.as_slice().to_vec(), m: m.as_slice().to_vec() }
    }

    /// Place ξ between 0 and 1 on the axis that lies nearest to `point`, and the arm from there to it.
    pub fn closest(&self, point: [f64; 3]) -> (f64, [f64; 3]) {
        let chord = Vector3::from(point) - self.begin;
        let axis: Vector3<f64> = self.axes.row(0).transpose();
        let xi = (axis.dot(&chord) / self.length).clamp(0.0, 1.0);
        (xi, (chord - xi * self.length * axis).into())
    }

    /// Row that gives the displacement along `direction` of a point `arm` (global, m) away from the axis at ξ:
    ///
    /// ```text
    /// direction · (u(ξ) + r(ξ) × arm)
    /// ```
    pub fn interpolate(&self, xi: f64, direction: [f64; 3], arm: [f64; 3]) -> Weights {
        let (direction, arm) = (Vector3::from(direction), Vector3::from(arm));
        let (along, about) = (self.axes * direction, self.axes * arm.cross(&direction));
        let mut row = Row12::zeros();
        for (first, factor) in [(0, along.x), (3, about.x)] {
            row[first] = factor * (1.0 - xi);
            row[first + 6] = factor * xi;
        }
        let planes =
            [(PLANE_2, self.section.plane_2(), along.y, about.z), (PLANE_3, self.section.plane_3(), along.z, about.y)];
        for ((places, sign), plane, across, turn) in planes {
            let (n, t) = (plane.shape(xi, self.length), plane.rotation(xi, self.length));
            for a in 0..4 {
                // θ = sign · r, both as a nodal value and as what is asked for.
                let nodal = if a % 2 == 1 { sign } else { 1.0 };
                row[places[a]] = nodal * (across * n[a] + sign * turn * t[a]);
            }
        }
        let row = self.transformation.transpose() * row;
        row.iter().copied().enumerate().filter(|(_, weight)| *weight != 0.0).collect()
    }
}

/// l and A.
fn axes(begin: Vector3<f64>, end: Vector3<f64>, orientation: [f64; 3]) -> Result<(f64, Matrix3<f64>), ElementError> {
    let (chord, vector) = (end - begin, Vector3::from(orientation));
    let (length, size) = (chord.norm(), vector.norm());
    // Shorter than rounding of the coordinates leaves meaningful.
    if !exceeds(length, 1e-9 * (1.0 + begin.amax())) {
        return Err(ElementError::NoLength);
    }
    let first = chord / length;
    let third = first.cross(&vector);
    if !exceeds(third.norm(), 1e-6 * size) {
        return Err(ElementError::ParallelOrientation);
    }
    let third = third.normalize();
    let second = third.cross(&first);
    Ok((length, Matrix3::from_rows(&[first.transpose(), second.transpose(), third.transpose()])))
}

/// Puts the rotations free in one plane into T: each takes the value at which its end moment vanishes.
fn hinge(t: &mut Matrix12, free: [bool; 2], (places, sign): ([usize; 4], f64), beam: &Beam, l: f64) {
    let [w1, first, w2, second] = places;
    let phi = beam.shear_stiffness.map_or(0.0, |ga| 12.0 * beam.bending_stiffness / (ga * l * l));
    let mut set = |hinge: usize, chord: f64, far: Option<(usize, f64)>| {
        t[(hinge, hinge)] = 0.0;
        (t[(hinge, w1)], t[(hinge, w2)]) = (-sign * chord, sign * chord);
        far.into_iter().for_each(|(place, value)| t[(hinge, place)] = value);
    };
    let (chord, other) = (6.0 / (l * (4.0 + phi)), -(2.0 - phi) / (4.0 + phi));
    match free {
        [false, false] => {}
        [true, true] => [first, second].into_iter().for_each(|place| set(place, 1.0 / l, None)),
        [true, false] => set(first, chord, Some((second, other))),
        [false, true] => set(second, chord, Some((first, other))),
    }
}

#[cfg(test)]
mod tests;
