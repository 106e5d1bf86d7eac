//! results.svg: deck displacement, deck acceleration, car acceleration and contact force over time.

use std::ops::Range;
use std::path::Path;

use plotters::coord::Shift;
use plotters::prelude::*;

use super::canvas::register_letters;
use crate::results::record::Recorder;

/// A panel: variables by the begin and end of their names, at most this many, and how they are shown.
struct Panel {
    title: &'static str,
    begin: &'static str,
    end: &'static str,
    factor: f64,
}

const PANELS: [Panel; 4] = [
    Panel { title: "Deck displacement, mm (down)", begin: "point[", end: "].displacement", factor: 1e3 },
    Panel { title: "Deck acceleration, m/s² (down)", begin: "point[", end: "].acceleration", factor: 1.0 },
    Panel { title: "Car body acceleration, m/s² (down)", begin: "car[", end: "].acceleration", factor: 1.0 },
    Panel { title: "Contact force of a wheelset, kN", begin: "wheel[", end: "].contact_force", factor: 1e-3 },
];
/// Curves in a panel at most: the first, the last and some in between.
const CURVES: usize = 3;
/// Points of a curve at most: each column of pixels keeps its extremes.
const POINTS: usize = 1600;
const COLORS: [RGBColor; CURVES] = [RGBColor(31, 85, 142), RGBColor(214, 96, 36), RGBColor(64, 140, 88)];

/// Time series of the variables that are drawn.
pub struct Plot {
    time: Vec<f64>,
    curves: Vec<Curve>,
}

struct Curve {
    panel: usize,
    column: usize,
    name: String,
    values: Vec<f64>,
}

impl Plot {
    /// Chooses the variables; `steps` is the number of rows to come.
    pub fn new(recorder: &Recorder, steps: u64) -> Self {
        let rows = steps as usize + 1;
        let mut curves = Vec::new();
        for (panel, Panel { begin, end, .. }) in PANELS.iter().enumerate() {
            let matches: Vec<usize> = (0..recorder.columns.len())
                .filter(|i| recorder.columns[*i].name.contains(begin) && recorder.columns[*i].name.ends_with(end))
                .collect();
            let count = matches.len().min(CURVES);
            let chosen = (0..count).map(|i| matches[if count > 1 { i * (matches.len() - 1) / (count - 1) } else { 0 }]);
            curves.extend(chosen.map(|column| {
                let name = recorder.columns[column].name.split_inclusive(']').next().unwrap_or_default().to_string();
                Curve { panel, column, name, values: Vec::with_capacity(rows) }
            }));
        }
        Self { time: Vec::with_capacity(rows), curves }
    }

    /// Takes in a row.
    pub fn update(&mut self, row: &[f64], time: f64) {
        self.time.push(time);
        self.curves.iter_mut().for_each(|c| c.values.push(row[c.column]));
    }

    /// Draws the picture; the message says what went wrong.
    pub fn draw(&self, path: &Path, title: &str) -> Result<(), String> {
        register_letters();
        let root = SVGBackend::new(path, (1200, 1000)).into_drawing_area();
        self.draw_on(&root, title).map_err(|e| e.to_string())
    }

    fn draw_on(
        &self,
        root: &DrawingArea<SVGBackend, Shift>,
        title: &str,
    ) -> Result<(), Box<dyn std::error::Error + '_>> {
        root.fill(&WHITE)?;
        let root = root.titled(title, ("sans-serif", 20))?;
        let end = self.time.last().copied().unwrap_or(1.0);
        for (panel, area) in root.split_evenly((4, 1)).iter().enumerate() {
            let Panel { title, factor, .. } = PANELS[panel];
            let curves: Vec<&Curve> = self.curves.iter().filter(|c| c.panel == panel).collect();
            let mut chart = ChartBuilder::on(area)
                .caption(title, ("sans-serif", 15))
                .margin_right(20)
                .x_label_area_size(if panel == 3 { 36 } else { 22 })
                .y_label_area_size(60)
                .build_cartesian_2d(0.0..end, limits(&curves, factor))?;
            let mut mesh = chart.configure_mesh();
            mesh.light_line_style(WHITE).x_labels(10).y_labels(5);
            if panel == 3 {
                mesh.x_desc("time, s");
            }
            mesh.draw()?;
            for (curve, color) in curves.iter().zip(COLORS) {
                let points = thin(&self.time, &curve.values).map(|(t, x)| (t, x * factor));
                let series = LineSeries::new(points, color.stroke_width(1));
                chart
                    .draw_series(series)?
                    .label(&curve.name)
                    .legend(move |(x, y)| PathElement::new([(x, y), (x + 14, y)], color));
            }
            if !curves.is_empty() {
                chart
                    .configure_series_labels()
                    .position(SeriesLabelPosition::UpperRight)
                    .background_style(WHITE.mix(0.8))
                    .draw()?;
            }
        }
        root.present()?;
        Ok(())
    }
}

/// Range of the curves, a little wider.
fn limits(curves: &[&Curve], factor: f64) -> Range<f64> {
    let values = || curves.iter().flat_map(|c| &c.values).map(|x| x * factor).filter(|x| x.is_finite());
    let (low, high) = (values().fold(f64::INFINITY, f64::min), values().fold(f64::NEG_INFINITY, f64::max));
    let margin = 0.05 * (high - low);
    if margin > 0.0 { low - margin..high + margin } else { -1.0..1.0 }
}

/// At most `POINTS` points that keep the extremes of every stretch.
fn thin<'a>(time: &'a [f64], values: &'a [f64]) -> impl Iterator<Item = (f64, f64)> + 'a {
    let stretch = (2 * values.len()).div_ceil(POINTS).max(1);
    time.chunks(stretch).zip(values.chunks(stretch)).flat_map(|(t, v)| {
        let low = (0..v.len()).min_by(|a, b| v[*a].total_cmp(&v[*b])).unwrap_or(0);
        let high = (0..v.len()).max_by(|a, b| v[*a].total_cmp(&v[*b])).unwrap_or(0);
        [low.min(high), low.max(high)].map(|i| (t[i], v[i]))
    })
}
