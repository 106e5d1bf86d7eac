//! Node and direction of every row: dofs.csv, CalculiX' .dof, ANSYS' .mapping.

mod readers;

use std::collections::HashMap;
use std::fmt;

use crate::input::Input;
use crate::numbering::Numbering;
use crate::problem::{Report, Stop};

pub(crate) use readers::nodes;

/// Names of a node's six motions, in order.
pub const DIRECTIONS: [&str; 6] = ["x", "y", "z", "rx", "ry", "rz"];

/// The internal node −k of an Abaqus model has the number `INTERNAL` + k.
pub const INTERNAL: u32 = 1 << 31;

/// A degree of freedom, in the axes of the program that wrote the matrices.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Dof {
    /// Number of its node; above [`INTERNAL`] an internal one.
    pub node: u32,
    /// 0…5: one of [`DIRECTIONS`].
    pub freedom: u8,
}

impl fmt::Display for Dof {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let direction = DIRECTIONS.get(usize::from(self.freedom)).unwrap_or(&"?");
        match self.node {
            internal if internal > INTERNAL => write!(f, "internal node {}, {direction}", internal - INTERNAL),
            node => write!(f, "node {node}, {direction}"),
        }
    }
}

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

/// A direction by its name: x, ux, 1; rx, rotx, 4.
pub(crate) fn direction(name: &str) -> Option<u8> {
    const ALIASES: [[&str; 3]; 6] = [
        ["x", "ux", "1"],
        ["y", "uy", "2"],
        ["z", "uz", "3"],
        ["rx", "rotx", "4"],
        ["ry", "roty", "5"],
        ["rz", "rotz", "6"],
    ];
    let name = name.to_ascii_lowercase();
    (0..6).find(|&freedom| ALIASES[usize::from(freedom)].contains(&name.as_str()))
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

/// A row as a file gives it: line, number, what it is.
type Found = (u64, u32, Dof);

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
