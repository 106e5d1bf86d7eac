//! A small finite-element model: enough to solve the benchmarks.

use ttb_elements::{Matrices, Plate, Shell3, Shell4};
use ttb_sparse::modes::lowest;
use ttb_sparse::{Assembly, Pencil};

/// Shape of the elements a surface is made of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shape {
    /// Elements with four corners.
    Quad,
    /// Triangles: each quadrilateral cut from its first to its third corner.
    Triangle,
    /// Triangles: each quadrilateral cut from its second to its fourth corner.
    OtherTriangle,
}

/// x, y, z, rx, ry, rz of a node.
pub const X: usize = 0;
/// See [`X`].
pub const Y: usize = 1;
/// See [`X`].
pub const Z: usize = 2;
/// See [`X`].
pub const RX: usize = 3;
/// See [`X`].
pub const RY: usize = 4;
/// See [`X`].
pub const RZ: usize = 5;
/// All of a node's motions.
pub const ALL: [usize; 6] = [X, Y, Z, RX, RY, RZ];

/// Nodes, elements, fixed motions and loads.
#[derive(Default)]
pub struct Structure {
    /// Places of the nodes.
    pub nodes: Vec<[f64; 3]>,
    elements: Vec<(Vec<usize>, Matrices)>,
    held: Vec<[Option<f64>; 6]>,
    load: Vec<[f64; 6]>,
}

impl Structure {
    /// A structure of nodes alone, at these places.
    pub fn new(nodes: Vec<[f64; 3]>) -> Self {
        let n = nodes.len();
        Self { nodes, elements: Vec::new(), held: vec![[None; 6]; n], load: vec![[0.0; 6]; n] }
    }

    /// A surface of `cells` elements in two directions; `place` maps [0, 1]² to space, node (i, j) has number
    /// j (cells[0] + 1) + i.
    pub fn surface(cells: [usize; 2], shape: Shape, plate: Plate, place: impl Fn(f64, f64) -> [f64; 3]) -> Self {
        let [a, b] = cells;
        let at = |k: usize| place((k % (a + 1)) as f64 / a as f64, (k / (a + 1)) as f64 / b as f64);
        let mut s = Self::new((0..(a + 1) * (b + 1)).map(at).collect());
        for j in 0..b {
            for i in 0..a {
                let first = j * (a + 1) + i;
                s.shell(shape, plate, [first, first + 1, first + a + 2, first + a + 1]);
            }
        }
        s
    }

    /// Adds an element.
    pub fn element(&mut self, nodes: &[usize], matrices: Matrices) {
        self.elements.push((nodes.to_vec(), matrices));
    }

    /// Adds a shell, or two triangles.
    pub fn shell(&mut self, shape: Shape, plate: Plate, [a, b, c, d]: [usize; 4]) {
        if shape == Shape::Quad {
            let shell = Shell4::new([a, b, c, d].map(|i| self.nodes[i]), plate).unwrap();
            return self.element(&[a, b, c, d], shell.matrices());
        }
        let halves = if shape == Shape::Triangle { [[a, b, c], [a, c, d]] } else { [[a, b, d], [b, c, d]] };
        for nodes in halves {
            let shell = Shell3::new(nodes.map(|i| self.nodes[i]), plate).unwrap();
            self.element(&nodes, shell.matrices());
        }
    }

    /// Numbers of the nodes that fulfil a condition on their place.
    pub fn nodes_where(&self, condition: impl Fn([f64; 3]) -> bool) -> Vec<usize> {
        (0..self.nodes.len()).filter(|i| condition(self.nodes[*i])).collect()
    }

    /// Fixes motions of the nodes that fulfil a condition.
    pub fn hold(&mut self, condition: impl Fn([f64; 3]) -> bool, motions: &[usize]) {
        for node in self.nodes_where(condition) {
            motions.iter().for_each(|&motion| self.held[node][motion] = Some(0.0));
        }
    }

    /// Prescribes one motion of a node.
    pub fn prescribe(&mut self, node: usize, motion: usize, value: f64) {
        self.held[node][motion] = Some(value);
    }

    /// Adds a force or moment.
    pub fn push(&mut self, node: usize, motion: usize, value: f64) {
        self.load[node][motion] += value;
    }

    /// Adds forces mass × value: a load spread like the mass.
    pub fn push_like_mass(&mut self, motion: usize, value: f64) {
        for (nodes, matrices) in &self.elements {
            for (row, m) in matrices.rows_m().enumerate() {
                let sum: f64 = m.iter().skip(motion).step_by(6).sum();
                self.load[nodes[row / 6]][row % 6] += value * sum;
            }
        }
    }

    /// Takes the moments out of the load.
    pub fn forces_only(&mut self) {
        self.load.iter_mut().for_each(|load| load[RX..].fill(0.0));
    }

    /// Number of each free motion.
    fn numbering(&self) -> (Vec<[Option<u32>; 6]>, usize) {
        let mut n = 0;
        let dofs = self.held.iter().map(|held| {
            held.map(|held| {
                held.is_none().then(|| {
                    n += 1;
                    n - 1
                })
            })
        });
        (dofs.collect(), n as usize)
    }

    fn pencil(&self) -> (Vec<[Option<u32>; 6]>, Pencil) {
        let (dofs, n) = self.numbering();
        let mut assembly = Assembly::new(n);
        for (nodes, matrices) in &self.elements {
            let dofs: Vec<_> = nodes.iter().flat_map(|i| dofs[*i]).collect();
            matrices.add_to(&mut assembly, &dofs);
        }
        (dofs, assembly.finish().unwrap())
    }

    /// Static motion of every node.
    pub fn solve(&self) -> Vec<[f64; 6]> {
        let (dofs, pencil) = self.pencil();
        let mut x = vec![0.0; pencil.ndof()];
        for (dofs, load) in dofs.iter().zip(&self.load) {
            dofs.iter().zip(load).for_each(|(dof, load)| dof.iter().for_each(|dof| x[*dof as usize] += load));
        }
        for (nodes, matrices) in &self.elements {
            let given: Vec<f64> = nodes.iter().flat_map(|i| self.held[*i]).map(|held| held.unwrap_or(0.0)).collect();
            for (row, k) in matrices.rows_k().enumerate() {
                if let Some(dof) = dofs[nodes[row / 6]][row % 6] {
                    x[dof as usize] -= k.iter().zip(&given).map(|(k, given)| k * given).sum::<f64>();
                }
            }
        }
        let mut scratch = vec![0.0; x.len()];
        pencil.factor(1.0, 0.0, 0.0).unwrap().solve_in_place(&mut x, &mut scratch);
        let motion = |(dofs, held): (&[Option<u32>; 6], &[Option<f64>; 6])| {
            ALL.map(|i| dofs[i].map_or(held[i].unwrap_or(0.0), |dof| x[dof as usize]))
        };
        dofs.iter().zip(&self.held).map(motion).collect()
    }

    /// Circular frequencies of the lowest modes, rad/s.
    pub fn frequencies(&self, count: usize) -> Vec<f64> {
        let (_, pencil) = self.pencil();
        let modes = lowest(&pencil, &pencil.factor(1.0, 0.0, 0.0).unwrap(), count).unwrap();
        modes.omega2.iter().map(|w2| w2.sqrt()).collect()
    }
}
