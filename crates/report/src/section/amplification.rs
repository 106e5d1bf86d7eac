//! Amplification: φ′ of the computation beside that of annex C, Φ₂ and Φ₃; the trains' design effects beside Φ·LM71.
//!
//! ```text
//! effect = |y_dyn| + c φ″ |y_stat| = (1 + φ′_dyn + c φ″) |y_stat|,   beside Φ α |y_LM71|
//! ```

use serde::Serialize;
use ttb_assessment::amplification::{k, n0_lower, n0_upper, phi_2, phi_3, phi_double_prime, phi_prime};
use ttb_assessment::statics::{DesignEffect, design_effects};

use super::Table;
use crate::input::Input;
use crate::number::{digits, with_unit};

#[derive(Serialize)]
pub(crate) struct Amplification {
    factors: Table,
    effects: Table,
    note: String,
}

impl Amplification {
    pub fn new(input: &Input) -> Self {
        let (effects, note) = match design_effects(&input.verdicts.facts, input.results) {
            Ok(effects) => (table(input, &effects), said(input)),
            Err(reason) => (Table::default(), format!("The trains are not compared with Φ·LM71: {reason}.")),
        };
        let note = match &input.results.statics.reason {
            Some(reason) => format!("The trains are not compared with Φ·LM71: {reason}."),
            None => note,
        };
        Self { factors: factors(input), effects, note }
    }
}

fn said(input: &Input) -> String {
    let (word, c) = if input.verdicts.facts.is_careful() { ("careful", "½ φ″") } else { ("standard", "φ″") };
    format!(
        "Each quantity at the place of its greatest or least value, of the run with the largest share: (1 + φ′ + {c}) times the \
         static effect of the train beside Φ times that of the load model at the same place; {word} maintenance of the track."
    )
}

/// Of every quantity and sense the run with the largest share.
fn table(input: &Input, effects: &[DesignEffect]) -> Table {
    let mut table = Table::new(&[
        "quantity",
        "x, m",
        "train, km/h",
        "static",
        "dynamic",
        "1 + φ′",
        "φ″ part",
        "design effect",
        "Φ × load model",
        "share",
        "run",
    ]);
    let mut kinds: Vec<(&str, bool)> = effects.iter().map(kind).collect();
    kinds.sort_unstable();
    kinds.dedup();
    for of in kinds {
        let own = effects.iter().filter(|effect| kind(effect) == of);
        let Some(worst) = own.reduce(|worst, one| if one.ratio() > worst.ratio() { one } else { worst }) else {
            continue;
        };
        let run = &input.results.runs[worst.run];
        let value = |value: f64| with_unit(value, &worst.unit);
        table.rows.push(vec![
            format!("{}, {}", worst.quantity, if of.1 { "least" } else { "greatest" }),
            super::optional(worst.x, 4),
            format!("{}, {}", run.train, super::speed(run.speed_km_h)),
            value(worst.statically),
            value(worst.dynamic),
            digits(worst.dynamic / worst.statically, 4),
            digits(worst.irregular, 3),
            value(worst.effect()),
            format!("{} ({} {}, {})", value(worst.allowed), worst.factor.name, digits(worst.factor.phi, 4), worst.load),
            format!("{} %", digits(100.0 * worst.ratio(), 3)),
            run.run_id.clone(),
        ]);
    }
    table
}

fn kind(effect: &DesignEffect) -> (&str, bool) {
    (effect.quantity.as_str(), effect.statistic == ttb_assessment::Statistic::Min)
}

fn factors(input: &Input) -> Table {
    let mut table = Table::new(&["quantity", "value", "of"]);
    let facts = &input.verdicts.facts;
    let mut row = |name: &str, value: String, of: String| table.rows.push(vec![name.into(), value, of]);
    let Some((l, from)) = facts.determinant_length(None) else { return table };
    row("determinant length L_Φ", format!("{} m", digits(l, 4)), format!("{from}, of the shortest span"));
    let chosen = |careful: bool| if careful == facts.is_careful() { ", applied" } else { "" };
    row("Φ₂", digits(phi_2(l), 4), format!("EN 1991-2 6.4.5, carefully maintained track{}", chosen(true)));
    row("Φ₃", digits(phi_3(l), 4), format!("EN 1991-2 6.4.5, standard maintenance{}", chosen(false)));
    let Some(n0) = facts.n0_hz else { return table };
    let lower = n0_lower(l);
    let inside = lower.is_some_and(|lower| (lower..=n0_upper(l)).contains(&n0));
    let word = if inside { "inside" } else { "outside" };
    let range = format!("{} … {} Hz", lower.map_or_else(|| "–".into(), |f| digits(f, 4)), digits(n0_upper(l), 4));
    row("n₀", format!("{} Hz", digits(n0, 4)), format!("{word} the limits {range}"));
    let Some(v) = input.results.runs.iter().filter_map(|run| run.speed_km_h).reduce(f64::max).map(|v| v / 3.6) else {
        return table;
    };
    row("K = v/(2 L_Φ n₀)", digits(k(v, l, n0), 4), format!("greatest speed {} km/h", digits(3.6 * v, 4)));
    row("φ′ of annex C", digits(phi_prime(v, l, n0), 4), "EN 1991-2 annex C, secondary".into());
    row(
        "φ″ of annex C",
        digits(phi_double_prime(v, l, n0), 3),
        "standard maintenance; half of it with careful maintenance".into(),
    );
    let dynamic = input.results.rows.iter().filter(|(_, p)| {
        p.quantity == "deck.displacement" && p.static_value.is_some_and(|s| s != 0.0) && p.value > 0.0
    });
    let phi = dynamic.map(|(at, p)| (p.value.abs() / p.static_value.unwrap_or(f64::NAN).abs() - 1.0, *at));
    if let Some((phi, at)) = phi.filter(|(phi, _)| phi.is_finite()).reduce(|a, b| if b.0 > a.0 { b } else { a }) {
        let run = &input.results.runs[at];
        let of = format!("{}, {} km/h, run {}", run.train, super::speed(run.speed_km_h), run.run_id);
        row("φ′ of the displacement, computed", digits(phi, 4), of);
    }
    table
}
