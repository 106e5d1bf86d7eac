//! All rows in memory, column by column.

use std::ops::ControlFlow;

use ttb_coupling::StepInfo;

use crate::column::Column;
use crate::error::RunError;
use crate::observe::{Begin, GO_ON, Moment, Observer};

/// A run's histories. Row 0 is the start.
#[derive(Clone, Debug, Default)]
pub struct Table {
    /// What stands in the columns.
    pub columns: Vec<Column>,
    /// t, s.
    pub time: Vec<f64>,
    /// One history a column.
    pub values: Vec<Vec<f64>>,
    /// How every step went; none for row 0.
    pub steps: Vec<StepInfo>,
}

impl Table {
    /// The history of a column by its name.
    pub fn history(&self, name: &str) -> Option<&[f64]> {
        let at = self.columns.iter().position(|column| column.to_string() == name)?;
        Some(&self.values[at])
    }
}

impl Observer for Table {
    fn start(&mut self, begin: &Begin) -> Result<(), RunError> {
        self.columns = begin.columns.to_vec();
        self.values = vec![Vec::new(); begin.columns.len()];
        Ok(())
    }

    fn step(&mut self, moment: &Moment) -> Result<ControlFlow<()>, RunError> {
        self.time.push(moment.t);
        self.values.iter_mut().zip(moment.row).for_each(|(history, x)| history.push(*x));
        self.steps.extend(moment.info);
        GO_ON
    }
}
