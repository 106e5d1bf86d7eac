//! What a subsystem has before it runs.

use std::sync::Arc;

use crate::model::{Model, ModelError};

/// All of a subsystem that depends on neither time nor, for a track, on train and speed: mesh, order of elimination, factors,
/// rows, tables. Any number of models share one, also in several threads.
pub trait Prepare: Send + Sync + Sized + 'static {
    /// What a model is built from.
    type Spec;
    /// The model.
    type Model: Model;

    /// Prepares for models of a specification.
    ///
    /// # Errors
    /// Anything in the specification that cannot be: the message names it.
    fn prepare(spec: &Self::Spec) -> Result<Arc<Self>, ModelError>;

    /// Whether a model of this specification can be had from here.
    fn serves(&self, spec: &Self::Spec) -> bool;

    /// A model.
    ///
    /// # Errors
    /// A specification that is not served, or that cannot be.
    fn model(self: &Arc<Self>, spec: &Self::Spec) -> Result<Self::Model, ModelError>;
}
