//! Names of the variables that are coupled, and of what is told about the coupling. FMUs, maps, results and tests take them
//! from here.

use crate::port::Component;

/// Output by which a train–track subsystem tells the work of its support forces on the deck over the last step, J.
pub const WORK: &str = "deck_work";

/// Name of a quantity at a support, which is counted from 1 along the track: `support[12].force`.
pub fn support(number: usize, quantity: &str) -> String {
    format!("support[{number}].{quantity}")
}

/// The number and the quantity of a name that [`support`] made.
pub fn parse_support(name: &str) -> Option<(usize, &str)> {
    let (number, quantity) = name.strip_prefix("support[")?.split_once("].")?;
    Some((number.parse().ok()?, quantity))
}

/// The support's name with another quantity: `support[3].mean_force` for `support[3].force`.
pub fn sibling(name: &str, quantity: &str) -> String {
    let place = name.rsplit_once('.').map_or(name, |(place, _)| place);
    format!("{place}.{quantity}")
}

/// The output with the mean of a force over a step: `support[3].mean_force` for `support[3].force`. A name that ends in none
/// of the forces is taken for a vertical one.
pub fn mean_force(force: &str) -> String {
    sibling(force, Component::of_force(force).unwrap_or_default().mean_force())
}

/// The force whose mean over a step a name means: `support[3].force` for `support[3].mean_force`; none if it means no mean.
pub fn instant_force(mean: &str) -> Option<String> {
    let (_, last) = mean.rsplit_once('.')?;
    let component = Component::ALL.into_iter().find(|component| component.mean_force() == last)?;
    Some(sibling(mean, component.force()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_support_s_name_is_written_and_read() {
        assert_eq!(support(12, "force"), "support[12].force");
        assert_eq!(parse_support("support[12].force_y"), Some((12, "force_y")));
        assert_eq!(parse_support("wheel[12].contact_force"), None);
        assert_eq!(parse_support("support[x].force"), None);
    }

    #[test]
    fn the_mean_of_each_component_s_force_has_its_own_name() {
        assert_eq!(mean_force("support[3].force"), "support[3].mean_force");
        assert_eq!(mean_force("support[3].moment_x"), "support[3].mean_moment_x");
        assert_eq!(mean_force("Track.load"), "Track.mean_force");
        assert_eq!(instant_force("support[3].mean_moment_x").as_deref(), Some("support[3].moment_x"));
        assert_eq!((instant_force("support[3].force"), instant_force("mean_force")), (None, None));
        assert_eq!(sibling("support[3].force", "displacement"), "support[3].displacement");
    }
}
