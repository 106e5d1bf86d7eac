//! The view that an iteration and a recorder have of either side: a few verbs over vectors.

/// A subsystem that did not do what it was asked.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Failure {
    /// Which subsystem, e.g. the FMU's model name.
    pub subsystem: String,
    /// What it was asked, what it answered, what it logged.
    pub message: String,
    /// Whether it ends the run of its own accord: a result and no fault.
    pub ended: bool,
}

impl Failure {
    /// A fault.
    pub fn new(subsystem: impl Into<String>, message: impl Into<String>) -> Self {
        Self { subsystem: subsystem.into(), message: message.into(), ended: false }
    }
}

impl std::fmt::Display for Failure {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}: {}", self.subsystem, self.message)
    }
}
impl std::error::Error for Failure {}

/// An output that can be recorded.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Signal {
    /// Its name.
    pub name: String,
    /// Its unit; empty if none is told.
    pub unit: String,
}

/// One side of the interface, seen as FMI sees it. Coupled vectors are in the order of the [`crate::Ports`]: one force a port;
/// positions, rates and others of the motions.
pub trait Subsystem {
    /// Sets the coupled inputs: values at t_n and, if `rates` is given, their first derivatives over the coming step.
    ///
    /// # Errors
    /// The subsystem refuses.
    fn set_inputs(&mut self, values: &[f64], rates: Option<&[f64]>) -> Result<(), Failure>;

    /// Reads the coupled outputs: at the end of the last step, or in static equilibrium during initialization. They may not
    /// be finite: the caller looks.
    ///
    /// # Errors
    /// The subsystem refuses.
    fn get_outputs(&mut self, outputs: &mut [f64]) -> Result<(), Failure>;

    /// Name of the coupled output at a position, for messages.
    fn output_name(&self, index: usize) -> String {
        format!("coupled output number {}", index + 1)
    }

    /// Ends initialization.
    ///
    /// # Errors
    /// The subsystem cannot start.
    fn exit_initialization(&mut self) -> Result<(), Failure>;

    /// One macro step from t to t + h; `may_restore` is true while the caller may still roll back behind t.
    ///
    /// # Errors
    /// The step failed; what that means for the run is the caller's decision.
    fn step(&mut self, t: f64, h: f64, may_restore: bool) -> Result<(), Failure>;

    /// Saves the state into the subsystem's one slot.
    ///
    /// # Errors
    /// The subsystem cannot.
    fn save(&mut self) -> Result<(), Failure>;

    /// Restores the slot's state.
    ///
    /// # Errors
    /// The subsystem cannot.
    fn restore(&mut self) -> Result<(), Failure>;

    /// Work of the coupled forces on the deck over the last step, J, as this side has counted it; `None`: it does not say.
    ///
    /// # Errors
    /// The subsystem refuses.
    fn work(&mut self) -> Result<Option<f64>, Failure> {
        Ok(None)
    }

    /// Whether [`Subsystem::set_inputs`] understands rates.
    fn can_interpolate(&self) -> bool;

    /// Whether [`Subsystem::save`] and [`Subsystem::restore`] work.
    fn can_roll_back(&self) -> bool {
        true
    }

    /// Another instance of the same, for trial steps, to be dropped afterwards: in the state this one had when initialization
    /// ended, under `inputs`. `None` if there can be none.
    ///
    /// # Errors
    /// It cannot be made.
    fn trial_instance(&mut self, _inputs: &[f64]) -> Result<Option<Box<dyn Subsystem>>, Failure> {
        Ok(None)
    }

    /// Whether [`Subsystem::derivative`] works.
    fn can_derive(&self) -> bool {
        false
    }

    /// Change of all coupled outputs at the end of the last step along a change `seed` of the input values it was
    /// given, in the way it was given them (with rates or held).
    ///
    /// # Errors
    /// The subsystem cannot.
    fn derivative(&mut self, _seed: &[f64], _change: &mut [f64]) -> Result<(), Failure> {
        Err(Failure::new("a subsystem", "it provides no directional derivatives"))
    }

    /// Chooses the outputs that [`Subsystem::read`] reads, those that are `wanted`, and tells them in its order.
    fn record(&mut self, _wanted: &dyn Fn(&Signal) -> bool) -> Vec<Signal> {
        Vec::new()
    }

    /// Reads the outputs that were chosen.
    ///
    /// # Errors
    /// The subsystem refuses.
    fn read(&mut self, _row: &mut [f64]) -> Result<(), Failure> {
        Ok(())
    }

    /// Name of the instance, or of all instances behind it.
    fn name(&self) -> &str;

    /// Seconds spent inside the subsystem's own code so far, where that is measured.
    fn seconds(&self) -> f64 {
        0.0
    }
}

/// A pointer to a subsystem is one.
macro_rules! forward {
    ($pointer:ty) => {
        impl<S: Subsystem + ?Sized> Subsystem for $pointer {
            fn set_inputs(&mut self, values: &[f64], rates: Option<&[f64]>) -> Result<(), Failure> {
                (**self).set_inputs(values, rates)
            }
            fn get_outputs(&mut self, outputs: &mut [f64]) -> Result<(), Failure> {
                (**self).get_outputs(outputs)
            }
            fn output_name(&self, index: usize) -> String {
                (**self).output_name(index)
            }
            fn exit_initialization(&mut self) -> Result<(), Failure> {
                (**self).exit_initialization()
            }
            fn step(&mut self, t: f64, h: f64, may_restore: bool) -> Result<(), Failure> {
                (**self).step(t, h, may_restore)
            }
            fn save(&mut self) -> Result<(), Failure> {
                (**self).save()
            }
            fn restore(&mut self) -> Result<(), Failure> {
                (**self).restore()
            }
            fn work(&mut self) -> Result<Option<f64>, Failure> {
                (**self).work()
            }
            fn can_interpolate(&self) -> bool {
                (**self).can_interpolate()
            }
            fn can_roll_back(&self) -> bool {
                (**self).can_roll_back()
            }
            fn trial_instance(&mut self, inputs: &[f64]) -> Result<Option<Box<dyn Subsystem>>, Failure> {
                (**self).trial_instance(inputs)
            }
            fn can_derive(&self) -> bool {
                (**self).can_derive()
            }
            fn derivative(&mut self, seed: &[f64], change: &mut [f64]) -> Result<(), Failure> {
                (**self).derivative(seed, change)
            }
            fn record(&mut self, wanted: &dyn Fn(&Signal) -> bool) -> Vec<Signal> {
                (**self).record(wanted)
            }
            fn read(&mut self, row: &mut [f64]) -> Result<(), Failure> {
                (**self).read(row)
            }
            fn name(&self) -> &str {
                (**self).name()
            }
            fn seconds(&self) -> f64 {
                (**self).seconds()
            }
        }
    };
}

forward!(Box<S>);
forward!(&mut S);
