//! Points of the deck along which extremes are looked for: in every span 23 at equal distances, its middle among them.

use ttb_scenario::deck::Deck;
use ttb_scenario::spec::StructureSpec;

/// Parts of a span.
const PARTS: u32 = 24;

/// Ends of the spans, m from the bridge's begin, 0 first. A structure that does not tell its inner bearings is one span.
pub fn bearings(structure: &StructureSpec) -> Vec<f64> {
    let Some(deck) = Deck::new(structure) else { return Vec::new() };
    [0.0].into_iter().chain(deck.inner_bearings).chain([deck.length]).collect()
}

/// The points, m from the bridge's begin, rising.
pub fn deck_points(structure: &StructureSpec) -> Vec<f64> {
    let ends = bearings(structure);
    let spans = ends.windows(2).filter(|span| span[1] > span[0]);
    spans.flat_map(|s| (1..PARTS).map(|k| s[0] + (s[1] - s[0]) * f64::from(k) / f64::from(PARTS))).collect()
}
