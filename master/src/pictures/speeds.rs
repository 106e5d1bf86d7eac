//! curves.svg and curves.png: largest deck acceleration and largest deflection over speed, a curve a train.

use std::ops::Range;
use std::path::Path;

use plotters::coord::Shift;
use plotters::prelude::*;

use super::canvas::{Drawing, Failed, SANS, save};
use super::panel::{Curve, Panel, Stroke, names};
use crate::error::Error;

/// Curves with a colour and a name of their own; all others are grey.
const NAMED: usize = 8;
const SIZE: [u32; 2] = [1200, 330];
const TITLE: f64 = 40.0;
const NAMES: f64 = 230.0;

/// A curve: its name, and (km/h, value), speeds rising.
pub type Line = (String, Vec<(f64, f64)>);

/// The picture.
pub struct Speeds {
    title: String,
    range: Range<f64>,
    panels: Vec<(String, Vec<Curve>)>,
}

impl Speeds {
    /// Of panels, each with its title and its lines; those with the largest values get names.
    pub fn new(title: &str, panels: Vec<(String, Vec<Line>)>) -> Self {
        let speeds = || panels.iter().flat_map(|(_, lines)| lines.iter().flat_map(|(_, points)| points)).map(|p| p.0);
        let (low, high) = speeds().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (low.min(v), high.max(v)));
        let range = if low < high { low..high } else { low.min(1e3) - 1.0..high.max(-1e3) + 1.0 };
        let panels = panels.into_iter().map(|(title, lines)| (title, curves(lines))).collect();
        Self { title: title.into(), range, panels }
    }

    /// Draws FILE.svg and FILE.png.
    ///
    /// # Errors
    /// A file cannot be written.
    pub fn save(&self, stem: &Path) -> Result<(), Error> {
        save(self, stem)
    }
}

fn curves(mut lines: Vec<Line>) -> Vec<Curve> {
    let most = |line: &Line| line.1.iter().map(|point| point.1).fold(0.0, f64::max);
    lines.sort_by(|a, b| most(b).total_cmp(&most(a)));
    let grey = lines.split_off(lines.len().min(NAMED));
    let rest = grey.into_iter().map(|(_, points)| Curve { name: String::new(), points, stroke: Stroke::rest() });
    let named = lines.into_iter().enumerate();
    rest.chain(named.map(|(i, (name, points))| Curve { name, points, stroke: Stroke::of(i) })).collect()
}

impl Drawing for Speeds {
    fn size(&self) -> (u32, u32) {
        (SIZE[0], TITLE as u32 + SIZE[1] * self.panels.len().max(1) as u32)
    }

    fn draw<'a, B: DrawingBackend + 'a>(&self, root: &DrawingArea<B, Shift>, scale: f64) -> Result<(), Failed<'a>>
    where
        B::ErrorType: 'static,
    {
        root.fill(&WHITE)?;
        let below = root.margin((8.0 * scale) as u32, 0, 0, 0).titled(&self.title, (SANS, 20.0 * scale))?;
        let count = self.panels.len();
        for ((at, (title, curves)), area) in self.panels.iter().enumerate().zip(below.split_evenly((count.max(1), 1))) {
            let (chart, beside) = area.split_horizontally(area.dim_in_pixel().0 - (NAMES * scale) as u32);
            let axis = (at + 1 == count).then_some("speed, km/h");
            Panel { title: title.clone(), time: self.range.clone(), axis, shaded: None, curves }.draw(&chart, scale)?;
            let named: Vec<&Curve> = curves.iter().filter(|curve| !curve.name.is_empty()).collect();
            names(&beside, named.into_iter(), None, scale)?;
        }
        Ok(())
    }
}
