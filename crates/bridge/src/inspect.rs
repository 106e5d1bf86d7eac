//! What engineers check first of a bridge: size, mass, equilibrium, what is loose, lowest natural frequencies.

use std::fmt;

use ttb_contract::ModelError;
use ttb_import::Inspection;
use ttb_scenario::spec::{BridgeSpec, StructureSpec};
use ttb_scenario::types::Model;
use ttb_sparse::Condition;
use ttb_sparse::Pencil;
use ttb_sparse::modes::lowest;
use ttb_sparse::{Factor, FactorError, Layout};

use crate::assembled::{Assembled, Names};
use crate::rounding::Digits;
use crate::space::{self, SelfCheck, Statics};
use crate::{imported, plane, rounding};

/// Natural frequencies that are sought.
const FREQUENCIES: usize = 8;

/// What was found.
pub struct Report {
    /// Degrees of freedom.
    pub ndof: usize,
    /// Entries of K and M, lower triangle.
    pub entries: usize,
    /// A finite-element model's account of itself.
    pub model: Option<SelfCheck>,
    /// What imported files hold.
    pub files: Option<Inspection>,
    /// Total mass, kg; none where imported matrices do not say which rows are translations.
    pub mass: Option<f64>,
    /// What the digits of a file leave of K.
    pub digits: Option<Digits>,
    /// What rounding leaves of static displacements.
    pub condition: Option<Condition>,
    /// Lowest natural frequencies, Hz; or why there are none.
    pub frequencies: Result<Vec<f64>, String>,
}

impl Report {
    /// Nothing is loose, forces balance, K is positive definite, rounding spoils nothing.
    #[must_use]
    pub fn is_sound(&self) -> bool {
        let accurate = self.condition.as_ref().is_none_or(rounding::is_tolerable);
        accurate && self.frequencies.is_ok() && self.model.as_ref().is_none_or(SelfCheck::is_sound)
    }
}

/// Looks at the bridge of a scenario.
///
/// # Errors
/// It cannot be assembled at all.
pub fn inspect(spec: &BridgeSpec) -> Result<Report, ModelError> {
    match &spec.structure {
        StructureSpec::FiniteElements(model) => of_model(model, &spec.supports),
        StructureSpec::Matrices { files, folder, .. } => {
            let imported = files.read(folder).map_err(|problems| ModelError(problems.to_string()))?;
            let (inspection, known) = (imported.inspect(), imported.dofs.is_some());
            let mut report = Equations::new(imported::from(imported, &spec.supports)?)?.report(None, Some(inspection));
            report.mass = report.mass.filter(|_| known);
            Ok(report)
        }
        StructureSpec::Beams { .. } | StructureSpec::Frame(_) => {
            Ok(Equations::new(plane::assemble(spec)?)?.report(None, None))
        }
        StructureSpec::Stored => Err(ModelError("bridge: a stored bridge was looked at when it was made".into())),
    }
}

/// Degrees of freedom up to which a check factorises a bridge; more take as long as the beginning of a run.
const CHECKED: usize = 300_000;

/// What the user of a scenario's bridge should know before it runs, a sentence each. A very large bridge is assembled only.
///
/// # Errors
/// It cannot be assembled or factorised, or rounding spoils its results.
pub fn remarks(spec: &BridgeSpec) -> Result<Vec<String>, ModelError> {
    let Some(assembled) = assembled(spec)? else { return Ok(Vec::new()) };
    let ndof = assembled.equations.ndof();
    if ndof > CHECKED {
        return Ok(vec![format!(
            "bridge: of {ndof} degrees of freedom, it is not factorised for a check: whether it is a mechanism, and whether \
             rounding shows, is found when it is built or inspected"
        )]);
    }
    let Equations { factor, names, condition, digits, .. } = Equations::new(assembled)?;
    factor.map_err(|error| ModelError(format!("bridge: {}", loose(error, &names))))?;
    let rounded = condition.map(|condition| rounding::remark(&condition)).transpose()?.flatten();
    Ok(rounded.into_iter().chain(digits.as_ref().and_then(Digits::remark)).collect())
}

/// The assembled bridge; none where a stored one stands for it.
fn assembled(spec: &BridgeSpec) -> Result<Option<Assembled>, ModelError> {
    Ok(Some(match &spec.structure {
        StructureSpec::FiniteElements(model) => space::assemble(model, &spec.supports, &[])?,
        StructureSpec::Matrices { files, folder, .. } => imported::assemble(files, folder, &spec.supports)?,
        StructureSpec::Beams { .. } | StructureSpec::Frame(_) => plane::assemble(spec)?,
        StructureSpec::Stored => return Ok(None),
    }))
}

