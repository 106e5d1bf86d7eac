//! Parameters of the subsystem: one list from which the interface, their start values and their limits follow.

use ttb_contract::{Interface, Kind, Values, Variable};
use ttb_scenario::limits::{GREATEST_SPEED, LONGEST_PRE_ROLL, STEP};
use ttb_scenario::spec::{Profile, TrainTrackSpec};

/// Parameters in the order of their value references.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs, reason = "each is described in the list below")]
pub enum Parameter {
    Speed,
    FrontWheel,
    IrregularityScale,
    IrregularitySeed,
    FastenerStiffnessFactor,
    FastenerDampingFactor,
    PreRoll,
    StepSize,
    Gamma,
    Beta,
    LocalCompliance,
    InputMeaning,
    /// Of a run in space only.
    Friction,
}

/// What a held input means, enumeration parameter `input_meaning`.
const INPUT_MEANING: &[(&str, &str)] = &[
    ("extrapolate", "displacement runs on with the velocity input over the step: for masters that take one pass"),
    ("mean", "the value is the mean over the step"),
    ("end", "the value belongs to the end of the step: for masters that iterate but cannot set derivatives"),
];

/// Which values a parameter may have, besides being finite and of its kind.
enum Allowed {
    Any,
    /// From the first to the second, both included.
    Within(f64, f64),
}

struct Entry {
    name: &'static str,
    kind: Kind,
    text: &'static str,
    /// Value that the specification gives.
    start: fn(&TrainTrackSpec) -> f64,
    allowed: Allowed,
}

/// Factors on fasteners are not further from 1 than this: beyond it the rail is held rigidly, or by nothing.
const FACTOR: f64 = 1e6;

/// All parameters, in the order of [`Parameter`].
const PARAMETERS: [Entry; 13] = [
    Entry {
        name: "speed",
        kind: Kind::Real { unit: "m/s" },
        text: "Train speed at the first point of the speed profile; the whole profile is scaled with it",
        start: |spec| spec.speed[0][1],
        allowed: Allowed::Within(0.0, GREATEST_SPEED),
    },
    Entry {
        name: "front_wheel",
        kind: Kind::Real { unit: "m" },
        text: "Abscissa of the leading wheel at the start",
        start: |spec| spec.front_wheel,
        allowed: Allowed::Any,
    },
    Entry {
        name: "irregularity_scale",
        kind: Kind::Real { unit: "1" },
        text: "Factor on the rail irregularity",
        start: |spec| spec.irregularity_scale,
        allowed: Allowed::Any,
    },
    Entry {
        name: "irregularity_seed",
        kind: Kind::Integer { min: 0, max: i32::MAX },
        text: "Seed of a spectrum's random phases",
        start: |spec| match &spec.irregularity {
            Profile::Spectrum { seed, .. } => *seed as f64,
            _ => 0.0,
        },
        allowed: Allowed::Within(0.0, i32::MAX as f64),
    },
    Entry {
        name: "fastener_stiffness_factor",
        kind: Kind::Real { unit: "1" },
        text: "Factor on the stiffness of fasteners or rail pads",
        start: |_| 1.0,
        allowed: Allowed::Within(1.0 / FACTOR, FACTOR),
    },
    Entry {
        name: "fastener_damping_factor",
        kind: Kind::Real { unit: "1" },
        text: "Factor on the damping of fasteners or rail pads",
        start: |_| 1.0,
        allowed: Allowed::Within(0.0, FACTOR),
    },
    Entry {
        name: "pre_roll",
        kind: Kind::Real { unit: "m" },
        text: "Distance over which the cars are rolled before the start; 0: start at rest",
        start: |spec| spec.pre_roll,
        allowed: Allowed::Within(0.0, LONGEST_PRE_ROLL),
    },
    Entry {
        name: "step_size",
        kind: Kind::Real { unit: "s" },
        text: "Step that is factorised for; other steps are divided into parts not longer than this",
        start: |spec| spec.step / spec.substeps as f64,
        allowed: Allowed::Within(STEP[0], STEP[1]),
    },
    Entry {
        name: "gamma",
        kind: Kind::Real { unit: "1" },
        text: "Newmark's gamma",
        start: |spec| spec.newmark.gamma,
        allowed: Allowed::Within(0.5, 1.0),
    },
    Entry {
        name: "beta",
        kind: Kind::Real { unit: "1" },
        text: "Newmark's beta",
        start: |spec| spec.newmark.beta,
        allowed: Allowed::Within(0.25, 1.0),
    },
    Entry {
        name: "local_compliance",
        kind: Kind::Boolean,
        text: "Local flexibility of the rail under a load inside an element",
        start: |spec| f64::from(u8::from(spec.local_compliance)),
        allowed: Allowed::Within(0.0, 1.0),
    },
    Entry {
        name: "input_meaning",
        kind: Kind::Enumeration(INPUT_MEANING),
        text: "What an input without derivative means over the step",
        start: |_| 1.0,
        allowed: Allowed::Within(1.0, INPUT_MEANING.len() as f64),
    },
    Entry {
        name: "friction",
        kind: Kind::Real { unit: "1" },
        text: "Friction coefficient of wheel and rail",
        start: |spec| spec.space.as_ref().map_or(0.0, |space| space.contact.friction),
        allowed: Allowed::Within(0.0, 1.0),
    },
];

