//! What of a bridge's motion is recorded under names of ours, whatever its own are: supports, the scenario's points, its
//! stations.

use std::ops::Range;

use ttb_contract::names::{parse_support, support};
use ttb_coupling::{Place, Stations, Watch};
use ttb_scenario::Checked;
use ttb_scenario::types::Direction;

use super::assign::Assigned;
use super::map::Map;

/// What the names of points at stations begin with; their number follows.
pub const STATION: &str = "station ";

/// Places of interest on one bridge; names of points on it are taken out of `missing`. Stations are of interest where the
/// results shall hold supports, or where the scenario names no point.
pub fn watch(
    map: &Map,
    checked: &Checked,
    range: &Range<usize>,
    stations: Option<&Vec<f64>>,
    missing: &mut Vec<String>,
) -> Option<Watch> {
    let supports = checked.bridge.supports.get(range.clone())?;
    let own = stations.map_or(supports, Vec::as_slice);
    let ends =
        own.iter().chain(&map.bearings).fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], x| [a.min(*x), b.max(*x)]);
    let place = |name: String, acceleration: bool| Place { name, acceleration };
    let mut places: Vec<(Place, f64)> = range
        .clone()
        .zip(supports)
        .map(|(k, x)| (place(support(k + 1, "").trim_end_matches('.').to_string(), false), *x))
        .collect();
    for point in checked.bridge.points.iter().filter(|point| point.direction != Direction::Y) {
        let Some(x) = point.x.filter(|x| (ends[0]..=ends[1]).contains(x)) else { continue };
        missing.retain(|name| *name != point.name);
        places.push((place(format!("point[{}]", point.name), true), x));
    }
    if checked.scenario.output.supports || checked.bridge.points.is_empty() {
        let all = stations.into_iter().flatten().enumerate();
        places.extend(all.map(|(k, x)| (place(format!("point[{STATION}{}]", k + 1), true), *x)));
    }
    let (places, at): (Vec<Place>, Vec<f64>) = places.into_iter().unzip();
    let rows = Stations::new(own, &map.bearings, &at, map.interpolation.into()).ok()?;
    Some(Watch::new(rows, places))
}

/// The same of a bridge whose variables have our names, if they are those of all supports in their order.
pub fn by_names(assigned: &Assigned, checked: &Checked, missing: &mut Vec<String>) -> Option<Watch> {
    let n = checked.bridge.supports.len();
    let number = |name: &String| parse_support(name).map(|(number, _)| number);
    let forces = &assigned.forces_in.names;
    // Component by component in space.
    let whole = n > 0 && forces.len() >= n && forces.len().is_multiple_of(n);
    let ours = whole && forces.iter().enumerate().all(|(i, name)| number(name) == Some(i % n + 1));
    let both = assigned.motions_out.names.len() == 2 * forces.len();
    if ours && both { watch(&Map::default(), checked, &(0..n), None, missing) } else { None }
}

/// Points of a scenario that may be missing in results of a foreign bridge.
pub fn points(checked: &Checked) -> Vec<String> {
    checked.bridge.points.iter().map(|point| point.name.clone()).collect()
}

/// A warning, if there are points that no bridge tells and none can be interpolated on.
pub fn told(missing: &[String]) -> Option<String> {
    let names = missing.iter().map(|name| format!("point[{name}]")).collect::<Vec<_>>().join(", ");
    let why = "not in the results, since the given bridge has no output of this name, and its place is no x between its stations";
    (!missing.is_empty()).then(|| format!("{names}: {why}"))
}
