//! What a criterion must know of bridge, track and project beside the results.
//!
//! ```text
//! L_Φ   simple span: L_i;   n continuous spans: k · mean(L) ≥ max L,  k = 1.2, 1.3, 1.4, 1.5 for n = 2, 3, 4, ≥ 5
//!       (EN 1991-2, table 6.2, cases 5.1 and 5.2, secondary)
//! Φ     Φ₂ with careful maintenance, else Φ₃
//! ```

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::amplification::{phi_2, phi_3};

/// Facts; what is `None` is not known, and a criterion that needs it is not judged, with that as the reason.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Facts {
    /// First natural frequency n₀ of the member, Hz.
    pub n0_hz: Option<f64>,
    /// Third natural frequency of the member, Hz.
    pub third_mode_hz: Option<f64>,
    /// Where both come from, for people.
    pub modes_from: Option<String>,
    /// `ballast` or `ballastless`.
    pub track: Option<String>,
    /// Spans, m.
    pub spans_m: Option<Vec<f64>>,
    /// Determinant length L_Φ, m.
    pub l_phi_m: Option<f64>,
    /// Whether the deck runs on over its inner bearings; a row of simple spans does not.
    pub continuous: Option<bool>,
    /// Maintenance of the track, `careful` or `standard`; standard unless it is known.
    pub maintenance: Option<String>,
    /// Classification factor α of LM71; 1 unless it is known.
    pub alpha: Option<f64>,
    /// Greatest speed on the line, km/h; that of the runs unless it is known.
    pub line_speed_km_h: Option<f64>,
    /// The longest overhang of the deck beyond a bearing at one of its ends, m.
    pub overhang_m: Option<f64>,
    /// Reactions of the dead load by the name of the bearing, kN, positive where they press.
    pub dead_reactions_kn: Option<BTreeMap<String, f64>>,
    /// The level of comfort that is asked for: `very good`, `good` or `acceptable`.
    pub comfort_level: Option<String>,
}

/// The dynamic factor of a static load model, and what it stands on.
#[derive(Clone, Debug, PartialEq)]
pub struct Factor {
    /// Φ₂ or Φ₃.
    pub phi: f64,
    /// Which of both.
    pub name: &'static str,
    /// L_Φ, m.
    pub length: f64,
    /// Where L_Φ comes from.
    pub from: &'static str,
}

/// Words that a fact may have: key, words.
pub(crate) const WORDS: [(&str, &[&str]); 3] = [
    ("track", &["ballast", "ballastless"]),
    ("maintenance", &["careful", "standard"]),
    ("comfort_level", &["very good", "good", "acceptable"]),
];

impl Facts {
    /// These, with everything that `other` knows instead.
    #[must_use]
    pub fn overruled_by(&self, other: &Self) -> Self {
        let text = |own: &Option<String>, other: &Option<String>| other.clone().or_else(|| own.clone());
        let by_user = other.n0_hz.is_some() || other.third_mode_hz.is_some();
        Self {
            n0_hz: other.n0_hz.or(self.n0_hz),
            third_mode_hz: other.third_mode_hz.or(self.third_mode_hz),
            modes_from: if by_user {
                Some("given by the user".into())
            } else {
                text(&self.modes_from, &other.modes_from)
            },
            track: text(&self.track, &other.track),
            spans_m: other.spans_m.clone().or_else(|| self.spans_m.clone()),
            l_phi_m: other.l_phi_m.or(self.l_phi_m),
            continuous: other.continuous.or(self.continuous),
            maintenance: text(&self.maintenance, &other.maintenance),
            alpha: other.alpha.or(self.alpha),
            line_speed_km_h: other.line_speed_km_h.or(self.line_speed_km_h),
            overhang_m: other.overhang_m.or(self.overhang_m),
            dead_reactions_kn: other.dead_reactions_kn.clone().or_else(|| self.dead_reactions_kn.clone()),
            comfort_level: text(&self.comfort_level, &other.comfort_level),
        }
    }

    /// The shortest span: L/600 of it is the strictest.
    pub fn shortest_span(&self) -> Option<f64> {
        self.spans_m.as_ref()?.iter().copied().reduce(f64::min)
    }

    /// The spans by begin and end, m from the begin of the deck.
    pub fn spans(&self) -> Vec<[f64; 2]> {
        let mut end = 0.0;
        let next = |length: &f64| {
            let begin = end;
            end += length;
            [begin, end]
        };
        self.spans_m.iter().flatten().map(next).collect()
    }

    /// The length of the span in which an abscissa lies, m; without an abscissa that of the shortest.
    pub fn span_at(&self, x: Option<f64>) -> Option<f64> {
        let Some(x) = x else { return self.shortest_span() };
        let spans = self.spans();
        let found = spans.iter().find(|span| x <= span[1]).or(spans.last())?;
        Some(found[1] - found[0])
    }

    /// L_Φ of the span in which an abscissa lies, m, and where it comes from; without an abscissa of the shortest span.
    pub fn determinant_length(&self, x: Option<f64>) -> Option<(f64, &'static str)> {
        if let Some(length) = self.l_phi_m {
            return Some((length, "given by the user"));
        }
        let spans = self.spans_m.as_ref().filter(|spans| !spans.is_empty())?;
        match (self.continuous, spans.len()) {
            (Some(false), _) => Some((self.span_at(x)?, "the simple span")),
            (Some(true), 1) => Some((spans[0], "the simple span")),
            (None, 1) => Some((spans[0], "the length of the deck, assumed")),
            (continuous, n) => {
                let k = match n {
                    2 => 1.2,
                    3 => 1.3,
                    4 => 1.4,
                    _ => 1.5,
                };
                let longest = spans.iter().copied().fold(0.0, f64::max);
                let length = (k * spans.iter().sum::<f64>() / n as f64).max(longest);
                let from = if continuous.is_some() { "continuous spans" } else { "continuous spans, assumed" };
                Some((length, from))
            }
        }
    }

    /// Whether the track is maintained carefully.
    pub fn is_careful(&self) -> bool {
        self.maintenance.as_deref() == Some("careful")
    }

    /// Φ of the span in which an abscissa lies.
    pub fn factor(&self, x: Option<f64>) -> Option<Factor> {
        let (length, from) = self.determinant_length(x)?;
        let (phi, name) = if self.is_careful() { (phi_2(length), "Φ₂") } else { (phi_3(length), "Φ₃") };
        Some(Factor { phi, name, length, from })
    }
}
