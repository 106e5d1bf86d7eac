//! Charts as SVG: axes with round ticks, curves, limits, marks, cells.
//!
//! Colours are classes of the page's style sheet. A curve carries its values in a `data-v` attribute, so that the page's script
//! can read them under the pointer and by keyboard; without it they are in the table beside the chart.

mod axis;
mod cells;
mod curves;
mod svg;

pub use axis::ticks;
pub use cells::{Cells, cells};
pub use curves::{Band, Chart, Curve, Line, thin};
pub use svg::escape;
