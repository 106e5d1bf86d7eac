//! K and M of a generated model, assembled here and not by the bridge's own assembly.

use std::collections::{BTreeMap, HashMap};

use ttb_elements::{Beam3, BeamSection, Matrices, Plate, Shell4, Spring, Truss3};
use ttb_generate::measure::coordinates;
use ttb_scenario::types::{Freedom, LineSection, Model};
use ttb_sparse::{Assembly, Pencil};

type Point = [f64; 3];

/// A model's equations.
pub struct Equations {
    /// K and M.
    pub pencil: Pencil,
    /// Degrees of freedom of each node that follows no other; `None`: held.
    pub dofs: HashMap<u32, [Option<u32>; 6]>,
    /// Coordinates.
    pub at: BTreeMap<u32, Point>,
    leaders: HashMap<u32, u32>,
}

struct Parts {
    assembly: Assembly,
    dofs: HashMap<u32, [Option<u32>; 6]>,
    leaders: HashMap<u32, u32>,
    at: BTreeMap<u32, Point>,
}

impl Parts {
    /// u_f = u_l + θ_l × r: K and M over the leader's motion.
    fn add(&mut self, mut e: Matrices, nodes: &[u32]) {
        let mut dofs = Vec::new();
        for (i, node) in nodes.iter().enumerate() {
            let Some(leader) = self.leaders.get(node) else {
                dofs.extend(self.dofs[node]);
                continue;
            };
            let (f, l) = (self.at[node], self.at[leader]);
            let r = [f[0] - l[0], f[1] - l[1], f[2] - l[2]];
            let arm = [[0.0, r[2], -r[1]], [-r[2], 0.0, r[0]], [r[1], -r[0], 0.0]];
            for a in [&mut e.k, &mut e.m] {
                let n = 6 * nodes.len();
                for row in 0..n {
                    for (turn, move_) in (0..3).flat_map(|t| (0..3).map(move |m| (t, m))) {
                        a[n * row + 6 * i + 3 + turn] += a[n * row + 6 * i + move_] * arm[move_][turn];
                    }
                }
                for column in 0..n {
                    for (turn, move_) in (0..3).flat_map(|t| (0..3).map(move |m| (t, m))) {
                        a[n * (6 * i + 3 + turn) + column] += a[n * (6 * i + move_) + column] * arm[move_][turn];
                    }
                }
            }
            dofs.extend(self.dofs[leader]);
        }
        e.add_to(&mut self.assembly, &dofs);
    }
}

/// Assembles a model of quadrilateral shells, beams, cables, springs and whole rigid links.
pub fn assemble(model: &Model) -> Equations {
    let at = coordinates(model);
    let leaders: HashMap<u32, u32> =
        model.rigid_links.iter().flat_map(|link| link.followers.iter().map(|f| (*f, link.leader))).collect();
    let mut held: HashMap<u32, Vec<Freedom>> = HashMap::new();
    for bearing in &model.bearings {
        bearing.nodes.iter().for_each(|node| held.entry(*node).or_default().extend(&bearing.fixed));
    }
    let (mut dofs, mut n) = (HashMap::new(), 0);
    for (number, ..) in model.nodes.iter().filter(|node| !leaders.contains_key(&node.0)) {
        let fixed = held.get(number).map_or(&[][..], Vec::as_slice);
        let own = Freedom::ALL.map(|freedom| {
            let free = !fixed.contains(&freedom);
            n += u32::from(free);
            free.then(|| n - 1)
        });
        dofs.insert(*number, own);
    }
    let mut parts = Parts { assembly: Assembly::new(n as usize), dofs, leaders, at };
    let material = |name: &str| model.materials.iter().find(|m| m.name == name).unwrap();
    let line = |name: &str| model.line_sections.iter().find(|s| s.name == name).unwrap();
    for group in &model.shells {
        let section = model.shell_sections.iter().find(|s| s.name == group.section).unwrap();
        let m = material(&section.material);
        let mass = m.density * section.thickness + section.added_mass;
        let plate = Plate { modulus: m.modulus, poisson: m.poisson, thickness: section.thickness, mass };
        for element in &group.elements {
            let corners = [0, 1, 2, 3].map(|k| parts.at[&element[k]]);
            parts.add(Shell4::new(corners, plate).unwrap().matrices(), element);
        }
    }
    let beam = |s: &LineSection| {
        let m = material(&s.material);
        BeamSection {
            modulus: m.modulus,
            shear_modulus: 0.5 * m.modulus / (1.0 + m.poisson),
            density: m.density,
            area: s.area,
            inertia_2: s.inertia_2,
            inertia_3: s.inertia_3,
            torsion: s.torsion,
            shear_area_2: s.shear_area_2,
            shear_area_3: s.shear_area_3,
            added_mass: s.added_mass,
        }
    };
    for group in &model.beams {
        let section = beam(line(&group.section));
        for pair in &group.elements {
            let ends = pair.map(|node| parts.at[&node]);
            let element = Beam3::new(ends, group.orientation, section, [[0.0; 3]; 2], [[false; 3]; 2]).unwrap();
            parts.add(element.matrices(), pair);
        }
    }
    for group in &model.trusses {
        let s = line(&group.section);
        let m = material(&s.material);
        for (pair, tension) in group.elements.iter().zip(group.tensions.as_ref().unwrap()) {
            let ends = pair.map(|node| parts.at[&node]);
            let mass = m.density * s.area;
            let cable = Truss3::cable(ends, [0.0, 0.0, 1.0], m.modulus, s.area, mass, *tension).unwrap();
            parts.add(cable.matrices(), pair);
        }
    }
    for group in &model.springs {
        let spring = Spring { stiffness: group.stiffness, damping: group.damping };
        group.elements.iter().for_each(|pair| parts.add(spring.matrices(), pair));
    }
    Equations { pencil: parts.assembly.finish().unwrap(), dofs: parts.dofs, at: parts.at, leaders: parts.leaders }
}

impl Equations {
    /// Node at a place.
    pub fn node(&self, at: Point) -> u32 {
        let near = |p: &Point| (0..3).all(|k| (p[k] - at[k]).abs() < 1e-5);
        *self.at.iter().find(|(node, p)| near(p) && self.dofs.contains_key(node)).unwrap().0
    }

    /// A node's displacement in a vector over the degrees of freedom.
    pub fn motion(&self, node: u32, u: &[f64]) -> Point {
        let of = |node: &u32| self.dofs[node].map(|dof| dof.map_or(0.0, |dof| u[dof as usize]));
        let Some(leader) = self.leaders.get(&node) else {
            let [x, y, z, ..] = of(&node);
            return [x, y, z];
        };
        let ([x, y, z, a, b, c], f, l) = (of(leader), self.at[&node], self.at[leader]);
        let r = [f[0] - l[0], f[1] - l[1], f[2] - l[2]];
        [x + b * r[2] - c * r[1], y + c * r[0] - a * r[2], z + a * r[1] - b * r[0]]
    }
}
