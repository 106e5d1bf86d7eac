//! Somebody who looks at some of the columns only.

use std::ops::ControlFlow;

use crate::column::Column;
use crate::error::RunError;
use crate::observe::{Begin, Moment, Observer};

/// Shows an observer the columns that are allowed and no others: these are read for other observers.
pub struct Only<'a> {
    inner: &'a mut dyn Observer,
    allowed: &'a dyn Fn(&Column) -> bool,
    /// Places of the columns that are shown.
    places: Vec<usize>,
    row: Vec<f64>,
}

impl<'a> Only<'a> {
    /// Of the columns for which `allowed` says so.
    pub fn new(inner: &'a mut dyn Observer, allowed: &'a dyn Fn(&Column) -> bool) -> Self {
        Self { inner, allowed, places: Vec::new(), row: Vec::new() }
    }
}

impl Observer for Only<'_> {
    fn start(&mut self, begin: &Begin) -> Result<(), RunError> {
        self.places = (0..begin.columns.len()).filter(|i| (self.allowed)(&begin.columns[*i])).collect();
        let columns: Vec<Column> = self.places.iter().map(|i| begin.columns[*i].clone()).collect();
        self.row = vec![0.0; columns.len()];
        self.inner.start(&Begin { columns: &columns, axis: begin.axis })
    }

    fn step(&mut self, moment: &Moment) -> Result<ControlFlow<()>, RunError> {
        self.row.iter_mut().zip(&self.places).for_each(|(value, i)| *value = moment.row[*i]);
        self.inner.step(&Moment { row: &self.row, ..*moment })
    }

    fn end(&mut self) -> Result<(), RunError> {
        self.inner.end()
    }
}
