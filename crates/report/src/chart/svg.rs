//! Pieces of SVG text.

use std::fmt::Write;

/// Text inside an element or attribute.
pub fn escape(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

/// A pixel coordinate: a tenth is enough.
pub(super) fn px(value: f64) -> String {
    let text = format!("{value:.1}");
    text.strip_suffix(".0").map_or(text.clone(), str::to_string)
}

/// SVG text that grows.
pub(super) struct Svg(pub String);

impl Svg {
    /// A picture of this size with a name for those who do not see it.
    pub fn new(width: f64, height: f64, name: &str, class: &str) -> Self {
        let mut text = String::new();
        let (name, w, h) = (escape(name), px(width), px(height));
        let _ = write!(
            text,
            "<svg viewBox=\"0 0 {w} {h}\" class=\"{class}\" role=\"img\" aria-label=\"{name}\" tabindex=\"0\">"
        );
        Self(text)
    }

    pub fn line(&mut self, class: &str, [x1, y1]: [f64; 2], [x2, y2]: [f64; 2]) {
        let [x1, y1, x2, y2] = [x1, y1, x2, y2].map(px);
        let _ = write!(self.0, "<line class=\"{class}\" x1=\"{x1}\" y1=\"{y1}\" x2=\"{x2}\" y2=\"{y2}\"/>");
    }

    pub fn text(&mut self, class: &str, [x, y]: [f64; 2], anchor: &str, text: &str) {
        let (x, y, text) = (px(x), px(y), escape(text));
        let _ = write!(self.0, "<text class=\"{class}\" x=\"{x}\" y=\"{y}\" text-anchor=\"{anchor}\">{text}</text>");
    }

    pub fn rect(&mut self, class: &str, [x, y]: [f64; 2], [w, h]: [f64; 2], title: &str) {
        let [x, y, w, h] = [x, y, w, h].map(px);
        let _ = write!(self.0, "<rect class=\"{class}\" x=\"{x}\" y=\"{y}\" width=\"{w}\" height=\"{h}\"");
        if title.is_empty() {
            self.0.push_str("/>");
        } else {
            let _ = write!(self.0, "><title>{}</title></rect>", escape(title));
        }
    }

    pub fn polyline(&mut self, class: &str, points: impl Iterator<Item = [f64; 2]>, data: &str) {
        let _ = write!(self.0, "<polyline class=\"{class}\"{data} points=\"");
        for (i, [x, y]) in points.enumerate() {
            let space = if i > 0 { " " } else { "" };
            let _ = write!(self.0, "{space}{},{}", px(x), px(y));
        }
        self.0.push_str("\"/>");
    }

    pub fn end(mut self) -> String {
        self.0.push_str("</svg>");
        self.0
    }
}
