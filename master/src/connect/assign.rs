//! Which variables of a bridge belong to which supports of the track: by its map, its declared units, its stations.

use std::ops::Range;

use ttb_contract::Component;
use ttb_coupling::{Stations, Watch};
use ttb_fmi::description::{ModelDescription, VariableType};
use ttb_fmi::{FmuInstance, Linear};

use super::map::{Even, Map, Places, Read, Series};
use crate::error::Error;

/// Coupled variables of an FMU in order, and the lines between each of them and the iteration.
#[derive(Clone, Debug, Default)]
pub struct Ends {
    /// Names.
    pub names: Vec<String>,
    /// To an input from the iteration, or from an output to it.
    pub lines: Vec<Linear>,
}

/// A bridge's part in the coupling.
#[derive(Clone)]
pub struct Assigned {
    /// The bridge's inputs.
    pub forces_in: Ends,
    /// The bridge's outputs: displacements, then velocities.
    pub motions_out: Ends,
    /// The train–track side's outputs.
    pub forces_out: Ends,
    /// The train–track side's inputs: displacements, then velocities.
    pub motions_in: Ends,
    /// From the bridge's places to the supports, if they differ.
    pub stations: Option<Stations>,
    /// Whether it gives velocities.
    pub velocities: bool,
    /// Components of force and motion at each place.
    pub components: usize,
    /// What else of its motion is recorded.
    pub watch: Option<Watch>,
}

/// What is coupled, as powers of kg, m, s.
const QUANTITIES: [(&str, [i32; 3]); 9] = [
    ("force", [1, 1, -2]),
    ("displacement", [0, 1, 0]),
    ("velocity", [0, 1, -1]),
    ("force_y", [1, 1, -2]),
    ("displacement_y", [0, 1, 0]),
    ("velocity_y", [0, 1, -1]),
    ("moment_x", [1, 2, -2]),
    ("rotation_x", [0, 0, 0]),
    ("angular_velocity_x", [0, 0, -1]),
];

impl Ends {
    /// Adds a variable.
    pub fn push(&mut self, name: String, line: Linear) {
        self.names.push(name);
        self.lines.push(line);
    }

    /// These, then others.
    pub fn extend(&mut self, others: Self) {
        self.names.extend(others.names);
        self.lines.extend(others.lines);
    }

    /// The first `count`, and the rest.
    pub fn split(mut self, count: usize) -> (Self, Self) {
        let count = count.min(self.names.len());
        let rest = Self { names: self.names.split_off(count), lines: self.lines.split_off(count) };
        (self, rest)
    }
}

impl Assigned {
    /// Every variable to one of the other side: the train–track side's forces, out of it and into the bridge, and the
    /// bridge's motions, out of it and into the train–track side.
    pub fn one_to_one([forces_out, forces_in]: [Ends; 2], [motions_out, motions_in]: [Ends; 2]) -> Self {
        Self {
            forces_in,
            motions_out,
            forces_out,
            motions_in,
            stations: None,
            velocities: true,
            components: 1,
            watch: None,
        }
    }
}

/// The line from a variable to SI by the unit it declares; none if it declares none.
///
/// # Errors
/// The unit is one of another quantity.
pub fn declared(description: &ModelDescription, name: &str) -> Result<Option<Linear>, String> {
    let unit = description.variable(name).and_then(|variable| Some((variable.unit.as_ref()?, variable)));
    let Some((unit_name, _)) = unit else { return Ok(None) };
    let Some(unit) = description.units.get(unit_name) else { return Ok(None) };
    // The longest: `velocity` also ends `angular_velocity`.
    let of = QUANTITIES.into_iter().filter(|(what, _)| name.ends_with(what)).max_by_key(|(what, _)| what.len());
    let Some((what, powers)) = of else {
        return Ok(Some(Linear { factor: unit.factor, offset: unit.offset }));
    };
    if unit.powers == [0; 8] && unit.factor == 1.0 {
        return Ok(None); // declared by name only
    }
    if !fits(&unit.powers, what, powers) {
        return Err(format!("{name} is in {unit_name}, which is no unit of a {what}"));
    }
    Ok(Some(Linear { factor: unit.factor, offset: unit.offset }))
}

/// Whether a unit's powers are those of a quantity; an angle may count as a power of its own, the eighth.
fn fits(unit: &[i32; 8], what: &str, powers: [i32; 3]) -> bool {
    let angle = what.starts_with("rotation") || what.starts_with("angular");
    let others = if angle { 3..7 } else { 3..8 };
    unit[..3] == powers && unit[others].iter().all(|p| *p == 0)
}

