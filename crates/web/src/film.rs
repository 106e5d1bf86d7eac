//! One run with the motion of the whole deck, for a moving picture and for what lies over place and time.
//!
//! ```text
//! w(x_i, t_k), a(x_i, t_k)      deck, m and m/s², down; i: points of the deck, k: moments at equal distances, at most FRAMES
//! x(t)                          the leading axle from the bridge's begin, m
//! ```

use std::sync::atomic::AtomicBool;

use serde::Serialize;
use ttb_campaign::Run;
use ttb_campaign::modal::force_train;
use ttb_campaign::plan::Load;
use ttb_campaign::points::bearings;
use ttb_passage::{Heading, ModalBridge, Passage, Quantity as Of, Settings};
use ttb_scenario::Checked;
use ttb_session::{Of as Place, Quantity, Table};

use crate::fault::Fault;
use crate::session::Session;

/// Moments at most.
const FRAMES: usize = 500;

/// A run, moment by moment.
#[derive(Debug, Serialize)]
pub struct Film {
    /// Train and speed.
    title: String,
    /// s.
    time: Vec<f32>,
    /// Whether the train comes from the bridge's end: its abscissae count from there.
    backward: bool,
    /// Of the leading axle, m from the bridge's begin, or from its end.
    front: Vec<f32>,
    /// Axles behind the leading one, m.
    axles: Vec<f64>,
    /// Where the deck bears, m from its begin, both ends among them.
    bearings: Vec<f64>,
    /// Points of the deck, m from its begin.
    x: Vec<f64>,
    /// Displacement, m, a row a moment.
    displacement: Vec<Vec<f32>>,
    /// Acceleration, m/s², likewise.
    acceleration: Vec<Vec<f32>>,
    /// Contact force of every wheelset, N, likewise; empty of axle loads.
    wheels: Vec<Vec<f32>>,
    /// Acceleration of every car body, m/s², likewise; empty of axle loads.
    cars: Vec<Vec<f32>>,
}

/// Computes a run once more; `None` if it was asked to stop.
///
/// # Errors
/// Why it fails.
pub fn film(session: &Session, run: &Run, stop: &AtomicBool) -> Result<Option<Film>, Fault> {
    let plan = &session.expanded.plan;
    if !plan.bridges.is_empty() {
        return Err(Fault::new("the motion of the whole deck is not known: the bridge is an FMU"));
    }
    let train = &plan.trains[run.train];
    let runner = session.runner()?;
    let backward = !train.heading.is_forward();
    let title = match run.speed_km_h {
        Some(speed) => format!("{} at {speed} km/h", train.name),
        None => train.name.clone(),
    };
    if let (Some(force), Some(speed)) = (force_train(train), run.speed().filter(|speed| *speed > 0.0)) {
        let variant = &plan.variants[run.variant];
        let checked = session.expanded.source.varied(variant).map_err(|problems| Fault::of(&problems))?;
        let settings =
            Settings { stiffness: variant.stiffness_factor, mass: variant.mass_factor, ..Settings::default() };
        if let Ok(bridge) = ModalBridge::new(&checked.bridge, &settings) {
            let heading = if backward { Heading::Backward } else { Heading::Forward };
            let film = modal(title, &bridge, &Passage::new(&bridge, &force, heading, None), speed);
            return Ok(Some(Film { backward, bearings: bearings(&checked.bridge.structure), ..film }));
        }
    }
    let vehicles = !matches!(train.load, Load::Axles(_));
    let ran = if vehicles { runner.vehicles().table(run, stop) } else { runner.loads(None).table(run, stop) };
    let Some((checked, table)) = ran.map_err(Fault::new)? else { return Ok(None) };
    let speed = run.speed().or_else(|| checked.train_track.speed.first().map(|point| point[1])).unwrap_or(0.0);
    let axles = match &train.load {
        Load::Axles(axles) => axles.iter().map(|axle| axle[0]).collect(),
        _ => checked.train_track.offsets(),
    };
    let backward = if vehicles { backward || !checked.scenario.train.heading.is_forward() } else { backward };
    Ok(Some(Film { backward, ..of_table(title, &checked, &table, axles, speed) }))
}

