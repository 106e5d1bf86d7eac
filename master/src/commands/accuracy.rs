//! `ttb accuracy`: every reported quantity at several steps against a fine one.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, Ordering};

use ttb_bridge::Bridge;
use ttb_contract::{InProcess, Interface, Model, ModelError, Pair};
use ttb_coupling::Coupling;
use ttb_coupling::run::{TimeAxis, run as run_steps};
use ttb_scenario::Checked;
use ttb_scenario::step::Steps;
use ttb_train_track::TrainTrack;

use super::progress::progress_bar;
use super::signals::stop_on_interrupt;
use crate::cli::Accuracy;
use crate::error::Error;
use crate::files::write;
use crate::pictures::slopes::{Kind, Slopes};
use crate::prepare::auto::decided;
use crate::results::names::{is_quantity, kind};

/// The command.
pub fn accuracy(arguments: &Accuracy) -> Result<(), Error> {
    let checked = decided(arguments.scenario.as_deref())?;
    let folder = &arguments.output;
    let fine = arguments.reference;
    let mut steps = arguments.steps.clone();
    steps.sort_by(|a, b| b.total_cmp(a));
    for h in &steps {
        let parts = (h / fine).round();
        if parts < 2.0 || (h / fine - parts).abs() > 1e-6 * parts {
            return Err(Error::Input(format!("--steps: {h} s is no multiple of the fine run's {fine} s")));
        }
    }
    std::fs::create_dir_all(folder).map_err(Error::io(folder))?;
    let stop = stop_on_interrupt();
    let run = |h: f64| histories(&checked, h, arguments.quiet, &stop);
    let truth = run(fine)?;
    let mut kinds: BTreeMap<String, Kind> = BTreeMap::new();
    for h in &steps {
        let coarse = run(*h)?;
        let parts = (h / fine).round() as usize;
        for (name, errors) in compare(&truth, &coarse, parts) {
            let kind = kinds.entry(name.clone()).or_insert_with(|| Kind { name, errors: Vec::new() });
            kind.errors.push(errors);
        }
    }
    let kinds: Vec<Kind> = kinds.into_values().collect();
    let text = markdown(&checked, &steps, fine, &kinds);
    write(&folder.join("accuracy.md"), text.as_bytes())?;
    write(&folder.join("accuracy.csv"), csv(&steps, &kinds).as_bytes())?;
    Slopes { title: &checked.scenario.title, steps: &steps, kinds: &kinds }.save(&folder.join("accuracy"))?;
    say!("{text}");
    say!("results in {}", folder.display());
    Ok(())
}

/// Histories by name.
type Histories = Vec<(String, Vec<f64>)>;

/// Runs the scenario at a step; all outputs but those of the supports and the wheels' positions.
fn histories(checked: &Checked, h: f64, quiet: bool, stop: &AtomicBool) -> Result<Histories, Error> {
    let mut checked = checked.clone();
    checked.set_steps(Steps { step: h, substeps: checked.steps().substeps });
    let refused = |e: ModelError| Error::Input(e.to_string());
    let train_track = TrainTrack::new(checked.train_track.clone()).map_err(refused)?;
    let bridge = Bridge::new(checked.bridge.clone()).map_err(refused)?;
    let wanted = |interface: &Interface| -> Vec<(String, u32)> {
        let names = interface.outputs().map(|r| (interface.variables()[r].name.clone(), r as u32));
        names.filter(|(name, _)| is_quantity(name)).collect()
    };
    let (of_train, of_bridge) = (wanted(train_track.interface()), wanted(bridge.interface()));
    let references = [&of_train, &of_bridge].map(|list| list.iter().map(|(_, r)| *r).collect::<Vec<u32>>());
    let names = of_train.into_iter().chain(of_bridge).map(|(name, _)| (name, Vec::new()));
    let mut table: Histories = names.collect();
    let Pair { mut train_track, mut bridge, ports } =
        Pair::new(train_track, bridge, checked.settings().force_scale, |force| checked.sent_force(force))
            .map_err(refused)?;
    let mut coupling = Coupling::new(ports.forces(), ports.motions(), checked.settings());
    coupling.initialise(&mut train_track, &mut bridge, 0.0)?;
    let mut row = vec![0.0; table.len()];
    let mut read = |t: &mut InProcess<TrainTrack>, b: &mut InProcess<Bridge>| {
        let (first, second) = row.split_at_mut(references[0].len());
        let failed = |e: ModelError| Error::Fmu(e.to_string());
        t.instance().get(&references[0], first).map_err(failed)?;
        b.instance().get(&references[1], second).map_err(failed)?;
        table.iter_mut().zip(&row).for_each(|((_, history), x)| history.push(*x));
        Ok::<_, Error>(())
    };
    read(&mut train_track, &mut bridge)?;
    let axis = TimeAxis::new(h, checked.train_track.end);
    let bar = progress_bar(axis.steps(), quiet).with_prefix(format!("{:.4} ms ", 1e3 * h));
    let ended = run_steps(&mut coupling, &mut train_track, &mut bridge, axis, |t, b, n, _, _| {
        read(t, b)?;
        bar.set_position(n);
        Ok::<_, Error>(if stop.load(Ordering::Relaxed) { ControlFlow::Break(()) } else { ControlFlow::Continue(()) })
    })?;
    bar.finish_and_clear();
    if ended.is_break() { Err(Error::Interrupted) } else { Ok(table) }
}

