//! A model as a set of files.

use std::path::Path;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::dofs::{self, Dofs};
use crate::formats::Format;
use crate::input::Input;
use crate::matrix::SymmetricMatrix;
use crate::problem::{Problem, Problems, Report, Stop};
use crate::read::{Facts, Matrix, read_matrix};
use crate::rows::{Row, Target, points, supports};
use crate::weights::weights;

/// Matrices from another program and what belongs to them. Paths are relative to the file that names them.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub struct Files {
    /// File of K over the free degrees of freedom, N/m, N, N m.
    pub stiffness: String,
    /// File of M, kg, kg m, kg m².
    pub mass: String,
    /// File of C, N s/m, N s, N m s.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub damping: Option<String>,
    /// Format of the matrices; absent: told from each file's beginning.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub format: Option<Format>,
    /// Node and direction of every row: CSV with columns row (from 1), node, direction (x, y, z, rx, ry, rz) and maybe
    /// x, y, z (coordinates, m); or CalculiX' .dof or ANSYS' .mapping.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub dofs: Option<String>,
    /// Coordinates of nodes where `dofs` has none: CSV with columns node, x, y, z (m).
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub nodes: Option<String>,
    /// Where the track's supports rest: CSV with columns x (m from the bridge's begin), row or node and direction,
    /// weight (default 1). Lines of the same x add up; the sum is the displacement downwards.
    pub supports: String,
    /// Monitored points: CSV with columns name, row or node and direction, weight (default 1). Lines of the same name
    /// add up.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub points: Option<String>,
}

/// A file that was read.
#[derive(Clone, Debug, PartialEq)]
pub struct FileFacts {
    /// Name of the file, as given.
    pub file: String,
    /// How it was read.
    pub facts: Facts,
}

/// Matrices and tables of a model.
#[derive(Clone, Debug)]
pub struct Imported {
    /// Stiffness matrix K.
    pub k: SymmetricMatrix,
    /// Mass matrix M.
    pub m: SymmetricMatrix,
    /// Damping matrix C, if a file holds one.
    pub c: Option<SymmetricMatrix>,
    /// Node and direction of every row, if known.
    pub dofs: Option<Dofs>,
    /// Supports: x in m from the bridge's begin, rising, and their weights.
    pub supports: Vec<(f64, Row)>,
    /// Monitored points: name and weights.
    pub points: Vec<(String, Row)>,
    /// How K, M and C were read.
    pub files: Vec<FileFacts>,
    /// Rows without any entry in K, M and C, from 0: motions that are held. K has a diagonal there nevertheless, so that
    /// it is regular, and no support or point moves with them.
    pub held: Vec<u32>,
}

