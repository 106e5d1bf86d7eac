//! All ports of an interface: in which order forces and motions stand.
//!
//! ```text
//! forces    f_1 … f_n                                      one a port
//! motions   q_1 … q_p,  q̇_1 … q̇_r,  others                 r ≤ p ≤ n
//! ```
//!
//! The ports whose motion is known best come first: r of them with position q and rate q̇, then those with the position
//! alone, then those of which only the force is known. `others` are motions that belong to no port (of a system that is no
//! bridge under a track). [`Ports::parts`] is the only place where this order is taken apart.
//!
//! Ports may have different units. With s_i the scale of port i,
//!
//! ```text
//! w_i = s_1/s_i        f̂_i = w_i f_i,   q̂_i = q_i/w_i        f̂·q̂ = f·q
//! ```
//!
//! have the units of the first port, so that norms and least squares over all ports make sense.

use crate::port::{Component, Known, Port};

/// The ports of an interface, in their order.
#[derive(Clone, Debug, PartialEq)]
pub struct Ports {
    list: Vec<Port>,
    /// Ports with a known position, ports with a known rate.
    positions: usize,
    rates: usize,
    others: usize,
}

/// A vector of motions, taken apart.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parts<T> {
    /// Positions, one for each port that has one, in the order of the ports.
    pub positions: T,
    /// Rates, likewise.
    pub rates: T,
    /// Motions that belong to no port.
    pub others: T,
}

impl<T> Parts<T> {
    /// One after the other.
    pub fn each(self) -> [T; 3] {
        [self.positions, self.rates, self.others]
    }
}

impl Ports {
    /// Of a list whose ports stand in the order of [`Known`], and `others` motions besides. `None` if they do not, or if a
    /// scale is not a positive number.
    pub fn new(list: Vec<Port>, others: usize) -> Option<Self> {
        let ordered = list.is_sorted_by_key(|port| port.known);
        let scaled = list.iter().all(|port| port.scale > 0.0 && port.scale.is_finite());
        let rates = list.iter().filter(|port| port.known == Known::PositionAndRate).count();
        let positions = list.iter().filter(|port| port.known != Known::Nothing).count();
        (ordered && scaled).then_some(Self { list, positions, rates, others })
    }

    /// `supports` vertical ports with displacement and velocity; `scale` is one axle load, N.
    pub fn vertical(supports: usize, scale: f64) -> Self {
        let list = (1..=supports).map(|support| Port::new(support, Component::Vertical, scale)).collect();
        Self { list, positions: supports, rates: supports, others: 0 }
    }

    /// The ports.
    pub fn list(&self) -> &[Port] {
        &self.list
    }

    /// Number of forces.
    pub fn forces(&self) -> usize {
        self.list.len()
    }

    /// Number of ports with a position: they come first.
    pub fn positions(&self) -> usize {
        self.positions
    }

    /// Length of a vector of motions.
    pub fn motions(&self) -> usize {
        self.positions + self.rates + self.others
    }

    /// Whether every force has a position, so that its work can be counted.
    pub fn count_work(&self) -> bool {
        self.positions == self.list.len()
    }

    /// Whether every port has position and rate, and there is nothing else.
    pub fn complete(&self) -> bool {
        self.rates == self.list.len() && self.others == 0
    }

    /// s of the first port: what a force is compared with. 1 without ports.
    pub fn scale(&self) -> f64 {
        self.list.first().map_or(1.0, |port| port.scale)
    }

    /// w, unless all ports have one scale and every w_i is 1.
    pub fn weights(&self) -> Option<Vec<f64>> {
        let first = self.scale();
        let uniform = self.list.iter().all(|port| port.scale == first);
        (!uniform).then(|| self.list.iter().map(|port| first / port.scale).collect())
    }

    /// Positions, rates and others of a vector of motions.
    pub fn parts<'a>(&self, motion: &'a [f64]) -> Parts<&'a [f64]> {
        let (positions, rest) = motion.split_at(self.positions);
        let (rates, others) = rest.split_at(self.rates);
        Parts { positions, rates, others }
    }

    /// The same, to be written.
    pub fn parts_mut<'a>(&self, motion: &'a mut [f64]) -> Parts<&'a mut [f64]> {
        let (positions, rest) = motion.split_at_mut(self.positions);
        let (rates, others) = rest.split_at_mut(self.rates);
        Parts { positions, rates, others }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn motions_are_positions_then_rates_then_what_belongs_to_no_port() {
        let known = [Known::PositionAndRate, Known::Position, Known::Nothing];
        let port = |(i, known)| Port { support: i + 1, component: Component::Vertical, scale: 1.0, known };
        let list: Vec<Port> = known.into_iter().enumerate().map(port).collect();
        let ports = Ports::new(list.clone(), 1).expect("ordered");
        assert_eq!((ports.forces(), ports.motions(), ports.complete(), ports.count_work()), (3, 4, false, false));
        let parts = ports.parts(&[1.0, 2.0, 3.0, 4.0]);
        assert_eq!(parts.each(), [&[1.0, 2.0][..], &[3.0], &[4.0]]);
        assert_eq!(Ports::new(list.into_iter().rev().collect(), 0), None);
    }

    #[test]
    fn weights_bring_forces_of_all_units_to_that_of_the_first() {
        let list = [Component::Vertical, Component::Roll].map(|component| Port::new(1, component, 100e3)).to_vec();
        assert_eq!(Ports::new(list, 0).and_then(|ports| ports.weights()), Some(vec![1.0, 1.0 / 0.75]));
        assert_eq!(Ports::vertical(3, 1e5).weights(), None);
        assert_eq!(Ports::new(vec![Port::new(1, Component::Roll, f64::NAN)], 0), None);
    }
}
