//! DMIG in wide fields, as Nastran punches it (`EXTSEOUT(STIFFNESS,MASS,DMIGPCH)`; MSC Nastran, Quick Reference Guide,
//! bulk data entry DMIG).
//!
//! ```text
//! DMIG    NAME           0    form  type   …        form 6: symmetric, one triangle; 1: square; type 1, 2: real
//! DMIG*   NAME                 G_j           C_j    a column: grid point and component
//! *                            G_i           C_i value
//! ```
//!
//! A component has one digit; the value may touch it. A file may hold several matrices; which is wanted, the input says by
//! the first letter of its name. Other entries are passed over.

use super::Heading;
use crate::collect::Symmetry;
use crate::dof::{Dof, INTERNAL};
use crate::input::Input;
use crate::lines::{Line, Lines};
use crate::number::{Fields, real, whole};
use crate::numbering::Numbering;
use crate::problem::{Report, Stop, excerpt};

/// Is this line a part of a DMIG entry?
pub(super) fn is_entry(text: &[u8]) -> bool {
    let head = text.get(..5).unwrap_or_default();
    head.eq_ignore_ascii_case(b"DMIG ") || head.eq_ignore_ascii_case(b"DMIG*") || head.eq_ignore_ascii_case(b"DMIG,")
}

/// Grid point and component at a line's beginning, and what follows: value or nothing.
fn label(text: &[u8]) -> Option<(Dof, &[u8])> {
    let mut fields = Fields::new(text);
    let node = u32::try_from(fields.whole()?).ok().filter(|node| (1..INTERNAL).contains(node))?;
    let (component, rest) = fields.remainder().split_first()?;
    let freedom = component.checked_sub(b'1').filter(|freedom| *freedom < 6)?;
    Some((Dof { node, freedom }, rest.trim_ascii()))
}

/// Passes over the wanted matrix of the file and hands on every entry: row, column, line, value.
fn pass(
    input: &Input,
    report: &mut Report,
    mut hand_on: impl FnMut(Dof, Dof, &[u8], &Line<'_>, &mut Report) -> Result<(), Stop>,
) -> Result<Symmetry, Stop> {
    let mut lines = Lines::open(input, report)?;
    let (mut symmetry, mut others) = (None::<(String, Symmetry)>, Vec::new());
    let mut column = None;
    while let Some(line) = lines.next(report)? {
        let text = line.text;
        if is_entry(text) {
            column = None;
            let wide = text[4] == b'*';
            let mut fields = Fields::new(text.get(5..).unwrap_or_default());
            let name = String::from_utf8_lossy(fields.next()).to_ascii_uppercase();
            let rest = fields.remainder();
            if !wide && Fields::new(rest).whole() == Some(0) {
                if input.wants().is_some_and(|letter| !name.starts_with(letter)) || symmetry.is_some() {
                    others.push(name);
                } else {
                    symmetry = Some((name, form(rest, &line, report)?));
                }
            } else if symmetry.as_ref().is_some_and(|(wanted, _)| *wanted == name) {
                if !wide {
                    let rule = "entries of DMIG must have wide fields (DMIG*): narrow ones hold too few digits";
                    return Err(report.fatal(Some(line.number), rule, excerpt(text)));
                }
                match label(rest) {
                    Some((dof, [])) => column = Some(dof),
                    _ => report.line(line.number, "DMIG* must name grid point and component 1 to 6", excerpt(text))?,
                }
            }
        } else if let ([b'*', rest @ ..], Some(column)) = (text, column) {
            match label(rest) {
                Some((row, value)) => hand_on(row, column, value, &line, report)?,
                None => {
                    let rule = "a line of DMIG* must hold grid point, component 1 to 6 and value";
                    report.line(line.number, rule, excerpt(text))?;
                }
            }
        } else if !matches!(text.trim_ascii().first(), None | Some(b'$')) {
            column = None;
        }
    }
    match symmetry {
        Some((_, symmetry)) => Ok(symmetry),
        None => {
            let wants = input.wants().map_or_else(String::new, |letter| format!(" whose name begins with {letter}"));
            let found = if others.is_empty() { "none".into() } else { others.join(", ") };
            Err(report.fatal(None, format!("the file must hold a DMIG matrix{wants}"), found))
        }
    }
}

/// Form and type of the matrix in its header.
fn form(rest: &[u8], line: &Line<'_>, report: &mut Report) -> Result<Symmetry, Stop> {
    let mut fields = Fields::new(rest);
    let numbers: [Option<u64>; 3] = std::array::from_fn(|_| whole(fields.next()));
    match numbers {
        [_, Some(6), Some(1 | 2)] => Ok(Symmetry::Triangle),
        [_, Some(1), Some(1 | 2)] => Ok(Symmetry::Full),
        _ => {
            let rule = "a DMIG matrix must be symmetric or square (form 6 or 1) and real (type 1 or 2)";
            Err(report.fatal(Some(line.number), rule, excerpt(line.text)))
        }
    }
}

/// All labels of the wanted matrix, sorted by node and freedom.
pub(super) fn collect(input: &Input, report: &mut Report) -> Result<Vec<Dof>, Stop> {
    let mut all = Numbering::default();
    pass(input, report, |row, column, _, _, _| {
        all.set(row, 0);
        all.set(column, 0);
        Ok(())
    })?;
    Ok(all.sorted())
}

pub(super) fn scan<const VALUES: bool>(
    input: &Input,
    numbering: Option<&Numbering>,
    report: &mut Report,
    mut entry: impl FnMut(u32, u32, f64),
) -> Result<Heading, Stop> {
    let Some(numbering) = numbering else {
        return Err(report.fatal(None, "a file of labels needs rows by label", "none are known"));
    };
    let symmetry = pass(input, report, |row, column, text, line, report| {
        let (Some(i), Some(j)) = (numbering.get(row), numbering.get(column)) else {
            let rule = "node and freedom must be among the rows of the stiffness matrix";
            return report.line(line.number, rule, format!("{row} or {column}"));
        };
        if !VALUES {
            entry(i, j, 0.0);
        } else if let Some(value) = real(text) {
            report.written(text);
            entry(i, j, value);
        } else {
            report.line(line.number, "values must be finite numbers", excerpt(text))?;
        }
        Ok(())
    })?;
    Ok(Heading { rows: Some(numbering.len()), symmetry })
}
