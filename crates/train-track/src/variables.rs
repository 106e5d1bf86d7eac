//! Interface list of the train–track subsystem, and how a state fills its outputs.

use ttb_contract::names::WORK;
use ttb_contract::{Interface, Kind, Values, Variable};
use ttb_dynamics::newmark::Motion;
use ttb_scenario::spec::{Profile, TrainTrackSpec};

use crate::car::{AXLES, DOFS};
use crate::coupled::{State, TrainTrackSystem};
use crate::over::Over;
use crate::track::RailPoint;

/// What a held input means, enumeration parameter `input_meaning`.
const INPUT_MEANING: &[(&str, &str)] = &[
    ("extrapolate", "displacement runs on with the velocity input over the step: for masters that take one pass"),
    ("mean", "the value is the mean over the step"),
    ("end", "the value belongs to the end of the step: for masters that iterate but cannot set derivatives"),
];

/// Parameters in the order of their value references.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs, reason = "each is described in the interface list below")]
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
}

/// Value of a parameter.
pub fn parameter(interface: &Interface, values: &Values, parameter: Parameter) -> f64 {
    values.all[interface.parameters().start + parameter as usize]
}

/// The interface list for `spec`.
pub fn interface(spec: &TrainTrackSpec) -> Interface {
    let supports = 1..=spec.on_bridge.len();
    let axles = 1..=spec.cars.len() * AXLES;
    let each = |range: &std::ops::RangeInclusive<usize>, make: &dyn Fn(usize) -> Variable| {
        range.clone().map(make).collect::<Vec<_>>()
    };
    let mut inputs = each(&supports, &|i| {
        Variable::input(
            format!("support[{i}].displacement"),
            "m",
            "Displacement of the deck under the support, down, from the dead-load state",
        )
    });
    inputs.extend(each(&supports, &|i| {
        Variable::input(format!("support[{i}].velocity"), "m/s", "Velocity of the deck under the support, down")
    }));
    let mut outputs = each(&supports, &|i| {
        let force = Variable::output(format!("support[{i}].force"), "N", "Force of the support on the deck, down");
        Variable { feed_through: true, ..force }
    });
    outputs.extend(each(&supports, &|i| {
        Variable::output(format!("support[{i}].mean_force"), "N", "Mean of the force over the last step")
    }));
    for i in axles {
        outputs.extend([
            Variable::output(
                format!("wheel[{i}].contact_force"),
                "N",
                "Contact force of the axle on the rail, weight included",
            ),
            Variable::output(format!("wheel[{i}].position"), "m", "Abscissa of the axle"),
            Variable::output(format!("wheel[{i}].displacement"), "m", "Displacement of the wheelset, down"),
            Variable::output(
                format!("wheel[{i}].rail_displacement"),
                "m",
                "Displacement of the rail under the wheel, down",
            ),
        ]);
    }
    for i in 1..=spec.cars.len() {
        outputs.extend([
            Variable::output(format!("car[{i}].displacement"), "m", "Displacement of the car body's centre, down"),
            Variable::output(format!("car[{i}].acceleration"), "m/s2", "Acceleration of the car body's centre, down"),
            Variable::output(
                format!("car[{i}].pitch_acceleration"),
                "rad/s2",
                "Pitch acceleration of the car body, front down",
            ),
            Variable::output(
                format!("car[{i}].front_bogie_acceleration"),
                "m/s2",
                "Acceleration of the leading bogie, down",
            ),
            Variable::output(
                format!("car[{i}].rear_bogie_acceleration"),
                "m/s2",
                "Acceleration of the trailing bogie, down",
            ),
        ]);
    }
    for point in &spec.rail_points {
        let name = |what: &str| format!("rail[{}].{what}", point.name);
        outputs.extend([
            Variable::output(name("displacement"), "m", "Displacement of the rail, down"),
            Variable::output(name("velocity"), "m/s", "Velocity of the rail, down"),
            Variable::output(name("acceleration"), "m/s2", "Acceleration of the rail, down"),
            Variable::output(
                name("peak_acceleration"),
                "m/s2",
                "Acceleration of the greatest amount at the ends of the last step's sub-steps",
            ),
        ]);
    }
    outputs.push(Variable::output(WORK, "J", "Work of all support forces on the deck over the last step"));
    Interface::new(inputs, outputs, parameters(spec))
}

