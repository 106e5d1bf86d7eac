//! A train on its track in the plane or in space: the same life, other equations.

use std::sync::Arc;

use crate::built::Built;
use crate::prepared::Prepared;
use crate::space::built::SpaceBuilt;
use crate::space::state::SpaceState;
use crate::state::State;

/// A train ready to run.
pub enum Either {
    /// In the vertical plane.
    Plane(Box<Built>),
    /// In space.
    Space(Box<SpaceBuilt>),
}

/// A state of either.
#[derive(Clone, Debug, PartialEq)]
pub enum Saved {
    /// Of a plane run.
    Plane(Arc<State>),
    /// Of a run in space.
    Space(Arc<SpaceState>),
}

impl Saved {
    /// The state of a plane run.
    pub fn plane(&self) -> Option<Arc<State>> {
        match self {
            Self::Plane(state) => Some(Arc::clone(state)),
            Self::Space(_) => None,
        }
    }

    /// The state of a run in space.
    pub fn space(&self) -> Option<Arc<SpaceState>> {
        match self {
            Self::Plane(_) => None,
            Self::Space(state) => Some(Arc::clone(state)),
        }
    }

    /// Appends all numbers, little endian.
    pub fn write(&self, bytes: &mut Vec<u8>) {
        match self {
            Self::Plane(state) => state.write(bytes),
            Self::Space(state) => state.write(bytes),
        }
    }
}

impl Either {
    /// The track it runs on.
    pub fn prepared(&self) -> &Arc<Prepared> {
        match self {
            Self::Plane(built) => built.prepared(),
            Self::Space(built) => &built.system().prepared,
        }
    }

    /// Start of the run, s.
    pub fn start(&self) -> f64 {
        match self {
            Self::Plane(built) => built.start(),
            Self::Space(built) => built.start(),
        }
    }

    /// Static equilibrium for the deck motion.
    ///
    /// # Errors
    /// There is none, or it was not found.
    pub fn equilibrium(&mut self, deck: &[f64]) -> Result<(), String> {
        match self {
            Self::Plane(built) => built.equilibrium(deck),
            Self::Space(built) => built.equilibrium(deck),
        }
    }

    /// From static equilibrium to the state of the start.
    ///
    /// # Errors
    /// The pre-roll cannot be done.
    pub fn roll_in(&mut self) -> Result<(), String> {
        match self {
            Self::Plane(built) => built.roll_in(),
            Self::Space(built) => built.roll_in(),
        }
    }

    /// One macro step.
    ///
    /// # Errors
    /// It cannot be done.
    pub fn step(&mut self, inputs: &[f64], rates: Option<&[f64]>, t: f64, h: f64) -> Result<(), String> {
        match self {
            Self::Plane(built) => built.step(inputs, rates, t, h),
            Self::Space(built) => built.step(inputs, rates, t, h),
        }
    }

    /// Whether the last step could not be done because a wheel has left its rail.
    pub fn has_ended(&self) -> bool {
        match self {
            Self::Plane(_) => false,
            Self::Space(built) => built.has_ended(),
        }
    }

    /// Fills in all outputs at time `t`, s; `plane` of them are those of a plane run.
    pub fn outputs(&mut self, t: f64, plane: usize, out: &mut [f64]) {
        match self {
            Self::Plane(built) => built.outputs(t, out),
            Self::Space(built) => built.outputs(t, plane, out),
        }
    }

    /// The state.
    pub fn save(&self) -> Saved {
        match self {
            Self::Plane(built) => Saved::Plane(Arc::clone(built.state())),
            Self::Space(built) => Saved::Space(Arc::clone(built.state())),
        }
    }

    /// Puts back a state of its own kind; another one is left alone.
    pub fn restore(&mut self, state: &Saved) {
        match (self, state) {
            (Self::Plane(built), Saved::Plane(state)) => built.restore(state),
            (Self::Space(built), Saved::Space(state)) => built.restore(state),
            _ => {}
        }
    }

    /// A state from its bytes.
    ///
    /// # Errors
    /// Bytes of another train or track, or a number that is not finite.
    pub fn read(&self, bytes: &[u8]) -> Result<Saved, String> {
        match self {
            Self::Plane(built) => {
                let mut state = State::clone(built.state());
                state.read(bytes)?;
                Ok(Saved::Plane(Arc::new(state)))
            }
            Self::Space(built) => {
                let mut state = SpaceState::clone(built.state());
                state.read(bytes)?;
                Ok(Saved::Space(Arc::new(state)))
            }
        }
    }
}
