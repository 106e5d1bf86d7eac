//! Curves over an axis, with limits, marks and bands.

use std::fmt::Write;

use super::axis::{Scale, label, ticks};
use super::svg::{Svg, escape};
use crate::number::short;

const WIDTH: f64 = 720.0;
const LEFT: f64 = 62.0;
const RIGHT: f64 = 14.0;
const TOP: f64 = 12.0;
const BOTTOM: f64 = 40.0;
/// Columns of pixels of a long curve; in each its least and greatest value are kept.
const COLUMNS: usize = 600;

/// A curve.
#[derive(Clone, Debug)]
pub struct Curve {
    /// Its name; empty: not in the legend.
    pub name: String,
    /// Class of the style sheet: `c1` … `c4`, `grey`, with `thin` or `dash` beside it.
    pub class: String,
    /// Rising abscissas, and values.
    pub points: Vec<[f64; 2]>,
    /// Points that are drawn as dots, by position.
    pub dots: Vec<usize>,
}

/// A line across the chart at a value or an abscissa.
#[derive(Clone, Debug)]
pub struct Line {
    /// Where.
    pub at: f64,
    /// Beside it.
    pub name: String,
    /// Class.
    pub class: &'static str,
}

/// A shaded range of the abscissa.
#[derive(Clone, Debug)]
pub struct Band {
    /// From, to.
    pub range: [f64; 2],
    /// What it is.
    pub name: String,
}

/// A chart.
#[derive(Clone, Debug, Default)]
pub struct Chart {
    /// For those who do not see it.
    pub name: String,
    /// Name of the abscissa with unit.
    pub x_name: String,
    /// Name of the value with unit.
    pub y_name: String,
    /// Curves, the first drawn first.
    pub curves: Vec<Curve>,
    /// Bars from zero: abscissa, value, class.
    pub bars: Vec<([f64; 2], &'static str)>,
    /// Lines of constant value.
    pub across: Vec<Line>,
    /// Lines of constant abscissa.
    pub upright: Vec<Line>,
    /// Shaded ranges.
    pub bands: Vec<Band>,
    /// Abscissas that belong to the picture of bars in any case.
    pub bars_over: Option<[f64; 2]>,
    /// Height in pixels; 0: the usual one.
    pub height: f64,
    /// Whether 0 belongs to the values.
    pub from_zero: bool,
}

impl Chart {
    /// The picture; empty without a point.
    pub fn svg(&self) -> String {
        let bars = || self.bars.iter().map(|(bar, _)| bar);
        let all = || self.curves.iter().flat_map(|curve| &curve.points).chain(bars());
        let wide = self.bars_over.iter().flatten().copied();
        let Some(x) = range(all().map(|p| p[0]).chain(wide)) else { return String::new() };
        let limits = self.across.iter().map(|line| line.at);
        let zero = self.from_zero.then_some(0.0);
        let Some(y) = range(all().map(|p| p[1]).chain(limits).chain(zero)) else { return String::new() };
        let height = if self.height > 0.0 { self.height } else { 300.0 };
        let margin = 0.05 * (y[1] - y[0]).max(1e-12 * y[1].abs());
        let low = if self.from_zero && y[0] >= 0.0 { 0.0 } else { y[0] - margin };
        let across = Scale { low: x[0], high: x[1], from: LEFT, to: WIDTH - RIGHT };
        let up = Scale { low, high: y[1] + margin, from: height - BOTTOM, to: TOP };
        let mut svg = Svg::new(WIDTH, height, &self.name, "chart");
        for band in &self.bands {
            let [a, b] = band.range.map(|x| across.at(x.clamp(across.low, across.high)));
            if b > a {
                svg.rect("band", [a, TOP], [b - a, up.from - TOP], &band.name);
            }
        }
        self.axes(&mut svg, across, up, height);
        // Upright names at different heights, so that neighbours do not cover each other.
        let shown = self.upright.iter().filter(|line| across.holds(line.at));
        for (i, line) in shown.enumerate() {
            let at = across.at(line.at);
            svg.line(line.class, [at, TOP], [at, up.from]);
            let (x, anchor) = if at > WIDTH - 110.0 { (at - 3.0, "end") } else { (at + 3.0, "start") };
            svg.text("mark", [x, TOP + 10.0 + 12.0 * (i % 4) as f64], anchor, &line.name);
        }
        for ([x, y], class) in &self.bars {
            svg.line(class, [across.at(*x), up.at(0.0)], [across.at(*x), up.at(*y)]);
        }
        for curve in &self.curves {
            self.curve(&mut svg, curve, across, up);
        }
        for line in &self.across {
            let y = up.at(line.at);
            svg.line(line.class, [LEFT, y], [WIDTH - RIGHT, y]);
            svg.text("limit-name", [WIDTH - RIGHT - 3.0, y - 4.0], "end", &line.name);
        }
        svg.end() + &self.legend()
    }