fn parameters(spec: &TrainTrackSpec) -> Vec<Variable> {
    let seed = match &spec.irregularity {
        Profile::Spectrum { seed, .. } => *seed as f64,
        _ => 0.0,
    };
    let real = |name: &str, unit, start, text: &str| Variable::parameter(name, unit, start, text);
    vec![
        real(
            "speed",
            "m/s",
            spec.speed[0][1],
            "Train speed at the first point of the speed profile; the whole profile is scaled with it",
        ),
        real("front_wheel", "m", spec.front_wheel, "Abscissa of the leading wheel at the start"),
        real("irregularity_scale", "1", spec.irregularity_scale, "Factor on the rail irregularity"),
        Variable::parameter_of(
            "irregularity_seed",
            Kind::Integer { min: 0, max: i32::MAX },
            seed,
            "Seed of a spectrum's random phases",
        ),
        real("fastener_stiffness_factor", "1", 1.0, "Factor on the stiffness of fasteners or rail pads"),
        real("fastener_damping_factor", "1", 1.0, "Factor on the damping of fasteners or rail pads"),
        real(
            "pre_roll",
            "m",
            spec.pre_roll,
            "Distance over which the cars are rolled before the start; 0: start at rest",
        ),
        real(
            "step_size",
            "s",
            spec.step / spec.substeps as f64,
            "Step that is factorised for; other steps are divided into parts not longer than this",
        ),
        real("gamma", "1", spec.newmark.gamma, "Newmark's gamma"),
        real("beta", "1", spec.newmark.beta, "Newmark's beta"),
        Variable::parameter_of(
            "local_compliance",
            Kind::Boolean,
            f64::from(u8::from(spec.local_compliance)),
            "Local flexibility of the rail under a load inside an element",
        ),
        Variable::parameter_of(
            "input_meaning",
            Kind::Enumeration(INPUT_MEANING),
            1.0,
            "What an input without derivative means over the step",
        ),
    ]
}

/// Writes all outputs of `state` at time `t` after the start; `over` is what the last step adds.
pub fn write_outputs(system: &TrainTrackSystem, state: &State, over: &Over, t: f64, out: &mut [f64]) {
    let n = state.supports.len();
    out[..n].copy_from_slice(&state.supports);
    out[n..2 * n].copy_from_slice(&over.mean);
    let (wheels, rest) = out[2 * n..].split_at_mut(4 * state.forces.len());
    let (cars, rest) = rest.split_at_mut(5 * system.cars.len());
    let (rail, work) = rest.split_at_mut(4 * over.points.len());
    for (axle, wheel) in wheels.chunks_exact_mut(4).enumerate() {
        let z = state.cars.u[axle / AXLES * DOFS + crate::car::FIRST_WHEEL + axle % AXLES];
        let rail = z - state.delta[axle] - system.roughness[axle];
        wheel.copy_from_slice(&[state.forces[axle], system.axle_position(axle, t), z, rail]);
    }
    for (c, car) in cars.chunks_exact_mut(5).enumerate() {
        let (u, a) = (&state.cars.u[c * DOFS..], &state.cars.a[c * DOFS..]);
        car.copy_from_slice(&[u[0], a[0], a[1], a[2], a[4]]);
    }
    let at = |point: &RailPoint, values: &[f64]| system.track.deflection(point, values);
    let Motion { u, v, a } = &state.track;
    for ((out, point), peak) in rail.chunks_exact_mut(4).zip(&over.points).zip(&over.peaks) {
        out.copy_from_slice(&[at(point, u), at(point, v), at(point, a), *peak]);
    }
    work.fill(over.work);
}
