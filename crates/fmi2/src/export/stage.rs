//! Where an instance is in its life, and what is allowed there.

/// Where an instance is in its life (FMI 2.0, section 4.2.4); each is one bit, so that a call lists those it accepts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub enum Stage {
    /// Fresh or reset.
    Instantiated = 1,
    /// In initialization mode.
    Initialization = 2,
    /// Between steps.
    Stepping = 4,
    /// A step failed: the physics may be half-way through it.
    Failed = 8,
    /// After `fmi2Terminate`.
    Terminated = 16,
    /// The code panicked: nothing in the model can be trusted.
    Panicked = 32,
}

/// Before, in and after initialization, between steps.
pub const USABLE: u8 = Stage::Instantiated as u8 | Stage::Initialization as u8 | Stage::Stepping as u8;
/// Also with the last step failed or the simulation terminated: reading harms nobody.
pub const READABLE: u8 = USABLE | Stage::Failed as u8 | Stage::Terminated as u8;
/// Also after a panic: what makes an instance usable again, or takes it away.
pub const ALWAYS: u8 = READABLE | Stage::Panicked as u8;
