//! The strongly coupled method as the paper has it: cars, track and bridge in one system whose matrix follows the wheels,
//! refactorised every step.
//!
//! ```text
//! (K̂ + Σ T_j v_j v_jᵀ) u = p − Σ v_j (F_j − T_j (s_j + r_j)),   s_j = v_jᵀ u − r_j,   v_j = e(z_w) − N(x_j)
//! ```
//!
//! T is the contacts' stiffness where the step begins: one factor a step serves all iterations on the forces (modified
//! Newton's method), unless a wheel leaves or meets the rail. To be fair to it: K̂ is assembled once, the order of
//! elimination found once (cars last, before them the rail, so that contacts fill nothing in), the factor's pattern
//! analysed once for each stretch of the passage with room for all entries met there, the factor's memory reused, and the
//! iterations sweep only over the part of the factor that rail and cars reach.

use faer::sparse::{SparseColMatRef, SymbolicSparseColMat};
use ttb_contract::finite::larger;
use ttb_sparse::{Factor, Layout, Symbolic};

use crate::constant;
use crate::sweeps::Sweeps;
use crate::wheels::Wheels;
use crate::whole::Whole;
use ttb_dynamics::newmark::Newmark;
use ttb_train_track::car::wheel;

/// The factor's pattern has room for so many metres of the passage.
const STRETCH: f64 = 10.0;
/// Iterations with one factor, and factors of a step.
const ITERATIONS: usize = 12;
const FACTORS: usize = 6;

/// A lower triangle by columns.
struct Columns {
    starts: Vec<u32>,
    rows: Vec<u32>,
    values: Vec<f64>,
}

/// The system of one step size.
pub struct Scm {
    tolerance: f64,
    /// K̂ of all without contacts.
    constant: Columns,
    order: Vec<u32>,
    /// Track and bridge; the cars follow.
    first_car: usize,
    stretch: Option<Stretch>,
    tangents: Vec<f64>,
    load: Vec<(u32, f64)>,
}

/// Pattern and factor for a stretch of the passage.
struct Stretch {
    /// Abscissae of the leading axle between which it serves.
    between: [f64; 2],
    pattern: SymbolicSparseColMat<u32>,
    /// K̂ on this pattern, and with the contacts of the step.
    constant: Vec<f64>,
    values: Vec<f64>,
    symbolic: Symbolic,
    sweeps: Option<Sweeps>,
}

/// What a step took.
#[derive(Clone, Copy, Debug, Default)]
pub struct Work {
    /// Solutions.
    pub iterations: usize,
    /// Factors.
    pub factors: usize,
}

impl Scm {
    /// Assembles for one step size; `tolerance` is on the forces, relative to an axle load.
    ///
    /// # Errors
    /// The pattern cannot be analysed.
    pub fn new(whole: &Whole, newmark: &Newmark, tolerance: f64) -> Result<Self, String> {
        let pencil = constant::equations(whole, newmark.a[0], newmark.a[1]).finish_with(&whole.layout);
        let raw = pencil.map_err(|e| e.to_string())?.raw();
        let (mut starts, mut rows, mut values) = (raw.starts, raw.rows, raw.k);
        let first_car = whole.order();
        for (c, car) in whole.cars.iter().enumerate() {
            let [a0, a1, ..] = newmark.a;
            for j in 0..10 {
                for i in j..10 {
                    let mass = if i == j { a0 * car.mass[i] } else { 0.0 };
                    rows.push((first_car + 10 * c + i) as u32);
                    values.push(car.stiffness[(i, j)] + a1 * car.damping[(i, j)] + mass);
                }
                starts.push(rows.len() as u32);
            }
        }
        let mut order = raw.order;
        if !order.is_empty() {
            order.extend(first_car as u32..starts.len() as u32 - 1);
        }
        let constant = Columns { starts, rows, values };
        Ok(Self {
            tolerance: tolerance * whole.axle_load,
            constant,
            order,
            first_car,
            stretch: None,
            tangents: vec![0.0; whole.wheels.len()],
            load: Vec::new(),
        })
    }

    /// Pattern with room for the contacts from the present places to [`STRETCH`] further on.
    fn analyse(&mut self, whole: &Whole, wheels: &Wheels) -> Result<(), String> {
        let n = self.constant.starts.len() - 1;
        let mut extra: Vec<Vec<u32>> = vec![Vec::new(); n];
        let (_, end) = whole.track.extent();
        for (axle, point) in wheels.points.iter().enumerate() {
            let reached = whole.track.locate((wheels.abscissa(axle) + STRETCH).min(end));
            let last = reached.map_or(point.element, |p| p.element);
            for element in point.element..=last {
                for dof in whole.track.element_dofs(element) {
                    extra[dof].push((self.first_car + wheel(axle)) as u32);
                }
            }
        }
        let Columns { starts, rows, values } = &self.constant;
        let (mut to_starts, mut to_rows, mut to_values) = (vec![0], Vec::new(), Vec::new());
        for (column, extra) in extra.iter_mut().enumerate() {
            let own = starts[column] as usize..starts[column + 1] as usize;
            to_rows.extend_from_slice(&rows[own.clone()]);
            to_values.extend_from_slice(&values[own]);
            // The cars come after all rows of track and bridge.
            extra.sort_unstable();
            extra.dedup();
            to_rows.extend_from_slice(extra);
            to_values.resize(to_rows.len(), 0.0);
            to_starts.push(to_rows.len() as u32);
        }
        let pattern = SymbolicSparseColMat::new_checked(n, n, to_starts, None, to_rows);
        let layout = Layout { order: self.order.clone(), ..Layout::default() };
        let symbolic = Symbolic::new(pattern.as_ref(), &layout).map_err(|e| e.to_string())?;
        let along = wheels.abscissa(0);
        let between = [along, along + STRETCH];
        self.stretch =
            Some(Stretch { between, pattern, values: to_values.clone(), constant: to_values, symbolic, sweeps: None });
        Ok(())
    }

