//! Static load models beside the runs: what they do to the bridge, and the comparison of trains with them.
//!
//! ```text
//! deflection         Φ α max w of every span
//! L/δ                span over Φ max w,  α = 1
//! offset of an end   Φ α |θ| e                          e: overhang beyond the bearing
//! reaction           R_dead + Φ α min R,                R_dead + min R of every run
//! design effect      (1 + φ′_dyn + c φ″) y_stat = |y_dyn| + c |y_stat| φ″,   c = ½ with careful maintenance, else 1
//!                    over Φ α max|y| of LM71 or SW/0 at the same place
//! ```

mod design;

use crate::facts::{Factor, Facts};
use crate::filter::RAW;
use crate::peak::quantity::{
    BEARING_REACTION, DECK_DISPLACEMENT, DECK_END_OFFSET, DECK_ROTATION, DEFLECTION_LM71, DESIGN_EFFECT,
    SPAN_OVER_DEFLECTION, TOTAL_REACTION,
};
use crate::peak::{Peak, PlaceKind, Statistic};
use crate::run::{Missing, Results};

pub use crate::load_case::{LoadCase, Statics};
pub use design::{DesignEffect, design_effects};

/// A value of a load model under its factors.
#[derive(Clone, Debug, PartialEq)]
pub struct Loaded {
    /// The load model.
    pub load: String,
    /// The value.
    pub peak: Peak,
    /// Which factors, for people.
    pub note: String,
}

/// What follows from load models and facts.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Derived {
    /// Of load models alone.
    pub of_loads: Vec<Loaded>,
    /// Of runs: index of the run, and the value.
    pub of_runs: Vec<(usize, Peak)>,
    /// What could not be made.
    pub missing: Vec<Missing>,
}

/// Everything that follows.
pub fn derive(facts: &Facts, results: &Results) -> Derived {
    let mut out = Derived::default();
    if results.statics.cases.is_empty() {
        let reason = results.statics.reason.as_deref().unwrap_or("there is no static analysis under LM71");
        for quantity in [DEFLECTION_LM71, SPAN_OVER_DEFLECTION, DECK_END_OFFSET, DESIGN_EFFECT] {
            out.miss(quantity, reason);
        }
    } else if facts.spans_m.as_ref().is_none_or(Vec::is_empty) {
        for quantity in [DEFLECTION_LM71, SPAN_OVER_DEFLECTION, DESIGN_EFFECT] {
            out.miss(quantity, "the spans are not known: give `spans_m` among the facts");
        }
    } else {
        deflections(facts, results, &mut out);
        design(facts, results, &mut out);
    }
    ends(facts, results, &mut out);
    reactions(facts, results, &mut out);
    out
}

impl Derived {
    fn miss(&mut self, quantity: &str, reason: &str) {
        let (quantity, filter, reason) = (quantity.into(), RAW.into(), reason.into());
        self.missing.push(Missing { quantity, filter, statistic: None, reason });
    }
}

fn note(factor: &Factor, alpha: f64) -> String {
    format!("{} = {:.4} for L_Φ = {:.4} m ({}), α = {alpha}", factor.name, factor.phi, factor.length, factor.from)
}

/// Rows of a quantity along the deck.
fn along<'a>(rows: &'a [Peak], quantity: &'a str, statistic: Statistic) -> impl Iterator<Item = &'a Peak> {
    rows.iter().filter(move |row| {
        row.quantity == quantity && row.statistic == statistic && row.place_kind == PlaceKind::Deck && row.x.is_some()
    })
}

/// w and L/w of every span.
fn deflections(facts: &Facts, results: &Results, out: &mut Derived) {
    for case in &results.statics.cases {
        for [begin, end] in facts.spans() {
            let inside = |row: &&Peak| row.x.is_some_and(|x| x >= begin - 1e-6 && x <= end + 1e-6);
            let all = along(&case.rows, DECK_DISPLACEMENT, Statistic::Max).filter(inside);
            let worst = all.reduce(|worst, row| if row.value > worst.value { row } else { worst });
            let middle = Some(0.5 * (begin + end));
            let (Some(worst), Some(factor)) = (worst, facts.factor(middle)) else { continue };
            let alpha = facts.alpha.unwrap_or(1.0);
            let row = |quantity: &'static str, statistic, value, unit: &'static str| Peak {
                quantity: quantity.into(),
                statistic,
                value,
                unit: unit.into(),
                static_value: None,
                time: None,
                ..worst.clone()
            };
            let mut push = |peak, alpha| {
                out.of_loads.push(Loaded { load: case.name.clone(), peak, note: note(&factor, alpha) });
            };
            push(row(DEFLECTION_LM71, Statistic::Max, factor.phi * alpha * worst.value, "m"), alpha);
            if case.name == "LM71" && worst.value > 0.0 {
                let share = (end - begin) / (factor.phi * worst.value);
                push(row(SPAN_OVER_DEFLECTION, Statistic::Min, share, "1"), 1.0);
            }
        }
    }
}

