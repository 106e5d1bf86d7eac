//! Node and direction of every row: dofs.csv, CalculiX' .dof, ANSYS' .mapping.

mod readers;

use std::collections::HashMap;

use crate::dof::Dof;
use crate::input::Input;
use crate::numbering::Numbering;
use crate::problem::{Report, Stop};

use readers::Found;
pub(crate) use readers::nodes;

/// Degrees of freedom of a model.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Dofs {
    /// Of every row.
    pub dofs: Vec<Dof>,
    /// Numbers of the nodes, rising.
    pub nodes: Vec<u32>,
    /// Node of every row, a position in `nodes`.
    pub node_of: Vec<u32>,
    /// Coordinates (x, y, z) of the nodes, m, in `nodes`' order, if they are known.
    pub coordinates: Option<Vec<[f64; 3]>>,
}

impl Dofs {
    pub(crate) fn new(dofs: Vec<Dof>, coordinates: Option<&HashMap<u32, [f64; 3]>>) -> Self {
        let mut nodes: Vec<u32> = dofs.iter().map(|dof| dof.node).collect();
        nodes.sort_unstable();
        nodes.dedup();
        let node_of = dofs.iter().map(|dof| nodes.partition_point(|node| *node < dof.node) as u32).collect();
        let all = |known: &HashMap<u32, [f64; 3]>| nodes.iter().map(|node| known.get(node).copied()).collect();
        let coordinates = coordinates.and_then(all);
        Self { dofs, nodes, node_of, coordinates }
    }

    /// Rows by node and direction.
    pub(crate) fn numbering(&self) -> Numbering {
        Numbering::new(&self.dofs)
    }
}

/// Reads a file of degrees of freedom; `nodes` holds coordinates from elsewhere.
pub(crate) fn read(input: &Input, nodes: Option<&HashMap<u32, [f64; 3]>>, report: &mut Report) -> Result<Dofs, Stop> {
    let mut coordinates = HashMap::new();
    let rows = match input.extension().as_str() {
        "dof" => readers::calculix(input, report)?,
        "mapping" => readers::ansys(input, report)?,
        _ => readers::table(input, &mut coordinates, report)?,
    };
    let dofs = order(rows, report)?;
    let known = nodes.or(Some(&coordinates).filter(|c| !c.is_empty()));
    if let Some(known) = known
        && let Some(dof) = dofs.iter().find(|dof| !known.contains_key(&dof.node))
    {
        report.whole("every node must have coordinates, or none", format!("node {} has none", dof.node));
    }
    Ok(Dofs::new(dofs, known))
}

/// Rows in order, each there once, each with a label of its own.
fn order(mut rows: Vec<Found>, report: &mut Report) -> Result<Vec<Dof>, Stop> {
    rows.sort_by_key(|(_, row, _)| *row);
    let mut seen = HashMap::with_capacity(rows.len());
    let mut expected = 1;
    for &(line, row, dof) in &rows {
        if row < expected {
            report.line(line, "every row must be named once", format!("row {row} again"))?;
        } else if row > expected {
            let missing =
                if row == expected + 1 { format!("row {expected}") } else { format!("rows {expected} to {}", row - 1) };
            report.line(line, "rows must be numbered from 1 without a gap", format!("{missing} missing"))?;
        }
        expected = row.saturating_add(1);
        if let Some(other) = seen.insert(dof, row) {
            report.line(line, "node and direction must belong to one row", format!("{dof}: rows {other} and {row}"))?;
        }
    }
    if rows.is_empty() {
        return Err(report.fatal(None, "the file must name the rows", "it names none"));
    }
    Ok(rows.into_iter().map(|(_, _, dof)| dof).collect())
}