    fn axes(&self, svg: &mut Svg, across: Scale, up: Scale, height: f64) {
        for tick in ticks(across.low, across.high, 7) {
            let at = across.at(tick);
            svg.line("grid", [at, TOP], [at, up.from]);
            svg.text("tick", [at, up.from + 14.0], "middle", &label(tick));
        }
        for tick in ticks(up.low, up.high, 5) {
            let at = up.at(tick);
            svg.line("grid", [LEFT, at], [WIDTH - RIGHT, at]);
            svg.text("tick", [LEFT - 5.0, at + 4.0], "end", &label(tick));
        }
        svg.line("axis", [LEFT, up.from], [WIDTH - RIGHT, up.from]);
        svg.line("axis", [LEFT, TOP], [LEFT, up.from]);
        svg.text("name", [0.5 * (LEFT + WIDTH - RIGHT), height - 6.0], "middle", &self.x_name);
        let middle = 0.5 * (TOP + up.from);
        let name = escape(&self.y_name);
        let _ = write!(
            svg.0,
            "<text class=\"name\" transform=\"translate(13,{middle:.0}) rotate(-90)\" text-anchor=\"middle\">{name}</text>"
        );
    }

    fn curve(&self, svg: &mut Svg, curve: &Curve, across: Scale, up: Scale) {
        let mut data = String::new();
        if !curve.name.is_empty() && curve.points.len() <= COLUMNS {
            let values = curve.points.iter().map(|[x, y]| format!("{} {}", short(*x), crate::number::digits(*y, 4)));
            let values: Vec<String> = values.collect();
            data = format!(" data-n=\"{}\" data-v=\"{}\"", escape(&curve.name), values.join(","));
        }
        let points = thin(&curve.points, COLUMNS);
        svg.polyline(&format!("curve {}", curve.class), points.iter().map(|[x, y]| [across.at(*x), up.at(*y)]), &data);
        for dot in &curve.dots {
            if let Some([x, y]) = curve.points.get(*dot) {
                let (cx, cy, class) = (across.at(*x), up.at(*y), &curve.class);
                let title = format!("{}: {} at {}", curve.name, crate::number::digits(*y, 4), short(*x));
                let _ = write!(
                    svg.0,
                    "<circle class=\"dot {class}\" cx=\"{cx:.1}\" cy=\"{cy:.1}\" r=\"2.4\"><title>{}</title></circle>",
                    escape(&title)
                );
            }
        }
    }

    fn legend(&self) -> String {
        let named: Vec<&Curve> =
            self.curves.iter().filter(|curve| !curve.name.is_empty() && !curve.class.contains("grey")).collect();
        let mut text = String::from("<ul class=\"legend\">");
        for curve in named {
            let _ = write!(
                text,
                "<li><svg viewBox=\"0 0 30 8\" aria-hidden=\"true\"><line class=\"curve {}\" x1=\"0\" y1=\"4\" x2=\"30\" y2=\"4\"/></svg> {}</li>",
                curve.class,
                escape(&curve.name)
            );
        }
        let grey = self.curves.iter().filter(|curve| curve.class.contains("grey")).count();
        if grey > 0 {
            let _ = write!(
                text,
                "<li><svg viewBox=\"0 0 30 8\" aria-hidden=\"true\"><line class=\"curve grey\" x1=\"0\" y1=\"4\" x2=\"30\" y2=\"4\"/></svg> {grey} others</li>"
            );
        }
        if text.ends_with("\">") {
            return "<p class=\"readout\" aria-live=\"polite\"></p>".into();
        }
        text + "</ul><p class=\"readout\" aria-live=\"polite\"></p>"
    }
}

/// Least and greatest finite value; of a constant a little beside it.
fn range(values: impl Iterator<Item = f64>) -> Option<[f64; 2]> {
    let finite = values.filter(|value| value.is_finite());
    let [low, high] = finite.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], v| [low.min(v), high.max(v)]);
    match high - low {
        wide if wide > 0.0 => Some([low, high]),
        0.0 => Some([low - 0.5 * low.abs().max(1.0), high + 0.5 * high.abs().max(1.0)]),
        _ => None,
    }
}

/// The least and the greatest point of every column of a long curve, in order.
pub fn thin(points: &[[f64; 2]], columns: usize) -> Vec<[f64; 2]> {
    if points.len() <= 2 * columns {
        return points.to_vec();
    }
    let size = points.len().div_ceil(columns);
    let mut kept = Vec::with_capacity(2 * columns);
    for chunk in points.chunks(size) {
        let by = |a: &&[f64; 2], b: &&[f64; 2]| a[1].total_cmp(&b[1]);
        let (Some(low), Some(high)) = (chunk.iter().min_by(by), chunk.iter().max_by(by)) else { continue };
        kept.extend(if low[0] < high[0] { [*low, *high] } else { [*high, *low] });
    }
    kept
}
