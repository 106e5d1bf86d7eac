//! results.svg and results.png: deck displacement, deck acceleration, car acceleration and contact force over time.

use std::ops::Range;
use std::path::Path;

use plotters::coord::Shift;
use plotters::prelude::*;

use super::canvas::{Drawing, Failed, SANS, save};
use super::envelope::Envelope;
use super::panel::{Curve, Panel, Stroke, names};
use crate::error::Error;
use crate::results::record::Recorder;
use crate::results::scene::Scene;

/// A panel: variables by the begin and end of their names, and how they are shown.
struct Kind {
    title: &'static str,
    begin: &'static str,
    end: &'static str,
    factor: f64,
    /// Of monitored points: those that move down with the deck, or the others.
    aside: bool,
}

const KINDS: [Kind; 6] = [
    Kind { title: "Deck displacement, mm (down)", begin: "point[", end: "].displacement", factor: 1e3, aside: false },
    Kind {
        title: "Deck acceleration, m/s² (down)", begin: "point[", end: "].acceleration", factor: 1.0, aside: false
    },
    Kind { title: "Other points, displacement, mm", begin: "point[", end: "].displacement", factor: 1e3, aside: true },
    Kind {
        title: "Other points, acceleration, m/s²",
        begin: "point[",
        end: "].acceleration",
        factor: 1.0,
        aside: true,
    },
    Kind {
        title: "Car body acceleration, m/s² (down)",
        begin: "car[",
        end: "].acceleration",
        factor: 1.0,
        aside: false,
    },
    Kind {
        title: "Contact force of a wheelset, kN",
        begin: "wheel[",
        end: "].contact_force",
        factor: 1e-3,
        aside: false,
    },
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

impl Plot {
    /// Chooses the variables of a run to `end` s.
    pub fn new(recorder: &Recorder, scene: &Scene, end: f64) -> Self {
        let mut curves = Vec::new();
        for (kind, Kind { begin, end: ending, aside, .. }) in KINDS.iter().enumerate() {
            let columns = recorder.columns.iter().map(|column| column.name.as_str()).enumerate();
            let of_kind = columns.filter(|(_, name)| name.contains(begin) && name.ends_with(ending));
            let matches: Vec<(usize, &str)> =
                of_kind.filter(|(_, name)| scene.direction(name).is_some() == *aside).collect();
            let count = matches.len().min(CURVES);
            let chosen = (0..count).map(|i| matches[if count > 1 { i * (matches.len() - 1) / (count - 1) } else { 0 }]);
            curves.extend(chosen.map(|(column, name)| {
                let how = scene.direction(name).map_or_else(String::new, |how| format!(" {how}"));
                Series { kind, column, name: short(name) + &how, envelope: Envelope::new(0.0, end) }
            }));
        }
        let wheels: Vec<usize> = (1..).map_while(|wheel| recorder.find(&format!("wheel[{wheel}].position"))).collect();
        let wheels = wheels.first().zip(wheels.last()).map(|(first, last)| [*first, *last]);
        Self { curves, stay: Stay { deck: scene.deck, wheels, from: None, to: None }, end }
    }

    /// Takes in a row.
    pub fn update(&mut self, row: &[f64], time: f64) {
        self.curves
            .iter_mut()
            .for_each(|series| series.envelope.add(time, row[series.column] * KINDS[series.kind].factor));
        self.stay.update(row, time);
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

/// `A` of `point[A].displacement`, `car 1` of `car[1].acceleration`.
fn short(name: &str) -> String {
    let short = name.rsplit_once("].").map_or(name, |(short, _)| short);
    short.replace("point[", "").replace('[', " ")
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
            let (title, names_time, time) = (title.to_string(), at + 1 == count, self.time.clone());
            Panel { title, time, names_time, shaded: self.shaded.clone(), curves }.draw(&chart, scale)?;
            names(&beside, curves, self.shaded.as_ref().filter(|_| at == 0).map(|_| SHADED), scale)?;
        }
        Ok(())
    }
}
