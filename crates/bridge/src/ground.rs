//! Motion of the ground under the bearings.
//!
//! With u = u' + r_y y_g + r_z z_g, r the rigid translations of all motions, those of the bearings included,
//!
//! ```text
//! M ü' + C u̇' + K u' = Bᵀ f − M r_y ÿ_g − M r_z z̈_g           C acts on the motion relative to the ground
//! ```
//!
//! so that −M r_y and −M r_z are two more rows B with the accelerations as their forces: they take every way that forces take,
//! also into modes and reduced models. What a row R sees of the whole motion is R u' + R r_y y_g + R r_z z_g, and R r is 1 for
//! the support's own direction, 0 about the track.

use ttb_contract::ModelError;
use ttb_import::Imported;
use ttb_scenario::ground::{GroundSeries, GroundState};
use ttb_scenario::spec::{BridgeSpec, StructureSpec};
use ttb_scenario::types::Direction;

use crate::deck::Row;
use crate::rows::sparse;
use crate::{across, plane, space};

/// Number of rows −M r.
pub const ROWS: usize = 2;

/// The ground's motion as a bridge feels it.
pub struct Ground {
    /// Its series.
    pub series: GroundSeries,
    /// R r_y and R r_z of the monitored points.
    pub points: Vec<[f64; 2]>,
}

/// −M r_y, −M r_z.
pub type Inertia = [Row; ROWS];

/// A specification's ground with the rows that carry it in; none without.
///
/// # Errors
/// Imported matrices whose directions are not known.
pub fn rows(spec: &BridgeSpec) -> Result<Option<(Ground, Inertia)>, ModelError> {
    let Some(series) = &spec.ground else { return Ok(None) };
    let of_points = || spec.points.iter().map(|point| along(point.direction)).collect();
    let (points, inertia) = match &spec.structure {
        StructureSpec::Beams { .. } | StructureSpec::Frame(_) => (of_points(), plane::inertia(spec)?),
        StructureSpec::FiniteElements(model) => (of_points(), space::inertia(model)?),
        StructureSpec::Matrices { files, folder, .. } => {
            let imported = files.read(folder).map_err(|problems| ModelError(problems.to_string()))?;
            of_imported(&imported)?
        }
        StructureSpec::Stored => (spec.ground_points.clone(), Default::default()),
    };
    Ok(Some((Ground { series: series.clone(), points }, inertia)))
}

fn along(direction: Direction) -> [f64; 2] {
    match direction {
        Direction::X => [0.0, 0.0],
        Direction::Y => [1.0, 0.0],
        Direction::Z => [0.0, 1.0],
    }
}

/// M r over the rows of imported matrices; what they do not hold, the mass at held motions, is not in it.
fn of_imported(imported: &Imported) -> Result<(Vec<[f64; 2]>, Inertia), ModelError> {
    let rigid = across::translations(imported)?;
    let inertia = rigid.each_ref().map(|r| {
        let mut load = vec![0.0; r.len()];
        for (j, share) in r.iter().enumerate() {
            for (i, value) in imported.m.column(j) {
                load[i] -= value * share;
                if i != j {
                    load[j] -= value * r[i];
                }
            }
        }
        sparse(&load)
    });
    let seen = |row: &Row, r: &[f64]| row.iter().map(|(dof, weight)| weight * r[*dof as usize]).sum::<f64>();
    let points = imported.points.iter().map(|(_, row)| rigid.each_ref().map(|r| seen(row, r))).collect();
    Ok((points, inertia))
}

impl Ground {
    /// Where the ground is at a time, s.
    pub fn at(&self, t: f64) -> GroundState {
        self.series.at(t)
    }
}
