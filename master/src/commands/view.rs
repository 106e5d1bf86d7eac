//! `ttb view`: the bridge for ParaView: sag, natural modes, the crossing of the train.

use std::path::{Path, PathBuf};

use ttb_bridge::drawing::Drawing;
use ttb_scenario::Checked;
use ttb_scenario::spec::{BridgeSpec, StructureSpec};
use ttb_scenario::types::{Damping, Newmark};
use ttb_session::Case;
use ttb_session::observe::Progress;

use super::inspect_bridge::is_model;
use super::progress::progress_bar;
use crate::cli::{Set, View};
use crate::error::Error;
use crate::prepare::fmus;
use crate::signals::Stop;
use crate::view::crossing::{Crossing, Frame};
use crate::view::grid::Grid;
use crate::view::series;

/// The scenario in a folder of results.
const RESOLVED: &str = "scenario.resolved.json";

/// The command.
pub fn view(arguments: &View, stop: &Stop) -> Result<(), Error> {
    let inside = arguments.what.join(RESOLVED);
    let file: PathBuf = if arguments.what.is_dir() { inside } else { arguments.what.clone() };
    let (spec, checked) = if is_model(&file) { (of_model(&file)?, None) } else { of_scenario(&file, &arguments.set)? };
    if checked.is_none() && !arguments.set.set.is_empty() {
        return Err(Error::Input(format!("--set: {} is a model file and no scenario", file.display())));
    }
    if arguments.crossing && checked.is_none() {
        let text = "a model file has no train: give a scenario for --crossing";
        return Err(Error::Input(format!("{}: {text}", file.display())));
    }
    let drawing = Drawing::new(&spec).map_err(|e| Error::Input(e.to_string()))?;
    let (sag, modes) = (drawing.sag(), drawing.modes(arguments.modes).map_err(|e| Error::Input(e.to_string()))?);
    let folder = &arguments.output;
    std::fs::create_dir_all(folder).map_err(Error::io(folder))?;
    let mut vectors = vec![("sag under own weight, m".to_string(), &sag[..])];
    let name = |number: usize, hertz: f64| format!("mode {number}, {hertz:.4} Hz");
    vectors.extend((1..).zip(&modes).map(|(number, mode)| (name(number, mode.frequency), &mode.displacements[..])));
    let path = folder.join("bridge.vtu");
    let (points, cells) = (drawing.points.len(), drawing.cells.len());
    Grid { points: &drawing.points, cells: &drawing.cells, vectors }.write(&path)?;
    say!("{}: {points} points, {cells} cells, sag, {} modes", path.display(), modes.len());
    match checked {
        Some(checked) if arguments.crossing => crossing(&checked, &drawing, arguments, stop),
        _ => Ok(()),
    }
}

fn of_scenario(file: &Path, set: &Set) -> Result<(BridgeSpec, Option<Checked>), Error> {
    let checked = fmus::scenario(Some(file), set)?;
    Ok((checked.bridge.clone(), Some(checked)))
}

/// A bridge model file: no track, no damping.
fn of_model(file: &Path) -> Result<BridgeSpec, Error> {
    let model = ttb_scenario::model::load(file).map_err(Error::Scenario)?;
    Ok(BridgeSpec {
        structure: StructureSpec::FiniteElements(Box::new(model)),
        damping: Damping::None,
        modes: None,
        reduction: None,
        supports: Vec::new(),
        points: Vec::new(),
        step: 1e-3,
        end: 1.0,
        newmark: Newmark::default(),
        space: false,
        ground: None,
        ground_points: Vec::new(),
    })
}

fn crossing(checked: &Checked, drawing: &Drawing, arguments: &View, stop: &Stop) -> Result<(), Error> {
    stop.gently();
    let folder = arguments.output.join("crossing");
    std::fs::create_dir_all(&folder).map_err(Error::io(&folder))?;
    let steps = Case::of(checked).axis().steps();
    let bar = progress_bar(steps, arguments.quiet);
    let mut tell = |n| bar.set_position(n);
    let ran = Crossing::new(checked, &mut Progress::new(&mut tell, stop.flag()));
    bar.finish_and_clear();
    let Some(mut ran) = ran? else { return stop.asked().map_or(Ok(()), |signal| Err(Error::Interrupted(signal))) };
    let every = steps.div_ceil(arguments.frames).max(1) as usize;
    let mut grids = Vec::new();
    ran.frames(drawing, every, |frame| write(&frame, drawing, &folder, &mut grids))?;
    let path = arguments.output.join("crossing.pvd");
    series::write(&path, &grids)?;
    say!("{}: {} moments", path.display(), grids.len() / 2);
    Ok(())
}

/// Bridge and wheelsets of one moment, a grid each.
fn write(frame: &Frame, drawing: &Drawing, folder: &Path, grids: &mut Vec<(f64, usize, String)>) -> Result<(), Error> {
    let number = grids.len() / 2;
    let vectors = vec![("displacement, m".to_string(), &frame.displacements[..])];
    let cells: Vec<Vec<u32>> = (0..frame.wheels.len() as u32).map(|wheel| vec![wheel]).collect();
    let bridge = Grid { points: &drawing.points, cells: &drawing.cells, vectors };
    let wheels = Grid { points: &frame.wheels, cells: &cells, vectors: Vec::new() };
    for (part, (name, grid)) in [("bridge", bridge), ("wheels", wheels)].into_iter().enumerate() {
        let name = format!("{name}-{number:04}.vtu");
        grid.write(&folder.join(&name))?;
        grids.push((frame.time, part, format!("crossing/{name}")));
    }
    Ok(())
}
