//! The paper's Figures 7 to 10: a quantity over time by all methods, below it a stretch around its peak.

use std::ops::Range;
use std::path::Path;

use plotters::coord::Shift;
use plotters::prelude::*;

use super::canvas::{Drawing, Failed, save};
use super::envelope::Envelope;
use super::panel::{Curve, Panel, Stroke, label, names};
use crate::error::Error;
use crate::results::ran::{QUANTITIES, Ran, Watched};

/// Half of the stretch around the peak, as share of the whole.
const ZOOM: f64 = 0.01;
/// Width of the strip with the curves' names.
const NAMES: f64 = 230.0;

/// Draws all four, each as SVG and PNG; `truth` is what the rows are compared with.
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
        let (charts, beside) = root.split_horizontally(root.dim_in_pixel().0 - (NAMES * scale) as u32);
        let half = ZOOM * longest.max(1.0);
        let peak = self.peak_time();
        let zoom = (peak - half).max(0.0)..(peak + half).min(longest.max(peak + 1e-6));
        let stretches = [(0.0..longest, self.title.as_str()), (zoom, "around its peak")];
        for ((time, title), area) in stretches.into_iter().zip(charts.split_evenly((2, 1))) {
            let curves = self.within(&time);
            let title = format!("{title}, {}", QUANTITIES[self.quantity].unit);
            Panel { title, time, axis: Some("time, s"), shaded: None, curves: &curves }.draw(&area, scale)?;
        }
        names(&beside, self.within(&(0.0..longest)).iter(), None, scale)
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

    /// The curves in a stretch of time; the first is what others are compared with.
    fn within(&self, time: &Range<f64>) -> Vec<Curve> {
        let curve = |(at, ran): (usize, &&Ran)| {
            let mut envelope = Envelope::new(time.start, time.end);
            let values = ran.histories[self.quantity].iter().map(|x| x * QUANTITIES[self.quantity].factor);
            ran.time.iter().zip(values).for_each(|(t, x)| envelope.add(*t, x));
            let name = format!("{}, {} ms", ran.method, label(1e3 * ran.step, 1e3 * ran.step));
            let stroke = if at == 0 { Stroke::reference() } else { Stroke::of(at - 1) };
            Curve { name, points: envelope.points(), stroke }
        };
        self.curves.iter().enumerate().map(curve).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A signal of spikes one step wide, which strokes with mitres would draw far beyond their tips.
    fn rough() -> Ran {
        let time: Vec<f64> = (0..=4000).map(|i| f64::from(i) * 1e-3).collect();
        let mut seed = 1_u64;
        let mut noise = |_: &f64| {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (seed >> 40) as f64 / (1_u64 << 24) as f64 - 0.5
        };
        let values: Vec<f64> = time.iter().map(&mut noise).collect();
        Ran {
            method: "rough".into(),
            step: 1e-3,
            time,
            histories: std::array::from_fn(|_| values.clone()),
            ..Ran::default()
        }
    }

    /// Points of the longer polylines of a colour in an SVG.
    fn polylines(svg: &str, color: &str) -> Vec<Vec<[f64; 2]>> {
        let lines = svg.split("<polyline ").skip(1).filter(|line| line.contains(&format!("stroke=\"{color}\"")));
        let points = |line: &str| -> Vec<[f64; 2]> {
            let text = line.split("points=\"").nth(1).unwrap().split('"').next().unwrap();
            let pairs = text.split_whitespace().map(|pair| pair.split_once(',').unwrap());
            pairs.map(|(x, y)| [x.parse().unwrap(), y.parse().unwrap()]).collect()
        };
        lines.map(points).filter(|line| line.len() > 2).collect()
    }

    /// Least and greatest y of a line between two x.
    fn span(line: &[[f64; 2]], from: f64, to: f64) -> [f64; 2] {
        let mut span = [f64::INFINITY, f64::NEG_INFINITY];
        for pair in line.windows(2).filter(|pair| pair[0][0] <= to && pair[1][0] >= from) {
            let [a, b] = [pair[0], pair[1]];
            let at = |x: f64| if b[0] > a[0] { a[1] + (b[1] - a[1]) * (x - a[0]) / (b[0] - a[0]) } else { a[1] };
            let mut ends = vec![at(a[0].max(from)), at(b[0].min(to))];
            if b[0] == a[0] {
                ends.push(b[1]);
            }
            ends.iter().for_each(|y| span = [span[0].min(*y), span[1].max(*y)]);
        }
        span
    }

    #[test]
    fn pixels_and_vectors_of_a_rough_signal_are_the_same_picture() {
        const REACH: f64 = 4.0; // half the width of the broad line, 6 pixels, and one more
        let folder = tempfile::tempdir().unwrap();
        let watched = Watched { point: "mid".into(), car: 1, wheel: 1 };
        draw(&[], Some(&rough()), &watched, folder.path()).unwrap();
        let stem = folder.path().join("figure-8-deck-acceleration");
        let svg = std::fs::read_to_string(stem.with_extension("svg")).unwrap();
        let file = std::io::BufReader::new(std::fs::File::open(stem.with_extension("png")).unwrap());
        let mut reader = png::Decoder::new(file).read_info().unwrap();
        let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
        let size = reader.next_frame(&mut pixels).unwrap();
        let width = size.width as usize;
        assert!(svg.starts_with("<svg width=\"1240\" height=\"760\" viewBox=\"0 0 2480 1520\""));
        let lines = polylines(&svg, "#282828");
        assert_eq!(lines.len(), 2);
        for line in &lines {
            let (first, last) = (line[0][0] as usize + 4, line[line.len() - 1][0] as usize - 4);
            // As far as the margin between the curve and the axes reaches.
            let all = span(line, 0.0, f64::INFINITY);
            let tall = all[0] as usize - 20..all[1] as usize + 20;
            // Not on a line of the grid, which is dark where it crosses another.
            let free = |column: &usize| pixels[3 * (tall.start * width + column)] == 255;
            for column in (first..last).filter(free) {
                // Darker than the grid.
                let dark = |row: &usize| pixels[3 * (row * width + column)..][..3].iter().all(|c| *c < 195);
                let rows: Vec<f64> = tall.clone().filter(dark).map(|row| row as f64 + 0.5).collect();
                let x = column as f64 + 0.5;
                let (around, inside) = (span(line, x - REACH, x + REACH), span(line, x, x));
                let (top, bottom) = (rows[0], rows[rows.len() - 1]);
                assert!(
                    top >= around[0] - REACH && bottom <= around[1] + REACH,
                    "{column}: {top}, {bottom}, {around:?}"
                );
                assert!(
                    top <= inside[0] + REACH && bottom >= inside[1] - REACH,
                    "{column}: {top}, {bottom}, {inside:?}"
                );
            }
        }
    }
}
