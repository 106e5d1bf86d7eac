//! What bindings give a component → start values of its FMU's variables, in the FMU's own units.
//!
//! A value goes over one or more hops: the entry of a mapping, connections of systems. On each
//!
//! ```text
//! value in the unit of the hop's end, where both are known and suppressUnitConversion does not say otherwise
//! then its transformation
//! ```
//!
//! and the last hop ends in the variable.

use std::collections::BTreeMap;

use ttb_fmi::description::{ModelDescription, ScalarVariable, VariableType};
use ttb_ssp::{BaseUnit, Bound, Flat, Hop, NamedUnit, Offer, Report, Transformation, Unit, Value};

use super::wiring::unit_of;
use crate::connect::map;
use crate::connect::parameters::is_settable;

/// Start values of a component by the names of its variables; `hit` notes which offers have found a variable.
pub fn start_values(
    flat: &Flat,
    component: usize,
    description: &ModelDescription,
    units: &[Unit],
    hit: &mut [bool],
    warnings: &mut Vec<String>,
    report: &mut Report,
) -> BTreeMap<String, map::Value> {
    let mut last: BTreeMap<&str, &Bound> = BTreeMap::new();
    for bound in &flat.values[component] {
        if description.variable(&bound.variable).is_some() {
            hit[bound.offer] = true;
            last.insert(&bound.variable, bound);
        }
    }
    let mut values = BTreeMap::new();
    for (name, bound) in last {
        let Some(variable) = description.variable(name) else { continue };
        let of = Target { variable, description, units };
        let value = if is_settable(variable) {
            of.value(bound)
        } else {
            let ScalarVariable { causality, variability, .. } = variable;
            Err(format!("{name} cannot be set: it is a {variability} {causality} of {}", description.model_name))
        };
        if let (Value::Real(x, Some(unit)), None) = (&bound.value, &variable.unit)
            && bound.hops.len() == 1
            && !bound.hops[0].suppress_unit_conversion
        {
            let Offer { file, place, .. } = &flat.offers[bound.offer];
            let unit = &unit.name;
            warnings.push(format!("{file}: {place}: {x} {unit} is taken as {x}, since {name} has no unit in the FMU"));
        }
        match value {
            Ok(value) => drop(values.insert(name.to_string(), value)),
            Err(why) => {
                let offer = &flat.offers[bound.offer];
                report.problem_in(&offer.file, &offer.place, why);
            }
        }
    }
    values
}

/// The variable that gets a value.
struct Target<'a> {
    variable: &'a ScalarVariable,
    description: &'a ModelDescription,
    units: &'a [Unit],
}

