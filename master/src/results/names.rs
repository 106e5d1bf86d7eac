//! What the name of an output says of it.

use ttb_contract::names::WORK;

/// A variable's kind: `wheel[].contact_force` of all wheels.
pub fn kind(name: &str) -> String {
    match (name.find('['), name.find(']')) {
        (Some(open), Some(close)) if open < close => format!("{}{}", &name[..=open], &name[close..]),
        _ => name.to_string(),
    }
}

/// Whether an output has extremes of interest: not what is a place, belongs to a support, or is the work of a step, which is
/// the less the shorter the step.
pub fn is_quantity(name: &str) -> bool {
    !name.starts_with("support[") && !name.ends_with(".position") && name != WORK
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn members_of_a_series_are_of_one_kind() {
        let kinds = ["wheel[12].contact_force", "point[mid].moment", "deck_work"].map(kind);
        assert_eq!(kinds, ["wheel[].contact_force", "point[].moment", "deck_work"]);
    }
}
