//! Two models of this process, coupled by the names of their ports.

use crate::in_process::InProcess;
use crate::instance::Instance;
use crate::interface::Interface;
use crate::model::{Model, ModelError};
use crate::names::{parse_support, sibling};
use crate::port::{Component, Port};
use crate::ports::Ports;

/// Both sides in initialization mode, and their ports.
pub struct Pair<T: Model, B: Model> {
    /// The train–track side.
    pub train_track: InProcess<T>,
    /// The bridge.
    pub bridge: InProcess<B>,
    /// Where they touch.
    pub ports: Ports,
}

impl<T: Model, B: Model> Pair<T, B> {
    /// Every input of the bridge that is a support's force is a port: `support[i].force`, `.force_y` or `.moment_x`, with the
    /// motion of the same support. `sent` names the train–track side's output that feeds an input of the bridge (itself, or
    /// the mean over a step); `axle_load`, N, is the scale of the ports.
    ///
    /// # Errors
    /// A model cannot be initialized, or one side lacks a variable that the other side's ports need.
    pub fn new(train_track: T, bridge: B, axle_load: f64, sent: impl Fn(&str) -> String) -> Result<Self, ModelError> {
        let (t, b) = (train_track.interface(), bridge.interface());
        let forces: Vec<&str> = b.inputs().map(|r| b.variables()[r].name.as_str()).collect();
        let ports: Vec<Port> = forces.iter().filter_map(|force| port(force, axle_load)).collect();
        let ports = Ports::new(ports, 0).filter(|ports| ports.forces() == forces.len());
        let ports = ports.ok_or_else(|| {
            ModelError(format!("an input of the bridge is no support's force, or an axle load of {axle_load} N"))
        })?;
        let component = |i: usize| ports.list()[i].component;
        let each = |motion: fn(Component) -> &'static str| -> Vec<String> {
            forces.iter().enumerate().map(|(i, force)| sibling(force, motion(component(i)))).collect()
        };
        let motions = [each(Component::position), each(Component::rate)].concat();
        let forces: Vec<String> = forces.into_iter().map(str::to_string).collect();
        let sent: Vec<String> = forces.iter().map(|force| sent(force)).collect();
        let into_bridge = references(b, "bridge", &forces)?;
        let out_of_bridge = references(b, "bridge", &motions)?;
        let into_track = references(t, "train–track side", &motions)?;
        let out_of_track = references(t, "train–track side", &sent)?;
        let (mut t, mut b) = (Instance::new(train_track), Instance::new(bridge));
        t.enter_initialization(0.0)?;
        b.enter_initialization(0.0)?;
        Ok(Self {
            train_track: InProcess::new("TrainTrack", t, into_track, out_of_track),
            bridge: InProcess::new("Bridge", b, into_bridge, out_of_bridge),
            ports,
        })
    }
}

/// The port of a support's force, by its name.
fn port(force: &str, axle_load: f64) -> Option<Port> {
    let (support, _) = parse_support(force)?;
    Some(Port::new(support, Component::of_force(force)?, axle_load))
}

/// Value references of names.
fn references(of: &Interface, side: &str, names: &[String]) -> Result<Vec<u32>, ModelError> {
    let by_name: std::collections::HashMap<&str, u32> =
        of.variables().iter().enumerate().map(|(r, v)| (v.name.as_str(), r as u32)).collect();
    let find = |name: &String| by_name.get(name.as_str()).copied();
    let missing = |name: &String| ModelError(format!("the {side} has no variable {name}"));
    names.iter().map(|name| find(name).ok_or_else(|| missing(name))).collect()
}
