//! What the model's own equations tell about it, as data and as lines for people.

use std::fmt;

use ttb_scenario::space::Part;

/// Forces (N) and moments about the nodes (N m) on the ground, along and about x, y, z.
#[derive(Clone, Debug, PartialEq)]
pub struct Reaction {
    /// Which bearings, as the file lists them, or the springs to the ground.
    pub name: String,
    /// Number of nodes.
    pub nodes: usize,
    /// Sum of the forces.
    pub force: [f64; 3],
    /// Sum of the moments that the bearings hold.
    pub moment: [f64; 3],
}

/// Forces on the ground under the model's own weight.
#[derive(Clone, Debug, PartialEq)]
pub struct Reactions {
    /// Of every group of bearings, and of the springs to the ground if there are any.
    pub groups: Vec<Reaction>,
    /// Sum of all forces; against the weight alone.
    pub force: [f64; 3],
    /// Sum of all moments about the origin, those of the weight subtracted: zero.
    pub moment: [f64; 3],
    /// Weight, N.
    pub weight: f64,
    /// Largest displacement down under the own weight, m, and the node that has it.
    pub sag: (f64, u32),
}

impl Reactions {
    /// Greatest of what forces and moments lack to balance the weight, over the weight (moments: over it times `size`, m).
    #[must_use]
    pub fn imbalance(&self, size: f64) -> f64 {
        let forces = [self.force[0], self.force[1], self.force[2] - self.weight];
        let moments = self.moment.map(|moment| moment / size.max(1.0));
        forces.iter().chain(&moments).fold(0.0, |most: f64, value| most.max(value.abs())) / self.weight.max(1.0)
    }
}

/// A model's account of itself.
#[derive(Clone, Debug, PartialEq)]
pub struct SelfCheck {
    /// Number of nodes.
    pub nodes: usize,
    /// Number of elements, springs and masses.
    pub elements: usize,
    /// Number of degrees of freedom.
    pub freedoms: usize,
    /// Mass of the model, kg.
    pub mass: f64,
    /// Centre of mass, m.
    pub centre: [f64; 3],
    /// Greatest extent of the nodes along an axis, m.
    pub size: f64,
    /// Parts that no bearing and no spring to the ground holds.
    pub loose_parts: Vec<Part>,
    /// Degrees of freedom that no element resists.
    pub loose: Vec<String>,
    /// A degree of freedom that moves without force once those before it follow.
    pub mechanism: Option<String>,
    /// Forces on the ground; only without mechanism.
    pub reactions: Option<Reactions>,
}

impl SelfCheck {
    /// Nothing is loose, and the ground carries the weight.
    #[must_use]
    pub fn is_sound(&self) -> bool {
        /// Rounding of the solver's.
        const BALANCED: f64 = 1e-4;
        let balanced = self.reactions.as_ref().is_none_or(|found| found.imbalance(self.size) < BALANCED);
        self.loose_parts.is_empty() && self.loose.is_empty() && self.mechanism.is_none() && balanced
    }
}

/// Of a long list so many are shown.
const SHOWN: usize = 10;

impl fmt::Display for SelfCheck {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [x, y, z] = self.centre;
        writeln!(f, "{} nodes, {} elements, {} degrees of freedom", self.nodes, self.elements, self.freedoms)?;
        write!(f, "mass {:.3} t, centre at x = {x:.3} m, y = {y:.3} m, z = {z:.3} m", self.mass / 1e3)?;
        for part in self.loose_parts.iter().take(SHOWN) {
            write!(f, "\nnot held: the part with node {} ({} nodes)", part.node, part.nodes)?;
        }
        for name in self.loose.iter().take(SHOWN) {
            write!(f, "\nmechanism: nothing resists the {name}")?;
        }
        let more = self.loose_parts.len().saturating_sub(SHOWN) + self.loose.len().saturating_sub(SHOWN);
        if more > 0 {
            write!(f, "\nand {more} more like these")?;
        }
        if let Some(name) = &self.mechanism {
            write!(f, "\nmechanism: nothing holds the {name} once what it is joined to follows")?;
        }
        self.reactions.iter().try_for_each(|reactions| write!(f, "\n{reactions}"))
    }
}

impl fmt::Display for Reactions {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let kilo = |values: [f64; 3]| {
            // no minus before what rounds to zero
            let [x, y, z] = values.map(|value| (value / 100.0).round() / 10.0 + 0.0);
            format!("{x:.1}, {y:.1}, {z:.1}")
        };
        writeln!(f, "under its own weight of {:.1} kN, on the ground along x, y, z in kN:", self.weight / 1e3)?;
        for group in &self.groups {
            writeln!(f, "  {} ({} nodes): {}", group.name, group.nodes, kilo(group.force))?;
        }
        writeln!(f, "  sum: {}", kilo(self.force))?;
        writeln!(f, "  moments about the origin that are not balanced, kN m: {}", kilo(self.moment))?;
        write!(f, "largest displacement down {:.3} mm, at node {}", self.sag.0 * 1e3, self.sag.1)
    }
}