/// Looks at a finite-element model; `supports` (m from its begin) may be empty.
///
/// # Errors
/// It cannot be assembled at all.
pub fn of_model(model: &Model, supports: &[f64]) -> Result<Report, ModelError> {
    let assembled = match space::assemble(model, supports, &[]) {
        Ok(assembled) => assembled,
        // What the model says of itself tells more than the first obstacle.
        Err(error) => {
            let check = space::self_check(model, Statics::Unknown)?;
            let (ndof, mass) = (check.freedoms, check.mass);
            return Ok(Report {
                ndof,
                entries: 0,
                model: Some(check),
                files: None,
                mass: Some(mass),
                digits: None,
                condition: None,
                frequencies: Err(error.0),
            });
        }
    };
    let equations = Equations::new(assembled)?;
    let check = match &equations.factor {
        Ok(factor) => {
            let mut scratch = vec![0.0; equations.pencil.ndof()];
            space::self_check(model, Statics::Solved(&mut |x| factor.solve_in_place(x, &mut scratch)))?
        }
        Err(FactorError::NotPositive { dof }) => space::self_check(model, Statics::Mechanism(*dof))?,
        Err(_) => space::self_check(model, Statics::Unknown)?,
    };
    Ok(equations.report(Some(check), None))
}

/// An assembled bridge and the factor of its K, if there is one.
struct Equations {
    pencil: Pencil,
    factor: Result<Factor, FactorError>,
    names: Names,
    mass: f64,
    digits: Option<Digits>,
    condition: Option<Condition>,
}

impl Equations {
    fn new(assembled: Assembled) -> Result<Self, ModelError> {
        let Assembled { equations, nodes, node_of, names, supports, mass, digits, .. } = assembled;
        let layout = Layout { node_of, place: nodes, ..Layout::default() };
        let pencil = equations.finish_with(&layout).map_err(|e| ModelError(format!("bridge: {e}")))?;
        let factor = pencil.factor(1.0, 0.0, 0.0);
        let condition = factor.as_ref().ok().and_then(|factor| rounding::condition(&pencil, factor, &supports));
        let digits = factor.as_ref().ok().and_then(|factor| rounding::of_digits(&pencil, factor, &supports, digits));
        Ok(Self { pencil, factor, names, mass, digits, condition })
    }

    fn report(self, model: Option<SelfCheck>, files: Option<Inspection>) -> Report {
        let Self { pencil, factor, names, mass, digits, condition } = self;
        let (ndof, entries) = (pencil.ndof(), pencil.entries());
        let (mass, frequencies) = (Some(mass), frequencies(&pencil, factor, &names));
        Report { ndof, entries, model, files, mass, digits, condition, frequencies }
    }
}

fn frequencies(pencil: &Pencil, factor: Result<Factor, FactorError>, names: &Names) -> Result<Vec<f64>, String> {
    let factor = factor.map_err(|error| loose(error, names))?;
    let found = lowest(pencil, &factor, FREQUENCIES.min(pencil.ndof()));
    found.map(|modes| modes.frequencies().collect()).map_err(|error| error.to_string())
}

fn loose(error: FactorError, names: &Names) -> String {
    match error {
        FactorError::NotPositive { dof } => format!("K is not positive definite: nothing holds the {}", names(dof)),
        other => other.to_string(),
    }
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "degrees of freedom   {}", self.ndof)?;
        writeln!(f, "entries, lower half  {}", self.entries)?;
        match self.mass {
            Some(mass) => writeln!(f, "mass                 {:.3} t", mass * 1e-3)?,
            None => writeln!(f, "mass                 unknown: no file `dofs` says which rows are translations")?,
        }
        if let Some(check) = &self.model {
            writeln!(f, "{check}")?;
        }
        if let Some(files) = &self.files {
            facts(files, f)?;
        }
        if let Some(condition) = &self.condition {
            let (number, error) = (condition.number, condition.error());
            writeln!(
                f,
                "condition of K       {number:.1e}: rounding moves displacements by about {error:.0e} of themselves"
            )?;
        }
        if let Some(remark) = self.digits.as_ref().and_then(Digits::remark) {
            writeln!(f, "digits of K          {remark}")?;
        }
        match &self.frequencies {
            Ok(hertz) => {
                let text: Vec<String> = hertz.iter().map(|hz| format!("{hz:.4}")).collect();
                write!(f, "lowest frequencies   {} Hz", text.join(", "))
            }
            Err(why) => write!(f, "lowest frequencies   none: {why}"),
        }
    }
}

fn facts(files: &Inspection, f: &mut fmt::Formatter<'_>) -> fmt::Result {
    writeln!(f, "diagonal of K        {:.3e} … {:.3e}", files.stiffness.1, files.stiffness.0)?;
    writeln!(f, "diagonal of M        {:.3e} … {:.3e}", files.masses.1, files.masses.0)?;
    writeln!(f, "rows without mass    {}", files.massless.len())?;
    for motion in &files.motions {
        let (name, unit) = match motion.direction {
            direction @ 0..3 => (["along x", "along y", "along z"][direction], "kg"),
            direction => (["about x", "about y", "about z"][(direction - 3).min(2)], "kg m²"),
        };
        writeln!(f, "mass {name}         {:.6e} {unit}, held in {} rows", motion.inertia, motion.held)?;
    }
    if !files.held.is_empty() {
        let (count, first) = (files.held.len(), files.held[0] + 1);
        writeln!(f, "rows that are held   {count}, without any entry, the first of them {first}")?;
    }
    if let [first, ..] = files.lone[..] {
        let count = files.lone.len();
        writeln!(
            f,
            "rows for themselves  {count}, with a diagonal only, the first of them {}: springs to the ground?",
            first + 1
        )?;
    }
    Ok(())
}
