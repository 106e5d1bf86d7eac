//! Two subsystems and their coupling as one thing that takes steps.

use std::collections::HashSet;
use std::ops::Range;

use ttb_contract::{Signal, Subsystem};
use ttb_coupling::probe::Probe;
use ttb_coupling::{Coupling, StepInfo};

use crate::axis::TimeAxis;
use crate::column::Column;
use crate::error::RunError;
use crate::stepping::Stepping;

/// Says whether what trial steps showed speaks against the run.
pub type Judge<'a> = &'a mut dyn FnMut(&Probe) -> Result<(), RunError>;

/// Both sides in initialization mode, coupled.
pub struct Coupled<'a> {
    train_track: &'a mut dyn Subsystem,
    bridge: &'a mut dyn Subsystem,
    coupling: &'a mut Coupling,
    /// Ports that act on a deck of their own each, and who looks at what trial steps show; `None`: no trial steps.
    probe: Option<(Vec<Range<usize>>, Judge<'a>)>,
    /// How many columns are the train–track side's.
    of_train_track: usize,
}

impl<'a> Coupled<'a> {
    /// Without trial steps.
    pub fn new(train_track: &'a mut dyn Subsystem, bridge: &'a mut dyn Subsystem, coupling: &'a mut Coupling) -> Self {
        Self { train_track, bridge, coupling, probe: None, of_train_track: 0 }
    }

    /// As before, of columns that were chosen already.
    pub(crate) fn again(
        train_track: &'a mut dyn Subsystem,
        bridge: &'a mut dyn Subsystem,
        coupling: &'a mut Coupling,
        of_train_track: usize,
    ) -> Self {
        Self { of_train_track, ..Self::new(train_track, bridge, coupling) }
    }

    /// With trial steps before the first one. `groups` are the ports, by position, that act on a deck of their own each.
    #[must_use]
    pub fn probed(self, groups: Vec<Range<usize>>, judge: Judge<'a>) -> Self {
        Self { probe: Some((groups, judge)), ..self }
    }

    /// How many columns are the train–track side's; they come first.
    pub fn of_train_track(&self) -> usize {
        self.of_train_track
    }
}

impl Stepping for Coupled<'_> {
    /// Those of the train–track side, then those of the bridge. A name that is another column's already, also that of the
    /// time, that is empty or that a spreadsheet would take for a formula gets the instance in front.
    fn columns(&mut self, wanted: &dyn Fn(&Column) -> bool) -> Vec<Column> {
        let column = |signal: &Signal| Column::parse(&signal.name, &signal.unit);
        let wanted = |signal: &Signal| wanted(&column(signal));
        let signals = self.train_track.record(&wanted);
        self.of_train_track = signals.len();
        let own = self.bridge.record(&wanted);
        // The time's column comes first.
        let mut taken = HashSet::from(["time".to_string()]);
        let mut columns = Vec::new();
        for (signals, instance) in [(signals, self.train_track.name()), (own, self.bridge.name())] {
            for signal in &signals {
                let odd = signal.name.trim().is_empty() || signal.name.starts_with(['=', '+', '-', '@']);
                let mut column = column(signal);
                while (odd && column.instance.is_none()) || !taken.insert(column.to_string()) {
                    let before = column.instance.map_or_else(String::new, |before| format!(".{before}"));
                    column.instance = Some(format!("{instance}{before}"));
                }
                columns.push(column);
            }
        }
        columns
    }

    fn start(&mut self) -> Result<(), RunError> {
        self.coupling.initialise(self.train_track, self.bridge, 0.0)?;
        Ok(())
    }

    fn rehearse(&mut self, axis: &TimeAxis) -> Result<(), RunError> {
        let Some((groups, judge)) = &mut self.probe else { return Ok(()) };
        let h = axis.size(0);
        let steps = (0..axis.steps()).take(MOST_TRIALS).take_while(|n| axis.size(*n) == h).count();
        let probe = self.coupling.probe(self.train_track, self.bridge, groups, [axis.time(0), h], steps)?;
        judge(&probe)
    }

    fn step(&mut self, t: f64, h: f64) -> Result<StepInfo, RunError> {
        Ok(self.coupling.step(self.train_track, self.bridge, t, h)?)
    }

    fn read(&mut self, row: &mut [f64]) -> Result<(), RunError> {
        let (first, second) = row.split_at_mut(self.of_train_track);
        self.train_track.read(first)?;
        self.bridge.read(second)?;
        Ok(())
    }

    fn inside(&self) -> [f64; 2] {
        [self.train_track.seconds(), self.bridge.seconds()]
    }
}

/// Trial steps of equal size at most; the coupling takes fewer.
const MOST_TRIALS: usize = 8;
