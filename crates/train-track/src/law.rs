//! The law of wheel–rail contact, for one axle.
//!
//! ```text
//! nonlinear Hertz   F = n (δ/G)^{3/2} for δ > 0, else 0                    n contacts per axle
//! linear            F = max(0, P0 + n k_H (δ − δ₀))                        k_H = 1.5 (P0/n)^{1/3}/G,  δ₀ = G (P0/n)^{2/3}
//! ```

use ttb_scenario::types::{Contact, ContactLaw};

/// Contact law of one axle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Law {
    linear: bool,
    /// A force alone, N: whatever the approach.
    dead: Option<f64>,
    /// n, contacts per axle.
    contacts: f64,
    /// G, m/N^{2/3}.
    g: f64,
    /// P0, N per axle.
    load: f64,
    /// δ₀, m.
    static_approach: f64,
    /// n k_H, N/m per axle.
    static_stiffness: f64,
}

impl Law {
    /// The law of an axle with static load `load`, N.
    pub fn new(contact: &Contact, load: f64) -> Self {
        let g = contact.constant();
        let contacts = f64::from(contact.wheels_per_axle);
        let root = libm::cbrt(load / contacts);
        let (static_approach, static_stiffness) = (g * root * root, contacts * 1.5 * root / g);
        Self {
            linear: contact.law == ContactLaw::Linear,
            dead: None,
            contacts,
            g,
            load,
            static_approach,
            static_stiffness,
        }
    }

    /// Of two wheels with the Hertz constant `g` each, m/N^{2/3}, and the static load `load` of the axle, N.
    pub fn of_wheels(g: f64, load: f64) -> Self {
        let contact =
            Contact { law: ContactLaw::Hertz, wheels_per_axle: 2, hertz_constant: Some(g), ..Contact::default() };
        Self::new(&contact, load)
    }

    /// P0, N.
    pub fn load(&self) -> f64 {
        self.load
    }

    /// Of a force alone, which presses with `load`, N, whatever the approach.
    pub fn dead(contact: &Contact, load: f64) -> Self {
        Self { dead: Some(load), static_approach: 0.0, ..Self::new(contact, load) }
    }

    /// F(δ) and F′(δ), N and N/m; neither is a number where δ is none.
    pub fn force(&self, delta: f64) -> (f64, f64) {
        if let Some(load) = self.dead {
            // A NaN goes through here, too.
            return (load + 0.0 * delta, 0.0);
        }
        if self.linear {
            let force = self.load + self.static_stiffness * (delta - self.static_approach);
            // A NaN is no separation: it goes through.
            return if force <= 0.0 { (0.0, 0.0) } else { (force, self.static_stiffness) };
        }
        if delta <= 0.0 {
            return (0.0, 0.0);
        }
        let s = delta / self.g;
        let root = s.sqrt();
        (self.contacts * s * root, self.contacts * 1.5 * root / self.g)
    }

    /// δ₀, the approach under the static load, m.
    pub fn static_approach(&self) -> f64 {
        self.static_approach
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn contact(law: ContactLaw, wheels: u32) -> Contact {
        Contact { law, wheels_per_axle: wheels, ..Contact::default() }
    }

    #[test]
    fn hertz_data_of_a_worn_wheel() {
        // docs/theory.md 15: G 4.2206e-8; at 71.6 kN per wheel δ₀ = 72.77 µm, k_H = 1.4758 GN/m.
        let law = Law::new(&contact(ContactLaw::Hertz, 1), 71.6e3);
        assert!((law.g / 4.2206e-8 - 1.0).abs() < 2e-5);
        assert!((law.static_approach() / 72.77e-6 - 1.0).abs() < 1e-4);
        let (force, stiffness) = law.force(law.static_approach());
        assert!((force / 71.6e3 - 1.0).abs() < 1e-12);
        assert!((stiffness / 1.4758e9 - 1.0).abs() < 1e-4);
    }

    #[test]
    fn the_linear_law_touches_the_nonlinear_one_at_the_static_load() {
        let (hertz, linear) =
            (Law::new(&contact(ContactLaw::Hertz, 2), 1.4e5), Law::new(&contact(ContactLaw::Linear, 2), 1.4e5));
        let (a, b) = (hertz.force(hertz.static_approach()), linear.force(linear.static_approach()));
        assert!((a.0 - b.0).abs() < 1e-6 && (a.1 / b.1 - 1.0).abs() < 1e-12);
        assert_eq!(linear.force(-1e-3), (0.0, 0.0));
    }
}
