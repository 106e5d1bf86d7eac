//! What a recorded variable measures.

/// A quantity, by the last part of a variable's name.
#[derive(Clone, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Quantity {
    /// Place along the track, m.
    Position,
    /// Displacement, m.
    Displacement,
    /// Velocity, m/s.
    Velocity,
    /// Acceleration, m/s².
    Acceleration,
    /// Acceleration of the greatest amount within the last step, m/s².
    PeakAcceleration,
    /// Pitch acceleration of a car body, rad/s².
    PitchAcceleration,
    /// Acceleration of a car's leading bogie, m/s².
    FrontBogieAcceleration,
    /// Acceleration of a car's trailing bogie, m/s².
    RearBogieAcceleration,
    /// Contact force of a wheelset, N.
    ContactForce,
    /// Displacement of the rail under a wheel, m.
    RailDisplacement,
    /// Force of a support on the deck, N.
    Force,
    /// Its mean over the last step, N.
    MeanForce,
    /// Bending moment, N·m.
    Moment,
    /// Work of all support forces over the last step, J.
    DeckWork,
    /// Another, by its name.
    Other(String),
}

/// All quantities with a name of ours.
const NAMES: [(Quantity, &str); 14] = [
    (Quantity::Position, "position"),
    (Quantity::Displacement, "displacement"),
    (Quantity::Velocity, "velocity"),
    (Quantity::Acceleration, "acceleration"),
    (Quantity::PeakAcceleration, "peak_acceleration"),
    (Quantity::PitchAcceleration, "pitch_acceleration"),
    (Quantity::FrontBogieAcceleration, "front_bogie_acceleration"),
    (Quantity::RearBogieAcceleration, "rear_bogie_acceleration"),
    (Quantity::ContactForce, "contact_force"),
    (Quantity::RailDisplacement, "rail_displacement"),
    (Quantity::Force, "force"),
    (Quantity::MeanForce, "mean_force"),
    (Quantity::Moment, "moment"),
    (Quantity::DeckWork, ttb_contract::names::WORK),
];

impl Quantity {
    /// By its name.
    pub fn named(name: &str) -> Self {
        let known = NAMES.iter().find(|(_, known)| *known == name);
        known.map_or_else(|| Self::Other(name.into()), |(quantity, _)| quantity.clone())
    }

    /// Its name.
    pub fn name(&self) -> &str {
        if let Self::Other(name) = self {
            return name;
        }
        NAMES.iter().find(|(quantity, _)| quantity == self).map_or("", |(_, name)| name)
    }
}

impl std::fmt::Display for Quantity {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.name())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_unique_and_come_back() {
        for (quantity, name) in &NAMES {
            assert_eq!((Quantity::named(name), quantity.name()), (quantity.clone(), *name));
        }
        assert_eq!(Quantity::named("torque"), Quantity::Other("torque".into()));
    }
}
