//! Outputs of the subsystem: one list from which the interface follows and by which a state fills them in.

use ttb_contract::names::{WORK, support};
use ttb_contract::{Component, Variable};
use ttb_scenario::spec::TrainTrackSpec;

use crate::coupled::TrainTrackSystem;
use crate::fleet::{Fleet, Reading};
use crate::state::State;
use crate::step_means::StepMeans;

/// What outputs are read from.
pub struct View<'a> {
    /// Matrices and the places of the wheels.
    pub system: &'a TrainTrackSystem,
    /// Outputs of all vehicles.
    pub readings: &'a [Reading],
    /// State at the end of the step.
    pub state: &'a State,
    /// What is known of the whole step.
    pub means: &'a StepMeans,
    /// Time after the start, s.
    pub t: f64,
}

/// An output of every body of a kind, and how it is read.
struct Output<R> {
    name: &'static str,
    unit: &'static str,
    text: &'static str,
    read: R,
}

/// Reads an output of one body, counted from 0.
type OfOne = fn(&View, usize) -> f64;

/// What an output belongs to.
#[derive(Clone, Copy)]
enum Body {
    Wheel,
    RailPoint,
    /// The subsystem as a whole: its outputs have no index.
    Whole,
}

/// Outputs in the order of their value references.
enum Group {
    /// One output of all supports on the bridge; `feed_through`: it follows the deck's motion at the same instant.
    Supports { output: Output<for<'a> fn(&'a View<'a>) -> &'a [f64]>, feed_through: bool },
    /// Outputs of the vehicles, as their bodies give them.
    Vehicles,
    /// All outputs of one body, then those of the next.
    Each(Body, &'static [Output<OfOne>]),
}

/// Supports carry vertical forces.
const SUPPORT: Component = Component::Vertical;

/// All outputs.
const OUTPUTS: [Group; 6] = [
    Group::Supports {
        output: Output {
            name: SUPPORT.force(),
            unit: SUPPORT.unit(),
            text: "Force of the support on the deck, down",
            read: |view| &view.state.supports,
        },
        feed_through: true,
    },
    Group::Supports {
        output: Output {
            name: SUPPORT.mean_force(),
            unit: SUPPORT.unit(),
            text: "Mean of the force over the last step",
            read: |view| &view.means.mean,
        },
        feed_through: false,
    },
    Group::Each(
        Body::Wheel,
        &[
            Output {
                name: "contact_force",
                unit: "N",
                text: "Contact force of the axle on the rail, weight included",
                read: |view, axle| view.state.forces[axle],
            },
            Output {
                name: "position",
                unit: "m",
                text: "Abscissa of the axle",
                read: |view, axle| view.system.wheels.position(axle, view.t),
            },
            Output {
                name: "displacement",
                unit: "m",
                text: "Displacement of the wheelset, down",
                read: |view, axle| view.wheel(axle),
            },
            Output {
                name: "rail_displacement",
                unit: "m",
                text: "Displacement of the rail under the wheel, down",
                read: |view, axle| {
                    let wheel = view.system.fleet.wheel(axle).map_or(0.0, |wheel| view.state.cars.u[wheel]);
                    wheel - view.state.delta[axle] - view.system.wheels.roughness[axle]
                },
            },
        ],
    ),
    Group::Vehicles,
    Group::Each(
        Body::RailPoint,
        &[
            Output {
                name: "displacement",
                unit: "m",
                text: "Displacement of the rail, down",
                read: |view, point| view.rail(point, &view.state.track.u),
            },
            Output {
                name: "velocity",
                unit: "m/s",
                text: "Velocity of the rail, down",
                read: |view, point| view.rail(point, &view.state.track.v),
            },
            Output {
                name: "acceleration",
                unit: "m/s2",
                text: "Acceleration of the rail, down",
                read: |view, point| view.rail(point, &view.state.track.a),
            },
            Output {
                name: "peak_acceleration",
                unit: "m/s2",
                text: "Acceleration of the greatest amount at the ends of the last step's sub-steps",
                read: |view, point| view.means.peaks[point],
            },
        ],
    ),
    Group::Each(
        Body::Whole,
        &[Output {
            name: WORK,
            unit: "J",
            text: "Work of all support forces on the deck over the last step",
            read: |view, _| view.means.work,
        }],
    ),
];

impl View<'_> {
    /// Displacement of a wheelset; that of a force alone is the rail's with its irregularity.
    fn wheel(&self, axle: usize) -> f64 {
        self.system.fleet.wheel(axle).map_or(-self.state.delta[axle], |wheel| self.state.cars.u[wheel])
    }

