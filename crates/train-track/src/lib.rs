//! the train-track subsystem.
