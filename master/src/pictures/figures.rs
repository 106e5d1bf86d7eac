//! The paper's Figures 7 to 10: a quantity over time by all methods, below it a stretch around its peak.

use std::ops::Range;
use std::path::Path;

use plotters::coord::Shift;
use plotters::prelude::*;

use super::canvas::{Drawing, Failed, SANS, rounded, save};
use crate::error::Error;
use crate::results::ran::{QUANTITIES, Ran, Watched};

/// Points of a curve at most: each column of pixels keeps its extremes.
const POINTS: usize = 2400;
/// Half of the stretch around the peak, as share of the whole.
const ZOOM: f64 = 0.01;
/// Width of the strip with the curves' names.
const NAMES: f64 = 230.0;
const COLORS: [RGBColor; 8] = [
    RGBColor(40, 40, 40),
    RGBColor(31, 85, 142),
    RGBColor(214, 96, 36),
    RGBColor(64, 140, 88),
    RGBColor(150, 60, 150),
    RGBColor(190, 150, 20),
    RGBColor(90, 170, 200),
    RGBColor(200, 60, 90),
];

/// Draws all four, each as SVG and PNG.
pub fn draw(rows: &[Ran], truth: Option<&Ran>, watched: &Watched, folder: &Path) -> Result<(), Error> {
    let curves: Vec<&Ran> = truth.into_iter().chain(rows).filter(|ran| ran.time.len() > 1).collect();
    if curves.is_empty() {
        return Ok(());
    }
    for (quantity, of) in QUANTITIES.iter().enumerate() {
        let figure = Figure { quantity, curves: &curves, title: watched.describe(quantity) };
        save(&figure, &folder.join(format!("figure-{}-{}", 7 + quantity, of.key)))?;
    }
    Ok(())
}

struct Figure<'a> {
    quantity: usize,
    curves: &'a [&'a Ran],
    title: String,
}

impl Drawing for Figure<'_> {
    fn size(&self) -> (u32, u32) {
        (1240, 760)
    }

    fn draw<'a, B: DrawingBackend + 'a>(&self, root: &DrawingArea<B, Shift>, scale: f64) -> Result<(), Failed<'a>>
    where
        B::ErrorType: 'static,
    {
        root.fill(&WHITE)?;
        let longest = self.curves.iter().map(|c| c.reached()).fold(0.0, f64::max);
        let (charts, names) = root.split_horizontally(root.dim_in_pixel().0 - (NAMES * scale) as u32);
        self.names(&names, scale)?;
        let panels = charts.split_evenly((2, 1));
        self.panel(&panels[0], 0.0..longest, &self.title, scale)?;
        let half = ZOOM * longest.max(1.0);
        let peak = self.peak_time();
        let zoom = (peak - half).max(0.0)..(peak + half).min(longest.max(peak + 1e-6));
        self.panel(&panels[1], zoom, "around its peak", scale)
    }
}

impl Figure<'_> {
    /// When the first curve is greatest.
    fn peak_time(&self) -> f64 {
        let first = self.curves[0];
        let values = &first.histories[self.quantity];
        let at = (0..values.len()).max_by(|a, b| values[*a].abs().total_cmp(&values[*b].abs()));
        at.map_or(0.0, |at| first.time[at])
    }

    /// What is what, beside the charts.
    fn names<'a, B: DrawingBackend + 'a>(&self, area: &DrawingArea<B, Shift>, scale: f64) -> Result<(), Failed<'a>>
    where
        B::ErrorType: 'static,
    {
        let px = |length: f64| (length * scale).round() as i32;
        for (at, (ran, color)) in self.curves.iter().zip(COLORS.iter().cycle()).enumerate() {
            let y = px(40.0 + 20.0 * at as f64);
            let line = vec![(px(4.0), y), (px(24.0), y)];
            area.draw(&PathElement::new(line, stroke(at, *color, scale)))?;
            let name = format!("{}, {} ms", ran.method, rounded(1e3 * ran.step));
            let letters = (SANS, 12.0 * scale).into_font();
            area.draw(&Text::new(name, (px(30.0), y - px(7.0)), letters))?;
        }
        Ok(())
    }

    fn panel<'a, B: DrawingBackend + 'a>(
        &self,
        area: &DrawingArea<B, Shift>,
        time: Range<f64>,
        title: &str,
        scale: f64,
    ) -> Result<(), Failed<'a>>
    where
        B::ErrorType: 'static,
    {
        let of = &QUANTITIES[self.quantity];
        let px = |length: f64| (length * scale).round() as u32;
        let letters = |size: f64| (SANS, size * scale);
        let points = |ran: &&Ran| {
            let points = within(ran, self.quantity, &time);
            thin(&points).into_iter().map(|(t, x)| (t, x * of.factor)).collect::<Vec<(f64, f64)>>()
        };
        let curves: Vec<Vec<(f64, f64)>> = self.curves.iter().map(points).collect();
        let mut chart = ChartBuilder::on(area)
            .caption(format!("{title}, {}", of.unit), letters(15.0))
            .margin(px(8.0))
            .margin_right(px(24.0))
            .x_label_area_size(px(36.0))
            .y_label_area_size(px(66.0))
            .build_cartesian_2d(time, limits(&curves))?;
        let mut mesh = chart.configure_mesh();
        mesh.light_line_style(WHITE).x_labels(10).y_labels(6).x_desc("time, s");
        mesh.y_label_formatter(&|y| rounded(*y).to_string());
        mesh.label_style(letters(12.0)).axis_desc_style(letters(13.0)).draw()?;
        for (at, (points, color)) in curves.into_iter().zip(COLORS.iter().cycle()).enumerate() {
            chart.draw_series(LineSeries::new(points, stroke(at, *color, scale)))?;
        }
        Ok(())
    }
}

/// The first curve is broad and light, so that all others are seen on it.
fn stroke(at: usize, color: RGBColor, scale: f64) -> ShapeStyle {
    let (width, share) = if at == 0 { (3.0, 0.35) } else { (1.0, 1.0) };
    color.mix(share).stroke_width((width * scale).round() as u32)
}

/// The points of a curve in a stretch of time, one more on either side.
fn within(ran: &Ran, quantity: usize, time: &Range<f64>) -> Vec<(f64, f64)> {
    let first = ran.time.partition_point(|t| *t < time.start);
    let end = ran.time.partition_point(|t| *t <= time.end);
    (first..end).map(|i| (ran.time[i], ran.histories[quantity][i])).filter(|(_, x)| x.is_finite()).collect()
}

fn limits(curves: &[Vec<(f64, f64)>]) -> Range<f64> {
    let values = || curves.iter().flatten().map(|(_, x)| *x);
    let (low, high) = (values().fold(f64::INFINITY, f64::min), values().fold(f64::NEG_INFINITY, f64::max));
    let margin = 0.06 * (high - low);
    if margin > 0.0 { low - margin..high + margin } else { -1.0..1.0 }
}

/// At most [`POINTS`] points that keep the extremes of every stretch.
fn thin(points: &[(f64, f64)]) -> Vec<(f64, f64)> {
    let stretch = (2 * points.len()).div_ceil(POINTS).max(1);
    let extremes = |part: &[(f64, f64)]| {
        let by = |a: &&(f64, f64), b: &&(f64, f64)| a.1.total_cmp(&b.1);
        let low = part.iter().min_by(by).copied().unwrap_or_default();
        let high = part.iter().max_by(by).copied().unwrap_or_default();
        if low.0 <= high.0 { [low, high] } else { [high, low] }
    };
    points.chunks(stretch).flat_map(extremes).collect()
}
