//! The cross-section of a girder: a channel open at the top.
//!
//! ```text
//!         flange            flange          z = −(H − t_s/2 − t_f/2)
//!         ══╦══             ══╦══
//!           ║ web         web ║
//!           ║      track      ║
//!           ╚═════════════════╝             z = 0: middle of the floor
//!           ▔▔▔▔ cross-beam ▔▔▔             z = depth
//!       y = −b                b
//! ```

/// Dimensions of a channel of shells, m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Trough {
    /// b: from the axis to the middle of a web.
    pub half_width: f64,
    /// t_s: thickness of the floor.
    pub floor: f64,
    /// Thickness of a web.
    pub web: f64,
    /// Width of the flange on a web.
    pub flange: f64,
    /// t_f: its thickness.
    pub flange_thickness: f64,
    /// From the middle of the floor to the bottom of a cross-beam.
    pub cross_beam: f64,
    /// Thickness of a cross-beam.
    pub cross_beam_thickness: f64,
}

impl Trough {
    /// Height of the flange's middle above that of the floor for the overall height `height`, m.
    #[must_use]
    pub fn rise(&self, height: f64) -> f64 {
        height - 0.5 * (self.floor + self.flange_thickness)
    }

    /// Parts of the cross-section: area, height of the centre above the floor's, second moment about the own centre.
    fn parts(&self, height: f64) -> [(f64, f64, f64); 3] {
        let rise = self.rise(height);
        let floor = 2.0 * self.half_width * self.floor;
        let web = 2.0 * rise * self.web;
        let flange = 2.0 * self.flange * self.flange_thickness;
        [
            (floor, 0.0, floor * self.floor.powi(2) / 12.0),
            (web, 0.5 * rise, web * rise.powi(2) / 12.0),
            (flange, rise, flange * self.flange_thickness.powi(2) / 12.0),
        ]
    }

    /// A of the shells without cross-beams, m².
    #[must_use]
    pub fn area(&self, height: f64) -> f64 {
        self.parts(height).iter().map(|part| part.0).sum()
    }

    /// Height of the centre of area above the middle of the floor, m.
    #[must_use]
    pub fn centroid(&self, height: f64) -> f64 {
        self.parts(height).iter().map(|part| part.0 * part.1).sum::<f64>() / self.area(height)
    }

    /// Second moment of area for vertical bending, m⁴.
    #[must_use]
    pub fn inertia(&self, height: f64) -> f64 {
        let centre = self.centroid(height);
        self.parts(height).iter().map(|(area, z, own)| own + area * (z - centre).powi(2)).sum()
    }

    /// Volume of one cross-beam, m³.
    #[must_use]
    pub fn cross_beam_volume(&self) -> f64 {
        2.0 * self.half_width * self.cross_beam * self.cross_beam_thickness
    }
}
