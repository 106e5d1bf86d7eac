//! Trains beside static load models.
//!
//! ```text
//! (1 + φ′_dyn + c φ″) y_stat = |y_dyn| + c φ″ |y_stat|,   c = ½ with careful maintenance, else 1
//! over Φ α max|y| of LM71 or SW/0 at the same place
//! ```

use super::{LoadCase, along};
use crate::amplification::phi_double_prime;
use crate::facts::{Factor, Facts};
use crate::filter::RAW;
use crate::peak::quantity::{DECK_DISPLACEMENT, DECK_MOMENT, DECK_SHEAR};
use crate::peak::{Peak, PlaceKind, Statistic};
use crate::run::{Results, Run};

/// A train's design effect beside that of the load models.
#[derive(Clone, Debug, PartialEq)]
pub struct DesignEffect {
    /// Index of the run.
    pub run: usize,
    /// Quantity: displacement, moment or shear.
    pub quantity: String,
    /// Greatest or least.
    pub statistic: Statistic,
    /// Place, m.
    pub x: Option<f64>,
    /// When, s.
    pub time: Option<f64>,
    /// Unit of the effects.
    pub unit: String,
    /// |y_dyn|.
    pub dynamic: f64,
    /// |y_stat| of the same train.
    pub statically: f64,
    /// c φ″.
    pub irregular: f64,
    /// The load model that does most at this place.
    pub load: String,
    /// Φ α |y| of it.
    pub allowed: f64,
    /// Φ.
    pub factor: Factor,
}

impl DesignEffect {
    /// (1 + φ′_dyn + c φ″) y_stat.
    pub fn effect(&self) -> f64 {
        self.dynamic + self.irregular * self.statically
    }

    /// Over that of the load model.
    pub fn ratio(&self) -> f64 {
        self.effect() / self.allowed
    }
}

/// Effects below this share of the largest are no effect that a ratio tells something of.
const SMALL: f64 = 0.02;

/// Design effects of all runs beside the load models.
///
/// # Errors
/// What would have to be known.
pub fn design_effects(facts: &Facts, results: &Results) -> Result<Vec<DesignEffect>, String> {
    let n0 = facts.n0_hz.ok_or("the first frequency is not known: give `n0_hz` among the facts")?;
    let kinds = [DECK_DISPLACEMENT, DECK_MOMENT, DECK_SHEAR];
    let mut lines = Vec::new();
    for case in &results.statics.cases {
        for quantity in kinds {
            lines.extend([Statistic::Max, Statistic::Min].map(|sense| Line::new(case, quantity, sense)));
        }
    }
    let mut effects = Vec::new();
    for (at, row) in &results.rows {
        let judged =
            kinds.contains(&row.quantity.as_ref()) && row.filter == RAW && row.place_kind != PlaceKind::Bearing;
        if judged && let Some(effect) = effect(facts, results, &lines, n0, *at, row) {
            effects.push(effect);
        }
    }
    if effects.is_empty() {
        return Err("no run has static values of its own train beside the dynamic ones".into());
    }
    Ok(effects)
}

fn effect(facts: &Facts, results: &Results, lines: &[Line], n0: f64, at: usize, row: &Peak) -> Option<DesignEffect> {
    let run: &Run = &results.runs[at];
    let (v, factor) = (run.speed_km_h? / 3.6, facts.factor(row.x)?);
    let alpha = facts.alpha.unwrap_or(1.0);
    let sense = if row.statistic == Statistic::Min { Statistic::Min } else { Statistic::Max };
    let here = lines.iter().filter(|line| line.sense == sense && line.quantity == row.quantity);
    let amounts = here.filter_map(|line| Some((line.case, line.amount(row.x?)?)));
    let (case, most) = amounts.reduce(|most, one| if one.1 > most.1 { one } else { most })?;
    let maintenance = if facts.is_careful() { 0.5 } else { 1.0 };
    Some(DesignEffect {
        run: at,
        quantity: row.quantity.to_string(),
        statistic: row.statistic,
        x: row.x,
        time: row.time,
        unit: row.unit.to_string(),
        dynamic: row.value.abs(),
        statically: row.static_value.filter(|value| *value != 0.0)?.abs(),
        irregular: maintenance * phi_double_prime(v, factor.length, n0),
        load: case.into(),
        allowed: factor.phi * alpha * most,
        factor,
    })
}

/// |y| of a load model along the deck.
struct Line<'a> {
    case: &'a str,
    quantity: &'a str,
    sense: Statistic,
    /// Places, m, and amounts, rising.
    points: Vec<[f64; 2]>,
    /// The largest in both senses: the least displacement of a simple span is rounding.
    most: f64,
}

impl<'a> Line<'a> {
    fn new(case: &'a LoadCase, quantity: &'a str, sense: Statistic) -> Self {
        let rows = along(&case.rows, quantity, sense);
        let mut points: Vec<[f64; 2]> = rows.filter_map(|row| Some([row.x?, row.value.abs()])).collect();
        points.sort_by(|a, b| a[0].total_cmp(&b[0]).then(b[1].total_cmp(&a[1])));
        points.dedup_by(|next, kept| next[0] == kept[0]);
        let both = [Statistic::Max, Statistic::Min].into_iter().flat_map(|sense| along(&case.rows, quantity, sense));
        let most = both.map(|row| row.value.abs()).fold(0.0, f64::max);
        Self { case: &case.name, quantity, sense, points, most }
    }

    /// At an abscissa, between its places a straight line; `None` where the model does next to nothing.
    fn amount(&self, x: f64) -> Option<f64> {
        let after = self.points.partition_point(|point| point[0] < x);
        let last = self.points.len().checked_sub(1)?;
        let (a, b) = (self.points.get(after.saturating_sub(1))?, self.points.get(after.min(last))?);
        let share = if b[0] > a[0] { ((x - a[0]) / (b[0] - a[0])).clamp(0.0, 1.0) } else { 0.0 };
        let value = a[1] + share * (b[1] - a[1]);
        (value > SMALL * self.most).then_some(value)
    }
}
