//! Matrices from another program → equations.

use std::path::Path;

use ttb_contract::ModelError;
use ttb_import::{Dofs, Files, Imported, Row};
use ttb_sparse::Assembly;

use crate::assembled::{Assembled, Monitor, Names};
use crate::outline::{Outline, Weight};

/// Stations closer than this to a support of the file are that support, m.
const NEAR: f64 = 1e-6;

/// Reads the files; supports at `stations` (m from the bridge's begin) stand where the file says, or between two of its
/// supports with linear weights.
///
/// # Errors
/// All problems of the files; a station outside the file's supports.
pub fn assemble(files: &Files, folder: &Path, stations: &[f64]) -> Result<Assembled, ModelError> {
    from(files.read(folder).map_err(|problems| ModelError(problems.to_string()))?, stations)
}

/// As [`assemble`], with the rows of all components of the supports' motion in blocks (module `across`).
///
/// # Errors
/// As [`assemble`], and matrices that do not tell how the supports move across.
pub fn assemble_in_space(files: &Files, folder: &Path, stations: &[f64]) -> Result<Assembled, ModelError> {
    let imported = files.read(folder).map_err(|problems| ModelError(problems.to_string()))?;
    let [across, about] = crate::across::rows(&imported)?;
    let mut lateral = Vec::with_capacity(2 * stations.len());
    for block in [&across, &about] {
        for (number, &x) in (1..).zip(stations) {
            lateral.push(support(block, number, x)?);
        }
    }
    let mut assembled = from(imported, stations)?;
    assembled.supports.extend(lateral);
    Ok(assembled)
}

/// From what was read.
///
/// # Errors
/// A station outside the file's supports.
pub fn from(imported: Imported, stations: &[f64]) -> Result<Assembled, ModelError> {
    let supports = (1..).zip(stations).map(|(number, &x)| support(&imported.supports, number, x));
    let supports = supports.collect::<Result<_, _>>()?;
    // As much as moves in a rigid translation; 0 when directions are unknown.
    let mass =
        imported.inspect().motions.iter().filter(|m| m.direction < 3).map(|motion| motion.inertia).fold(0.0, f64::max);
    let digits = imported.files.first().map(|file| file.facts.digits);
    let Imported { k, m, c, dofs, points, .. } = imported;
    let mut equations = Assembly::new(k.n);
    for j in 0..k.n {
        k.column(j).for_each(|(i, value)| equations.add_entry(i as u32, j as u32, value, 0.0));
        m.column(j).for_each(|(i, value)| equations.add_entry(i as u32, j as u32, 0.0, value));
        let damping = c.iter().flat_map(|c| c.column(j));
        damping.for_each(|(i, value)| equations.add_entry_of_damping(i as u32, j as u32, value));
    }
    let (monitors, points) = points
        .into_iter()
        .enumerate()
        .map(|(motion, (name, row))| (row, Monitor { name, motion, moment: None }))
        .unzip();
    let node_of = dofs.as_ref().map(|dofs| dofs.node_of.clone()).unwrap_or_default();
    let nodes = dofs.as_ref().and_then(|dofs| dofs.coordinates.clone()).unwrap_or_default();
    Ok(Assembled { equations, nodes, node_of, names: names(dofs), supports, monitors, points, mass, digits })
}

fn names(dofs: Option<Dofs>) -> Names {
    Box::new(move |dof| match dofs.as_ref().and_then(|dofs| dofs.dofs.get(dof)) {
        Some(label) => format!("row {} of the matrices ({label})", dof + 1),
        None => format!("row {} of the matrices", dof + 1),
    })
}

fn support(supports: &[(f64, Row)], number: usize, x: f64) -> Result<Row, ModelError> {
    let after = supports.partition_point(|(at, _)| *at < x - NEAR);
    let off = || {
        let ends = supports.first().zip(supports.last()).map(|(a, b)| format!("from {} m to {} m", a.0, b.0));
        let ends = ends.unwrap_or_else(|| "nowhere".into());
        ModelError(format!(
            "bridge: support[{number}] at x = {x} m is outside the file of supports, which reaches {ends}"
        ))
    };
    let (right, row) = supports.get(after).ok_or_else(off)?;
    if *right <= x + NEAR {
        return Ok(row.clone());
    }
    let (left, before) = after.checked_sub(1).and_then(|i| supports.get(i)).ok_or_else(off)?;
    let share = (x - left) / (right - left);
    let part = |row: &Row, share: f64| row.iter().map(|(dof, w)| (*dof, share * w)).collect::<Row>();
    Ok([part(before, 1.0 - share), part(row, share)].concat())
}

/// Nodes of imported matrices as points, each a cell of its own: which elements joined them is not in the matrices.
///
/// # Errors
/// There is no table of degrees of freedom, or it has no coordinates.
pub fn outline(imported: &Imported) -> Result<Outline, ModelError> {
    let dofs = imported.dofs.as_ref().filter(|dofs| dofs.coordinates.is_some());
    let Some((dofs, Some(points))) = dofs.map(|dofs| (dofs, dofs.coordinates.clone())) else {
        let text = "bridge: only nodes with coordinates can be drawn: give bridge.structure.dofs with columns x, y, z";
        return Err(ModelError(text.into()));
    };
    let mut rows = vec![<[Row; 3]>::default(); points.len()];
    for ((row, dof), node) in (0..).zip(&dofs.dofs).zip(&dofs.node_of) {
        if let Some(along) = rows[*node as usize].get_mut(usize::from(dof.freedom)) {
            along.push((row, 1.0));
        }
    }
    let cells = (0..points.len() as u32).map(|node| vec![node]).collect();
    // The rows of the supports are displacements down.
    let mut down = [0.0; 3];
    for (dof, weight) in imported.supports.iter().flat_map(|(_, row)| row) {
        if let Some(sum) = down.get_mut(usize::from(dofs.dofs[*dof as usize].freedom)) {
            *sum += weight;
        }
    }
    let vertical = (0..3).max_by(|a, b| down[*a].abs().total_cmp(&down[*b].abs())).unwrap_or(2);
    Ok(Outline { points, cells, rows, weight: Weight::Down(vertical, down[vertical].signum()) })
}
