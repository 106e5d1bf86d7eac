//! One place where the two sides touch: a force, and the motion that does work with it.

/// Direction of a port. Forces act on the deck, motions are the deck's; both are positive along +z (down), along +y, and
/// about +x.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Component {
    /// Force and displacement along z, down.
    #[default]
    Vertical,
    /// Force and displacement along y.
    Lateral,
    /// Moment and rotation about x, the axis of the track.
    Roll,
}

impl Component {
    /// All components, in the order of an interface.
    pub const ALL: [Self; 3] = [Self::Vertical, Self::Lateral, Self::Roll];

    /// The component whose force a name ends in: `support[3].force_y`; none if it ends in none.
    pub fn of_force(name: &str) -> Option<Self> {
        let last = name.rsplit('.').next().unwrap_or(name);
        Self::ALL.into_iter().find(|component| component.force() == last)
    }

    /// Last part of the force's name.
    pub const fn force(self) -> &'static str {
        match self {
            Self::Vertical => "force",
            Self::Lateral => "force_y",
            Self::Roll => "moment_x",
        }
    }

    /// Last part of the name of the force's mean over a step.
    pub const fn mean_force(self) -> &'static str {
        match self {
            Self::Vertical => "mean_force",
            Self::Lateral => "mean_force_y",
            Self::Roll => "mean_moment_x",
        }
    }

    /// Last part of the position's name.
    pub const fn position(self) -> &'static str {
        match self {
            Self::Vertical => "displacement",
            Self::Lateral => "displacement_y",
            Self::Roll => "rotation_x",
        }
    }

    /// Last part of the rate's name.
    pub const fn rate(self) -> &'static str {
        match self {
            Self::Vertical => "velocity",
            Self::Lateral => "velocity_y",
            Self::Roll => "angular_velocity_x",
        }
    }

    /// SI unit of the force.
    pub const fn unit(self) -> &'static str {
        match self {
            Self::Vertical | Self::Lateral => "N",
            Self::Roll => "N.m",
        }
    }

    /// By what one axle load, N, is multiplied to give a force of this component that counts: 1, or for a moment half the
    /// distance between the rails of standard gauge, 0.75 m.
    pub fn lever(self) -> f64 {
        match self {
            Self::Vertical | Self::Lateral => 1.0,
            Self::Roll => 0.75,
        }
    }

    /// SI units of position and rate.
    pub const fn motion_units(self) -> [&'static str; 2] {
        match self {
            Self::Vertical | Self::Lateral => ["m", "m/s"],
            Self::Roll => ["rad", "rad/s"],
        }
    }
}

/// What is known of a port's motion.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum Known {
    /// Position and rate.
    #[default]
    PositionAndRate,
    /// The position alone.
    Position,
    /// Neither: the force is coupled, but nobody says along which motion it does work.
    Nothing,
}

/// A port: one entry among the forces, and a position with its rate among the motions. Force times rate is power.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Port {
    /// Number of the support it belongs to, from 1 along the track.
    pub support: usize,
    /// Its direction.
    pub component: Component,
    /// A force that counts, in the unit of the component: one axle load in N, or an axle load times a lever in N·m. Residuals
    /// and trial loads are measured with it. Positive and finite.
    pub scale: f64,
    /// What is known of its motion.
    pub known: Known,
}

impl Port {
    /// With position and rate, measured by `axle_load`, N.
    pub fn new(support: usize, component: Component, axle_load: f64) -> Self {
        Self { support, component, scale: axle_load * component.lever(), known: Known::PositionAndRate }
    }

    /// SI unit of its force.
    pub fn unit(&self) -> &'static str {
        self.component.unit()
    }
}