    /// Deflection of a monitored point of the rail, from u, u̇ or ü of the track.
    fn rail(&self, point: usize, of: &[f64]) -> f64 {
        self.system.track().deflection(&self.means.points[point], of)
    }

    /// Number of bodies of a kind.
    fn count(&self, body: Body) -> usize {
        match body {
            Body::Wheel => self.state.forces.len(),
            Body::RailPoint => self.means.points.len(),
            Body::Whole => 1,
        }
    }

    /// Fills in all outputs.
    pub fn write(&self, mut out: &mut [f64]) {
        for group in &OUTPUTS {
            match group {
                Group::Supports { output, .. } => {
                    let values = (output.read)(self);
                    out.split_off_mut(..values.len()).into_iter().for_each(|part| part.copy_from_slice(values));
                }
                Group::Vehicles => {
                    let part = out.split_off_mut(..self.readings.len()).into_iter().flatten();
                    for (out, Reading { dof, acceleration, .. }) in part.zip(self.readings) {
                        *out = if *acceleration { self.state.cars.a[*dof] } else { self.state.cars.u[*dof] };
                    }
                }
                Group::Each(body, outputs) => {
                    let n = self.count(*body);
                    let rows = out.split_off_mut(..n * outputs.len()).into_iter();
                    for (i, row) in rows.flat_map(|part| part.chunks_exact_mut(outputs.len())).enumerate() {
                        row.iter_mut().zip(*outputs).for_each(|(out, output)| *out = (output.read)(self, i));
                    }
                }
            }
        }
    }
}

/// The variables of all outputs.
pub fn variables(spec: &TrainTrackSpec) -> Vec<Variable> {
    let mut variables = plane_variables(spec);
    if spec.space.is_some() {
        variables.extend(crate::space::outputs::variables(spec));
    }
    variables
}

/// Those that a plane run has.
pub fn plane_variables(spec: &TrainTrackSpec) -> Vec<Variable> {
    let mut variables = Vec::new();
    for group in &OUTPUTS {
        match group {
            Group::Supports { output, feed_through } => {
                variables.extend((1..=spec.on_bridge.len()).map(|i| {
                    let name = support(i, output.name);
                    let variable = Variable::output(name, output.unit, output.text);
                    Variable { feed_through: *feed_through, ..variable }
                }));
            }
            Group::Vehicles => {
                // One that cannot be built has been refused before.
                let vehicles = Fleet::new(&spec.consist()).map(|fleet| fleet.readings()).unwrap_or_default();
                for (car, readings) in (1..).zip(vehicles) {
                    let of = |r: &Reading| Variable::output(format!("car[{car}].{}", r.name), r.unit, &r.text);
                    variables.extend(readings.iter().map(of));
                }
            }
            Group::Each(body, outputs) => {
                for holder in holders(*body, spec) {
                    let of = |output: &Output<_>| {
                        Variable::output(format!("{holder}{}", output.name), output.unit, output.text)
                    };
                    variables.extend(outputs.iter().map(of));
                }
            }
        }
    }
    variables
}

/// How the names of the outputs of every body of a kind begin.
fn holders(body: Body, spec: &TrainTrackSpec) -> Vec<String> {
    let numbered = |what: &str, count: usize| (1..=count).map(|i| format!("{what}[{i}].")).collect();
    match body {
        Body::Wheel => numbered("wheel", spec.axle_count()),
        Body::RailPoint => spec.rail_points.iter().map(|point| format!("rail[{}].", point.name)).collect(),
        Body::Whole => vec![String::new()],
    }
}