impl Files {
    /// All files that are named.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        let optional = [&self.damping, &self.dofs, &self.nodes, &self.points].into_iter().flatten();
        [&self.stiffness, &self.mass, &self.supports].into_iter().chain(optional).map(String::as_str)
    }

    /// Reads everything; paths are relative to `folder`.
    ///
    /// # Errors
    /// All problems of all files, up to a limit for each.
    pub fn read(&self, folder: &Path) -> Result<Imported, Problems> {
        self.read_from(|name| Input::path(&folder.join(name)))
    }

    /// As [`Files::read`], from wherever `open` finds the files.
    ///
    /// # Errors
    /// All problems of all files, up to a limit for each.
    pub fn read_from(&self, open: impl Fn(&str) -> Input) -> Result<Imported, Problems> {
        let mut problems = Vec::new();
        let nodes = self.nodes.as_deref().and_then(|name| part(&open(name), &mut problems, dofs::nodes));
        let dofs = self.dofs.as_deref().and_then(|name| {
            part(&open(name), &mut problems, |input, report| dofs::read(input, nodes.as_ref(), report))
        });
        let labels = dofs.as_ref().map(|dofs| dofs.dofs.as_slice());
        let mut matrix = |name: &str, letter, size, labels: Option<&[_]>| {
            read_matrix(&open(name).of(letter), self.format, size, labels)
                .map_err(|Problems(p)| problems.extend(p))
                .ok()
        };
        let mut k = matrix(&self.stiffness, 'K', None, labels);
        let own_labels = k.as_ref().and_then(|k| k.labels.clone());
        let labels = labels.or(own_labels.as_deref());
        let size = k.as_ref().map(|k| k.matrix.n as u32);
        let m = matrix(&self.mass, 'M', size, labels);
        let c = self.damping.as_deref().map(|name| matrix(name, 'B', size, labels));

        let dofs = dofs.or_else(|| own_labels.map(|labels| Dofs::new(labels, nodes.as_ref())));
        let held = hold(k.as_mut(), [m.as_ref(), c.iter().flatten().next()]);
        self.agree(k.as_ref(), m.as_ref(), dofs.as_ref(), &open, &mut problems);

        let numbering = dofs.as_ref().map(Dofs::numbering);
        // What is missing for another file's sake is told of that file alone.
        let hidden = numbering.is_none() && (self.dofs.is_some() || k.is_none());
        let target = Target { n: size.map(|n| n as usize), numbering: numbering.as_ref(), hidden };
        let supports = part(&open(&self.supports), &mut problems, |i, r| {
            let found = supports(i, &target, r)?;
            weights(&found, dofs.as_ref(), r);
            Ok(found)
        });
        let points = match self.points.as_deref() {
            Some(name) => part(&open(name), &mut problems, |i, r| points(i, &target, r)),
            None => Some(Vec::new()),
        };
        let (Some(k), Some(m), Some(supports), Some(points), true) = (k, m, supports, points, problems.is_empty())
        else {
            return Err(Problems(problems));
        };
        let c = c.flatten();
        let fact = |name: &str, matrix: &Matrix| FileFacts { file: name.to_owned(), facts: matrix.facts.clone() };
        let mut files = vec![fact(&self.stiffness, &k), fact(&self.mass, &m)];
        files.extend(self.damping.as_deref().zip(c.as_ref()).map(|(name, c)| fact(name, c)));
        let c = c.map(|c| c.matrix);
        let supports = still(supports, &held);
        let points = still(points, &held);
        Ok(Imported { k: k.matrix, m: m.matrix, c, dofs, supports, points, files, held })
    }

    /// What no file can tell alone: sizes that fit, a positive diagonal of K, none negative of M.
    fn agree(
        &self,
        k: Option<&Matrix>,
        m: Option<&Matrix>,
        dofs: Option<&Dofs>,
        open: &impl Fn(&str) -> Input,
        problems: &mut Vec<Problem>,
    ) {
        if let (Some(k), Some(dofs), Some(name)) = (k, dofs, self.dofs.as_deref())
            && k.matrix.n != dofs.dofs.len()
        {
            let mut report = Report::new(open(name).name());
            let found = format!("{} instead of {}", dofs.dofs.len(), k.matrix.n);
            report.whole("there must be as many degrees of freedom as rows of the stiffness matrix", found);
            problems.append(&mut report.problems);
        }
        let mut check = |name: &str, matrix: &SymmetricMatrix, rule: &str, bad: fn(f64) -> bool| {
            let mut report = Report::new(open(name).name());
            let diagonal = matrix.diagonal();
            let found: Vec<usize> = (0..matrix.n).filter(|&i| bad(diagonal[i])).collect();
            for &row in found.iter().take(Self::SHOWN) {
                let label = dofs.and_then(|dofs| dofs.dofs.get(row)).map(|dof| format!(" ({dof})")).unwrap_or_default();
                report.whole(rule, format!("row {}{label}: {:e}", row + 1, diagonal[row]));
            }
            if found.len() > Self::SHOWN {
                report.whole(rule, format!("{} more rows", found.len() - Self::SHOWN));
            }
            problems.append(&mut report.problems);
        };
        if let Some(k) = k {
            check(&self.stiffness, &k.matrix, "the diagonal of the stiffness matrix must be positive", |d| d <= 0.0);
        }
        if let Some(m) = m {
            check(&self.mass, &m.matrix, "the diagonal of the mass matrix must not be negative", |d| d < 0.0);
        }
    }

    /// Bad rows shown one by one.
    const SHOWN: usize = 10;
}

/// Rows that nothing names in any matrix. K gets its largest diagonal there.
fn hold(k: Option<&mut Matrix>, others: [Option<&Matrix>; 2]) -> Vec<u32> {
    let Some(k) = k else { return Vec::new() };
    let mut empty = k.matrix.empty_rows();
    for other in others.into_iter().flatten() {
        let theirs = other.matrix.empty_rows();
        empty.retain(|row| theirs.binary_search(row).is_ok());
    }
    let most = k.matrix.diagonal().into_iter().fold(0.0, f64::max);
    if most > 0.0 && !empty.is_empty() {
        k.matrix.hold(&empty, most);
    }
    empty
}

/// Nothing moves with a row that is held.
fn still<T>(rows: Vec<(T, Row)>, held: &[u32]) -> Vec<(T, Row)> {
    let of = |(row, weight): (u32, f64)| (row, if held.binary_search(&row).is_ok() { 0.0 } else { weight });
    rows.into_iter().map(|(name, row)| (name, row.into_iter().map(of).collect())).collect()
}

/// Reads one file and collects what is wrong with it.
fn part<T>(
    input: &Input,
    problems: &mut Vec<Problem>,
    read: impl FnOnce(&Input, &mut Report) -> Result<T, Stop>,
) -> Option<T> {
    let mut report = Report::new(input.name());
    let done = read(input, &mut report).ok().filter(|_| report.problems.is_empty());
    problems.append(&mut report.problems);
    done
}
