//! Error over step, both axes logarithmic, a line a quantity.

use std::path::Path;

use plotters::coord::Shift;
use plotters::prelude::*;

use super::canvas::{Drawing, Failed, SANS, save};
use super::panel::label;
use crate::error::Error;

/// A quantity: all outputs of equal name but for number or name in brackets.
pub struct Kind {
    /// `point[·].displacement`.
    pub name: String,
    /// Greatest difference of the histories from the fine run over all members and times, and of the peaks, relative to the
    /// greatest value of the fine run; one pair a step.
    pub errors: Vec<[f64; 2]>,
}

/// Errors of histories by step.
pub struct Slopes<'a> {
    /// Above the picture.
    pub title: &'a str,
    /// s.
    pub steps: &'a [f64],
    /// The quantities.
    pub kinds: &'a [Kind],
}

/// Smaller errors are rounding.
const LEAST: f64 = 1e-8;
/// Width of the strip with the names.
const NAMES: f64 = 290.0;

impl Slopes<'_> {
    /// Draws FILE.svg and FILE.png.
    pub fn save(&self, stem: &Path) -> Result<(), Error> {
        save(self, stem)
    }
}

impl Drawing for Slopes<'_> {
    fn size(&self) -> (u32, u32) {
        (1100, 560)
    }

    fn draw<'a, B: DrawingBackend + 'a>(&self, root: &DrawingArea<B, Shift>, scale: f64) -> Result<(), Failed<'a>>
    where
        B::ErrorType: 'static,
    {
        root.fill(&WHITE)?;
        let px = |length: f64| (length * scale).round() as i32;
        let letters = |size: f64| (SANS, size * scale);
        let (area, names) = root.split_horizontally(root.dim_in_pixel().0 - px(NAMES) as u32);
        let errors = || self.kinds.iter().flat_map(|k| k.errors.iter().map(|[history, _]| history.max(LEAST)));
        let (low, high) = (errors().fold(1.0, f64::min), errors().fold(LEAST, f64::max));
        let times = |f: fn(f64, f64) -> f64, start| self.steps.iter().map(|h| 1e3 * h).fold(start, f);
        let (first, last) = (times(f64::min, f64::INFINITY), times(f64::max, 0.0));
        let mut chart = ChartBuilder::on(&area)
            .caption(self.title, letters(14.0))
            .margin(px(8.0))
            .margin_right(px(20.0))
            .x_label_area_size(px(38.0))
            .y_label_area_size(px(70.0))
            .build_cartesian_2d((0.9 * first..1.1 * last).log_scale(), (0.5 * low..2.0 * high).log_scale())?;
        let mut mesh = chart.configure_mesh();
        mesh.light_line_style(TRANSPARENT).x_desc("step, ms").y_desc("greatest error of the history, relative");
        mesh.y_label_formatter(&|y| format!("{y:.0e}")).x_label_formatter(&|h| one_two_five(*h));
        mesh.label_style(letters(12.0)).axis_desc_style(letters(13.0)).draw()?;
        for (at, kind) in self.kinds.iter().enumerate() {
            let color = HSLColor(at as f64 / self.kinds.len() as f64, 0.75, 0.42);
            let line = color.stroke_width(px(1.6) as u32);
            let points = self.steps.iter().zip(&kind.errors).map(|(h, [history, _])| (1e3 * h, history.max(LEAST)));
            chart.draw_series(LineSeries::new(points.clone(), line))?;
            chart.draw_series(points.map(|point| Circle::new(point, px(3.0), color.filled())))?;
            let y = px(40.0 + 20.0 * at as f64);
            names.draw(&PathElement::new(vec![(px(4.0), y), (px(24.0), y)], line))?;
            names.draw(&Text::new(kind.name.clone(), (px(30.0), y - px(7.0)), letters(12.0).into_font()))?;
        }
        Ok(())
    }
}

/// 0.1, 0.2, 0.5, 1 …; what is between has no room on a logarithmic axis.
fn one_two_five(h: f64) -> String {
    let first = h / 10_f64.powf((h.log10() + 1e-9).floor());
    if [1.0, 2.0, 5.0].iter().any(|digit| (first - digit).abs() < 1e-6) { label(h, h) } else { String::new() }
}
