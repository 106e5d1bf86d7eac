//! What a criterion must know of bridge, track and project beside the results.

use serde::{Deserialize, Serialize};

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
    /// The level of comfort that is asked for: `very good`, `good` or `acceptable`.
    pub comfort_level: Option<String>,
}

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
            comfort_level: text(&self.comfort_level, &other.comfort_level),
        }
    }

    /// The shortest span: L/600 of it is the strictest.
    pub fn shortest_span(&self) -> Option<f64> {
        self.spans_m.as_ref()?.iter().copied().reduce(f64::min)
    }
}
