//! A chart of curves over time, and the names of its curves beside it: the same colours, limits and labels in all pictures.

use std::ops::Range;

use plotters::coord::Shift;
use plotters::prelude::*;

use super::canvas::{Failed, SANS};
use super::envelope::Point;

/// Colours of curves, in order and again from the first.
const COLORS: [RGBColor; 8] = [
    RGBColor(31, 85, 142),
    RGBColor(214, 96, 36),
    RGBColor(64, 140, 88),
    RGBColor(150, 60, 150),
    RGBColor(190, 150, 20),
    RGBColor(90, 170, 200),
    RGBColor(200, 60, 90),
    RGBColor(110, 110, 110),
];
/// What others are compared with.
const REFERENCE: RGBColor = RGBColor(40, 40, 40);
/// A stretch of time.
const SHADE: RGBColor = RGBColor(225, 232, 240);
/// Share of the curves' range that is free above and below them.
const MARGIN: f64 = 0.05;

/// A curve as it is drawn.
pub struct Curve {
    /// Beside the chart.
    pub name: String,
    /// Time in s, and value.
    pub points: Vec<Point>,
    /// Colour, width and opacity.
    pub stroke: Stroke,
}

/// How a curve is drawn.
#[derive(Clone, Copy, Debug)]
pub struct Stroke {
    color: RGBColor,
    width: f64,
    opacity: f64,
}

impl Stroke {
    /// Of the curve at a place in the order, from 0.
    pub fn of(place: usize) -> Self {
        Self { color: COLORS[place % COLORS.len()], width: 1.0, opacity: 1.0 }
    }

    /// Of a curve that others are compared with: broad and light, so that all others are seen on it.
    pub fn reference() -> Self {
        Self { color: REFERENCE, width: 3.0, opacity: 0.35 }
    }

    /// Of a curve without a name, behind those that have one.
    pub fn rest() -> Self {
        Self { color: REFERENCE, width: 1.0, opacity: 0.25 }
    }

    fn style(self, scale: f64) -> ShapeStyle {
        self.color.mix(self.opacity).stroke_width((self.width * scale).round() as u32)
    }
}

/// A chart.
pub struct Panel<'a> {
    /// Above it.
    pub title: String,
    /// Its axis: of time, s, or of what else the picture is over.
    pub time: Range<f64>,
    /// The name below the axis, if it has one.
    pub axis: Option<&'static str>,
    /// A stretch of time that is shaded, s.
    pub shaded: Option<Range<f64>>,
    /// The curves; none leaves the axes.
    pub curves: &'a [Curve],
}

impl Panel<'_> {
    /// Draws the chart; `left` is the width of the labels beside the axis, in units.
    ///
    /// # Errors
    /// The canvas fails.
    pub fn draw<'a, B: DrawingBackend + 'a>(&self, area: &DrawingArea<B, Shift>, scale: f64) -> Result<(), Failed<'a>>
    where
        B::ErrorType: 'static,
    {
        let px = |length: f64| (length * scale).round() as u32;
        let letters = |size: f64| (SANS, size * scale);
        let limits = limits(self.curves.iter().flat_map(|curve| &curve.points).map(|point| point.1));
        let (time, span) = (self.time.clone(), limits.end - limits.start);
        let mut chart = ChartBuilder::on(area)
            .caption(&self.title, letters(15.0))
            .margin(px(4.0))
            .margin_right(px(24.0))
            .x_label_area_size(px(if self.axis.is_some() { 36.0 } else { 22.0 }))
            .y_label_area_size(px(66.0))
            .build_cartesian_2d(time.clone(), limits.clone())?;
        if let Some(shaded) = &self.shaded {
            let (begin, end) = (shaded.start.max(time.start), shaded.end.min(time.end));
            if begin < end {
                let corners = [(begin, limits.start), (end, limits.end)];
                chart.draw_series([Rectangle::new(corners, SHADE.filled())])?;
            }
        }
        let mut mesh = chart.configure_mesh();
        mesh.light_line_style(TRANSPARENT).x_labels(10).y_labels(5);
        let (of_time, of_value) = (|t: &f64| label(*t, time.end - time.start), |x: &f64| label(*x, span));
        mesh.x_label_formatter(&of_time).y_label_formatter(&of_value);
        if let Some(axis) = self.axis {
            mesh.x_desc(axis);
        }
        mesh.label_style(letters(12.0)).axis_desc_style(letters(13.0)).draw()?;
        for curve in self.curves {
            chart.draw_series(LineSeries::new(curve.points.iter().copied(), curve.stroke.style(scale)))?;
        }
        Ok(())
    }
}

