//! Amplification: φ′ of the computation beside that of annex C, Φ₂ and Φ₃.

use ttb_assessment::amplification::{k, n0_lower, n0_upper, phi_2, phi_3, phi_double_prime, phi_prime};

use super::Table;
use crate::input::Input;
use crate::number::digits;

pub(crate) fn table(input: &Input) -> Option<Table> {
    let facts = &input.verdicts.facts;
    let (n0, span) = (facts.n0_hz?, facts.shortest_span()?);
    let l = facts.l_phi_m.unwrap_or(span);
    let speeds = input.results.runs.iter().filter_map(|run| run.speed_km_h);
    let v = speeds.reduce(f64::max)? / 3.6;
    let mut table = Table::new(&["quantity", "value", "of"]);
    let mut row = |name: &str, value: String, of: String| table.rows.push(vec![name.into(), value, of]);
    let assumed = if facts.l_phi_m.is_some() { "given" } else { "the shortest span, assumed" };
    row("determinant length L_Φ", format!("{} m", digits(l, 4)), assumed.into());
    row("K = v/(2 L_Φ n₀)", digits(k(v, l, n0), 4), format!("greatest speed {} km/h", digits(3.6 * v, 4)));
    row("φ′ of annex C", digits(phi_prime(v, l, n0), 4), "EN 1991-2 annex C, secondary".into());
    row(
        "φ″ of annex C",
        digits(phi_double_prime(v, l, n0), 3),
        "standard maintenance; half of it with careful maintenance".into(),
    );
    let dynamic = input
        .results
        .rows
        .iter()
        .filter(|(_, p)| p.quantity == "deck.displacement" && p.static_value.is_some_and(|s| s != 0.0));
    let phi = dynamic.map(|(at, p)| (p.value.abs() / p.static_value.unwrap_or(f64::NAN).abs() - 1.0, *at));
    if let Some((phi, at)) = phi.filter(|(phi, _)| phi.is_finite()).reduce(|a, b| if b.0 > a.0 { b } else { a }) {
        let run = &input.results.runs[at];
        row(
            "φ′ of the displacement, computed",
            digits(phi, 4),
            format!("{}, {} km/h, run {}", run.train, super::speed(run.speed_km_h), run.run_id),
        );
    }
    row("Φ₂", digits(phi_2(l), 4), "EN 1991-2 6.4.5, carefully maintained track".into());
    row("Φ₃", digits(phi_3(l), 4), "EN 1991-2 6.4.5, standard maintenance".into());
    let lower = n0_lower(l);
    let inside = lower.is_some_and(|lower| (lower..=n0_upper(l)).contains(&n0));
    let word = if inside { "inside" } else { "outside" };
    let range = format!("{} … {} Hz", lower.map_or_else(|| "–".into(), |f| digits(f, 4)), digits(n0_upper(l), 4));
    row("n₀", format!("{} Hz", digits(n0, 4)), format!("{word} the limits {range}"));
    Some(table)
}
