//! The files that name rows and place nodes.

use std::collections::HashMap;

use crate::dof::{Dof, direction};
use crate::input::Input;
use crate::lines::Lines;
use crate::number::{Fields, whole};
use crate::problem::{Report, Stop, excerpt};
use crate::table::{Column, Table};

/// A row as a file gives it: line, number, what it is.
pub(super) type Found = (u64, u32, Dof);

/// Columns row, node, direction and maybe x, y, z.
pub(super) fn table(
    input: &Input,
    coordinates: &mut HashMap<u32, [f64; 3]>,
    report: &mut Report,
) -> Result<Vec<Found>, Stop> {
    let mut table = Table::open(input, Some(&["row", "node", "direction", "x", "y", "z"]), report)?;
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
            place(&mut table, places, node, coordinates, report)?;
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
    table: &mut Table,
    places: [Column; 3],
    node: u32,
    coordinates: &mut HashMap<u32, [f64; 3]>,
    report: &mut Report,
) -> Result<(), Stop> {
    let mut at = [0.0; 3];
    for (at, column) in at.iter_mut().zip(places) {
        match table.number(column, report)? {
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
    let mut table = Table::open(input, Some(&["node", "x", "y", "z"]), report)?;
    let node = table.needs("node", report)?;
    table.needs("x", report)?;
    let places = places(&table, report)?;
    let mut all = HashMap::new();
    while table.advance(report)? {
        if let (Some(node), Some(places)) = (table.count(node, report)?, places) {
            place(&mut table, places, node, &mut all, report)?;
        }
    }
    Ok(all)
}

/// CalculiX: node.direction, line by line.
pub(super) fn calculix(input: &Input, report: &mut Report) -> Result<Vec<Found>, Stop> {
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
pub(super) fn ansys(input: &Input, report: &mut Report) -> Result<Vec<Found>, Stop> {
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