/// Names of curves from the top of an area downwards; of the shaded stretch, if there is one.
///
/// # Errors
/// The canvas fails.
pub fn names<'a, 'c, B: DrawingBackend + 'a>(
    area: &DrawingArea<B, Shift>,
    curves: impl Iterator<Item = &'c Curve>,
    shaded: Option<&str>,
    scale: f64,
) -> Result<(), Failed<'a>>
where
    B::ErrorType: 'static,
{
    let px = |length: f64| (length * scale).round() as i32;
    let row = |at: usize| px(40.0 + 20.0 * at as f64);
    let text =
        |name: &str, y: i32| Text::new(name.to_string(), (px(30.0), y - px(7.0)), (SANS, 12.0 * scale).into_font());
    let mut count = 0;
    for (at, curve) in curves.enumerate() {
        count = at + 1;
        let y = row(at);
        area.draw(&PathElement::new(vec![(px(4.0), y), (px(24.0), y)], curve.stroke.style(scale)))?;
        area.draw(&text(&curve.name, y))?;
    }
    if let Some(name) = shaded {
        let y = row(count);
        area.draw(&Rectangle::new([(px(4.0), y - px(6.0)), (px(24.0), y + px(6.0))], SHADE.filled()))?;
        area.draw(&text(name, y))?;
    }
    Ok(())
}

/// Range of values, a little wider; what is not finite is left out.
fn limits(values: impl Iterator<Item = f64>) -> Range<f64> {
    let finite = values.filter(|x| x.is_finite());
    let (low, high) = finite.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)));
    // A constant, however large, stands in the middle.
    let margin = (MARGIN * (high - low)).max(1e-9 * high.abs());
    match high - low {
        wide if wide >= 0.0 && margin > 0.0 => low - margin..high + margin,
        _ => -1.0..1.0,
    }
}

/// A number on an axis as long as `span`: no digits of rounding, no minus before zero.
pub fn label(x: f64, span: f64) -> String {
    let digits = (4.0 - span.abs().max(1e-300).log10().floor()).clamp(0.0, 12.0) as usize;
    let text = format!("{x:.digits$}");
    let text = if digits > 0 { text.trim_end_matches('0').trim_end_matches('.') } else { &text };
    if text == "-0" { "0".into() } else { text.into() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn labels_have_no_rounding_and_no_minus_before_zero() {
        let labels = [(-0.0, 1.0), (0.1 + 0.2, 1.0), (-1e-17, 0.4), (-2.5e-7, 1e-6), (1_250.0, 3e3), (1e7, 5e6)];
        let texts = labels.map(|(x, span)| label(x, span));
        assert_eq!(texts, ["0", "0.3", "0", "-0.00000025", "1250", "10000000"]);
    }

    #[test]
    fn limits_hold_every_finite_value_and_a_constant_one() {
        let of = |values: &[f64]| limits(values.iter().copied());
        assert_eq!(of(&[]), -1.0..1.0);
        assert_eq!(of(&[0.0, f64::NAN, 10.0]), -0.5..10.5);
        assert!(of(&[7e4, 7e4]).contains(&7e4) && of(&[0.0]).contains(&0.0));
    }
}