/// Every how many of `n` samples a moment is shown.
fn stride(n: usize) -> usize {
    n.div_ceil(FRAMES).max(1)
}

fn modal(title: String, bridge: &ModalBridge, passage: &Passage, speed: f64) -> Film {
    let histories = passage.histories(speed);
    let along = |quantity: Of| {
        let is = |at: &usize| bridge.outputs()[*at].quantity == quantity;
        let mut of: Vec<(f64, usize)> =
            (0..bridge.outputs().len()).filter(is).filter_map(|at| Some((bridge.outputs()[at].place.x?, at))).collect();
        of.sort_by(|a, b| a.0.total_cmp(&b.0));
        of.dedup_by(|a, b| a.0 == b.0);
        of
    };
    let (displacements, accelerations) = (along(Of::Displacement), along(Of::Acceleration));
    let rows: Vec<usize> = (0..histories.samples()).step_by(stride(histories.samples())).collect();
    let of = |outputs: &[(f64, usize)]| {
        let columns: Vec<Vec<f64>> = outputs.iter().map(|(_, at)| histories.output(*at)).collect();
        rows.iter().map(|row| columns.iter().map(|column| column[*row] as f32).collect()).collect()
    };
    let time = |row: &usize| *row as f64 * histories.h;
    Film {
        title,
        backward: false,
        time: rows.iter().map(|row| time(row) as f32).collect(),
        front: rows.iter().map(|row| (speed * time(row)) as f32).collect(),
        axles: passage.train().axles.iter().map(|axle| axle.x).collect(),
        bearings: Vec::new(),
        x: displacements.iter().map(|(x, _)| *x).collect(),
        displacement: of(&displacements),
        acceleration: of(&accelerations),
        wheels: Vec::new(),
        cars: Vec::new(),
    }
}

fn of_table(title: String, checked: &Checked, table: &Table, axles: Vec<f64>, speed: f64) -> Film {
    let rows: Vec<usize> = (0..table.time.len()).step_by(stride(table.time.len())).collect();
    let column = |of: &Place, quantity: &Quantity| {
        table.columns.iter().position(|column| column.of == *of && column.quantity == *quantity)
    };
    let rows_of = |columns: Vec<usize>| -> Vec<Vec<f32>> {
        if columns.is_empty() {
            return Vec::new();
        }
        rows.iter().map(|row| columns.iter().map(|column| table.values[*column][*row] as f32).collect()).collect()
    };
    let mut points: Vec<(f64, Place)> =
        checked.bridge.points.iter().filter_map(|point| Some((point.x?, Place::Point(point.name.clone())))).collect();
    points.sort_by(|a, b| a.0.total_cmp(&b.0));
    points.dedup_by(|a, b| a.0 == b.0);
    let along = |quantity: &Quantity| rows_of(points.iter().filter_map(|(_, of)| column(of, quantity)).collect());
    let wheels = (1..=checked.train_track.axle_count()).map(Place::Wheel);
    let cars = (1..=checked.train_track.consist().len()).map(Place::Car);
    let at = checked.scenario.bridge.at;
    let front: Vec<f32> = match column(&Place::Wheel(1), &Quantity::Position) {
        Some(column) => rows.iter().map(|row| (table.values[column][*row] - at) as f32).collect(),
        None => rows.iter().map(|row| (speed * table.time[*row]) as f32).collect(),
    };
    Film {
        title,
        backward: false,
        time: rows.iter().map(|row| table.time[*row] as f32).collect(),
        front,
        axles,
        displacement: along(&Quantity::Displacement),
        acceleration: along(&Quantity::Acceleration),
        wheels: rows_of(wheels.filter_map(|of| column(&of, &Quantity::ContactForce)).collect()),
        cars: rows_of(cars.filter_map(|of| column(&of, &Quantity::Acceleration)).collect()),
        bearings: bearings(&checked.bridge.structure),
        x: points.into_iter().map(|(x, _)| x).collect(),
    }
}
