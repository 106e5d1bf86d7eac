//! A row of the table: its method and its step.

use ttb_scenario::Checked;

use crate::cli::{Budget, Compared};

/// Sub-steps of train and track in a multi-time-step row, where the scenario has none.
const SUB_STEPS: usize = 10;

/// How a row is computed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Method {
    /// Strongly coupled, refactorised every step.
    Scm,
    /// Strongly coupled, constant matrices.
    Schur,
    /// Loosely coupled.
    Lcm,
    /// Loosely coupled, best relaxation.
    Relaxed,
    /// The product.
    Hybrid,
    /// The product with sub-steps of train and track.
    Multi,
}

/// A row to be computed.
#[derive(Clone, Debug)]
pub struct Planned {
    /// The method.
    pub method: Method,
    /// Step, s.
    pub step: f64,
    /// Its name.
    pub name: String,
}

impl Planned {
    /// Named after its method.
    pub fn new(method: Method, step: f64) -> Self {
        let name = match method {
            Method::Scm => "SCM, as in the paper",
            Method::Schur => "SCM, constant matrices",
            Method::Lcm => "LCM",
            Method::Relaxed => "LCM, relaxed",
            Method::Hybrid => "HSA",
            Method::Multi => "HSA, multi-time-step",
        };
        Self { method, step, name: name.into() }
    }

    /// CPU time its steps may take, s: its method's, or that of all.
    pub fn budget(&self, budgets: &[Budget]) -> f64 {
        let own = |b: &&Budget| b.method.is_some_and(|method| Method::from(method) == self.method);
        let found = budgets.iter().find(own).or_else(|| budgets.iter().find(|b| b.method.is_none()));
        found.map_or(f64::INFINITY, |b| b.seconds)
    }

    /// The run that the others are measured with.
    pub fn reference(step: f64) -> Self {
        Self { name: "reference (HSA)".into(), ..Self::new(Method::Hybrid, step) }
    }
}

impl From<Compared> for Method {
    fn from(asked: Compared) -> Self {
        match asked {
            Compared::Scm => Self::Scm,
            Compared::Schur => Self::Schur,
            Compared::Lcm => Self::Lcm,
            Compared::LcmRelaxed => Self::Relaxed,
            Compared::Hsa => Self::Hybrid,
            Compared::Multi => Self::Multi,
        }
    }
}

/// Sub-steps of a multi-time-step row.
pub fn sub_steps(checked: &Checked) -> usize {
    let own = checked.steps().substeps;
    if own > 1 { own } else { SUB_STEPS }
}
