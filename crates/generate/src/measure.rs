//! What a model weighs and how large it is.

use std::collections::{BTreeMap, HashSet};

use ttb_scenario::types::{Freedom, Model};

type Point = [f64; 3];

/// Coordinates by node number.
#[must_use]
pub fn coordinates(model: &Model) -> BTreeMap<u32, Point> {
    model.nodes.iter().map(|&(number, x, y, z)| (number, [x, y, z])).collect()
}

/// Free degrees of freedom: six a node, without those that bearings hold, rigid links lead or constraints eliminate.
#[must_use]
pub fn degrees_of_freedom(model: &Model) -> usize {
    let mut bound: HashSet<(u32, Freedom)> = HashSet::new();
    for bearing in &model.bearings {
        bound.extend(bearing.nodes.iter().flat_map(|node| bearing.fixed.iter().map(|freedom| (*node, *freedom))));
    }
    for link in &model.rigid_links {
        let freedoms = link.freedoms.as_deref().unwrap_or(&Freedom::ALL);
        bound.extend(link.followers.iter().flat_map(|node| freedoms.iter().map(|freedom| (*node, *freedom))));
    }
    bound.extend(model.constraints.iter().filter_map(|c| c.terms.first()).map(|(node, freedom, _)| (*node, *freedom)));
    6 * model.nodes.len() - bound.len()
}

/// Mass in kg of the elements whose section's name satisfies `of`, and of the masses at nodes if `""` does. Elements
/// with unknown nodes or sections weigh nothing.
#[must_use]
pub fn mass(model: &Model, of: impl Fn(&str) -> bool) -> f64 {
    let at = coordinates(model);
    let density = |name: &str| model.materials.iter().find(|m| m.name == name).map_or(0.0, |m| m.density);
    let line = |name: &str| {
        let section = model.line_sections.iter().find(|s| s.name == name).filter(|_| of(name));
        section.map_or(0.0, |s| s.area * density(&s.material) + s.added_mass)
    };
    let shell = |name: &str| {
        let section = model.shell_sections.iter().find(|s| s.name == name).filter(|_| of(name));
        section.map_or(0.0, |s| s.thickness * density(&s.material) + s.added_mass)
    };
    let length = |pair: &[u32; 2]| at.get(&pair[0]).zip(at.get(&pair[1])).map_or(0.0, |(a, b)| distance(a, b));
    let beams = model.beams.iter().map(|group| (&group.section, &group.elements));
    let trusses = model.trusses.iter().map(|group| (&group.section, &group.elements));
    let lines: f64 = beams.chain(trusses).map(|(name, pairs)| line(name) * pairs.iter().map(length).sum::<f64>()).sum();
    let surface = |nodes: &Vec<u32>| area(&nodes.iter().filter_map(|node| at.get(node)).copied().collect::<Vec<_>>());
    let shells: f64 =
        model.shells.iter().map(|group| shell(&group.section) * group.elements.iter().map(surface).sum::<f64>()).sum();
    let lumped: f64 = model.masses.iter().map(|group| group.mass * group.nodes.len() as f64).sum();
    lines + shells + if of("") { lumped } else { 0.0 }
}

/// From `a` to `b`, m.
pub(crate) fn distance(a: &Point, b: &Point) -> f64 {
    (0..3).map(|k| (b[k] - a[k]).powi(2)).sum::<f64>().sqrt()
}

/// Area of a plane polygon, m².
fn area(corners: &[Point]) -> f64 {
    let Some(&origin) = corners.first() else { return 0.0 };
    let arm = |p: &Point| [p[0] - origin[0], p[1] - origin[1], p[2] - origin[2]];
    let sum = corners.windows(2).fold([0.0; 3], |sum, pair| {
        let (a, b) = (arm(&pair[0]), arm(&pair[1]));
        let cross = [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
        [sum[0] + cross[0], sum[1] + cross[1], sum[2] + cross[2]]
    });
    0.5 * sum.iter().map(|v| v * v).sum::<f64>().sqrt()
}
