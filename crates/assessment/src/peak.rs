//! One reduced value of a run: the tidy row, one value a row.
//!
//! A quantity is named by what is measured and where: `deck.acceleration`, `wheel.unloading`. Its filter and statistic stand beside
//! it, so that a row says how it was made and a criterion finds the row that it judges. The names of [`quantity`] are those that
//! the bundled criteria use; others are allowed.

use std::borrow::Cow;

use serde::{Deserialize, Serialize};

/// Names of the quantities that criteria judge, SI units.
pub mod quantity {
    /// Vertical acceleration of the deck, m/s².
    pub const DECK_ACCELERATION: &str = "deck.acceleration";
    /// Displacement of the deck, downwards, m.
    pub const DECK_DISPLACEMENT: &str = "deck.displacement";
    /// Bending moment, N m.
    pub const DECK_MOMENT: &str = "deck.moment";
    /// Shear force, N.
    pub const DECK_SHEAR: &str = "deck.shear";
    /// Rotation of the deck's end, rad.
    pub const DECK_ROTATION: &str = "deck.rotation";
    /// Vertical offset of the deck's end against its neighbour, m.
    pub const DECK_END_OFFSET: &str = "deck.end-offset";
    /// Displacement of the deck under Φ times a static load model, m.
    pub const DEFLECTION_LM71: &str = "deck.deflection-lm71";
    /// Span over the displacement under Φ·LM71 of one track, α = 1.
    pub const SPAN_OVER_DEFLECTION: &str = "deck.span-over-deflection";
    /// (1 + φ′_dyn + φ″/2) times a train's effect over that of Φ·LM71 or Φ·SW/0.
    pub const DESIGN_EFFECT: &str = "deck.design-effect";
    /// Force of the train on a bearing, N; positive where it presses.
    pub const BEARING_REACTION: &str = "bearing.reaction";
    /// The same with that of the dead load, N.
    pub const TOTAL_REACTION: &str = "bearing.total-reaction";
    /// Contact force of a wheelset, N.
    pub const WHEEL_FORCE: &str = "wheel.force";
    /// Wheel load Q, half of the contact force of a wheelset, N.
    pub const WHEEL_LOAD: &str = "wheel.load";
    /// (Q₀ − Q)/Q₀ of a wheelset.
    pub const WHEEL_UNLOADING: &str = "wheel.unloading";
    /// Time without contact of a wheelset, s; statistics `count`, `sum`, `max`.
    pub const CONTACT_LOSS: &str = "wheel.contact-loss";
    /// The same, of the losses that begin on the bridge.
    pub const CONTACT_LOSS_ON_BRIDGE: &str = "wheel.contact-loss-on-bridge";
    /// The longest way of a wheelset without contact, m.
    pub const CONTACT_LOSS_WAY: &str = "wheel.contact-loss-way";
    /// Vertical acceleration of a car body, m/s².
    pub const BODY_ACCELERATION: &str = "body.acceleration";
    /// Sperling's index of a car body: the greatest of all pieces of 5 s.
    pub const SPERLING: &str = "body.sperling";
    /// The same of the whole record, which is not what the code names.
    pub const SPERLING_WHOLE: &str = "body.sperling-whole";
    /// Sperling's index by the continuous weighting W_z: the greatest of all pieces of 5 s.
    pub const SPERLING_CONTINUOUS: &str = "body.sperling-wz";
    /// The same of the whole record.
    pub const SPERLING_CONTINUOUS_WHOLE: &str = "body.sperling-wz-whole";
    /// Twist of the track by the deck on 3 m, m.
    pub const DECK_TWIST: &str = "deck.twist";
    /// Horizontal rotation of a deck's end, rad; a run in space.
    pub const DECK_HORIZONTAL_ROTATION: &str = "deck.horizontal-rotation";
    /// Derailment quotient Y/Q of a wheel; a run in space.
    pub const DERAILMENT: &str = "wheel.derailment";
    /// Lateral force ΣY of a wheelset on the track, N; static value 2Q₀/3.
    pub const TRACK_SHIFT: &str = "wheel.track-shift";
    /// Lateral acceleration of a car body, m/s².
    pub const BODY_LATERAL: &str = "body.lateral-acceleration";
    /// Sperling's lateral index of a car body: the greatest of all pieces of 5 s.
    pub const SPERLING_LATERAL: &str = "body.sperling-lateral";
    /// Mean comfort N_MV, vertical part.
    pub const COMFORT_N_MV: &str = "body.comfort-n-mv";
    /// Greatest dynamic over greatest static value, less 1.
    pub const PHI_DYN: &str = "deck.phi-dyn";
}