/// Range of supports and stations of every bridge; `supports` are the track's supports on bridges, m from the begin.
///
/// # Errors
/// Supports that belong to no bridge or to two.
pub fn ranges(
    maps: &[&Map],
    bridges: &[&mut FmuInstance],
    places: &[Option<Vec<f64>>],
    supports: &[f64],
) -> Result<Vec<Range<usize>>, Error> {
    let mut ranges = Vec::new();
    let mut next = 0;
    for ((map, bridge), places) in maps.iter().zip(bridges).zip(places) {
        let points = map.force.count(bridge.description());
        let range = match (map.supports, places) {
            (Some([first, last]), _) => first - 1..last,
            _ if maps.len() == 1 => 0..supports.len(),
            (None, None) => next..next + points,
            (None, Some(places)) => {
                let ends = places
                    .iter()
                    .chain(&map.bearings)
                    .fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], x| [a.min(*x), b.max(*x)]);
                let end = next + supports.iter().skip(next).take_while(|x| **x <= ends[1] + 1e-3).count();
                next..end
            }
        };
        if range.start != next || range.end > supports.len() {
            return Err(Error::Input(format!(
                "{}: supports {} to {} would be its own, but the one after the bridge before is {}, and there are {} in all",
                bridge.name(),
                range.start + 1,
                range.end,
                next + 1,
                supports.len()
            )));
        }
        next = range.end;
        ranges.push(range);
    }
    if next != supports.len() {
        return Err(Error::Input(format!(
            "the bridges have {next} supports of the track's {}: the forces of the others would be lost",
            supports.len()
        )));
    }
    Ok(ranges)
}

/// Where a bridge's places are, m from the begin of the scenario's bridge; none if they are the supports.
///
/// # Errors
/// They cannot be read.
pub fn places(map: &Map, bridge: &mut FmuInstance) -> Result<Option<Vec<f64>>, Error> {
    let count = map.force.count(bridge.description());
    Ok(match &map.stations {
        None => None,
        Some(Places::List(places)) => Some(places.clone()),
        Some(Places::Even(Even { from, spacing })) => Some((0..count).map(|i| from + i as f64 * spacing).collect()),
        Some(Places::Read(read)) => Some(read_places(read, count, bridge)?),
    })
}

fn read_places(read: &Read, count: usize, bridge: &mut FmuInstance) -> Result<Vec<f64>, Error> {
    let mut places = Vec::new();
    for name in (1..=count).map(|k| read.at(k)) {
        if bridge.description().variable(&name).is_none() {
            let name_of_bridge = bridge.name();
            return Err(Error::Input(format!(
                "{name_of_bridge}: stations: it has no variable {name}, but {count} forces"
            )));
        }
        let unit = declared(bridge.description(), &name).ok().flatten().map_or(1.0, |line| line.factor);
        let value = bridge.get_number(&name)?;
        places.push(read.offset + read.factor.map_or(unit * value, |factor| value / factor));
    }
    Ok(places)
}

