//! An instance driven through initialization and steps by inputs that move.

use ttb_fmi::file_uri;
use ttb_fmi2::probe::{Instantiation, LogEntry, Probe, Probed, State};
use ttb_fmi2::types::Status;

use super::compare::{differ, leave_out};
use super::context::Context;
use super::finding::{Finding, Severity};
use super::plan::Plan;

/// A loaded FMU and the way it is driven.
pub fn open(context: &Context) -> Result<(Probe, Plan), Finding> {
    let probe = Probe::open(&context.folder, &context.description, context.announce());
    let probe = probe.map_err(|e| Finding::error("library", e.to_string()))?;
    Ok((probe, Plan::new(&context.description, file_uri(&context.folder.join("resources")))))
}

/// The plan's first steps by an instance of their own; outputs that a second one gives otherwise are left out of all
/// comparisons from then on. Nothing where there may be one instance only.
pub fn reference(probe: &Probe, plan: &Plan, steps: usize) -> Result<Option<Vec<Vec<f64>>>, Finding> {
    if !plan.several {
        return Ok(None);
    }
    let mut first = Drive::fresh(probe, plan)?;
    let run = first.steps(0..steps, 0.0)?;
    first.instance.free();
    let mut second = Drive::fresh(probe, plan)?;
    let again = second.steps(0..steps, 0.0)?;
    second.instance.free();
    leave_out(plan, &run, &again);
    Ok(Some(run))
}

/// Runs made again before somebody is accused.
const CONTROLS: usize = 3;

/// What still differs between the plan's first steps and a run that has shown a difference, once outputs are left out that
/// also differ in runs of further instances: an FMU with random numbers differs now and then.
pub fn confirmed(
    probe: &Probe,
    plan: &Plan,
    expected: &[Vec<f64>],
    run: &[Vec<f64>],
    rounding: f64,
) -> Result<Option<String>, Finding> {
    let n = expected.len().min(run.len());
    let difference = |plan: &Plan| differ(plan, &expected[..n], &run[..n], rounding);
    for _ in 0..if plan.several { CONTROLS } else { 0 } {
        if difference(plan).is_none() {
            break;
        }
        let mut control = Drive::fresh(probe, plan)?;
        let again = control.steps(0..expected.len(), 0.0)?;
        control.instance.free();
        leave_out(plan, expected, &again);
    }
    Ok(difference(plan))
}

/// An instance on its way.
pub struct Drive<'a> {
    pub instance: Probed<'a>,
    pub plan: &'a Plan,
    /// Calls that answered fmi2Warning.
    pub warnings: u64,
}

impl<'a> Drive<'a> {
    /// A new instance at the start time.
    pub fn fresh(probe: &'a Probe, plan: &'a Plan) -> Result<Self, Finding> {
        Self::born(probe, plan, &plan.instantiation())
    }

    /// As [`Drive::fresh`], otherwise made.
    pub fn born(probe: &'a Probe, plan: &'a Plan, wanted: &Instantiation) -> Result<Self, Finding> {
        let instance = probe.instantiate(wanted).map_err(|log| {
            Finding::error("no-instance", "fmi2Instantiate answers NULL to a right GUID").seen(last(&log))
        })?;
        let mut drive = Self { instance, plan, warnings: 0 };
        drive.begin()?;
        Ok(drive)
    }

    /// Through initialization mode.
    pub fn begin(&mut self) -> Result<(), Finding> {
        let (start, stop) = (self.plan.start, self.plan.stop);
        let status = self.instance.setup_experiment(start, stop);
        self.ok(status, "fmi2SetupExperiment")?;
        let status = self.instance.enter_initialization();
        self.ok(status, "fmi2EnterInitializationMode")?;
        let status = self.instance.exit_initialization();
        self.ok(status, "fmi2ExitInitializationMode")
    }

    /// Step k of the plan from its time on, with the inputs of that time; the outputs after it.
    pub fn step(&mut self, k: usize, tune: f64) -> Result<Vec<f64>, Finding> {
        let (t, h) = (self.plan.time(k), self.plan.h);
        self.step_from(t, h, tune)
    }

