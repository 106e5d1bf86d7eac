//! Usual and possible ranges of what engineers mistype: data files, each range with its source.
//!
//! ```text
//! outside possible           a problem: it cannot be meant
//! outside usual              a warning, with the slip that would explain it: the first one whose factor leads into usual
//! ```

use std::sync::LazyLock;

use serde::{Deserialize, Serialize};

use crate::data::PLAUSIBLE;
use crate::problem::{Report, Warning};

/// A range; an end that is absent is not looked at.
pub(crate) type Ends = [Option<f64>; 2];

/// What may have been meant.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Slip {
    /// The value times this would be usual.
    #[serde(default)]
    pub factor: Option<f64>,
    /// Or the value is larger than this.
    #[serde(default)]
    pub above: Option<f64>,
    /// The question to ask.
    pub meant: String,
}

/// A quantity and where it usually lies.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Range {
    /// Key by which the checks find it.
    pub what: String,
    /// For people.
    pub name: String,
    /// Unit, or nothing.
    pub unit: String,
    /// Outside it is warned of.
    pub usual: Ends,
    /// Outside it is refused.
    #[serde(default)]
    pub possible: Ends,
    /// What may have been meant, the likeliest first.
    pub slips: Vec<Slip>,
    /// Where the range comes from.
    pub source: String,
    /// How well that is known.
    pub verified: String,
}

#[derive(Deserialize)]
struct Ranges {
    ranges: Vec<Range>,
}

/// The text of a data file on what is plausible; a test reads them all.
pub(crate) fn file(name: &str) -> &'static str {
    PLAUSIBLE.iter().find(|(known, _)| *known == name).map_or("{}", |(_, text)| text)
}

static RANGES: LazyLock<Vec<Range>> =
    LazyLock::new(|| serde_json::from_str::<Ranges>(file("ranges")).map(|all| all.ranges).unwrap_or_default());

/// The data file of all ranges: quantity, name, unit, usual and possible values, source.
#[must_use]
pub fn usual() -> &'static str {
    file("ranges")
}

/// The data file of the limits of a simple span's first frequency over its length.
#[must_use]
pub fn usual_frequencies() -> &'static str {
    file("frequencies")
}

/// The range of a quantity.
pub(crate) fn range(what: &str) -> Option<&'static Range> {
    RANGES.iter().find(|range| range.what == what)
}

/// Whether a value lies between two ends.
pub(crate) fn within([low, high]: Ends, value: f64) -> bool {
    low.is_none_or(|low| value >= low) && high.is_none_or(|high| value <= high)
}

/// The slip that explains a value.
pub(crate) fn slip(slips: &[Slip], usual: Ends, value: f64) -> Option<&str> {
    let explains = |slip: &&Slip| {
        slip.factor.is_some_and(|factor| within(usual, factor * value)) || slip.above.is_some_and(|above| value > above)
    };
    slips.iter().find(explains).map(|slip| slip.meant.as_str())
}

/// Judges a value that stands, or follows from what stands, at `path`; returns whether it is usual.
pub(crate) fn judge(what: &str, path: &str, value: f64, report: &mut Report) -> bool {
    let Some(range) = range(what).filter(|_| value.is_finite()) else { return true };
    let meant = slip(&range.slips, range.usual, value);
    if !within(range.possible, value) {
        let rule = format!("{} must lie {}", range.name, ends(range.possible, &range.unit));
        let found = with_unit(value, &range.unit);
        report.problem(path, rule, meant.map_or_else(|| found.clone(), |meant| format!("{found}; {meant}")));
    } else if !within(range.usual, value) {
        report.note(Warning {
            path: path.to_owned(),
            name: range.name.clone(),
            value: Some(value),
            unit: range.unit.clone(),
            usual: range.usual,
            slip: meant.map(str::to_owned),
            source: range.source.clone(),
            text: format!(
                "{path}: {} {}, usual {}{}",
                range.name,
                with_unit(value, &range.unit),
                ends(range.usual, &range.unit),
                meant.map_or_else(String::new, |meant| format!(": {meant}"))
            ),
        });
    }
    within(range.usual, value)
}

/// A range in words.
pub(crate) fn ends([low, high]: Ends, unit: &str) -> String {
    match (low, high) {
        (Some(low), Some(high)) => format!("{} to {}", shown(low), with_unit(high, unit)),
        (None, Some(high)) => format!("up to {}", with_unit(high, unit)),
        (Some(low), None) => format!("from {} on", with_unit(low, unit)),
        (None, None) => "anywhere".into(),
    }
}

pub(crate) fn with_unit(value: f64, unit: &str) -> String {
    if unit.is_empty() { shown(value) } else { format!("{} {unit}", shown(value)) }
}

/// A number with four digits.
pub(crate) fn shown(value: f64) -> String {
    let amount = value.abs();
    if amount != 0.0 && !(1e-3..1e6).contains(&amount) {
        let text = format!("{value:.3e}");
        let (mantissa, exponent) = text.split_once('e').unwrap_or((&text, "0"));
        let mantissa =
            if mantissa.contains('.') { mantissa.trim_end_matches('0').trim_end_matches('.') } else { mantissa };
        return format!("{mantissa}e{exponent}");
    }
    let decimals = if amount > 0.0 { (3 - amount.log10().floor() as i32).clamp(0, 9) as usize } else { 0 };
    let text = format!("{value:.decimals$}");
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_range_has_a_source_and_slips_lead_into_it() {
        assert!(RANGES.len() > 20);
        for range in RANGES.iter() {
            assert!(range.source.len() > 10 && !range.verified.is_empty(), "{range:?}");
            let [low, high] = range.usual;
            assert!(low.zip(high).is_none_or(|(low, high)| low < high), "{range:?}");
            for end in range.usual.into_iter().flatten() {
                assert!(within(range.possible, end), "{range:?}");
            }
            assert!(range.slips.iter().all(|slip| slip.factor.is_some() != slip.above.is_some()), "{range:?}");
        }
    }

    #[test]
    fn a_value_is_judged_by_its_range() {
        let mut report = Report::new("f");
        judge("contact.hertz_constant", "$.a", 4e-8, &mut report);
        assert!(report.problems.is_empty() && report.warnings.is_empty());
        judge("contact.hertz_constant", "$.a", 1.4e9, &mut report);
        let problem = report.problems[0].to_string();
        assert!(
            problem.starts_with(
                "f: $.a: Hertz constant G must lie 1e-9 to 1e-6 m/N^(2/3): 1.4e9 m/N^(2/3); a stiffness in N/m"
            ),
            "{problem}"
        );
        judge("track.spring", "$.b", 100.0, &mut report);
        assert_eq!(
            report.warnings[0].to_string(),
            "$.b: stiffness of the spring 100 N/m, usual 5e6 to 5e9 N/m: given in kN/mm (MN/m)?"
        );
        assert_eq!(report.warnings[0].value, Some(100.0));
    }

    #[test]
    fn numbers_are_shown_with_four_digits() {
        for (value, text) in
            [(0.0, "0"), (19.2345, "19.23"), (100.0, "100"), (0.05, "0.05"), (1.4e9, "1.4e9"), (-2.5e-5, "-2.5e-5")]
        {
            assert_eq!(shown(value), text);
        }
    }
}