    /// The forces at the end of a step and its displacements [track | bridge | cars] (the bridge's without g), from the load
    /// p of all and the approaches at its begin.
    ///
    /// # Errors
    /// The iteration does not converge, a matrix is not positive definite.
    pub fn solve(
        &mut self,
        whole: &Whole,
        wheels: &Wheels,
        load: &[f64],
        approach: &mut [f64],
        forces: &mut [f64],
        u: &mut [f64],
    ) -> Result<Work, String> {
        let along = wheels.abscissa(0);
        if self.stretch.as_ref().is_none_or(|s| along < s.between[0] || along > s.between[1]) {
            self.analyse(whole, wheels)?;
        }
        let mut work = Work::default();
        for round in 0..FACTORS {
            for (axle, tangent) in self.tangents.iter_mut().enumerate() {
                let found = wheels.force(axle, approach[axle]);
                // A wheel in the air may come down within the step: half the static stiffness is safe from above.
                let law = &wheels.laws[axle];
                let least = if round == 0 { 0.5 * law.force(law.static_approach()).1 } else { 0.0 };
                let least = least / (1.0 + wheels.points[axle].local_compliance * least);
                (forces[axle], *tangent) = (found.0, found.1.max(least));
            }
            let Some(stretch) = self.stretch.as_mut() else { return Err("no pattern".into()) };
            stretch.factorise(whole, wheels, self.first_car, &self.tangents)?;
            work.factors += 1;
            let Some(sweeps) = stretch.sweeps.as_mut() else { return Err("no factor".into()) };
            sweeps.begin(load);
            for _ in 0..ITERATIONS {
                work.iterations += 1;
                self.load.clear();
                for axle in 0..forces.len() {
                    let t = self.tangents[axle];
                    let pull = t * (approach[axle] + wheels.roughness[axle]) - forces[axle];
                    self.load.push(((self.first_car + wheel(axle)) as u32, pull));
                    let dofs = whole.track.element_dofs(wheels.points[axle].element);
                    let rail = dofs.iter().zip(wheels.points[axle].row);
                    self.load.extend(rail.map(|(dof, n)| (*dof as u32, -n * pull)));
                }
                sweeps.look(&self.load);
                let mut missing = 0.0_f64;
                for axle in 0..forces.len() {
                    let dofs = whole.track.element_dofs(wheels.points[axle].element);
                    let rail: f64 = dofs.iter().zip(wheels.points[axle].row).map(|(dof, n)| n * sweeps.at(*dof)).sum();
                    let s = sweeps.at(self.first_car + wheel(axle)) - rail - wheels.roughness[axle];
                    let linear = forces[axle] + self.tangents[axle] * (s - approach[axle]);
                    (approach[axle], forces[axle]) = (s, wheels.force(axle, s).0);
                    let off = (forces[axle] - linear).abs();
                    missing = larger(missing, off);
                }
                if missing <= self.tolerance {
                    sweeps.finish(&self.load, u);
                    return Ok(work);
                }
                if !missing.is_finite() {
                    return Err("the contacts' iteration meets a number that is not finite".into());
                }
            }
        }
        Err(format!("the contacts did not converge with {FACTORS} factors"))
    }
}

impl Stretch {
    /// Factorises K̂ + Σ T v vᵀ.
    fn factorise(&mut self, whole: &Whole, wheels: &Wheels, first_car: usize, tangents: &[f64]) -> Result<(), String> {
        let Self { pattern, constant, values, symbolic, sweeps, .. } = self;
        values.copy_from_slice(constant);
        let (starts, rows) = (pattern.col_ptr(), pattern.row_idx());
        let mut complete = true;
        let mut add = |i: usize, j: usize, value: f64| {
            let column = starts[j] as usize..starts[j + 1] as usize;
            match rows[column.clone()].binary_search(&(i as u32)) {
                Ok(at) => values[column.start + at] += value,
                Err(_) => complete = false,
            }
        };
        for (axle, t) in tangents.iter().enumerate() {
            let point = &wheels.points[axle];
            let (dofs, car) = (whole.track.element_dofs(point.element), first_car + wheel(axle));
            add(car, car, *t);
            for (p, a) in dofs.iter().zip(point.row) {
                add(car, *p, -t * a);
                dofs.iter().zip(point.row).filter(|(q, _)| *q <= p).for_each(|(q, b)| add(*p, *q, t * a * b));
            }
        }
        if !complete {
            return Err("a contact is off the pattern".into());
        }
        let a = SparseColMatRef::new(pattern.as_ref(), &values[..]);
        let not_positive = |e: ttb_sparse::FactorError| e.to_string();
        match sweeps {
            Some(sweeps) => sweeps.factor_mut().again(a).map_err(not_positive)?,
            None => {
                let factor = Factor::positive(symbolic, a).map_err(not_positive)?;
                let cars = first_car as u32..pattern.ncols() as u32;
                *sweeps = Some(Sweeps::new(factor, whole.rail().chain(cars)));
            }
        }
        Ok(())
    }
}
