//! A column of results: quantity, of what, unit. Its name is how it is written; [`Column::parse`] reads names, ours and those
//! of foreign FMUs.

use crate::quantity::Quantity;

/// What a quantity belongs to. Wheels, cars and supports are counted from 1.
#[derive(Clone, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Of {
    /// A wheelset, from the front of the train.
    Wheel(usize),
    /// A car, from the front of the train.
    Car(usize),
    /// A support of the track on the deck.
    Support(usize),
    /// A monitored point of the bridge.
    Point(String),
    /// A monitored point of the rail.
    Rail(String),
    /// The model as a whole.
    Whole,
}

/// A recorded variable.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Column {
    /// What is measured.
    pub quantity: Quantity,
    /// Of what.
    pub of: Of,
    /// Unit as its model tells it, empty if it tells none.
    pub unit: String,
    /// The instance it comes from, where its name alone would not tell.
    pub instance: Option<String>,
}

impl Column {
    /// By its name as its model has it. A name that is none of ours is a quantity of the whole.
    pub fn parse(name: &str, unit: &str) -> Self {
        let known = place(name).or_else(|| {
            let (instance, rest) = name.split_once('.')?;
            place(rest).map(|(_, of, quantity)| (Some(instance.to_string()), of, quantity))
        });
        let (instance, of, quantity) = known.unwrap_or_else(|| (None, Of::Whole, Quantity::named(name)));
        Self { quantity, of, unit: unit.into(), instance }
    }

    /// Whether its extremes are of interest: not those of a place, of what belongs to a support, or of the work of a step,
    /// which is the less the shorter the step.
    pub fn has_extremes(&self) -> bool {
        !matches!(self.of, Of::Support(_)) && !matches!(self.quantity, Quantity::Position | Quantity::DeckWork)
    }

    /// Whether it is a quantity of a kind of place, whichever it is: `column.is(Kind::Wheel, &Quantity::ContactForce)`.
    pub fn is(&self, kind: Kind, quantity: &Quantity) -> bool {
        self.of.kind() == kind && self.quantity == *quantity
    }

    /// What all members of a series share: `wheel[].contact_force` of all wheels.
    pub fn series(&self) -> String {
        match self.of.kind().word() {
            "" => self.to_string(),
            word => format!("{}{word}[].{}", self.prefix(), self.quantity),
        }
    }

    /// Of what: `wheel[1]`; empty for the whole.
    pub fn place(&self) -> String {
        format!("{}{}", self.prefix(), self.of)
    }

    fn prefix(&self) -> String {
        self.instance.as_ref().map_or_else(String::new, |instance| format!("{instance}."))
    }
}

/// Kinds of places.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Kind {
    /// Wheelsets.
    Wheel,
    /// Cars.
    Car,
    /// Supports.
    Support,
    /// Points of the bridge.
    Point,
    /// Points of the rail.
    Rail,
    /// The whole.
    Whole,
}

impl Kind {
    fn word(self) -> &'static str {
        match self {
            Self::Wheel => "wheel",
            Self::Car => "car",
            Self::Support => "support",
            Self::Point => "point",
            Self::Rail => "rail",
            Self::Whole => "",
        }
    }
}

impl Of {
    /// Its kind.
    pub fn kind(&self) -> Kind {
        match self {
            Self::Wheel(_) => Kind::Wheel,
            Self::Car(_) => Kind::Car,
            Self::Support(_) => Kind::Support,
            Self::Point(_) => Kind::Point,
            Self::Rail(_) => Kind::Rail,
            Self::Whole => Kind::Whole,
        }
    }
}

/// `wheel[1].contact_force`, if the name has this form.
fn place(name: &str) -> Option<(Option<String>, Of, Quantity)> {
    let (word, rest) = name.split_once('[')?;
    let (which, quantity) = rest.split_once("].")?;
    let number = || which.parse().ok().filter(|number: &usize| number.to_string() == which);
    let of = match word {
        "wheel" => Of::Wheel(number()?),
        "car" => Of::Car(number()?),
        "support" => Of::Support(number()?),
        "point" => Of::Point(which.into()),
        "rail" => Of::Rail(which.into()),
        _ => return None,
    };
    Some((None, of, Quantity::named(quantity)))
}

impl std::fmt::Display for Of {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let word = self.kind().word();
        match self {
            Self::Wheel(n) | Self::Car(n) | Self::Support(n) => write!(f, "{word}[{n}]"),
            Self::Point(name) | Self::Rail(name) => write!(f, "{word}[{name}]"),
            Self::Whole => Ok(()),
        }
    }
}

impl std::fmt::Display for Column {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        if let Some(instance) = &self.instance {
            write!(f, "{instance}.")?;
        }
        match self.of {
            Of::Whole => write!(f, "{}", self.quantity),
            _ => write!(f, "{}.{}", self.of, self.quantity),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_name_is_written_as_it_was_read() {
        let names = [
            "wheel[12].contact_force",
            "car[1].front_bogie_acceleration",
            "point[mid].moment",
            "rail[a-b].peak_acceleration",
            "support[3].mean_force",
            "deck_work",
            "Bridge2.point[mid].displacement",
            "der(x[1].y)",
            "wheel[01].position",
            "Deck.w[3]",
            "point[a].b[c].d",
        ];
        for name in names {
            assert_eq!(Column::parse(name, "m").to_string(), name);
        }
    }

    #[test]
    fn a_name_is_taken_apart_once() {
        let column = Column::parse("Bridge2.point[mid].displacement", "m");
        assert_eq!((column.of.clone(), column.quantity.clone()), (Of::Point("mid".into()), Quantity::Displacement));
        assert_eq!(
            (column.series().as_str(), column.place().as_str()),
            ("Bridge2.point[].displacement", "Bridge2.point[mid]")
        );
        assert_eq!(Column::parse("wheel[12].contact_force", "N").series(), "wheel[].contact_force");
        assert_eq!(Column::parse("deck_work", "J").series(), "deck_work");
        let kept = |name: &str| Column::parse(name, "").has_extremes();
        assert!(kept("wheel[1].contact_force") && kept("deflection") && !kept("wheel[1].position"));
        assert!(!kept("support[1].force") && !kept("deck_work"));
    }
}
