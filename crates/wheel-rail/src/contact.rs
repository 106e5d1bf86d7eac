//! One wheel on one rail: both regions of its table with elasticity and creep; forces on the wheel and their derivatives.
//!
//! Everything that the table's D decides is made once: G, a₁, b₁ and Kalker's coefficients of the ellipse with the curvatures
//! A₂ = cos γ/r along and B₂ across. Between the nodes these are linear, g is the cubic through g and g′.

use crate::creep::Creep;
use crate::geometry::{Geometry, Part, Region};
use crate::hertz::{Hertz, Material};
use crate::kalker::Coefficients;
use crate::patch::{Column, Contacting, Forces, Gradient, Law, Motion, Running, patch};

/// What the forces of a contact are made from, besides its geometry.
#[derive(Clone, Copy, Debug)]
pub struct Settings {
    /// r0: rolling radius at the taping line, m.
    pub radius: f64,
    /// Of wheel and rail.
    pub material: Material,
    /// G in m/N^{2/3}, or `None`: from the curvatures of every place.
    pub hertz_constant: Option<f64>,
    /// Kalker's coefficients, or `None`: those of the ellipse of every place.
    pub kalker: Option<Coefficients>,
    /// μ.
    pub friction: f64,
    /// The law.
    pub creep: Creep,
}

/// What the tread has at one D.
#[derive(Clone, Copy, Debug, Default)]
pub struct Tread {
    /// g, m.
    pub distance: f64,
    /// g′.
    pub slope: f64,
    /// u_c, m.
    pub across: f64,
    /// r, m.
    pub radius: f64,
    /// G, m/N^{2/3}.
    pub hertz: f64,
}

/// The elastic values of one node: G, c₁₁, c₂₂, c₂₃, a₁, b₁.
type Elastic = [f64; 6];

/// A wheel on a rail.
#[derive(Clone, Debug)]
pub struct Contact {
    geometry: Geometry,
    elastic: [Vec<Elastic>; 2],
    law: Law,
}

impl Contact {
    /// Joins a table with what it is made of.
    ///
    /// # Errors
    /// Settings without sense, each with its value.
    pub fn new(geometry: Geometry, settings: &Settings) -> Result<Self, String> {
        let Settings { radius, material, friction, .. } = *settings;
        let above_zero = [
            ("rolling radius", radius),
            ("Young's modulus", material.young),
            ("Hertz constant", settings.hertz_constant.unwrap_or(1.0)),
        ];
        if let Some((name, value)) = above_zero.into_iter().find(|(_, x)| !(x.is_finite() && *x > 0.0)) {
            return Err(format!("the {name} of a wheel–rail contact is {value}; it must be a number above 0"));
        }
        if !(0.0..=0.5).contains(&material.poisson) {
            return Err(format!(
                "Poisson's ratio of a wheel–rail contact is {}; it must lie in 0…0.5",
                material.poisson
            ));
        }
        if !(friction.is_finite() && friction >= 0.0) {
            return Err(format!("the friction coefficient is {friction}; it must be a number of at least 0"));
        }
        let elastic = |region: Region| {
            let nodes = &geometry.region(region).nodes;
            nodes
                .iter()
                .map(|node| elastic(settings, radius + node.radius_change, node.slope, node.curvature))
                .collect()
        };
        let law = Law { creep: settings.creep, friction, shear: material.shear(), radius };
        Ok(Self { elastic: Region::ALL.map(elastic), geometry, law })
    }

    /// The table.
    #[must_use]
    pub fn geometry(&self) -> &Geometry {
        &self.geometry
    }

    /// The tread at D, for rest.
    #[must_use]
    pub fn tread(&self, d: f64) -> Tread {
        self.column(Region::Tread, d).map_or_else(Tread::default, |column| Tread {
            distance: column.distance[0],
            slope: column.distance[1],
            across: column.across[0],
            radius: column.radius[0],
            hertz: column.hertz[0],
        })
    }

    /// Another friction coefficient.
    pub fn set_friction(&mut self, friction: f64) {
        self.law.friction = friction;
    }

    /// Another law of creep.
    pub fn set_creep(&mut self, creep: Creep) {
        self.law.creep = creep;
    }

    /// Forces on the wheel.
    #[must_use]
    pub fn forces(&self, motion: &Motion, running: Running) -> Forces {
        self.total(motion, running, None)
    }

    /// Forces on the wheel, and their derivatives in `gradient`.
    #[must_use]
    pub fn forces_and_gradient(&self, motion: &Motion, running: Running, gradient: &mut Gradient) -> Forces {
        *gradient = [[0.0; 8]; 6];
        self.total(motion, running, Some(gradient))
    }

    /// Forces on the wheel; the patches' derivatives are added to `gradient`.
    fn total(&self, motion: &Motion, running: Running, mut gradient: Option<&mut Gradient>) -> Forces {
        let mut total = [0.0; 6];
        for region in Region::ALL {
            if let Some(column) = self.column(region, motion[0]) {
                patch(&column, &self.law, motion, running, gradient.as_deref_mut()).add_to(&mut total);
            }
        }
        total
    }

    /// The patches on tread and flange.
    #[must_use]
    pub fn patches(&self, motion: &Motion, running: Running) -> [Contacting; 2] {
        Region::ALL.map(|region| {
            let column = self.column(region, motion[0]);
            column.map_or_else(Contacting::default, |column| patch(&column, &self.law, motion, running, None))
        })
    }

    /// The table's values at D; `None` for a region that cannot touch there.
    fn column(&self, region: Region, d: f64) -> Option<Column> {
        let part = self.geometry.region(region);
        let (i, x) = part.place(d);
        let [a, b] = part.nodes.get(i..i + 2)? else { return None };
        if region == Region::Flange && d < part.start {
            return None;
        }
        let [from, to] = self.elastic[region as usize].get(i..i + 2)? else { return None };
        // Beyond the table its end values hold; g alone goes on.
        let inside = x.clamp(0.0, 1.0);
        let linear = |a: f64, b: f64| {
            let rate = if inside == x { (b - a) / part.spacing } else { 0.0 };
            [a + inside * (b - a), rate]
        };
        let of = |k: usize| linear(from[k], to[k]);
        let [radius, rate] = linear(a.radius_change, b.radius_change);
        Some(Column {
            distance: distance(part, i, x),
            across: linear(a.across, b.across),
            radius: [self.law.radius + radius, rate],
            hertz: of(0),
            creep: [of(1), of(2), of(3)],
            axes: [of(4)[0], of(5)[0]],
        })
    }
}

fn distance(part: &Part, i: usize, x: f64) -> [f64; 3] {
    let (a, b) = (&part.nodes[i], &part.nodes[i + 1]);
    crate::geometry::cubic(x, part.spacing, [a.distance, a.slope], [b.distance, b.slope])
}

fn elastic(settings: &Settings, radius: f64, slope: f64, across: f64) -> Elastic {
    let along = 1.0 / (radius * (1.0 + slope * slope).sqrt());
    let hertz = Hertz::new(along, across, &settings.material);
    let (a, b) = (hertz.along, hertz.across);
    let own = || Coefficients::new(a / b, settings.material.poisson);
    let Coefficients { c11, c22, c23 } = settings.kalker.unwrap_or_else(own);
    let area = a * b;
    [settings.hertz_constant.unwrap_or(hertz.constant), area * c11, area * c22, area * area.sqrt() * c23, a, b]
}

#[cfg(test)]
mod tests;
