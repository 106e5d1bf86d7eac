//! Nodes, elements and degrees of freedom of a plane structure, fixed directions left out.
//!
//! A node moves by [u_x, u_z, θ]. A direction is a degree of freedom when it is not fixed and some element resists it:
//! a node that only trusses and hinges meet has no rotation.

use ttb_contract::ModelError;
use ttb_dynamics::frame::FrameElement;
use ttb_sparse::Assembly;

/// A node of the plane structure.
#[derive(Clone, Debug)]
pub struct Node {
    /// For messages, and for monitored points.
    pub name: String,
    /// From the bridge's begin, m.
    pub x: f64,
    /// Depth below the bridge's begin, m, positive down.
    pub z: f64,
    /// Held directions x, z, rotation.
    pub fixed: [bool; 3],
}

/// An element between two nodes.
#[derive(Clone, Debug)]
pub struct Element {
    /// Positions in [`Mesh::nodes`].
    pub nodes: [usize; 2],
    /// Stiffness and mass.
    pub frame: FrameElement,
    /// It carries the track.
    pub deck: bool,
}

/// A numbered structure.
#[derive(Clone, Debug)]
pub struct Mesh {
    /// All nodes; elements refer to them by position.
    pub nodes: Vec<Node>,
    /// All elements.
    pub elements: Vec<Element>,
    /// Degrees of freedom of each node.
    pub dofs: Vec<[Option<u32>; 3]>,
    /// Number of degrees of freedom.
    pub ndof: usize,
}

impl Mesh {
    /// Numbers the degrees of freedom.
    ///
    /// # Errors
    /// A node without any element, or nothing that can move.
    pub fn new(nodes: Vec<Node>, elements: Vec<Element>) -> Result<Self, ModelError> {
        let mut resisted = vec![[false; 3]; nodes.len()];
        for element in &elements {
            for (&node, hinged) in element.nodes.iter().zip(element.frame.hinged) {
                (resisted[node][0], resisted[node][1]) = (true, true);
                resisted[node][2] |= !hinged;
            }
        }
        let mut ndof = 0;
        let mut dofs = vec![[None; 3]; nodes.len()];
        for ((node, resisted), dofs) in nodes.iter().zip(&resisted).zip(&mut dofs) {
            if !resisted[0] {
                return Err(ModelError(format!("bridge: node {} belongs to no member", node.name)));
            }
            for direction in 0..3 {
                if resisted[direction] && !node.fixed[direction] {
                    dofs[direction] = Some(ndof);
                    ndof += 1;
                }
            }
        }
        if ndof == 0 {
            return Err(ModelError("bridge: every direction of every node is fixed, nothing can move".into()));
        }
        Ok(Self { nodes, elements, dofs, ndof: ndof as usize })
    }

    /// Degrees of freedom of an element in the order of its matrices.
    pub fn element_dofs(&self, element: &Element) -> [Option<u32>; 6] {
        let [[a, b, c], [d, e, f]] = element.nodes.map(|node| self.dofs[node]);
        [a, b, c, d, e, f]
    }

    /// K and M of all elements, to be factorised.
    pub fn assembly(&self) -> Assembly {
        let mut assembly = Assembly::new(self.ndof);
        for element in &self.elements {
            let rows = |m: ttb_dynamics::frame::Matrix6| -> [[f64; 6]; 6] { m.transpose().into() };
            let (k, m) = (rows(element.frame.stiffness()), rows(element.frame.mass_matrix()));
            assembly.add(&self.element_dofs(element), &k, &m);
        }
        assembly
    }

    /// Position of the node of every degree of freedom.
    pub fn node_of(&self) -> Vec<u32> {
        let nodes = self.dofs.iter().zip(0..);
        nodes.flat_map(|(dofs, node)| dofs.iter().flatten().map(move |_| node)).collect()
    }

    /// Mass of all elements, kg.
    pub fn mass(&self) -> f64 {
        self.elements.iter().map(|e| e.frame.beam.mass * e.frame.length()).sum()
    }

    /// A degree of freedom in words, for messages.
    pub fn describe(&self, dof: usize) -> String {
        let found = self.dofs.iter().zip(&self.nodes).find_map(|(dofs, node)| {
            let direction = dofs.iter().position(|d| d.is_some_and(|d| d as usize == dof))?;
            Some(format!(
                "{} of node {}",
                ["displacement along x", "displacement along z", "rotation"][direction],
                node.name
            ))
        });
        found.unwrap_or_else(|| format!("degree of freedom {dof}"))
    }
}
