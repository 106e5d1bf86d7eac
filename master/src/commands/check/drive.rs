//! An instance driven through initialization and steps by inputs that move.

use ttb_fmi::description::{ModelDescription, ScalarVariable, VariableType};
use ttb_fmi::file_uri;
use ttb_fmi2::probe::{Instantiation, LogEntry, Probe, Probed, State};
use ttb_fmi2::types::Status;

use super::context::Context;
use super::finding::Finding;

/// Steps when nothing is said of them, s.
const STEP: f64 = 1e-3;

/// How an FMU is driven: its coupled variables, its time.
pub struct Plan {
    inputs: Vec<u32>,
    /// Start value and amplitude of each input.
    swing: Vec<(f64, f64)>,
    pub outputs: Vec<u32>,
    names: Vec<String>,
    /// Begin, end and step in s.
    pub start: f64,
    pub stop: Option<f64>,
    pub h: f64,
    guid: String,
    resources: String,
}

/// A loaded FMU and the way it is driven.
pub fn open(context: &Context) -> Result<(Probe, Plan), Finding> {
    let probe = Probe::open(&context.folder, &context.description, context.announce());
    let probe = probe.map_err(|e| Finding::error("library", e.to_string()))?;
    Ok((probe, Plan::new(&context.description, file_uri(&context.folder.join("resources")))))
}

impl Plan {
    fn new(d: &ModelDescription, resources: String) -> Self {
        let reals = |causality| d.with_causality(causality).filter(|v| v.kind == VariableType::Real);
        let start = d.start_time.filter(|t| t.is_finite()).unwrap_or(0.0);
        let stop = d.stop_time.filter(|t| *t > start);
        let h = d.step_size.filter(|h| *h > 0.0 && h.is_finite());
        let h = h.or(stop.map(|stop| (stop - start) / 500.0)).unwrap_or(STEP);
        Self {
            inputs: reals("input").map(|v| v.value_reference).collect(),
            swing: reals("input").map(|v| swing(v, d)).collect(),
            outputs: reals("output").map(|v| v.value_reference).collect(),
            names: reals("output").map(|v| v.name.clone()).collect(),
            start,
            stop,
            h,
            guid: d.guid.clone(),
            resources,
        }
    }

    /// Time after k steps.
    pub fn time(&self, k: usize) -> f64 {
        self.start + k as f64 * self.h
    }

    /// How many of the `wanted` steps there are until the stop time.
    pub fn steps(&self, wanted: usize) -> usize {
        let whole = |stop: f64| ((stop - self.start) / self.h * (1.0 + 1e-9)) as usize;
        self.stop.map_or(wanted, |stop| whole(stop).min(wanted))
    }

    /// How a right instance is made.
    pub fn instantiation(&self) -> Instantiation<'_> {
        Instantiation { name: "Check", guid: &self.guid, resources: &self.resources, logging: false }
    }

    /// Inputs by number: references, start values, amplitudes.
    pub fn input(&self, i: usize) -> Option<(u32, f64)> {
        Some((*self.inputs.get(i)?, self.swing[i].1))
    }
    /// How many inputs there are.
    pub fn input_count(&self) -> usize {
        self.inputs.len()
    }
    /// References of all inputs.
    pub fn inputs(&self) -> &[u32] {
        &self.inputs
    }
    /// Name of an output.
    pub fn name(&self, i: usize) -> &str {
        &self.names[i]
    }

    /// Inputs at a time; another `tune` is another excitation.
    pub fn values(&self, t: f64, tune: f64) -> Vec<f64> {
        let tau = (t - self.start) / self.h;
        let value = |(i, (start, amplitude)): (usize, &(f64, f64))| {
            start + amplitude * (0.05 * (1.0 + tune) * tau + 0.7 * i as f64 + tune).sin()
        };
        self.swing.iter().enumerate().map(value).collect()
    }
}

/// Start value and amplitude, by unit: 10 kN, 0.1 mm, 1 mm/s, or one.
fn swing(v: &ScalarVariable, d: &ModelDescription) -> (f64, f64) {
    let start = v.start.as_ref().and_then(|text| text.trim().parse().ok()).unwrap_or(0.0);
    let unit = v.unit.as_ref().and_then(|unit| d.units.get(unit));
    let amplitude = match unit.map(|unit| (unit.powers, unit.factor)) {
        Some(([1, 1, -2, ..], factor)) => 1e4 / factor,
        Some(([0, 1, 0, ..], factor)) => 1e-4 / factor,
        Some(([0, 1, -1, ..], factor)) => 1e-3 / factor,
        _ => 1.0,
    };
    (start, amplitude)
}

/// The plan's first steps; nothing if a second instance takes them otherwise, so that it cannot serve as a reference.
pub fn reference(probe: &Probe, plan: &Plan, steps: usize) -> Result<Option<Vec<Vec<f64>>>, Finding> {
    let mut first = Drive::fresh(probe, plan)?;
    let run = first.steps(0..steps, 0.0)?;
    first.instance.free();
    let mut second = Drive::fresh(probe, plan)?;
    let again = second.steps(0..steps, 0.0)?;
    let different = second.differ(&run, &again, 1e-12);
    second.instance.free();
    Ok(if different.is_none() { Some(run) } else { None })
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
        let status = self.instance.set_real(&self.plan.inputs, values);
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
        let name = match status {
            Status::Ok => return Ok(()),
            Status::Warning => {
                self.warnings += 1;
                return Ok(());
            }
            Status::Discard => "discard",
            Status::Error => "failed",
            Status::Fatal => "fatal",
            Status::Pending => "pending",
        };
        let function = call.split(' ').next().unwrap_or(call);
        Err(Finding::error(name, format!("{function} answers fmi2{status}"))
            .at(call)
            .seen(last(&self.instance.take_log())))
    }

    /// The largest difference between two runs beyond rounding: which output, and both values. `rounding` is relative to
    /// the output's largest value in either.
    pub fn differ(&self, a: &[Vec<f64>], b: &[Vec<f64>], rounding: f64) -> Option<String> {
        let mut worst: Option<(f64, String)> = None;
        for i in 0..self.plan.outputs.len() {
            let size = |run: &[Vec<f64>]| run.iter().map(|y| y[i].abs()).fold(0.0, f64::max);
            let scale = size(a).max(size(b));
            for (k, (x, y)) in a.iter().zip(b).enumerate() {
                let (x, y) = (x[i], y[i]);
                let same = x.to_bits() == y.to_bits() || (x.is_nan() && y.is_nan());
                let error = if same { 0.0 } else { (x - y).abs() / scale };
                if !same && (error > rounding || error.is_nan()) && worst.as_ref().is_none_or(|(e, _)| error > *e) {
                    worst = Some((error, format!("{} is {x:e} and {y:e} after step {}", self.plan.name(i), k + 1)));
                }
            }
        }
        worst.map(|(_, words)| words)
    }
}

/// The last thing an FMU logged.
pub fn last(log: &[LogEntry]) -> String {
    log.last().map_or_else(|| "nothing logged".into(), |entry| format!("logged {:?}", entry.text.trim()))
}
