//! A model as it grows.

use ttb_scenario::types::{
    Beams, DeckCarrier, DeckLine, LineSection, Material, Model, RigidLink, ShellSection, Shells, Springs,
};

use crate::lines::rounded;
use crate::section::Profile;

/// Nodes are numbered from 1 in the order they come.
pub(crate) struct Builder {
    /// What has grown so far.
    pub(crate) model: Model,
}

impl Builder {
    /// An empty model.
    pub(crate) fn new(source: &str) -> Self {
        let deck = DeckLine { length: 0.0, y: 0.0, z: None, on: DeckCarrier::Nodes(Vec::new()) };
        let model = Model {
            schema: None,
            source: source.to_string(),
            materials: Vec::new(),
            line_sections: Vec::new(),
            shell_sections: Vec::new(),
            nodes: Vec::new(),
            beams: Vec::new(),
            trusses: Vec::new(),
            shells: Vec::new(),
            springs: Vec::new(),
            masses: Vec::new(),
            rigid_links: Vec::new(),
            constraints: Vec::new(),
            bearings: Vec::new(),
            deck,
        };
        Self { model }
    }

    /// A new node at (x, y, z).
    pub(crate) fn node(&mut self, at: [f64; 3]) -> u32 {
        let number = self.model.nodes.len() as u32 + 1;
        let [x, y, z] = at.map(rounded);
        self.model.nodes.push((number, x, y, z));
        number
    }

    /// A material.
    pub(crate) fn material(&mut self, name: &str, modulus: f64, poisson: f64, density: f64) {
        self.model.materials.push(Material { name: name.to_string(), modulus, poisson, density });
    }

    /// A section of beams of `profile`: axis 2 along, axis 3 across.
    pub(crate) fn beam_section(&mut self, name: &str, material: &str, profile: &Profile) {
        self.model.line_sections.push(LineSection {
            name: name.to_string(),
            material: material.to_string(),
            area: rounded(profile.area),
            inertia_2: rounded(profile.inertia_across),
            inertia_3: rounded(profile.inertia_along),
            torsion: rounded(profile.torsion),
            shear_area_2: Some(rounded(profile.shear_along)),
            shear_area_3: Some(rounded(profile.shear_across)),
            added_mass: 0.0,
        });
    }

    /// A section of shells; kg/m² of added mass.
    pub(crate) fn shell_section(&mut self, name: &str, material: &str, thickness: f64, added_mass: f64) {
        let (name, material) = (name.to_string(), material.to_string());
        self.model.shell_sections.push(ShellSection { name, material, thickness, added_mass: rounded(added_mass) });
    }

    /// Shells of one section, one group for each section.
    pub(crate) fn shells(&mut self, section: &str, elements: impl IntoIterator<Item = [u32; 4]>) {
        let elements = elements.into_iter().map(|nodes| nodes.to_vec());
        match self.model.shells.iter_mut().find(|group| group.section == section) {
            Some(group) => group.elements.extend(elements),
            None => {
                self.model.shells.push(Shells { section: section.to_string(), elements: elements.collect() });
            }
        }
    }

    /// Beams of one section through `nodes` in a row; axis 2 towards x.
    pub(crate) fn beams(&mut self, section: &str, nodes: &[u32]) {
        let elements = nodes.windows(2).map(|pair| [pair[0], pair[1]]);
        match self.model.beams.iter_mut().find(|group| group.section == section) {
            Some(group) => group.elements.extend(elements),
            None => self.model.beams.push(Beams {
                section: section.to_string(),
                orientation: [1.0, 0.0, 0.0],
                elements: elements.collect(),
                offsets: None,
                releases: None,
            }),
        }
    }

    /// Springs between the two nodes of each pair.
    pub(crate) fn springs(&mut self, pairs: &[[u32; 2]], stiffness: [f64; 6]) {
        let elements = pairs.iter().map(|pair| pair.to_vec());
        match self.model.springs.iter_mut().find(|group| group.stiffness == stiffness) {
            Some(group) => group.elements.extend(elements),
            None => self.model.springs.push(Springs { elements: elements.collect(), stiffness, damping: [0.0; 6] }),
        }
    }

    /// `followers` move with `leader`.
    pub(crate) fn rigid(&mut self, leader: u32, followers: Vec<u32>) {
        self.model.rigid_links.push(RigidLink { leader, followers, freedoms: None });
    }
}