/// What a value belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum PlaceKind {
    /// The deck at an abscissa.
    Deck,
    /// A named point of the bridge.
    Point,
    /// A bearing.
    Bearing,
    /// A wheelset, from 1 at the front.
    Axle,
    /// A car, from 1 at the front.
    Car,
    /// The whole bridge or train.
    Whole,
}

/// How a history became one value.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Statistic {
    /// Greatest amount, positive.
    AbsMax,
    /// Greatest value.
    Max,
    /// Least value.
    Min,
    /// Greatest less least value in any window of one second.
    PeakToPeak,
    /// Root of the mean square over the whole record.
    Rms,
    /// Greatest running root mean square over 1 s (MTVV).
    #[serde(rename = "rms-1s-max")]
    Rms1sMax,
    /// Greatest running root mean square over 5 s (C_Cz).
    #[serde(rename = "rms-5s-max")]
    Rms5sMax,
    /// 99.85 % of the values.
    #[serde(rename = "percentile-99.85")]
    Percentile9985,
    /// Number of events.
    Count,
    /// Sum of all events.
    Sum,
    /// The value itself: an index, a factor.
    Value,
}

macro_rules! kebab {
    ($type:ty { $($variant:ident => $name:literal),* $(,)? }) => {
        impl $type {
            /// All, in order.
            pub const ALL: &[Self] = &[$(Self::$variant),*];

            /// Its name in tables and files.
            pub fn name(self) -> &'static str {
                match self { $(Self::$variant => $name),* }
            }

            /// By its name.
            pub fn parse(name: &str) -> Option<Self> {
                Self::ALL.iter().copied().find(|one| one.name() == name)
            }
        }

        impl std::fmt::Display for $type {
            fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                f.write_str(self.name())
            }
        }
    };
}

kebab!(PlaceKind {
    Deck => "deck",
    Point => "point",
    Bearing => "bearing",
    Axle => "axle",
    Car => "car",
    Whole => "whole",
});

kebab!(Statistic {
    AbsMax => "abs-max",
    Max => "max",
    Min => "min",
    PeakToPeak => "peak-to-peak",
    Rms => "rms",
    Rms1sMax => "rms-1s-max",
    Rms5sMax => "rms-5s-max",
    Percentile9985 => "percentile-99.85",
    Count => "count",
    Sum => "sum",
    Value => "value",
});

/// One reduced value of one run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Peak {
    /// What: a name of [`quantity`] or another.
    pub quantity: Cow<'static, str>,
    /// Of what.
    pub place_kind: PlaceKind,
    /// Which: the name of the point, the number of the axle; `0.5L` or the like on a deck.
    pub place: Cow<'static, str>,
    /// Where, m; on the deck from its left end, of a wheelset when the value occurred.
    #[serde(rename = "x_m")]
    pub x: Option<f64>,
    /// The label of the [`crate::Filter`], `raw` without.
    pub filter: Cow<'static, str>,
    /// How the history became one value.
    pub statistic: Statistic,
    /// In `unit`.
    pub value: f64,
    /// Unit of `value` and of `static_value`, as FMI writes units: `m/s2`, `N.m`, `1`.
    pub unit: Cow<'static, str>,
    /// When the value occurred, s.
    #[serde(rename = "time_s")]
    pub time: Option<f64>,
    /// The same for the train standing, without dynamics, where it has a meaning.
    pub static_value: Option<f64>,
}

impl Peak {
    /// A raw value with neither place nor time; the rest by assignment (`Peak { x: Some(12.5), ..Peak::raw(…) }`).
    pub fn raw(quantity: impl Into<Cow<'static, str>>, kind: PlaceKind, statistic: Statistic, value: f64) -> Self {
        Self {
            quantity: quantity.into(),
            place_kind: kind,
            place: Cow::Borrowed(""),
            x: None,
            filter: Cow::Borrowed(crate::filter::RAW),
            statistic,
            value,
            unit: Cow::Borrowed("1"),
            time: None,
            static_value: None,
        }
    }
}
