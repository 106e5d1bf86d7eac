//! results.svg and results.png: deck displacement, deck acceleration, car acceleration and contact force over time.

use std::ops::{ControlFlow, Range};
use std::path::Path;

use plotters::coord::Shift;
use plotters::prelude::*;
use ttb_session::column::Kind as Place;
use ttb_session::observe::{Begin, GO_ON, Moment, Observer};
use ttb_session::{Column, Of, Quantity, RunError};

use super::canvas::{Drawing, Failed, SANS, save};
use super::envelope::Envelope;
use super::panel::{Curve, Panel, Stroke, names};
use crate::error::Error;
use crate::results::scene::Scene;

/// A panel: a quantity of places of a kind, and how it is shown.
struct Kind {
    title: &'static str,
    of: Place,
    quantity: Quantity,
    factor: f64,
    /// Of monitored points: those that move down with the deck, or the others.
    aside: bool,
}

const fn kind(title: &'static str, of: Place, quantity: Quantity, factor: f64, aside: bool) -> Kind {
    Kind { title, of, quantity, factor, aside }
}

const KINDS: [Kind; 6] = [
    kind("Deck displacement, mm (down)", Place::Point, Quantity::Displacement, 1e3, false),
    kind("Deck acceleration, m/s² (down)", Place::Point, Quantity::Acceleration, 1.0, false),
    kind("Other points, displacement, mm", Place::Point, Quantity::Displacement, 1e3, true),
    kind("Other points, acceleration, m/s²", Place::Point, Quantity::Acceleration, 1.0, true),
    kind("Car body acceleration, m/s² (down)", Place::Car, Quantity::Acceleration, 1.0, false),
    kind("Contact force of a wheelset, kN", Place::Wheel, Quantity::ContactForce, 1e-3, false),
];
/// Curves in a panel at most: the first, the last and some in between.
const CURVES: usize = 3;
/// Size of the picture: its width, a panel's height, and the strips with the title and with the curves' names.
const SIZE: [u32; 2] = [1200, 240];
const TITLE: f64 = 40.0;
const NAMES: f64 = 190.0;
/// What the shaded stretch of time is called.
const SHADED: &str = "train on the bridge";

/// Time series of the variables that are drawn, thinned as they come.
pub struct Plot {
    scene: Scene,
    curves: Vec<Series>,
    stay: Stay,
    end: f64,
}

struct Series {
    kind: usize,
    column: usize,
    name: String,
    envelope: Envelope,
}

/// When the train is on the bridge, from the positions of its first and last wheel.
struct Stay {
    deck: Option<[f64; 2]>,
    wheels: Option<[usize; 2]>,
    from: Option<f64>,
    to: Option<f64>,
}

impl Observer for Plot {
    /// Chooses the variables.
    fn start(&mut self, begin: &Begin) -> Result<(), RunError> {
        self.end = begin.axis.time(begin.axis.steps());
        for (kind, Kind { of, quantity, aside, .. }) in KINDS.iter().enumerate() {
            let fits =
                |column: &Column| column.is(*of, quantity) && self.scene.direction(&column.of).is_some() == *aside;
            let matches: Vec<usize> = (0..begin.columns.len()).filter(|i| fits(&begin.columns[*i])).collect();
            let count = matches.len().min(CURVES);
            let chosen = (0..count).map(|i| matches[if count > 1 { i * (matches.len() - 1) / (count - 1) } else { 0 }]);
            self.curves.extend(chosen.map(|column| {
                let of = &begin.columns[column].of;
                let how = self.scene.direction(of).map_or_else(String::new, |how| format!(" {how}"));
                Series { kind, column, name: short(of) + &how, envelope: Envelope::new(0.0, self.end) }
            }));
        }
        let is_position = |column: &Column| column.is(Place::Wheel, &Quantity::Position);
        let place = |i: &Column| begin.columns.iter().position(|column| column == i);
        let mut wheels = begin.columns.iter().filter(|column| is_position(column));
        let first = wheels.next().and_then(place);
        self.stay.wheels = first.map(|first| [first, wheels.next_back().and_then(place).unwrap_or(first)]);
        Ok(())
    }

