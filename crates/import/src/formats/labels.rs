//! Lines of node, freedom, node, freedom, value, as Abaqus' *MATRIX INPUT reads them. Negative nodes are internal ones of
//! elements.

use super::{Heading, Known, triplets};
use crate::collect::Symmetry;
use crate::dof::{Dof, INTERNAL};
use crate::input::Input;
use crate::lines::{Line, Lines};
use crate::number::Fields;
use crate::numbering::Numbering;
use crate::problem::{Report, Stop, excerpt};

const RULE: &str = "a line must hold node, freedom, node, freedom and value";

/// Both labels of a line, and the fields behind them.
fn labels<'a>(line: &Line<'a>, report: &mut Report) -> Result<Option<([Dof; 2], Fields<'a>)>, Stop> {
    let mut fields = Fields::new(line.text);
    let mut label = || Some((fields.minus(), fields.whole()?, fields.whole()?));
    let (Some(row), Some(column)) = (label(), label()) else {
        return report.line(line.number, RULE, excerpt(line.text)).map(|()| None);
    };
    let known = |(internal, node, freedom): (bool, u64, u64)| {
        let most = if internal { u32::MAX - INTERNAL } else { INTERNAL };
        let node = u32::try_from(node).ok().filter(|node| (1..=most).contains(node))?;
        let node = if internal { INTERNAL + node } else { node };
        (1..=6).contains(&freedom).then(|| Dof { node, freedom: freedom as u8 - 1 })
    };
    match (known(row), known(column)) {
        (Some(row), Some(column)) => Ok(Some(([row, column], fields))),
        _ => {
            let rule = "nodes must be numbered from 1 (internal ones from -1) to 2147483648, freedoms from 1 to 6";
            report.line(line.number, rule, excerpt(line.text)).map(|()| None)
        }
    }
}

/// All labels of a file, sorted by node and freedom.
pub(super) fn collect(input: &Input, report: &mut Report) -> Result<Vec<Dof>, Stop> {
    let mut lines = Lines::open(input, report)?;
    let mut all = Numbering::default();
    while let Some(line) = lines.next(report)? {
        if triplets::is_comment(line.text) {
            triplets::remark(&line, report)?;
            continue;
        }
        let Some(([row, column], _)) = labels(&line, report)? else { continue };
        all.set(row, 0);
        all.set(column, 0);
    }
    Ok(all.sorted())
}

pub(super) fn scan<const VALUES: bool>(
    input: &Input,
    known: Known<'_>,
    report: &mut Report,
    mut hand_on: impl FnMut(u32, u32, f64),
) -> Result<Heading, Stop> {
    let Some(numbering) = known.numbering else {
        return Err(report.fatal(None, "a file of labels needs rows by label", "none are known"));
    };
    let mut lines = Lines::open(input, report)?;
    while let Some(line) = lines.next(report)? {
        if triplets::is_comment(line.text) {
            continue;
        }
        let Some((label, fields)) = labels(&line, report)? else { continue };
        let [Some(i), Some(j)] = label.map(|dof| numbering.get(dof)) else {
            let found = format!("{} or {}", label[0], label[1]);
            report.line(line.number, "node and freedom must be among the rows of the stiffness matrix", found)?;
            continue;
        };
        if let Some(value) = triplets::value::<VALUES>(fields, &line, RULE, report)? {
            hand_on(i, j, value);
        }
    }
    Ok(Heading { rows: Some(numbering.len()), symmetry: Symmetry::Either })
}