/// A bridge's part by its map.
///
/// # Errors
/// Missing variables, units of another quantity, stations that would lose force: all of them.
pub fn assign(
    map: &Map,
    train_track: &ModelDescription,
    bridge: &FmuInstance,
    range: &Range<usize>,
    places: Option<&Vec<f64>>,
    supports: &[f64],
    warnings: &mut Vec<String>,
) -> Result<Assigned, Error> {
    let description = bridge.description();
    let mut problems = Problems { missing: Vec::new(), others: Vec::new() };
    let stations = places.and_then(|places| {
        let stations = Stations::new(places, &map.bearings, &supports[range.clone()], map.interpolation.into());
        stations.map_err(|e| problems.others.push(e.to_string())).ok()
    });
    let points = places.map_or(range.len(), Vec::len);
    let mut lacking = Vec::new();
    let mut theirs = |series: &Series, what: &str, causality: &str| {
        let mut ends = Ends::default();
        for k in 1..=points {
            let Some(name) = series.at(k) else {
                problems.others.push(format!("the map names {} of its {points} {what}s", k - 1));
                break;
            };
            if !has(description, &name, causality) {
                problems.missing.push(format!("{causality} {name}"));
                continue;
            }
            let line = line(series, description, &name, what, &mut problems.others);
            // From SI to the FMU, or the other way round.
            ends.push(name, if causality == "input" { line } else { line.inverse() });
        }
        ends
    };
    let wanted = |component: &Component| {
        let input = format!("support[{}].{}", range.start + 1, component.position());
        *component == Component::Vertical || has(train_track, &input, "input")
    };
    let (mut components, mut absent) = (Vec::new(), Vec::new());
    for component in Component::ALL.into_iter().filter(wanted) {
        match map.series(component, description) {
            Some([Some(force), Some(position), rate]) => components.push((component, force, position, rate)),
            Some(_) => lacking.push(component),
            None => absent.push(component),
        }
    }
    warnings.extend(without(bridge.name(), &absent));
    let velocities = components.iter().all(|(.., rate)| rate.is_some());
    let [mut forces_in, mut motions_out] = [Ends::default(), Ends::default()];
    for (component, force, ..) in &components {
        forces_in.extend(theirs(force, component.force(), "input"));
    }
    for (component, _, position, _) in &components {
        motions_out.extend(theirs(position, component.position(), "output"));
    }
    for (component, .., rate) in components.iter().filter(|_| velocities) {
        motions_out.extend(rate.iter().map(|rate| theirs(rate, component.rate(), "output")).next().unwrap_or_default());
    }
    let mut ours = |what: &str, causality: &str| {
        let mut ends = Ends::default();
        for k in range.clone() {
            let name = format!("support[{}].{what}", k + 1);
            if has(train_track, &name, causality) {
                ends.push(name, Linear::IDENTITY);
            } else {
                problems.others.push(format!("{} has no {causality} {name}", train_track.model_name));
            }
        }
        ends
    };
    let [mut forces_out, mut motions_in] = [Ends::default(), Ends::default()];
    components.iter().for_each(|(component, ..)| forces_out.extend(ours(component.force(), "output")));
    components.iter().for_each(|(component, ..)| motions_in.extend(ours(component.position(), "input")));
    components.iter().for_each(|(component, ..)| motions_in.extend(ours(component.rate(), "input")));
    problems.others.extend(
        lacking
            .into_iter()
            .map(|component: Component| format!("the map names {} but no {}", component.force(), component.position())),
    );
    problems.tell(bridge.name(), points)?;
    if !velocities {
        warnings.push(format!(
            "{}: it gives no velocities (or not of every component): they follow from its displacements by the trapezoidal rule, as \
             accurate as its own where it integrates by it, of second order elsewhere (docs/guide/bridges.md)",
            bridge.name()
        ));
    }
    let more = map.force.count(description);
    if more > points {
        warnings.push(format!("{}: {} forces beyond the {points} mapped ones stay 0", bridge.name(), more - points));
    }
    let (components, watch) = (components.len(), None);
    Ok(Assigned { forces_in, motions_out, forces_out, motions_in, stations, velocities, components, watch })
}

/// What a bridge without some components means; nothing where it has all.
pub fn without(bridge: &str, components: &[Component]) -> Option<String> {
    let motion = |component: &Component| match component {
        Component::Vertical => format!("vertically ({})", component.position()),
        Component::Lateral => format!("across the track ({})", component.position()),
        Component::Roll => format!("about the track ({})", component.position()),
    };
    let motions: Vec<String> = components.iter().map(motion).collect();
    (!motions.is_empty()).then(|| {
        format!(
            "{bridge} gives no motion {}: it is taken as 0, and such forces and moments of the track go to the ground",
            motions.join(" and ")
        )
    })
}

/// From SI to a variable: by the map's factor, else by the unit it declares.
fn line(series: &Series, description: &ModelDescription, name: &str, what: &str, problems: &mut Vec<String>) -> Linear {
    if let Some(factor) = series.factor {
        return Linear { factor, offset: 0.0 };
    }
    let unit = description.variable(name).and_then(|variable| description.units.get(variable.unit.as_ref()?));
    let Some(unit) = unit.filter(|unit| unit.powers != [0; 8]) else { return Linear::IDENTITY };
    let powers = QUANTITIES.into_iter().find(|(quantity, _)| *quantity == what).map_or([0; 3], |(_, powers)| powers);
    if !fits(&unit.powers, what, powers) {
        problems.push(format!("the unit of {name} is none of a {what}: give a factor if it is one all the same"));
    }
    Linear { factor: unit.factor, offset: unit.offset }.inverse()
}

/// Names told one by one.
const TOLD: usize = 10;

/// What is wrong with a map and its FMU.
struct Problems {
    missing: Vec<String>,
    others: Vec<String>,
}

impl Problems {
    fn tell(mut self, bridge: &str, points: usize) -> Result<(), Error> {
        if !self.missing.is_empty() {
            let more = self.missing.len().saturating_sub(TOLD);
            self.missing.truncate(TOLD);
            let more = if more > 0 { format!(" and {more} more") } else { String::new() };
            self.others
                .insert(0, format!("{points} places are mapped, but it has no {}{more}", self.missing.join(", ")));
        }
        if self.others.is_empty() {
            Ok(())
        } else {
            Err(Error::Input(format!("{bridge}: {}", self.others.join("\n  "))))
        }
    }
}

fn has(description: &ModelDescription, name: &str, causality: &str) -> bool {
    description.with_causality(causality).any(|v| v.name == name && v.kind == VariableType::Real)
}
