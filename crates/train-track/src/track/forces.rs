//! Forces in the track: what a step begins with, what the deck's motion adds, what the supports give to the deck.
//!
//! ```text
//! p = M (a₀u + a₂u̇ + a₃ü) + C (a₁u + a₄u̇ + a₅ü)
//! k d + c ḋ                 the deck's motion at the base springs
//! k (u − d) + c (u̇ − ḋ)    the force of a support on the deck
//! ```

use ttb_dynamics::newmark::{Motion, Newmark};

use super::Track;

impl Track {
    /// y = M x, element by element along the rail; a node's share from the element behind is carried on.
    fn multiply_mass(&self, x: &[f64], y: &mut [f64]) {
        let m = &self.element_mass;
        let mut carried = [0.0; 2];
        for nodes in self.nodes.windows(2) {
            let (a, b) = (nodes[0], nodes[1]);
            let q = [x[a], x[a + 1], x[b], x[b + 1]];
            let row = |i: usize| m[i][0] * q[0] + m[i][1] * q[1] + m[i][2] * q[2] + m[i][3] * q[3];
            (y[a], y[a + 1]) = (carried[0] + row(0), carried[1] + row(1));
            carried = [row(2), row(3)];
        }
        let last = self.nodes[self.elements];
        (y[last], y[last + 1]) = (carried[0], carried[1]);
        for (dof, mass) in &self.lumped {
            y[*dof] = mass * x[*dof];
        }
    }

    /// p = M (a₀u + a₂u̇ + a₃ü) + C (a₁u + a₄u̇ + a₅ü); `work` is scratch of the same length.
    pub fn history(&self, newmark: &Newmark, old: &Motion, p: &mut [f64], work: &mut [f64]) {
        let terms = || old.u.iter().zip(&old.v).zip(&old.a);
        for (w, ((u, v), a)) in work.iter_mut().zip(terms()) {
            *w = newmark.inertia(*u, *v, *a);
        }
        self.multiply_mass(work, p);
        let damping = |i: usize| newmark.damping(old.u[i], old.v[i], old.a[i]);
        for link in &self.links {
            let [i, j] = link.dofs;
            let force = link.spring.damping * (damping(i) - damping(j));
            p[i] += force;
            p[j] -= force;
        }
        for support in 0..=self.elements / self.elements_per_bay {
            let i = self.base_dof(support);
            p[i] += self.base.damping * damping(i);
        }
    }

    /// Rail node over and degree of freedom above the base spring of every support on the bridge.
    pub fn bridge_bases(&self) -> impl Iterator<Item = (usize, usize)> + '_ {
        self.on_bridge.iter().map(|support| (support * self.elements_per_bay, self.base_dof(*support)))
    }

    /// f += k d + c ḋ of the base springs beside the bridge, where the ground moves by `d` m at `v` m/s.
    pub fn add_ground(&self, d: f64, v: f64, f: &mut [f64]) {
        let force = self.base.stiffness * d + self.base.damping * v;
        for support in 0..=self.elements / self.elements_per_bay {
            if self.on_bridge.binary_search(&support).is_err() {
                f[self.base_dof(support)] += force;
            }
        }
    }

    /// k d + c ḋ of the base springs on the bridge; `deck` is [d…, ḋ…].
    pub fn deck_forces(&self, deck: &[f64], forces: &mut [f64]) {
        let (d, v) = deck.split_at(self.on_bridge.len());
        for ((force, d), v) in forces.iter_mut().zip(d).zip(v) {
            *force = self.base.stiffness * d + self.base.damping * v;
        }
    }

    /// f += deck forces at the degrees of freedom they act on.
    pub fn add_deck_forces(&self, forces: &[f64], f: &mut [f64]) {
        for ((_, base), force) in self.bridge_bases().zip(forces) {
            f[base] += force;
        }
    }

    /// Support forces k(u − d) + c(u̇ − ḋ) on the bridge, N.
    pub fn support_forces(&self, motion: &Motion, deck: &[f64], forces: &mut [f64]) {
        let (d, v) = deck.split_at(self.on_bridge.len());
        for (((force, support), d), v) in forces.iter_mut().zip(&self.on_bridge).zip(d).zip(v) {
            let i = self.base_dof(*support);
            *force = self.base.stiffness * (motion.u[i] - d) + self.base.damping * (motion.v[i] - v);
        }
    }
}
