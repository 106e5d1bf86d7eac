//! Simply supported girders in a row on rigid supports; one of them is a span.

use ttb_scenario::types::{Bearings, DeckCarrier, DeckLine, Freedom, Model};

use crate::builder::Builder;
use crate::cable_stayed::even;
use crate::error::{Refused, Rules};
use crate::fit::fit;
use crate::girder::{Girder, STRIP};
use crate::plan;
use crate::trough::Trough;

/// What can be chosen of a viaduct.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Viaduct {
    /// Number of girders.
    pub spans: usize,
    /// Length of each, m.
    pub span: f64,
    /// Width over the flanges, m.
    pub width: f64,
    /// Overall height, m.
    pub depth: f64,
    /// y of the track's axis, m.
    pub track_y: f64,
    /// Degrees of freedom aimed at, in all.
    pub dofs: usize,
}

impl Default for Viaduct {
    fn default() -> Self {
        Self { spans: 10, span: 32.0, width: 10.8, depth: 3.5, track_y: 0.0, dofs: 120_000 }
    }
}

const SOURCE: &str = "Made by `ttb generate`. Simply supported channel girders of concrete C50 in a row on rigid supports; \
thicknesses in proportion to those of the 32 m girder before the cable-stayed bridge of the same program, dead load of the \
track 67.9 kN/m. z = 0 is the middle of the floor. Estimates, not an existing bridge.";

/// One simply supported girder of `length` m, `width` m wide and `depth` m high, of about `dofs` degrees of freedom.
///
/// # Errors
/// As [`viaduct`].
pub fn simple_span(length: f64, width: f64, depth: f64, dofs: usize) -> Result<Model, Refused> {
    viaduct(&Viaduct { spans: 1, span: length, width, depth, dofs, ..Viaduct::default() })
}

/// The viaduct as a finite-element model.
///
/// # Errors
/// Dimensions that make no girder, a track beside the floor, too few or too many degrees of freedom.
pub fn viaduct(asked: &Viaduct) -> Result<Model, Refused> {
    let trough = asked.trough();
    let mut rules = Rules::default();
    rules.demand((1..=10_000).contains(&asked.spans), "spans must be 1 to 10000", asked.spans);
    rules.demand((4.0..=200.0).contains(&asked.span), "a span must be 4 to 200 m long", asked.span);
    rules.demand((6.0..=30.0).contains(&asked.width), "the width must be 6 to 30 m", asked.width);
    rules.demand((1.0..=20.0).contains(&asked.depth), "the depth must be 1 to 20 m", asked.depth);
    let room = trough.half_width - 0.5 * trough.web - STRIP;
    let rule = format!("track_y must lie between {:.2} and {room:.2} m", -room);
    rules.demand(asked.track_y.abs() <= room, &rule, asked.track_y);
    rules.result()?;
    let girders: Vec<Girder> = (0..asked.spans).map(|i| asked.girder(trough, i as f64 * asked.span)).collect();
    let one = asked.girder(trough, 0.0);
    let bay = asked.span / (one.cross_beams.len() - 1) as f64;
    let count = |mesh| asked.spans * (6 * one.nodes(mesh) - HELD);
    let mesh = fit(asked.dofs, bay, 2.0 * trough.half_width, count)?;

    let mut b = Builder::new(SOURCE);
    b.material("C50", plan::MODULUS, plan::POISSON, plan::DENSITY);
    one.add_sections(&mut b, "C50", plan::TRACK_LOAD);
    let (mut along, mut bearings, mut guides) = (Vec::new(), Vec::new(), Vec::new());
    for (i, girder) in girders.iter().enumerate() {
        let placed = girder.add(&mut b, mesh);
        let [from, to] = [i as f64, (i + 1) as f64].map(|n| n * asked.span);
        along.extend(placed.edges(from));
        for end in [from, to] {
            bearings.extend(placed.corners(end));
            guides.push(placed.middle(end).0);
        }
    }
    let held = [(along, Freedom::X), (guides, Freedom::Y), (bearings, Freedom::Z)];
    b.model.bearings = held.into_iter().map(|(nodes, fixed)| Bearings { nodes, fixed: vec![fixed] }).collect();
    let on = DeckCarrier::Shells(one.floor().to_vec());
    b.model.deck = DeckLine { length: asked.spans as f64 * asked.span, y: asked.track_y, z: None, on };
    Ok(b.model)
}

/// Degrees of freedom that the bearings of a girder hold.
const HELD: usize = 2 + 2 + 4;

impl Viaduct {
    /// The girders' cross-section: thicknesses and widths in proportion to the girder before the cable-stayed bridge.
    #[must_use]
    pub fn trough(&self) -> Trough {
        let like = plan::APPROACH;
        let wide = self.width / (2.0 * like.half_width + like.flange);
        let high = self.depth / plan::LOW;
        Trough {
            half_width: like.half_width * wide,
            floor: like.floor * wide,
            web: like.web * wide,
            flange: like.flange * wide,
            flange_thickness: like.flange_thickness * high,
            cross_beam: like.cross_beam * wide,
            cross_beam_thickness: like.cross_beam_thickness,
        }
    }

    fn girder(&self, trough: Trough, from: f64) -> Girder {
        Girder {
            prefix: "girder".into(),
            trough,
            heights: vec![[0.0, self.depth]],
            cross_beams: even(from, from + self.span),
            track: self.track_y,
        }
    }
}
