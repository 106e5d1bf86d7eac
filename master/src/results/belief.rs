//! Results that no one can believe: a warning each, with the slip that may have made them.
//!
//! The limits are data (`plausible/results.json` of the scenario crate): far beyond any criterion of a code.

use ttb_scenario::spec::StructureSpec;
use ttb_scenario::{Believable, Checked, believable};
use ttb_session::column::{Column, Kind};
use ttb_session::observe::Peaks;
use ttb_session::{Of, Quantity};

/// What results are compared with; of a system structure nothing is known.
#[derive(Clone, Debug, Default)]
pub struct Scale {
    /// Longest span, m.
    span: Option<f64>,
    /// Static load of an axle, N.
    axle_load: Option<f64>,
}

impl Scale {
    /// Of a scenario.
    pub fn new(checked: &Checked) -> Self {
        let span = match &checked.bridge.structure {
            StructureSpec::Beams { spans, .. } => spans.iter().map(|span| span.length).reduce(f64::max),
            other => ttb_scenario::deck::Deck::new(other).map(|deck| deck.length),
        };
        Self { span: span.filter(|span| *span > 0.0), axle_load: Some(checked.axle_load).filter(|load| *load > 0.0) }
    }

    fn of(&self, relative_to: &str) -> Option<f64> {
        match relative_to {
            "span" => self.span,
            "axle load" => self.axle_load,
            _ => Some(1.0),
        }
    }
}

/// The key of a column's limit.
fn key(column: &Column) -> Option<&'static str> {
    let deck = matches!(column.of, Of::Point(_) | Of::Support(_));
    Some(match (&column.quantity, &column.of) {
        (Quantity::Displacement, _) if deck => "deck.displacement",
        (Quantity::Acceleration, _) if deck => "deck.acceleration",
        (Quantity::Acceleration, of) if of.kind() == Kind::Car => "car.acceleration",
        (Quantity::Displacement, of) if of.kind() == Kind::Car => "car.displacement",
        (Quantity::ContactForce, _) => "wheel.contact_force",
        (Quantity::RailDisplacement, _) | (Quantity::Displacement, Of::Rail(_)) => "rail.displacement",
        _ => return None,
    })
}

/// A sentence for every limit that is exceeded, about the column that exceeds it most.
pub fn unbelievable(peaks: &Peaks, scale: &Scale) -> Vec<String> {
    let judge = |limit: &Believable| {
        let most = limit.at_most * scale.of(&limit.relative_to)?;
        let of_kind = peaks.all().iter().filter(|peak| key(&peak.column) == Some(limit.what.as_str()));
        let worst = of_kind.filter(|peak| peak.amount() > most).max_by(|a, b| a.amount().total_cmp(&b.amount()))?;
        let extreme = if worst.max.value.abs() >= worst.min.value.abs() { worst.max } else { worst.min };
        let (column, value, time) = (&worst.column, extreme.value, extreme.time);
        let Believable { name, meant, slip, .. } = limit;
        Some(format!(
            "{column} reaches {value:.3e} {} at t = {time} s: a {name} beyond {meant} cannot be believed; {slip}",
            column.unit
        ))
    };
    believable().iter().filter_map(judge).collect()
}

#[cfg(test)]
mod tests {
    use ttb_session::TimeAxis;
    use ttb_session::observe::{Begin, Moment, Observer, Timing};

    use super::*;

    fn peaks(columns: &[(&str, &str, f64)]) -> Peaks {
        let named: Vec<Column> = columns.iter().map(|(name, unit, _)| Column::parse(name, unit)).collect();
        let row: Vec<f64> = columns.iter().map(|(.., value)| *value).collect();
        let (mut peaks, axis) = (Peaks::default(), TimeAxis::new(0.5, 1.0));
        peaks.start(&Begin { columns: &named, axis: &axis }).unwrap();
        let moment = Moment { n: 1, t: 0.5, h: 0.5, row: &row, info: None, timing: Timing::default() };
        assert!(peaks.step(&moment).unwrap().is_continue());
        peaks
    }

    #[test]
    fn what_no_bridge_does_is_told_once_a_kind() {
        let scale = Scale { span: Some(32.5), axle_load: Some(1.4e5) };
        let usual = [
            ("point[mid].displacement", "m", 0.02),
            ("point[mid].acceleration", "m/s2", -12.0),
            ("wheel[1].contact_force", "N", 4e5),
            ("wheel[1].rail_displacement", "m", 2e-3),
            ("car[1].acceleration", "m/s2", 1.5),
            ("car[1].displacement", "m", 0.05),
        ];
        assert_eq!(unbelievable(&peaks(&usual), &scale), Vec::<String>::new());
        let wrong = usual.map(|(name, unit, value)| (name, unit, 200.0 * value));
        let told = unbelievable(&peaks(&wrong), &scale);
        assert_eq!(told.len(), usual.len(), "{told:?}");
        assert!(told[0].starts_with(
            "point[mid].displacement reaches 4.000e0 m at t = 0.5 s: a displacement of the deck beyond 1/100"
        ));
        // Of a system structure neither span nor load is known.
        assert_eq!(unbelievable(&peaks(&wrong), &Scale::default()).len(), usual.len() - 2);
    }
}