impl Target<'_> {
    fn value(&self, bound: &Bound) -> Result<map::Value, String> {
        let Self { variable, description, .. } = self;
        let own = variable.unit.as_ref().and_then(|name| unit_of(description, name));
        let mut value = bound.value.clone();
        if let (Value::Integer(i), VariableType::Real) = (&value, variable.kind) {
            value = Value::Real(*i as f64, None);
        }
        let plain = bound.hops.iter().all(|hop| hop.suppress_unit_conversion);
        let mut unit = match &value {
            Value::Real(_, Some(unit)) if !plain => self.unit(unit, own)?,
            _ => None,
        };
        for (k, hop) in bound.hops.iter().enumerate() {
            let target = hop.unit.or_else(|| own.filter(|_| k + 1 == bound.hops.len()));
            if let (Value::Real(x, _), Some(from), Some(to), false) =
                (&mut value, unit, target, hop.suppress_unit_conversion)
            {
                *x = converted(*x, from, to)
                    .ok_or_else(|| format!("{}: its unit is one of another quantity", variable.name))?;
            }
            unit = target.or(unit);
            value = self.transformed(value, hop)?;
        }
        self.fitting(value)
    }

    /// What a named unit is: by the set, by the structure, by the FMU. The variable's own name for its unit needs no more.
    fn unit(&self, unit: &NamedUnit, own: Option<BaseUnit>) -> Result<Option<BaseUnit>, String> {
        let of_structure = || self.units.iter().find(|known| known.name == unit.name).map(|known| known.base);
        let known = unit.base.or_else(of_structure).or_else(|| unit_of(self.description, &unit.name));
        if known.is_some() || own.is_none() || self.variable.unit.as_ref() == Some(&unit.name) {
            return Ok(known);
        }
        Err(format!("the unit {} is defined nowhere: it belongs into the Units of the parameter set", unit.name))
    }

    fn transformed(&self, value: Value, hop: &Hop) -> Result<Value, String> {
        fn entry<T: PartialEq + Clone>(table: &[(T, T)], value: T) -> T {
            table.iter().find(|(source, _)| *source == value).map_or(value, |(_, target)| target.clone())
        }
        let Some(transformation) = &hop.transformation else { return Ok(value) };
        Ok(match (transformation, value) {
            (Transformation::Linear { factor, offset }, Value::Real(x, unit)) => Value::Real(factor * x + offset, unit),
            (Transformation::Boolean(table), Value::Boolean(truth)) => Value::Boolean(entry(table, truth)),
            (Transformation::Integer(table), Value::Integer(i)) => Value::Integer(entry(table, i)),
            (Transformation::Integer(table), Value::Item(name, number)) => {
                let number = number.or_else(|| self.number(&name)).ok_or_else(|| self.no_item(&name))?;
                Value::Integer(entry(table, number))
            }
            (Transformation::Enumeration(table), Value::Item(name, _)) => Value::Item(entry(table, name), None),
            (other, value) => return Err(format!("{} is not for {}", other.name(), word(&value))),
        })
    }

    /// As the variable takes it.
    fn fitting(&self, value: Value) -> Result<map::Value, String> {
        let whole = |i: i64| i32::try_from(i).map(f64::from).map_err(|_| format!("{i} is beyond 32 bits"));
        let number = |x: f64| Ok(map::Value::Number(x));
        match (self.variable.kind, value) {
            (VariableType::Real, Value::Real(x, _)) if x.is_finite() => number(x),
            (VariableType::Integer, Value::Integer(i) | Value::Item(_, Some(i))) => number(whole(i)?),
            (VariableType::Integer, Value::Real(x, _)) if x == f64::from(x as i32) => number(x),
            (VariableType::Enumeration, Value::Integer(i)) => match self.items() {
                Some(items) if items.iter().all(|(_, known)| i64::from(*known) != i) => {
                    Err(self.no_item(&i.to_string()))
                }
                _ => number(whole(i)?),
            },
            (VariableType::Enumeration, Value::Item(name, number_of_set)) => {
                let number_here = self.number(&name).or(if self.items().is_none() { number_of_set } else { None });
                number(whole(number_here.ok_or_else(|| self.no_item(&name))?)?)
            }
            (VariableType::Boolean, Value::Boolean(truth)) => Ok(map::Value::Boolean(truth)),
            (VariableType::Boolean, Value::Integer(i @ (0 | 1))) => Ok(map::Value::Boolean(i == 1)),
            (VariableType::String, Value::Text(text)) => Ok(map::Value::Text(text)),
            (kind, value) => Err(format!("{} is of type {kind:?}, the value is {}", self.variable.name, word(&value))),
        }
    }

    /// Items of its enumeration, where the FMU tells them.
    fn items(&self) -> Option<&Vec<(String, i32)>> {
        self.description.enumerations.get(self.variable.declared_type.as_ref()?)
    }

    fn number(&self, item: &str) -> Option<i64> {
        self.items()?.iter().find(|(name, _)| name == item).map(|(_, number)| i64::from(*number))
    }

    fn no_item(&self, item: &str) -> String {
        let items = self.items().into_iter().flatten().map(|(name, number)| format!("{name} ({number})"));
        let items = items.collect::<Vec<_>>().join(", ");
        let items = if items.is_empty() { "the FMU names none".into() } else { format!("there are {items}") };
        format!("{}: its enumeration has no item {item}; {items}", self.variable.name)
    }
}

/// From one unit to another of the same quantity; not a bit changes between equal ones.
fn converted(x: f64, from: BaseUnit, to: BaseUnit) -> Option<f64> {
    if from.powers != to.powers {
        return None;
    }
    Some(if from == to { x } else { (from.factor * x + from.offset - to.offset) / to.factor })
}

fn word(value: &Value) -> String {
    match value {
        Value::Real(x, _) => format!("the number {x}"),
        Value::Integer(i) => format!("the whole number {i}"),
        Value::Boolean(truth) => truth.to_string(),
        Value::Text(text) => format!("the text {text:?}"),
        Value::Item(name, _) => format!("the item {name}"),
        Value::Other(what) => what.clone(),
    }
}

/// What found no variable, as warnings, one for each file.
pub fn without_variable(flat: &Flat, hit: &[bool]) -> Vec<String> {
    const TOLD: usize = 5;
    let mut files: BTreeMap<&str, Vec<&str>> = BTreeMap::new();
    for (offer, _) in flat.offers.iter().zip(hit).filter(|(offer, hit)| !**hit && !offer.connector) {
        files.entry(&offer.file).or_default().push(&offer.name);
    }
    let told = |(file, names): (&str, Vec<&str>)| {
        let more = names.len().saturating_sub(TOLD);
        let more = if more > 0 { format!(" and {more} more") } else { String::new() };
        let named = names.iter().take(TOLD).copied().collect::<Vec<_>>().join(", ");
        format!("{file}: no variable has the name {named}{more}: what is bound to it is ignored, as SSP says")
    };
    files.into_iter().map(told).collect()
}
