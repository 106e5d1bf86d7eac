//! Along the deck: envelopes of the governing runs.

use super::{Figure, Table};
use crate::chart::{Chart, Curve};
use crate::input::Input;
use crate::number::{digits, readable, short};

pub(crate) fn figures(input: &Input) -> Vec<Figure> {
    input
        .envelopes
        .iter()
        .map(|envelope| {
            let unit = match envelope.quantity.as_str() {
                "deck.acceleration" => "m/s2",
                "deck.displacement" => "m",
                "deck.moment" => "N.m",
                _ => "N",
            };
            let (factor, name) = readable(unit);
            let curve = |values: &[f64], word: &str, class: &str| Curve {
                name: word.into(),
                class: class.into(),
                points: envelope.x.iter().zip(values).map(|(x, y)| [*x, y * factor]).collect(),
                dots: Vec::new(),
            };
            let chart = Chart {
                name: format!("Envelope of {}", envelope.quantity),
                x_name: "from the begin of the bridge, m".into(),
                y_name: format!("{}, {name}", envelope.quantity),
                curves: vec![
                    curve(&envelope.max, "greatest", "c1 bold"),
                    curve(&envelope.min, "least", "c2 dash bold"),
                ],
                height: 240.0,
                ..Chart::default()
            };
            let mut table = Table::new(&["x, m", "least", "greatest"]);
            for ((x, low), high) in envelope.x.iter().zip(&envelope.min).zip(&envelope.max) {
                table.rows.push(vec![short(*x), digits(low * factor, 4), digits(high * factor, 4)]);
            }
            Figure {
                title: format!("{} along the deck", envelope.quantity),
                svg: chart.svg(),
                note: format!("{}, run {}.", envelope.filter, envelope.run_id),
                table,
            }
        })
        .collect()
}
