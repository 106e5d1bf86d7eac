//! Variables of an instance: reading, setting, derivatives.

use super::life::FmuInstance;
use crate::description::VariableType;
use crate::error::FmuError;
use crate::slave::Call;

impl FmuInstance {
    /// Reads Reals.
    ///
    /// # Errors
    /// The FMU refuses, or the slices differ in length.
    pub fn get_real(&mut self, references: &[u32], values: &mut [f64]) -> Result<(), FmuError> {
        if !self.worth_calling(references.len(), values.len())? {
            return Ok(());
        }
        self.run(Call::GetReal, |slave| slave.get_real(references, values))
    }

    /// Sets Reals.
    ///
    /// # Errors
    /// The FMU refuses, or the slices differ in length.
    pub fn set_real(&mut self, references: &[u32], values: &[f64]) -> Result<(), FmuError> {
        if !self.worth_calling(references.len(), values.len())? {
            return Ok(());
        }
        self.run(Call::SetReal, |slave| slave.set_real(references, values))
    }

    /// Sets derivatives of inputs for the coming step; `orders` is 1 for first derivatives.
    ///
    /// # Errors
    /// The FMU cannot or refuses, or the slices differ in length.
    pub fn set_input_derivatives(
        &mut self,
        references: &[u32],
        orders: &[i32],
        values: &[f64],
    ) -> Result<(), FmuError> {
        if !self.worth_calling(references.len(), values.len().min(orders.len()))? {
            return Ok(());
        }
        self.needs(Call::SetInputDerivatives)?;
        let (orders, values) = (&orders[..references.len()], &values[..references.len()]);
        self.run(Call::SetInputDerivatives, |slave| slave.set_input_derivatives(references, orders, values))
    }

    /// Derivative of `unknown` outputs along a change `seed` of the `known` inputs.
    ///
    /// # Errors
    /// The FMU cannot or refuses, or slices differ in length.
    pub fn directional_derivative(
        &mut self,
        unknown: &[u32],
        known: &[u32],
        seed: &[f64],
        out: &mut [f64],
    ) -> Result<(), FmuError> {
        if !self.worth_calling(unknown.len(), out.len())? || !self.worth_calling(known.len(), seed.len())? {
            out.fill(0.0);
            return Ok(());
        }
        self.needs(Call::DirectionalDerivative)?;
        self.run(Call::DirectionalDerivative, |slave| slave.directional_derivative(unknown, known, seed, out))
    }

    /// Sets one variable by name to a number, whatever its numeric type: a Boolean to `value != 0`.
    ///
    /// # Errors
    /// No such variable, a String, a number that is not whole for an Integer, or the FMU refuses.
    pub fn set_number(&mut self, name: &str, value: f64) -> Result<(), FmuError> {
        let (vr, kind) = self.find(name)?;
        match kind {
            VariableType::Real => self.set_real(&[vr], &[value]),
            VariableType::Boolean => self.set_boolean(vr, value != 0.0),
            VariableType::Integer | VariableType::Enumeration if value == f64::from(value as i32) => {
                self.set_integer(vr, value as i32)
            }
            VariableType::Integer | VariableType::Enumeration => {
                Err(self.impossible(format!("{name} is an Integer and cannot be set to {value}")))
            }
            VariableType::String => Err(self.impossible(format!("{name} is a String and cannot be set to {value}"))),
        }
    }

    /// Reads one variable by name as a number, whatever its numeric type.
    ///
    /// # Errors
    /// No such variable, a String, or the FMU refuses.
    pub fn get_number(&mut self, name: &str) -> Result<f64, FmuError> {
        let (vr, kind) = self.find(name)?;
        match kind {
            VariableType::Real => {
                let mut value = [0.0];
                self.get_real(&[vr], &mut value)?;
                Ok(value[0])
            }
            VariableType::Integer | VariableType::Enumeration => self.get_integer(vr).map(f64::from),
            VariableType::Boolean => self.get_boolean(vr).map(|truth| f64::from(u8::from(truth))),
            VariableType::String => Err(self.impossible(format!("{name} is a String, not a number"))),
        }
    }

    /// Reads an Integer or an enumeration.
    ///
    /// # Errors
    /// The FMU refuses.
    pub fn get_integer(&mut self, reference: u32) -> Result<i32, FmuError> {
        self.needs(Call::GetInteger)?;
        let mut value = 0;
        self.run(Call::GetInteger, |slave| slave.get_integer(reference, &mut value)).map(|()| value)
    }

    /// Reads a Boolean.
    ///
    /// # Errors
    /// The FMU refuses.
    pub fn get_boolean(&mut self, reference: u32) -> Result<bool, FmuError> {
        self.needs(Call::GetBoolean)?;
        let mut value = false;
        self.run(Call::GetBoolean, |slave| slave.get_boolean(reference, &mut value)).map(|()| value)
    }

    /// Reads a String.
    ///
    /// # Errors
    /// The FMU refuses.
    pub fn get_string(&mut self, reference: u32) -> Result<String, FmuError> {
        self.needs(Call::GetString)?;
        let mut value = String::new();
        self.run(Call::GetString, |slave| slave.get_string(reference, &mut value)).map(|()| value)
    }

    /// Sets an Integer or an enumeration.
    ///
    /// # Errors
    /// The FMU refuses.
    pub fn set_integer(&mut self, reference: u32, value: i32) -> Result<(), FmuError> {
        self.needs(Call::SetInteger)?;
        self.run(Call::SetInteger, |slave| slave.set_integer(reference, value))
    }

    /// Sets a Boolean.
    ///
    /// # Errors
    /// The FMU refuses.
    pub fn set_boolean(&mut self, reference: u32, value: bool) -> Result<(), FmuError> {
        self.needs(Call::SetBoolean)?;
        self.run(Call::SetBoolean, |slave| slave.set_boolean(reference, value))
    }

    /// Sets a String.
    ///
    /// # Errors
    /// The FMU refuses, or the text contains a zero byte.
    pub fn set_string(&mut self, reference: u32, value: &str) -> Result<(), FmuError> {
        self.needs(Call::SetString)?;
        if value.contains('\0') {
            return Err(self.impossible("a String cannot contain a zero byte"));
        }
        self.run(Call::SetString, |slave| slave.set_string(reference, value))
    }

    fn find(&self, name: &str) -> Result<(u32, VariableType), FmuError> {
        let found = self.description.variable(name).map(|v| (v.value_reference, v.kind));
        found.ok_or_else(|| self.impossible(format!("it has no variable {name}")))
    }

    /// Whether there is anything to exchange; some FMUs stumble over a call for nothing.
    fn worth_calling(&self, references: usize, values: usize) -> Result<bool, FmuError> {
        if references == values {
            return Ok(references > 0);
        }
        Err(self.impossible(format!("{references} variables were given {values} values")))
    }
}
