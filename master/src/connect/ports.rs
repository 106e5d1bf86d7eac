//! Which motion belongs to which force: the ports of two FMUs whose variables are connected one to one.
//!
//! By the train–track FMU's names, `support[3].force` with `support[3].displacement` and `.velocity`. Where its names do not
//! tell and there are two motions for each force, the units do: displacements are in metres, velocities per second, each in
//! the order of the forces; without units the first half are displacements.

use std::collections::HashMap;

use ttb_contract::names::{instant_force, parse_support, sibling};
use ttb_contract::{Component, Known, Port, Ports};
use ttb_fmi::description::ModelDescription;

use super::assign::{Assigned, Ends};

/// Power of the second in a unit's exponents.
const SECOND: usize = 2;

/// Brings forces and motions into the order of ports, whose scale is one axle load, N.
pub fn in_order(assigned: &mut Assigned, train_track: &ModelDescription, axle_load: f64) -> Option<Ports> {
    let forces = &assigned.forces_out.names;
    let motions = &assigned.motions_in.names;
    let mut pairs: Vec<[Option<usize>; 2]> = by_names(forces, motions);
    if pairs.iter().all(|pair| *pair == [None; 2]) && motions.len() == 2 * forces.len() {
        pairs = by_units(forces.len(), motions, train_track);
    }
    let known = |pair: &[Option<usize>; 2]| match pair {
        [Some(_), Some(_)] => Known::PositionAndRate,
        [Some(_), None] => Known::Position,
        _ => Known::Nothing,
    };
    let mut order: Vec<usize> = (0..forces.len()).collect();
    order.sort_by_key(|i| known(&pairs[*i]));
    let port = |i: &usize| {
        let component = component(&forces[*i]);
        let support = parse_support(&forces[*i]).map_or(i + 1, |(support, _)| support);
        Port { support, component, scale: axle_load * component.lever(), known: known(&pairs[*i]) }
    };
    let list: Vec<Port> = order.iter().map(port).collect();
    let of = |which: usize, least: Known| -> Vec<usize> {
        let fits = order.iter().filter(|i| known(&pairs[**i]) <= least);
        fits.filter_map(|i| pairs[*i][which]).collect()
    };
    let mut places = [of(0, Known::Position), of(1, Known::PositionAndRate)].concat();
    let others: Vec<usize> = (0..motions.len()).filter(|at| !places.contains(at)).collect();
    let ports = Ports::new(list, others.len());
    places.extend(others);
    for (ends, order) in [(&mut assigned.forces_out, &order), (&mut assigned.motions_in, &places)] {
        *ends = permuted(ends, order);
    }
    // A bridge with places of its own, or without velocities, has other variables, which its map has put in order.
    if assigned.stations.is_none() && assigned.velocities {
        for (ends, order) in [(&mut assigned.forces_in, &order), (&mut assigned.motions_out, &places)] {
            *ends = permuted(ends, order);
        }
    }
    ports
}

/// By the name of the force or of its mean; vertical if it tells nothing.
fn component(force: &str) -> Component {
    Component::of_force(force).or_else(|| Component::of_force(&instant_force(force)?)).unwrap_or_default()
}

fn by_names(forces: &[String], motions: &[String]) -> Vec<[Option<usize>; 2]> {
    let places: HashMap<&str, usize> = motions.iter().enumerate().map(|(i, name)| (name.as_str(), i)).collect();
    let find = |force: &String, quantity: &str| places.get(sibling(force, quantity).as_str()).copied();
    let pair = |force: &String| {
        let component = component(force);
        [find(force, component.position()), find(force, component.rate())]
    };
    forces.iter().map(pair).collect()
}

fn by_units(forces: usize, motions: &[String], train_track: &ModelDescription) -> Vec<[Option<usize>; 2]> {
    let per_second = |name: &String| {
        let unit = train_track.variable(name).and_then(|variable| train_track.units.get(variable.unit.as_ref()?));
        unit.map(|unit| unit.powers[SECOND] < 0)
    };
    let (mut positions, mut rates) = (Vec::new(), Vec::new());
    for (at, name) in motions.iter().enumerate() {
        if per_second(name).unwrap_or(at >= forces) { rates.push(at) } else { positions.push(at) }
    }
    if positions.len() != forces {
        return vec![[None; 2]; forces];
    }
    positions.into_iter().zip(rates).map(|(position, rate)| [Some(position), Some(rate)]).collect()
}

fn permuted(ends: &Ends, order: &[usize]) -> Ends {
    Ends {
        names: order.iter().map(|i| ends.names[*i].clone()).collect(),
        lines: order.iter().map(|i| ends.lines[*i]).collect(),
    }
}
