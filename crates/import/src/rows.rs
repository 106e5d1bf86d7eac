//! Where supports and points rest: weights on the rows of the matrices.

use crate::dof::{Dof, direction};
use crate::input::Input;
use crate::numbering::Numbering;
use crate::problem::{Report, Stop};
use crate::table::{Column, Table};

/// Stations closer than this are the same, m.
pub(crate) const NEAR: f64 = 1e-6;

/// Weights on rows, from 0: u = Σ w q.
pub type Row = Vec<(u32, f64)>;

/// What the rows of a table may refer to.
pub(crate) struct Target<'a> {
    /// Number of rows; unknown if the matrices are bad.
    pub n: Option<usize>,
    /// Rows by node and direction.
    pub numbering: Option<&'a Numbering>,
    /// There are rows by node and direction, but the file that names them is bad.
    pub hidden: bool,
}

/// Which columns name the row.
enum Naming {
    Row(Column),
    Dof(Column, Column),
}

struct Weights {
    naming: Naming,
    weight: Option<Column>,
}

impl Weights {
    fn new(table: &Table, target: &Target<'_>, report: &mut Report) -> Result<Self, Stop> {
        let naming = match (table.column("row"), table.column("node"), table.column("direction")) {
            (Some(row), None, None) => Naming::Row(row),
            (None, Some(node), Some(direction)) if target.numbering.is_some() || target.hidden => {
                Naming::Dof(node, direction)
            }
            (None, Some(_), Some(_)) => {
                let rule = "rows named by node and direction need the file `dofs`";
                return Err(report.fatal(Some(1), rule, "none is given"));
            }
            _ => return Err(report.fatal(Some(1), "there must be a column row, or node and direction", "")),
        };
        Ok(Self { naming, weight: table.column("weight") })
    }

    /// Row and weight of a line.
    fn read(&self, table: &mut Table, target: &Target<'_>, report: &mut Report) -> Result<Option<(u32, f64)>, Stop> {
        let weight = match self.weight {
            Some(column) if !table.text(column).is_empty() => table.number(column, report)?,
            _ => Some(1.0),
        };
        let row = match self.naming {
            Naming::Row(column) => {
                let row = table.count(column, report)?;
                match (row, target.n) {
                    (Some(row), Some(n)) if row as usize > n => {
                        report.line(table.line(), format!("row must lie between 1 and {n}"), row)?;
                        None
                    }
                    _ => row.map(|row| row - 1),
                }
            }
            Naming::Dof(node, along) => {
                let node = table.count(node, report)?;
                let freedom = direction(table.text(along));
                let freedom = table.check(freedom, along, "one of x, y, z, rx, ry, rz", report)?;
                let (Some(node), Some(freedom)) = (node, freedom) else { return Ok(None) };
                let dof = Dof { node, freedom };
                let row = target.numbering.and_then(|rows| rows.get(dof));
                if row.is_none() && !target.hidden {
                    report.line(table.line(), "node and direction must be among the free rows", dof)?;
                }
                row
            }
        };
        Ok(row.zip(weight))
    }
}

/// Supports: columns x, row or node and direction, weight; ordered by x.
pub(crate) fn supports(input: &Input, target: &Target<'_>, report: &mut Report) -> Result<Vec<(f64, Row)>, Stop> {
    let mut table = Table::open(input, Some(&["x", "row", "node", "direction", "weight"]), report)?;
    let x = table.needs("x", report)?;
    let weights = Weights::new(&table, target, report)?;
    let mut all: Vec<(f64, (u32, f64))> = Vec::new();
    let mut empty = true;
    while table.advance(report)? {
        empty = false;
        let x = table.number(x, report)?;
        if let (Some(x), Some(weight)) = (x, weights.read(&mut table, target, report)?) {
            all.push((x, weight));
        }
    }
    if empty {
        report.whole("there must be at least one support", "no line of data");
    }
    all.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut groups: Vec<&[(f64, (u32, f64))]> = Vec::new();
    let mut from = 0;
    for to in 1..=all.len() {
        // Stations that differ by rounding are one.
        if to == all.len() || all[to].0 - all[from].0 > NEAR {
            groups.push(&all[from..to]);
            from = to;
        }
    }
    Ok(groups.into_iter().map(|group| (group[0].0, sum(group.iter().map(|(_, weight)| *weight).collect()))).collect())
}

/// Points: columns name, row or node and direction, weight; in the order of first lines.
pub(crate) fn points(input: &Input, target: &Target<'_>, report: &mut Report) -> Result<Vec<(String, Row)>, Stop> {
    let mut table = Table::open(input, Some(&["name", "row", "node", "direction", "weight"]), report)?;
    let name = table.needs("name", report)?;
    let weights = Weights::new(&table, target, report)?;
    let mut position = std::collections::HashMap::new();
    let mut all: Vec<(String, Row)> = Vec::new();
    while table.advance(report)? {
        let text = table.text(name).to_owned();
        let named = table.check(Some(text).filter(|text| !text.is_empty()), name, "a name", report)?;
        let weight = weights.read(&mut table, target, report)?;
        let (Some(named), Some(weight)) = (named, weight) else { continue };
        let at = *position.entry(named.clone()).or_insert(all.len());
        if at == all.len() {
            all.push((named, Vec::new()));
        }
        all[at].1.push(weight);
    }
    Ok(all.into_iter().map(|(name, row)| (name, sum(row))).collect())
}

/// Weights by row, those on the same row summed.
fn sum(mut weights: Row) -> Row {
    weights.sort_by_key(|(row, _)| *row);
    weights.chunk_by(|a, b| a.0 == b.0).map(|same| (same[0].0, same.iter().map(|(_, w)| w).sum())).collect()
}