/// Errors of every kind; the fine run has `parts` steps in one of the coarse run.
fn compare(truth: &Histories, coarse: &Histories, parts: usize) -> Vec<(String, [f64; 2])> {
    // Per kind: greatest value, greatest difference, greatest difference of peaks.
    let mut kinds: BTreeMap<String, [f64; 3]> = BTreeMap::new();
    for ((name, fine), (_, coarse)) in truth.iter().zip(coarse) {
        let kind = kinds.entry(kind(name).replace("[]", "[·]")).or_default();
        let peak = |values: &[f64]| values.iter().fold(0.0_f64, |peak, x| peak.max(x.abs()));
        kind[0] = kind[0].max(peak(fine));
        // A last step that was shortened is no multiple of the fine ones.
        let pairs = coarse.iter().zip(fine.iter().step_by(parts)).take((fine.len() - 1) / parts + 1);
        kind[1] = pairs.fold(kind[1], |most, (a, b)| most.max((a - b).abs()));
        kind[2] = kind[2].max((peak(coarse) - peak(fine)).abs());
    }
    let relative = |[scale, history, peak]: [f64; 3]| [history / scale, peak / scale];
    kinds.into_iter().filter(|(_, k)| k[0] > 0.0).map(|(name, k)| (name, relative(k))).collect()
}

/// History and peak error in percent, a column a step.
fn markdown(checked: &Checked, steps: &[f64], fine: f64, kinds: &[Kind]) -> String {
    let mut text = format!(
        "{}, against steps of {} ms. History: greatest difference at any time; peak: difference of the greatest values; \
         both in percent of the greatest value of the kind.\n\n| quantity |",
        checked.scenario.title,
        milliseconds(fine)
    );
    for h in steps {
        // Writing to a string does not fail.
        let _ = write!(text, " {} ms: history, peak |", milliseconds(*h));
    }
    text += "\n|---|";
    steps.iter().for_each(|_| text += "---|");
    for kind in kinds {
        let _ = write!(text, "\n| `{}` |", kind.name);
        for [history, peak] in &kind.errors {
            let _ = write!(text, " {}, {} |", percent(*history), percent(*peak));
        }
    }
    text + "\n"
}

fn csv(steps: &[f64], kinds: &[Kind]) -> String {
    let mut text = String::from("quantity,step_s,history_error,peak_error\n");
    for kind in kinds {
        for (h, [history, peak]) in steps.iter().zip(&kind.errors) {
            let _ = writeln!(text, "{},{h},{history:.6e},{peak:.6e}", kind.name);
        }
    }
    text
}

/// A step for people, in ms without rounding noise.
fn milliseconds(h: f64) -> f64 {
    (1e9 * h).round() * 1e-6
}

/// Two significant digits of a percentage.
fn percent(error: f64) -> String {
    let percent = 100.0 * error;
    if percent < 1e-4 { "< 0.0001".into() } else { format!("{percent:.*}", digits(percent)) }
}

fn digits(x: f64) -> usize {
    (1.0 - x.log10().floor()).max(0.0) as usize
}
