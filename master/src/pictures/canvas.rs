//! Pictures as SVG and PNG from one drawing; their letters come along, so that no font of the machine enters.

use std::path::Path;
use std::sync::Once;

use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::register_font;

use super::pen::Pen;
use crate::error::Error;
use crate::files::write;

/// DejaVu Sans, see fonts/LICENSE.
const FONT: &[u8] = include_bytes!("../../fonts/DejaVuSans.ttf");
/// Its name in drawings; an SVG's viewer takes what it has by this name.
pub const SANS: &str = "sans-serif";
/// Points of the grid that both are drawn on, a unit of a picture's size: pixels of the PNG.
const SHARPNESS: u32 = 2;

/// What goes wrong in a drawing.
pub type Failed<'a> = Box<dyn std::error::Error + 'a>;

/// Something that can be drawn on any canvas.
pub trait Drawing {
    /// Width and height in units.
    fn size(&self) -> (u32, u32);

    /// Draws with every length multiplied by `scale`.
    ///
    /// # Errors
    /// The canvas fails.
    fn draw<'a, B: DrawingBackend + 'a>(&self, root: &DrawingArea<B, Shift>, scale: f64) -> Result<(), Failed<'a>>
    where
        B::ErrorType: 'static;
}

/// Writes FILE.svg and FILE.png.
pub fn save(drawing: &impl Drawing, stem: &Path) -> Result<(), Error> {
    let (svg, png) = (stem.with_extension("svg"), stem.with_extension("png"));
    let failed = |path: &Path, why: String| Error::Io { path: path.to_path_buf(), source: std::io::Error::other(why) };
    register_letters();
    write(&svg, vector(drawing).map_err(|why| failed(&svg, why))?.as_bytes())?;
    write(&png, &pixels(drawing).map_err(|why| failed(&png, why))?)
}

/// The drawing as SVG.
fn vector(drawing: &impl Drawing) -> Result<String, String> {
    let (width, height) = drawing.size();
    let grid = (width * SHARPNESS, height * SHARPNESS);
    let mut text = String::new();
    {
        let root = SVGBackend::with_string(&mut text, grid).into_drawing_area();
        let drawn = drawing.draw(&root, f64::from(SHARPNESS)).and_then(|()| root.present().map_err(Into::into));
        drawn.map_err(|e| e.to_string())?;
    }
    // Shown in units, with the joins that the pixels have.
    let of_grid = format!("width=\"{}\" height=\"{}\"", grid.0, grid.1);
    let text = text.replacen(&of_grid, &format!("width=\"{width}\" height=\"{height}\""), 1);
    Ok(text.replace("<polyline ", "<polyline stroke-linejoin=\"round\" stroke-linecap=\"round\" "))
}

/// The drawing as PNG.
fn pixels(drawing: &impl Drawing) -> Result<Vec<u8>, String> {
    let (width, height) = (drawing.size().0 * SHARPNESS, drawing.size().1 * SHARPNESS);
    let mut pixels = vec![255; (width * height * 3) as usize];
    {
        let root = Pen(BitMapBackend::with_buffer(&mut pixels, (width, height))).into_drawing_area();
        let drawn = drawing.draw(&root, f64::from(SHARPNESS)).and_then(|()| root.present().map_err(Into::into));
        drawn.map_err(|e| e.to_string())?;
    }
    let mut file = Vec::new();
    let mut encoder = png::Encoder::new(&mut file, width, height);
    encoder.set_color(png::ColorType::Rgb);
    let written = encoder.write_header().and_then(|mut writer| writer.write_image_data(&pixels));
    written.map_err(|e| e.to_string())?;
    Ok(file)
}

/// Makes [`SANS`] known; needed before any drawing.
fn register_letters() {
    static ONCE: Once = Once::new();
    // The font is part of this program: if it were no font, drawings would say so.
    ONCE.call_once(|| drop(register_font(SANS, FontStyle::Normal, FONT)));
}
