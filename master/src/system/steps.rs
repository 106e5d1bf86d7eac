//! Step, end and sub-steps of a system: what its annotations say, else what its FMUs say.

use std::collections::{BTreeMap, HashSet};

use ttb_contract::names::{instant_force, mean_force};
use ttb_ssp::{Report, Structure};

use super::annotation::Settings;
use super::wiring::{Link, Side};
use crate::connect::map::Value;

/// Steps of a run whose step nobody says.
const STEPS: f64 = 1000.0;
/// A step may differ from a multiple of another by this part.
const ROUNDING: f64 = 1e-6;

/// Step and end of the run; where the structure does not say, the FMUs are asked in this order.
pub fn times(
    structure: &Structure,
    settings: &Settings,
    sides: &[Side],
    warnings: &mut Vec<String>,
    report: &mut Report,
) -> (f64, f64) {
    const PLACE: &str = "/SystemStructureDescription/DefaultExperiment";
    let experiment = &structure.experiment;
    if let Some(start) = experiment.start.filter(|start| *start != 0.0) {
        report.problem(&format!("{PLACE}/@startTime"), format!("is {start}; runs start at 0"));
    }
    let positive = |time: &f64| *time > 0.0 && time.is_finite();
    let end = experiment.stop.or_else(|| sides.iter().find_map(|(_, fmu)| fmu.stop_time));
    let end = end.filter(positive).unwrap_or_else(|| {
        report.problem(&format!("{PLACE}/@stopTime"), "there is no end after 0, neither here nor in the FMUs");
        0.0
    });
    let step = settings.step.or_else(|| sides.iter().find_map(|(_, fmu)| fmu.step_size).filter(positive));
    let step = step.unwrap_or_else(|| {
        let step = end / STEPS;
        warnings.push(format!(
            "neither the structure nor an FMU says a step: it is {step} s, a thousandth of the run; say it with the attribute \
             step of the annotation org.ttb.coupling"
        ));
        step
    });
    (step, end)
}

/// Of several sub-steps the means of the forces are coupled, else the forces themselves, whichever of the two an annotated
/// structure connects for other masters.
pub fn choose_forces(links: &mut [Link], train_track: usize, side: &Side, substeps: usize) {
    if substeps > 1 {
        return; // the means are taken where the FMUs are coupled
    }
    let outputs: HashSet<&str> = side.1.with_causality("output").map(|v| v.name.as_str()).collect();
    for link in links.iter_mut().filter(|link| link.from == train_track) {
        if let Some(force) = instant_force(&link.output).filter(|force| outputs.contains(force.as_str())) {
            link.output = force;
        }
    }
}

/// Sub-steps that the train–track FMU does not take, or takes although nobody says so.
#[allow(clippy::too_many_arguments)]
pub fn sub_steps(
    settings: &Settings,
    step: f64,
    (component, description): &Side,
    parameters: &BTreeMap<String, Value>,
    links: &[Link],
    train_track: usize,
    warnings: &mut Vec<String>,
    report: &mut Report,
) {
    let place = format!("{}/@substeps", settings.place);
    let n = settings.substeps;
    let name = &component.name;
    if n > 1 {
        let has = |output: &str| description.variable(output).is_some_and(|v| v.causality == "output");
        let forces = links.iter().filter(|link| link.from == train_track).map(|link| mean_force(&link.output));
        if let Some(missing) = forces.into_iter().find(|force| !has(force)) {
            let message = format!("{n} sub-steps couple the means of forces, but {name} has no output {missing}");
            return report.problem(&place, message);
        }
    }
    let set = match parameters.get("step_size") {
        Some(Value::Number(set)) => Some(*set),
        _ => description.variable("step_size").and_then(|v| v.start.as_ref()?.trim().parse().ok()),
    };
    let Some(inner) = set.filter(|inner: &f64| *inner > 0.0) else {
        if n > 1 {
            warnings.push(format!(
                "{name} does not tell its step (no parameter step_size): that it takes {n} is not tested"
            ));
        }
        return;
    };
    let takes = (step / inner * (1.0 - ROUNDING)).ceil().max(1.0);
    if (takes - n as f64).abs() < 0.5 {
        return;
    }
    let told = format!("{name} takes {takes} in a step of {step} s, since its parameter step_size is {inner} s");
    if n > 1 {
        report
            .problem(&place, format!("is {n}, but {told}: bind step_size = {:?} or correct substeps", step / n as f64));
    } else {
        warnings
            .push(format!("{told}: without substeps = {takes} in the annotation some work is lost at the interface"));
    }
}
