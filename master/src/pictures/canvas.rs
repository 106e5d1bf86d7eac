//! Pictures as SVG and PNG from one drawing; their letters come along, so that no font of the machine enters.

use std::fs::File;
use std::io::BufWriter;
use std::path::Path;
use std::sync::Once;

use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::register_font;

use crate::error::Error;

/// DejaVu Sans, see fonts/LICENSE.
const FONT: &[u8] = include_bytes!("../../fonts/DejaVuSans.ttf");
/// Its name in drawings; an SVG's viewer takes what it has by this name.
pub const SANS: &str = "sans-serif";
/// Pixels of the PNG a unit of the SVG.
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

/// Makes [`SANS`] known; needed before any drawing.
pub fn register_letters() {
    static ONCE: Once = Once::new();
    // The font is part of this program: if it were no font, drawings would say so.
    ONCE.call_once(|| drop(register_font(SANS, FontStyle::Normal, FONT)));
}

/// Writes FILE.svg and FILE.png.
pub fn save(drawing: &impl Drawing, stem: &Path) -> Result<(), Error> {
    let (svg, png) = (stem.with_extension("svg"), stem.with_extension("png"));
    let failed = |path: &Path, why: String| Error::Io { path: path.to_path_buf(), source: std::io::Error::other(why) };
    register_letters();
    let root = SVGBackend::new(&svg, drawing.size()).into_drawing_area();
    let drawn = drawing.draw(&root, 1.0).and_then(|()| root.present().map_err(Into::into));
    drawn.map_err(|e| failed(&svg, e.to_string()))?;
    let (width, height) = (drawing.size().0 * SHARPNESS, drawing.size().1 * SHARPNESS);
    let mut pixels = vec![255; (width * height * 3) as usize];
    {
        let root = BitMapBackend::with_buffer(&mut pixels, (width, height)).into_drawing_area();
        let drawn = drawing.draw(&root, f64::from(SHARPNESS)).and_then(|()| root.present().map_err(Into::into));
        drawn.map_err(|e| failed(&png, e.to_string()))?;
    }
    let file = BufWriter::new(File::create(&png).map_err(Error::io(&png))?);
    let mut encoder = png::Encoder::new(file, width, height);
    encoder.set_color(png::ColorType::Rgb);
    let written = encoder.write_header().and_then(|mut writer| writer.write_image_data(&pixels));
    written.map_err(|e| failed(&png, e.to_string()))
}

/// Without rounding noise, nor a minus before zero.
pub fn rounded(x: f64) -> f64 {
    (1e6 * x).round() / 1e6 + 0.0
}
