//! Node and direction of every row: dofs.csv, CalculiX' .dof, ANSYS' .mapping.

use std::collections::HashMap;
use std::fmt;

use crate::input::Input;
use crate::lines::Lines;
use crate::number::{Fields, whole};
use crate::numbering::Numbering;
use crate::problem::{Report, Stop, excerpt};
use crate::table::{Column, Table};

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
        "dof" => calculix(input, report)?,
        "mapping" => ansys(input, report)?,
        _ => table(input, &mut coordinates, report)?,
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

/// Columns row, node, direction and maybe x, y, z.
fn table(input: &Input, coordinates: &mut HashMap<u32, [f64; 3]>, report: &mut Report) -> Result<Vec<Found>, Stop> {
    let mut table = Table::open(input, &["row", "node", "direction", "x", "y", "z"], report)?;
    let [row, node, along] = ["row", "node", "direction"].map(|name| table.needs(name, report));
    let (row, node, along) = (row?, node?, along?);
    let places = places(&table, report)?;
    let mut rows = Vec::new();
    while table.advance(report)? {
        let row = table.count(row, report)?;
        let node = table.count(node, report)?;
        let freedom = direction(table.text(along));
        let freedom = table.check(freedom, along, "one of x, y, z, rx, ry, rz", report)?;
        if let (Some(places), Some(node)) = (places, node) {
            place(&table, places, node, coordinates, report)?;
        }
        if let (Some(row), Some(node), Some(freedom)) = (row, node, freedom) {
            rows.push((table.line(), row, Dof { node, freedom }));
        }
    }
    Ok(rows)
}

/// The columns x, y, z: all or none.
fn places(table: &Table, report: &mut Report) -> Result<Option<[Column; 3]>, Stop> {
    match ["x", "y", "z"].map(|name| table.column(name)) {
        [Some(x), Some(y), Some(z)] => Ok(Some([x, y, z])),
        [None, None, None] => Ok(None),
        _ => Err(report.fatal(Some(1), "coordinates must have all three columns x, y, z", "")),
    }
}

fn place(
    table: &Table,
    places: [Column; 3],
    node: u32,
    coordinates: &mut HashMap<u32, [f64; 3]>,
    report: &mut Report,
) -> Result<(), Stop> {
    let mut at = [0.0; 3];
    for (at, column) in at.iter_mut().zip(places) {
        match table.real(column, report)? {
            Some(value) => *at = value,
            None => return Ok(()),
        }
    }
    let other = *coordinates.entry(node).or_insert(at);
    if other == at {
        return Ok(());
    }
    let found = format!("node {node}: {other:?} and {at:?}");
    report.line(table.line(), "a node must have the same coordinates in all its lines", found)
}

/// Reads coordinates of nodes: columns node, x, y, z.
pub(crate) fn nodes(input: &Input, report: &mut Report) -> Result<HashMap<u32, [f64; 3]>, Stop> {
    let mut table = Table::open(input, &["node", "x", "y", "z"], report)?;
    let node = table.needs("node", report)?;
    table.needs("x", report)?;
    let places = places(&table, report)?;
    let mut all = HashMap::new();
    while table.advance(report)? {
        if let (Some(node), Some(places)) = (table.count(node, report)?, places) {
            place(&table, places, node, &mut all, report)?;
        }
    }
    Ok(all)
}

/// CalculiX: node.direction, line by line.
fn calculix(input: &Input, report: &mut Report) -> Result<Vec<Found>, Stop> {
    let mut lines = Lines::open(input, report)?;
    let mut rows = Vec::new();
    while let Some(line) = lines.next(report)? {
        let text = line.text.trim_ascii();
        if text.is_empty() {
            continue;
        }
        let mut parts = text.splitn(2, |byte| *byte == b'.');
        let mut part = || whole(parts.next()?).and_then(|n| u32::try_from(n).ok());
        match (part().filter(|n| *n > 0), part()) {
            (Some(node), Some(freedom @ 1..=6)) => {
                rows.push((line.number, rows.len() as u32 + 1, Dof { node, freedom: freedom as u8 - 1 }));
            }
            _ => {
                let rule = "a line must hold node.direction with directions 1 to 6";
                report.line(line.number, rule, excerpt(text))?;
            }
        }
    }
    Ok(rows)
}

/// ANSYS: equation, node and label, line by line after a header.
fn ansys(input: &Input, report: &mut Report) -> Result<Vec<Found>, Stop> {
    let mut lines = Lines::open(input, report)?;
    let mut rows = Vec::new();
    while let Some(line) = lines.next(report)? {
        let mut fields = Fields::new(line.text);
        let (row, node) = (fields.whole(), fields.whole());
        if rows.is_empty() && row.is_none() || line.text.trim_ascii().is_empty() {
            continue; // header
        }
        let label = direction(&String::from_utf8_lossy(fields.next()));
        let number = |n: Option<u64>| u32::try_from(n?).ok().filter(|n| *n > 0);
        match (number(row), number(node), label, fields.end()) {
            (Some(row), Some(node), Some(freedom), true) => rows.push((line.number, row, Dof { node, freedom })),
            _ => {
                let rule = "a line must hold equation, node and one of UX, UY, UZ, ROTX, ROTY, ROTZ";
                report.line(line.number, rule, excerpt(line.text))?;
            }
        }
    }
    Ok(rows)
}
