//! Pixels with the strokes of a vector drawing: joins and ends are round, so that no spike grows beyond its points.
//!
//! ```text
//! coverage of a pixel = clamp(w/2 + 1/2 − d, 0, 1),     d its distance from the line, w the width of the stroke
//! ```
//!
//! A stroke is mixed into the picture once, by the greatest coverage of its pieces: light strokes have no spots at joins.

use plotters::prelude::BitMapBackend;
use plotters_backend::{BackendColor, BackendCoord, BackendStyle, BackendTextStyle, DrawingBackend, DrawingErrorKind};

type Error = <BitMapBackend<'static> as DrawingBackend>::ErrorType;
type Done = Result<(), DrawingErrorKind<Error>>;

/// A canvas of pixels.
pub struct Pen<'a>(pub BitMapBackend<'a>);

impl DrawingBackend for Pen<'_> {
    type ErrorType = Error;

    fn get_size(&self) -> (u32, u32) {
        self.0.get_size()
    }

    fn ensure_prepared(&mut self) -> Done {
        self.0.ensure_prepared()
    }

    fn present(&mut self) -> Done {
        self.0.present()
    }

    fn draw_pixel(&mut self, point: BackendCoord, color: BackendColor) -> Done {
        self.0.draw_pixel(point, color)
    }

    fn draw_line<S: BackendStyle>(&mut self, from: BackendCoord, to: BackendCoord, style: &S) -> Done {
        self.0.draw_line(from, to, style)
    }

    fn draw_rect<S: BackendStyle>(&mut self, a: BackendCoord, b: BackendCoord, style: &S, fill: bool) -> Done {
        self.0.draw_rect(a, b, style, fill)
    }

    fn draw_circle<S: BackendStyle>(&mut self, at: BackendCoord, radius: u32, style: &S, fill: bool) -> Done {
        self.0.draw_circle(at, radius, style, fill)
    }

    fn draw_text<T: BackendTextStyle>(&mut self, text: &str, style: &T, at: BackendCoord) -> Done {
        self.0.draw_text(text, style, at)
    }

    fn draw_path<S: BackendStyle, I: IntoIterator<Item = BackendCoord>>(&mut self, path: I, style: &S) -> Done {
        let points: Vec<[f64; 2]> = path.into_iter().map(|(x, y)| [f64::from(x), f64::from(y)]).collect();
        let color = style.color();
        for (pixel, coverage) in stroke(&points, f64::from(style.stroke_width()), self.get_size()) {
            self.draw_pixel(pixel, BackendColor { alpha: color.alpha * coverage, ..color })?;
        }
        Ok(())
    }
}

/// The pixels of a line through points, of some width, and how much of each it covers.
fn stroke(points: &[[f64; 2]], width: f64, (across, down): (u32, u32)) -> Vec<(BackendCoord, f64)> {
    let reach = 0.5 * width + 0.5;
    let bounds = |axis: usize, a: &[[f64; 2]], size: u32| {
        let (low, high) =
            a.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), p| (l.min(p[axis]), h.max(p[axis])));
        let clamp = |x: f64| x.clamp(0.0, f64::from(size)) as usize;
        clamp((low - reach).floor())..clamp((high + reach).ceil())
    };
    let (columns, rows) = (bounds(0, points, across), bounds(1, points, down));
    let mut covered = vec![0.0_f32; columns.len() * rows.len()];
    for piece in points.windows(2) {
        for j in bounds(1, piece, down) {
            for i in bounds(0, piece, across) {
                let coverage = (reach - distance([i as f64 + 0.5, j as f64 + 0.5], piece[0], piece[1])).clamp(0.0, 1.0);
                let pixel = &mut covered[(j - rows.start) * columns.len() + i - columns.start];
                *pixel = pixel.max(coverage as f32);
            }
        }
    }
    let place = |at: usize| ((columns.start + at % columns.len()) as i32, (rows.start + at / columns.len()) as i32);
    covered.into_iter().enumerate().filter(|(_, c)| *c > 0.0).map(|(at, c)| (place(at), f64::from(c))).collect()
}

/// Distance of a point from the straight piece between two others.
fn distance([x, y]: [f64; 2], a: [f64; 2], b: [f64; 2]) -> f64 {
    let along = [b[0] - a[0], b[1] - a[1]];
    let length2 = along[0] * along[0] + along[1] * along[1];
    let share =
        if length2 > 0.0 { (((x - a[0]) * along[0] + (y - a[1]) * along[1]) / length2).clamp(0.0, 1.0) } else { 0.0 };
    (x - a[0] - share * along[0]).hypot(y - a[1] - share * along[1])
}