    /// A step of any size.
    pub fn step_from(&mut self, t: f64, h: f64, tune: f64) -> Result<Vec<f64>, Finding> {
        self.set(&self.plan.values(t, tune))?;
        let status = self.instance.step(t, h);
        self.ok(status, &format!("fmi2DoStep from t = {t} s by {h} s"))?;
        self.outputs()
    }

    /// Steps from k to below `to`.
    pub fn steps(&mut self, range: std::ops::Range<usize>, tune: f64) -> Result<Vec<Vec<f64>>, Finding> {
        range.map(|k| self.step(k, tune)).collect()
    }

    /// Sets all inputs.
    pub fn set(&mut self, values: &[f64]) -> Result<(), Finding> {
        if values.is_empty() {
            return Ok(());
        }
        let status = self.instance.set_real(self.plan.inputs(), values);
        self.ok(status, "fmi2SetReal")
    }

    /// Reads all outputs.
    pub fn outputs(&mut self) -> Result<Vec<f64>, Finding> {
        let mut values = vec![0.0; self.plan.outputs.len()];
        if !values.is_empty() {
            let status = self.instance.get_real(&self.plan.outputs, &mut values);
            self.ok(status, "fmi2GetReal")?;
        }
        Ok(values)
    }

    /// Saves.
    pub fn save(&mut self, over: Option<State>) -> Result<State, Finding> {
        let (status, state) = self.instance.get_state(over);
        self.ok(status, "fmi2GetFMUstate")?;
        if state.is_null() {
            return Err(Finding::error("state-null", "fmi2GetFMUstate answers fmi2OK and gives NULL"));
        }
        Ok(state)
    }

    /// Restores.
    pub fn restore(&mut self, state: &State) -> Result<(), Finding> {
        let status = self.instance.set_state(state);
        self.ok(status, "fmi2SetFMUstate")
    }

    /// A status as a result.
    pub fn ok(&mut self, status: Status, call: &str) -> Result<(), Finding> {
        let function = call.split(' ').next().unwrap_or(call);
        let name = match status {
            Status::Ok => return Ok(()),
            Status::Warning => {
                self.warnings += 1;
                return Ok(());
            }
            Status::Discard | Status::Ended => return Err(self.discarded(function, call)),
            Status::Error => "failed",
            Status::Fatal => "fatal",
            Status::Pending => "pending",
        };
        let found = Finding::error(name, format!("{function} answers fmi2{status}"));
        let allowed = status == Status::Pending && self.plan.asynchronous;
        let found = if allowed { found.of(Severity::Warning) } else { found };
        Err(found.at(call).seen(last(&self.instance.take_log())))
    }

    /// fmi2Discard: an FMU may end the simulation by it, and a step or a value that it refuses so may be tried otherwise.
    fn discarded(&mut self, function: &str, call: &str) -> Finding {
        if function == "fmi2DoStep" && self.instance.wants_end() {
            let what = "it ends the simulation of its own accord: fmi2Discard, and fmi2Terminated is true";
            return Finding::remark("ends", what).at(call);
        }
        let allowed = matches!(function, "fmi2DoStep" | "fmi2SetReal");
        let found = Finding::error("discard", format!("{function} answers fmi2Discard"));
        let found = if allowed { found.of(Severity::Warning) } else { found };
        found.at(call).seen(last(&self.instance.take_log()))
    }

    /// The largest difference between two runs beyond rounding: which output, and both values. `rounding` is relative to
    /// the output's largest value in either.
    pub fn differ(&self, a: &[Vec<f64>], b: &[Vec<f64>], rounding: f64) -> Option<String> {
        differ(self.plan, a, b, rounding)
    }
}

/// The last thing an FMU logged.
pub fn last(log: &[LogEntry]) -> String {
    log.last().map_or_else(|| "nothing logged".into(), |entry| format!("logged {:?}", entry.text.trim()))
}
