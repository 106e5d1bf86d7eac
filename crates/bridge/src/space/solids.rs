//! From sections and coordinates to elements.

use std::collections::HashMap;

use ttb_elements::{Beam3, BeamSection, Plate, Shell3, Shell4, Truss3};
use ttb_scenario::types::{Beams, Freedom, LineSection, Material, Model, ShellSection, Trusses};

use super::kind::Kind;

/// Materials and sections by name.
#[derive(Clone)]
pub(super) struct Sections<'a> {
    materials: HashMap<&'a str, &'a Material>,
    lines: HashMap<&'a str, &'a LineSection>,
    shells: HashMap<&'a str, &'a ShellSection>,
}

/// A line section with its material.
pub(super) type Line<'a> = (&'a LineSection, &'a Material);

impl<'a> Sections<'a> {
    pub fn new(model: &'a Model) -> Self {
        Self {
            materials: model.materials.iter().map(|material| (material.name.as_str(), material)).collect(),
            lines: model.line_sections.iter().map(|section| (section.name.as_str(), section)).collect(),
            shells: model.shell_sections.iter().map(|section| (section.name.as_str(), section)).collect(),
        }
    }

    fn material(&self, name: &str) -> Result<&'a Material, String> {
        self.materials.get(name).copied().ok_or_else(|| format!("there is no material named `{name}`"))
    }

    pub fn line(&self, name: &str) -> Result<Line<'a>, String> {
        let section = self.lines.get(name).copied().ok_or_else(|| format!("there is no section named `{name}`"))?;
        Ok((section, self.material(&section.material)?))
    }

    pub fn beam(&self, name: &str) -> Result<BeamSection, String> {
        let (section, material) = self.line(name)?;
        Ok(BeamSection {
            modulus: material.modulus,
            shear_modulus: 0.5 * material.modulus / (1.0 + material.poisson),
            density: material.density,
            area: section.area,
            inertia_2: section.inertia_2,
            inertia_3: section.inertia_3,
            torsion: section.torsion,
            shear_area_2: section.shear_area_2,
            shear_area_3: section.shear_area_3,
            added_mass: section.added_mass,
        })
    }

    pub fn plate(&self, name: &str) -> Result<Plate, String> {
        let section = self.shells.get(name).copied().ok_or_else(|| format!("there is no section named `{name}`"))?;
        let material = self.material(&section.material)?;
        Ok(Plate {
            modulus: material.modulus,
            poisson: material.poisson,
            thickness: section.thickness,
            mass: material.density * section.thickness + section.added_mass,
        })
    }
}

pub(super) fn beam(list: &Beams, section: BeamSection, ends: [[f64; 3]; 2]) -> Result<Beam3, String> {
    let released = |end: usize| {
        let freed = list.releases.as_ref().map_or(&[][..], |ends| ends[end].as_slice());
        [Freedom::Rx, Freedom::Ry, Freedom::Rz].map(|freedom| freed.contains(&freedom))
    };
    let offsets = list.offsets.unwrap_or_default();
    let beam = Beam3::new(ends, list.orientation, section, offsets, [released(0), released(1)]);
    beam.map_err(|error| error.to_string())
}

pub(super) fn truss(
    list: &Trusses,
    element: usize,
    (section, material): Line,
    ends: [[f64; 3]; 2],
) -> Result<Truss3, String> {
    let mass = material.density * section.area + section.added_mass;
    let truss = match &list.tensions {
        None => Truss3::new(ends, material.modulus * section.area, mass),
        Some(tensions) => {
            let tension = tensions.get(element).ok_or("the cable has no tension")?;
            Truss3::cable(ends, [0.0, 0.0, 1.0], material.modulus, section.area, mass, *tension)
        }
    };
    truss.map_err(|error| error.to_string())
}

pub(super) fn shell(corners: &[[f64; 3]], plate: Plate) -> Result<Kind, String> {
    match *corners {
        [a, b, c] => Shell3::new([a, b, c], plate).map(|shell| Kind::Shell3(Box::new(shell))),
        [a, b, c, d] => Shell4::new([a, b, c, d], plate).map(|shell| Kind::Shell4(Box::new(shell))),
        _ => return Err(format!("a shell has 3 or 4 nodes, not {}", corners.len())),
    }
    .map_err(|error| error.to_string())
}