    fn step(&mut self, moment: &Moment) -> Result<ControlFlow<()>, RunError> {
        for series in &mut self.curves {
            series.envelope.add(moment.t, moment.row[series.column] * KINDS[series.kind].factor);
        }
        self.stay.update(moment.row, moment.t);
        GO_ON
    }
}

impl Plot {
    /// Of a run over a scene.
    pub fn new(scene: Scene) -> Self {
        let stay = Stay { deck: scene.deck, wheels: None, from: None, to: None };
        Self { scene, curves: Vec::new(), stay, end: 0.0 }
    }

    /// Draws results.svg and results.png into a folder.
    pub fn draw(&self, folder: &Path, title: &str) -> Result<(), Error> {
        let of_kind = |kind: usize| {
            let series = self.curves.iter().filter(|series| series.kind == kind).enumerate();
            let curve = |(place, series): (usize, &Series)| Curve {
                name: series.name.clone(),
                points: series.envelope.points(),
                stroke: Stroke::of(place),
            };
            series.map(curve).collect::<Vec<Curve>>()
        };
        let panels = (0..KINDS.len()).map(|kind| (KINDS[kind].title, of_kind(kind)));
        let panels = panels.filter(|(_, curves)| !curves.is_empty()).collect();
        save(
            &Results { title, time: 0.0..self.end, shaded: self.stay.range(self.end), panels },
            &folder.join("results"),
        )
    }
}

/// `A` of `point[A]`, `car 1` of `car[1]`.
fn short(of: &Of) -> String {
    match of {
        Of::Point(name) => name.clone(),
        Of::Car(number) => format!("car {number}"),
        Of::Wheel(number) => format!("wheel {number}"),
        other => other.to_string(),
    }
}

impl Stay {
    fn update(&mut self, row: &[f64], time: f64) {
        let Some(([begin, end], [first, last])) = self.deck.zip(self.wheels) else { return };
        if self.from.is_none() && row[first] >= begin {
            self.from = Some(time);
        }
        if self.to.is_none() && row[last] > end {
            self.to = Some(time);
        }
    }

    fn range(&self, end: f64) -> Option<Range<f64>> {
        Some(self.from?..self.to.unwrap_or(end))
    }
}

struct Results<'a> {
    title: &'a str,
    time: Range<f64>,
    shaded: Option<Range<f64>>,
    panels: Vec<(&'static str, Vec<Curve>)>,
}

impl Drawing for Results<'_> {
    fn size(&self) -> (u32, u32) {
        (SIZE[0], TITLE as u32 + SIZE[1] * self.panels.len().max(1) as u32)
    }

    fn draw<'a, B: DrawingBackend + 'a>(&self, root: &DrawingArea<B, Shift>, scale: f64) -> Result<(), Failed<'a>>
    where
        B::ErrorType: 'static,
    {
        root.fill(&WHITE)?;
        let below = root.margin((8.0 * scale) as u32, 0, 0, 0).titled(self.title, (SANS, 20.0 * scale))?;
        let count = self.panels.len();
        for ((at, (title, curves)), area) in self.panels.iter().enumerate().zip(below.split_evenly((count.max(1), 1))) {
            let (chart, beside) = area.split_horizontally(area.dim_in_pixel().0 - (NAMES * scale) as u32);
            let (title, time) = (title.to_string(), self.time.clone());
            let axis = (at + 1 == count).then_some("time, s");
            Panel { title, time, axis, shaded: self.shaded.clone(), curves }.draw(&chart, scale)?;
            names(&beside, curves.iter(), self.shaded.as_ref().filter(|_| at == 0).map(|_| SHADED), scale)?;
        }
        Ok(())
    }
}