/// Parameters that a plane run has, too.
const PLANE: usize = 12;

/// The variables of all parameters.
pub fn variables(spec: &TrainTrackSpec) -> Vec<Variable> {
    let variable =
        |entry: &Entry| Variable::parameter_of(entry.name, entry.kind.clone(), (entry.start)(spec), entry.text);
    let count = if spec.space.is_some() { PARAMETERS.len() } else { PLANE };
    PARAMETERS.iter().take(count).map(variable).collect()
}

/// Values of all parameters that may stand together.
pub struct Parameters([f64; PARAMETERS.len()]);

impl Parameters {
    /// Takes them from the values of an interface.
    ///
    /// # Errors
    /// A value outside its limits, with its name and the limit.
    pub fn check(interface: &Interface, values: &Values) -> Result<Self, String> {
        let mut checked = [0.0; PARAMETERS.len()];
        let given = &values.all[interface.parameters()];
        for ((checked, value), entry) in checked.iter_mut().zip(given).zip(&PARAMETERS) {
            let refuse = |rule: String| Err(format!("parameter {} is {value}; it must be {rule}", entry.name));
            if !value.is_finite() {
                return refuse("a finite number".into());
            }
            if let Allowed::Within(least, most) = entry.allowed {
                if *value < least {
                    return refuse(format!("at least {least}"));
                }
                if *value > most {
                    return refuse(format!("at most {most}"));
                }
            }
            if !matches!(entry.kind, Kind::Real { .. }) && value.fract() != 0.0 {
                return refuse("a whole number".into());
            }
            *checked = *value;
        }
        let checked = Self(checked);
        let (gamma, beta) = (checked.get(Parameter::Gamma), checked.get(Parameter::Beta));
        if beta < 0.5 * gamma * (1.0 - 1e-12) {
            let limit = 0.5 * gamma;
            return Err(format!(
                "parameter beta is {beta}; it must be at least gamma/2 = {limit}, or steps are unstable"
            ));
        }
        Ok(checked)
    }

    /// Value of one of them.
    pub fn get(&self, parameter: Parameter) -> f64 {
        self.0[parameter as usize]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_list_stands_in_the_order_of_the_parameters() {
        for (parameter, name) in [
            (Parameter::Speed, "speed"),
            (Parameter::IrregularitySeed, "irregularity_seed"),
            (Parameter::PreRoll, "pre_roll"),
            (Parameter::StepSize, "step_size"),
            (Parameter::Beta, "beta"),
            (Parameter::InputMeaning, "input_meaning"),
            (Parameter::Friction, "friction"),
        ] {
            assert_eq!(PARAMETERS[parameter as usize].name, name);
        }
    }
}
