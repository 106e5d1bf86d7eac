//! The bridge's interface list: names and order are the contract with the train–track side and with every master.

use ttb_contract::names::support;
use ttb_contract::{Component, Interface, Kind, Variable};
use ttb_scenario::spec::BridgeSpec;

use crate::law::ratio;
use crate::structure::Structure;

/// Values of the parameters, in the order of their group.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parameters {
    /// Damping ratio ζ.
    pub damping_ratio: f64,
    /// Factor k on the stiffness.
    pub stiffness_factor: f64,
    /// Factor m on the mass.
    pub mass_factor: f64,
    /// Step h that is factorised for, s.
    pub step_size: f64,
    /// Newmark's γ.
    pub gamma: f64,
    /// Newmark's β.
    pub beta: f64,
    /// What a held force means: 1 or 2, see [`Parameters::held`].
    pub input_meaning: f64,
}

/// What a force without rate means over a step.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Held {
    /// Its mean.
    #[default]
    Mean,
    /// Its value at the end.
    End,
}

/// Items of the enumeration parameter `input_meaning`, in the order of [`Held`].
const INPUT_MEANING: &[(&str, &str)] = &[
    ("mean", "the value is the mean over the step: for means, and for masters that take one pass"),
    (
        "end",
        "the value belongs to the end of the step, the force runs there on a straight line: for masters that iterate",
    ),
];

/// A component beside the vertical one with the descriptions of its force, position and rate.
type Lateral = (Component, [&'static str; 3]);

/// Those components.
const LATERAL: [Lateral; 2] = [
    (
        Component::Lateral,
        [
            "Lateral force of the track on the bridge, positive to the right",
            "Lateral displacement of the deck's reference point at the support, positive to the right",
            "Lateral velocity of the deck's reference point at the support, positive to the right",
        ],
    ),
    (
        Component::Roll,
        [
            "Moment of the track on the bridge about the track's axis, positive if it lowers the right side",
            "Rotation of the deck about the track's axis at the support, positive if the right side is lowered",
            "Angular velocity of the deck about the track's axis at the support, positive if the right side is lowered",
        ],
    ),
];

impl Structure {
    /// The components beside the vertical one that its supports have.
    fn lateral(&self) -> &'static [Lateral] {
        &LATERAL[..self.ports().checked_div(self.stations).unwrap_or(1).clamp(1, 3) - 1]
    }
}

/// The list for a structure.
pub fn list(spec: &BridgeSpec, structure: &Structure) -> Interface {
    let supports = 1..=structure.stations;
    let forces = supports.clone().map(|i| {
        Variable::input(format!("support[{i}].force"), "N", "Force of the track on the bridge, positive down")
    });
    let forces = forces.chain(structure.lateral().iter().flat_map(|(component, texts)| {
        let name = component.force();
        supports.clone().map(move |i| Variable::input(support(i, name), component.unit(), texts[0]))
    }));
    let mut outputs: Vec<Variable> = Vec::new();
    outputs.extend(supports.clone().map(|i| {
        Variable::output(
            format!("support[{i}].displacement"),
            "m",
            "Displacement of the deck under the support, positive down",
        )
    }));
    outputs.extend(supports.clone().map(|i| {
        Variable::output(
            format!("support[{i}].velocity"),
            "m/s",
            "Velocity of the deck under the support, positive down",
        )
    }));
    for point in &structure.points {
        let mut add = |what: &str, unit, description: &str| {
            outputs.push(Variable::output(format!("point[{}].{what}", point.name), unit, description));
        };
        add("displacement", "m", "Displacement of the monitored point");
        add("velocity", "m/s", "Velocity of the monitored point");
        add("acceleration", "m/s2", "Acceleration of the monitored point; with held inputs its mean over the step");
        if point.moment.is_some() {
            add("moment", "N.m", "Bending moment of the deck at the monitored point, sagging positive");
        }
    }
    for (component, texts) in structure.lateral() {
        let motions = [component.position(), component.rate()].into_iter().zip(component.motion_units());
        for ((name, unit), text) in motions.zip(&texts[1..]) {
            outputs.extend(supports.clone().map(|i| Variable::output(support(i, name), unit, text)));
        }
    }
    let parameters = vec![
        Variable::parameter("damping_ratio", "1", ratio(&spec.damping), "Damping ratio, from 0 to 1"),
        Variable::parameter("stiffness_factor", "1", 1.0, "Factor on all stiffness, positive"),
        Variable::parameter("mass_factor", "1", 1.0, "Factor on all mass, positive"),
        Variable::parameter("step_size", "s", spec.step, "Step that is factorised for; longer steps are divided"),
        Variable::parameter("gamma", "1", spec.newmark.gamma, "Newmark's gamma, from 0.5 to 1"),
        Variable::parameter(
            "beta",
            "1",
            spec.newmark.beta,
            "Newmark's beta, positive; unconditionally stable from gamma/2 on",
        ),
        Variable::parameter_of(
            "input_meaning",
            Kind::Enumeration(INPUT_MEANING),
            1.0,
            "What a force without derivative means over a step",
        ),
    ];
    Interface::new(forces.collect(), outputs, parameters)
}

impl Parameters {
    /// Reads the group of parameters.
    pub fn read(group: &[f64]) -> Option<Self> {
        let &[damping_ratio, stiffness_factor, mass_factor, step_size, gamma, beta, input_meaning] = group else {
            return None;
        };
        Some(Self { damping_ratio, stiffness_factor, mass_factor, step_size, gamma, beta, input_meaning })
    }

    /// What a held force means.
    pub fn held(&self) -> Held {
        if self.input_meaning == 2.0 { Held::End } else { Held::Mean }
    }

    /// The first one that cannot be: its name, value and rule.
    pub fn impossible(&self) -> Option<String> {
        let positive = |x: f64| x > 0.0 && x.is_finite();
        let rules = [
            ("damping_ratio", self.damping_ratio, (0.0..=1.0).contains(&self.damping_ratio), "between 0 and 1"),
            ("stiffness_factor", self.stiffness_factor, positive(self.stiffness_factor), "positive"),
            ("mass_factor", self.mass_factor, positive(self.mass_factor), "positive"),
            ("step_size", self.step_size, positive(self.step_size), "positive"),
            ("gamma", self.gamma, (0.5..=1.0).contains(&self.gamma), "between 0.5 and 1"),
            ("beta", self.beta, positive(self.beta), "positive"),
            ("input_meaning", self.input_meaning, [1.0, 2.0].contains(&self.input_meaning), "1 (mean) or 2 (end)"),
        ];
        let (name, value, _, rule) = rules.into_iter().find(|(_, _, possible, _)| !possible)?;
        Some(format!("parameter {name} is {value}; it must be {rule}"))
    }
}
