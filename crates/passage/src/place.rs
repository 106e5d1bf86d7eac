//! What is looked at: quantities, and the places where they are.

use std::fmt;

/// A quantity of the bridge. Displacements and accelerations are positive down, moments where they stretch the lower side,
/// shear where it is dM/dx, reactions where they press on the bearing.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Quantity {
    /// Displacement, m.
    Displacement,
    /// Acceleration, m/s².
    Acceleration,
    /// Bending moment, N m.
    Moment,
    /// Shear force, N.
    Shear,
    /// Force on a bearing, N.
    Reaction,
}

impl Quantity {
    /// All, in the order of tables.
    pub const ALL: [Self; 5] = [Self::Displacement, Self::Acceleration, Self::Moment, Self::Shear, Self::Reaction];

    /// As in tables: `deck.displacement` and the like.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Displacement => "deck.displacement",
            Self::Acceleration => "deck.acceleration",
            Self::Moment => "deck.moment",
            Self::Shear => "deck.shear",
            Self::Reaction => "bearing.reaction",
        }
    }

    /// Its SI unit, as FMI writes it.
    #[must_use]
    pub const fn unit(self) -> &'static str {
        match self {
            Self::Displacement => "m",
            Self::Acceleration => "m/s2",
            Self::Moment => "N.m",
            Self::Shear | Self::Reaction => "N",
        }
    }
}

impl fmt::Display for Quantity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// Kind of a place.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum PlaceKind {
    /// A point of the deck, chosen by the program.
    Deck,
    /// A point that the scenario names.
    Point,
    /// A bearing.
    Bearing,
}

impl PlaceKind {
    /// As in tables.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Deck => "deck",
            Self::Point => "point",
            Self::Bearing => "bearing",
        }
    }
}

/// A place.
#[derive(Clone, Debug, PartialEq)]
pub struct Place {
    /// Its kind.
    pub kind: PlaceKind,
    /// Its name: of a deck point its abscissa in m, beside an inner bearing with `-` (before) or `+` (behind).
    pub name: String,
    /// Distance from the bridge's begin, m; `None` for a node that is not on the deck.
    pub x: Option<f64>,
}

impl Place {
    /// A point of the deck at `x`, m; `side` is `-`, `+` or nothing.
    #[must_use]
    pub fn on_deck(x: f64, side: &str) -> Self {
        // Micrometres are rounding.
        let name = format!("{}{side}", (x * 1e6).round() / 1e6);
        Self { kind: PlaceKind::Deck, name, x: Some(x) }
    }
}

/// A quantity at a place.
#[derive(Clone, Debug, PartialEq)]
pub struct Output {
    /// What.
    pub quantity: Quantity,
    /// Where.
    pub place: Place,
}
