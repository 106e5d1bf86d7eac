//! Cells: train × speed, or place × time, shaded by a value.

use super::axis::{Scale, label, ticks};
use super::svg::Svg;
use crate::number::digits;

const WIDTH: f64 = 720.0;
const LEFT: f64 = 84.0;
const RIGHT: f64 = 14.0;
const TOP: f64 = 6.0;
const BOTTOM: f64 = 40.0;

/// Rows of cells.
pub struct Cells<'a> {
    /// For those who do not see it.
    pub name: &'a str,
    /// Name of the abscissa.
    pub x_name: &'a str,
    /// Rising abscissas.
    pub x: &'a [f64],
    /// Names of rows, from the top; one a row.
    pub rows: &'a [String],
    /// Values, a list a row; `None`: nothing was computed.
    pub values: &'a [Vec<Option<f64>>],
    /// Class and title of a value.
    pub class: &'a dyn Fn(f64) -> &'static str,
    /// Height of a row.
    pub height: f64,
    /// Lines over the cells: abscissa and row of both ends.
    pub lines: &'a [[[f64; 2]; 2]],
}

/// The picture.
pub fn cells(of: &Cells) -> String {
    let (Some(first), Some(last)) = (of.x.first(), of.x.last()) else { return String::new() };
    if of.values.is_empty() {
        return String::new();
    }
    let height = TOP + of.height * of.values.len() as f64 + BOTTOM;
    let half = if of.x.len() > 1 { 0.5 * (of.x[1] - of.x[0]) } else { 0.5 };
    let across = Scale { low: first - half, high: last + half, from: LEFT, to: WIDTH - RIGHT };
    let mut svg = Svg::new(WIDTH, height, of.name, "chart cells");
    for (i, values) in of.values.iter().enumerate() {
        let y = TOP + of.height * i as f64;
        let name = of.rows.get(i).map_or("", String::as_str);
        if !name.is_empty() {
            svg.text("tick", [LEFT - 5.0, y + 0.5 * of.height + 4.0], "end", name);
        }
        // Neighbours of one class are one rectangle where a single value is not to be read.
        let mut k = 0;
        while k < values.len() {
            let Some(value) = values[k] else {
                k += 1;
                continue;
            };
            let class = (of.class)(value);
            let mut end = k + 1;
            if name.is_empty() {
                while end < values.len() && values[end].is_some_and(|other| (of.class)(other) == class) {
                    end += 1;
                }
            }
            let edge = |k: usize| match k {
                0 => across.low,
                k if k == of.x.len() => across.high,
                k => 0.5 * (of.x[k - 1] + of.x[k]),
            };
            let (a, b) = (across.at(edge(k)), across.at(edge(end)));
            let title = if name.is_empty() {
                String::new()
            } else {
                format!("{name}, {}: {}", label(of.x[k]), digits(value, 3))
            };
            if class != "h0" || !name.is_empty() {
                svg.rect(class, [a, y], [b - a + 0.2, of.height], &title);
            }
            k = end;
        }
    }
    for ends in of.lines {
        let [a, b] = ends.map(|[x, row]| [across.at(x), TOP + of.height * row]);
        svg.line("path", a, b);
    }
    let bottom = TOP + of.height * of.values.len() as f64;
    for tick in ticks(across.low, across.high, 7) {
        let at = across.at(tick);
        svg.line("axis", [at, bottom], [at, bottom + 4.0]);
        svg.text("tick", [at, bottom + 16.0], "middle", &label(tick));
    }
    svg.text("name", [0.5 * (LEFT + WIDTH - RIGHT), height - 6.0], "middle", of.x_name);
    svg.end()
}
