//! Variables of an instance: reading, setting, derivatives.

use super::description::VariableType;
use super::error::FmuError;
use super::instance::FmuInstance;
use crate::types::*;
use std::ffi::{CStr, CString};
use std::ptr;

impl FmuInstance {
    /// Reads Reals.
    ///
    /// # Errors
    /// The FMU refuses, or the slices differ in length.
    pub fn get_real(&mut self, references: &[u32], values: &mut [f64]) -> Result<(), FmuError> {
        if !self.worth_calling(references.len(), values.len())? {
            return Ok(());
        }
        let (vr, n, out) = (references.as_ptr(), references.len(), values.as_mut_ptr());
        // SAFETY: a live instance and two arrays of n items.
        self.run("fmi2GetReal", |f, c| unsafe { (f.get_real)(c, vr, n, out) })
    }

    /// Sets Reals.
    ///
    /// # Errors
    /// The FMU refuses, or the slices differ in length.
    pub fn set_real(&mut self, references: &[u32], values: &[f64]) -> Result<(), FmuError> {
        if !self.worth_calling(references.len(), values.len())? {
            return Ok(());
        }
        let (vr, n, values) = (references.as_ptr(), references.len(), values.as_ptr());
        // SAFETY: a live instance and two arrays of n items.
        self.run("fmi2SetReal", |f, c| unsafe { (f.set_real)(c, vr, n, values) })
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
        let Some(set) = self.loaded.functions.set_input_derivatives else {
            return Err(self.missing("fmi2SetRealInputDerivatives"));
        };
        let (vr, n, orders, values) = (references.as_ptr(), references.len(), orders.as_ptr(), values.as_ptr());
        // SAFETY: a live instance and three arrays of n items at least.
        self.run("fmi2SetRealInputDerivatives", |_, c| unsafe { set(c, vr, n, orders, values) })
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
        let Some(derive) = self.loaded.functions.directional_derivative else {
            return Err(self.missing("fmi2GetDirectionalDerivative"));
        };
        let (vr, n, out) = (unknown.as_ptr(), unknown.len(), out.as_mut_ptr());
        let (known, m, seed) = (known.as_ptr(), known.len(), seed.as_ptr());
        // SAFETY: a live instance, two arrays of n items and two of m.
        self.run("fmi2GetDirectionalDerivative", |_, c| unsafe { derive(c, vr, n, known, m, seed, out) })
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
        let Some(get) = self.loaded.functions.get_integer else { return Err(self.missing("fmi2GetInteger")) };
        let mut value = 0;
        let out = &raw mut value;
        // SAFETY: a live instance and arrays of one item.
        self.run("fmi2GetInteger", |_, c| unsafe { get(c, &reference, 1, out) })?;
        Ok(value)
    }

    /// Reads a Boolean.
    ///
    /// # Errors
    /// The FMU refuses.
    pub fn get_boolean(&mut self, reference: u32) -> Result<bool, FmuError> {
        let Some(get) = self.loaded.functions.get_boolean else { return Err(self.missing("fmi2GetBoolean")) };
        let mut value = FMI2_FALSE;
        let out = &raw mut value;
        // SAFETY: a live instance and arrays of one item.
        self.run("fmi2GetBoolean", |_, c| unsafe { get(c, &reference, 1, out) })?;
        Ok(value != FMI2_FALSE)
    }

    /// Reads a String.
    ///
    /// # Errors
    /// The FMU refuses.
    pub fn get_string(&mut self, reference: u32) -> Result<String, FmuError> {
        let Some(get) = self.loaded.functions.get_string else { return Err(self.missing("fmi2GetString")) };
        let mut value: fmi2String = ptr::null();
        let out = &raw mut value;
        // SAFETY: a live instance and arrays of one item.
        self.run("fmi2GetString", |_, c| unsafe { get(c, &reference, 1, out) })?;
        if value.is_null() {
            return Ok(String::new());
        }
        // SAFETY: FMI 2.0 keeps the string until the next call; it is copied here.
        Ok(unsafe { CStr::from_ptr(value) }.to_string_lossy().into_owned())
    }

    /// Sets an Integer or an enumeration.
    ///
    /// # Errors
    /// The FMU refuses.
    pub fn set_integer(&mut self, reference: u32, value: i32) -> Result<(), FmuError> {
        let Some(set) = self.loaded.functions.set_integer else { return Err(self.missing("fmi2SetInteger")) };
        // SAFETY: a live instance and arrays of one item.
        self.run("fmi2SetInteger", |_, c| unsafe { set(c, &reference, 1, &value) })
    }

    /// Sets a Boolean.
    ///
    /// # Errors
    /// The FMU refuses.
    pub fn set_boolean(&mut self, reference: u32, value: bool) -> Result<(), FmuError> {
        let Some(set) = self.loaded.functions.set_boolean else { return Err(self.missing("fmi2SetBoolean")) };
        let value = fmi2Boolean::from(value);
        // SAFETY: a live instance and arrays of one item.
        self.run("fmi2SetBoolean", |_, c| unsafe { set(c, &reference, 1, &value) })
    }

    /// Sets a String.
    ///
    /// # Errors
    /// The FMU refuses, or the text contains a zero byte.
    pub fn set_string(&mut self, reference: u32, value: &str) -> Result<(), FmuError> {
        let Some(set) = self.loaded.functions.set_string else { return Err(self.missing("fmi2SetString")) };
        let value = CString::new(value).map_err(|_| self.impossible("a String cannot contain a zero byte"))?;
        // SAFETY: a live instance and arrays of one item.
        self.run("fmi2SetString", |_, c| unsafe { set(c, &reference, 1, &value.as_ptr()) })
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

    #[cold]
    pub(super) fn missing(&self, function: &str) -> FmuError {
        self.impossible(format!("its library has no {function}"))
    }
}