/// Rotations of ends times the overhang, of load models and of runs.
fn ends(facts: &Facts, results: &Results, out: &mut Derived) {
    let Some(overhang) = facts.overhang_m else {
        return out
            .miss(DECK_END_OFFSET, "the overhang beyond the bearings is not known: give `overhang_m` among the facts");
    };
    let offset = |row: &Peak, factor: f64| Peak {
        quantity: DECK_END_OFFSET.into(),
        statistic: Statistic::AbsMax,
        value: factor * overhang * row.value.abs(),
        unit: "m".into(),
        static_value: None,
        ..row.clone()
    };
    let is = |row: &&Peak| row.quantity == DECK_ROTATION && row.filter == RAW;
    let alpha = facts.alpha.unwrap_or(1.0);
    for case in &results.statics.cases {
        for row in case.rows.iter().filter(is) {
            let Some(factor) = facts.factor(row.x) else { continue };
            let peak = offset(row, factor.phi * alpha);
            let note = format!("{}, overhang {overhang} m", note(&factor, alpha));
            out.of_loads.push(Loaded { load: case.name.clone(), peak, note });
        }
    }
    let of_runs = results.rows.iter().filter(|(_, row)| is(&row)).map(|(run, row)| (*run, offset(row, 1.0)));
    out.of_runs.extend(of_runs);
}

/// Least reactions with those of the dead load.
fn reactions(facts: &Facts, results: &Results, out: &mut Derived) {
    let is = |row: &&Peak| row.quantity == BEARING_REACTION && row.statistic == Statistic::Min;
    let of_loads =
        || results.statics.cases.iter().flat_map(|case| case.rows.iter().filter(is).map(move |row| (case, row)));
    let of_runs = || results.rows.iter().filter(|(_, row)| is(&row));
    let mut names: Vec<&str> =
        of_loads().map(|(_, row)| row).chain(of_runs().map(|(_, row)| row)).map(|row| row.place.as_ref()).collect();
    names.sort_unstable();
    names.dedup();
    if names.is_empty() {
        return out.miss(TOTAL_REACTION, "reactions of the train are known of beams and plane frames only");
    }
    let Some(dead) = &facts.dead_reactions_kn else {
        let reason = format!(
            "the reactions of the dead load are not known: give `dead_reactions_kn` among the facts, by bearing: {}",
            names.join(", ")
        );
        return out.miss(TOTAL_REACTION, &reason);
    };
    let lacking: Vec<&str> = names.iter().copied().filter(|name| !dead.contains_key(*name)).collect();
    if !lacking.is_empty() {
        let reason =
            format!("`dead_reactions_kn` has no bearing {}; there are {}", lacking.join(", "), names.join(", "));
        return out.miss(TOTAL_REACTION, &reason);
    }
    let total = |row: &Peak, factor: f64| {
        let value = 1e3 * dead[row.place.as_ref()] + factor * row.value;
        Peak { quantity: TOTAL_REACTION.into(), value, static_value: None, ..row.clone() }
    };
    let alpha = facts.alpha.unwrap_or(1.0);
    let loads = of_loads().filter_map(|(case, row)| {
        let factor = facts.factor(row.x)?;
        let peak = total(row, factor.phi * alpha);
        Some(Loaded { load: case.name.clone(), peak, note: note(&factor, alpha) })
    });
    out.of_loads.extend(loads);
    out.of_runs.extend(of_runs().map(|(run, row)| (*run, total(row, 1.0))));
}

fn design(facts: &Facts, results: &Results, out: &mut Derived) {
    match design_effects(facts, results) {
        Ok(effects) => out.of_runs.extend(effects.iter().map(|effect| {
            let row = Peak::raw(DESIGN_EFFECT, PlaceKind::Deck, Statistic::Max, effect.ratio());
            let place = effect.quantity.trim_start_matches("deck.").to_string().into();
            (effect.run, Peak { x: effect.x, time: effect.time, place, ..row })
        })),
        Err(reason) => out.miss(DESIGN_EFFECT, &reason),
    }
}
