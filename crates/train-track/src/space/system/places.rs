//! Compliances between all axles for the places of a step.

use super::super::axle::RAIL_PORTS;
use super::super::car::{AXLES, CarStep};
use super::super::newton::{Neighbour, RailBlock};
use super::super::point::LineFactors;
use super::super::rails::W_SUM;
use super::{SpaceStep, SpaceSystem};
use crate::prepared::TrackFactors;

impl SpaceSystem {
    /// Compliance of the rails between two axles.
    fn between(&self, track: &TrackFactors, lines: &[LineFactors], i: usize, j: usize) -> RailBlock {
        let mut block = [[0.0; RAIL_PORTS]; RAIL_PORTS];
        block[W_SUM][W_SUM] = track.compliance.between(&self.wheels.points[i], &self.wheels.points[j]);
        for (((_, ports), factors), points) in self.lines.lines.iter().zip(lines).zip(&self.points) {
            let y = factors.between(ports.len(), &points[i], &points[j]);
            for (a, row) in ports.iter().zip(&y) {
                ports.iter().zip(row).for_each(|(b, y)| block[*a][*b] = *y);
            }
        }
        block
    }

    /// c_loc of the rails' ports under an axle.
    pub fn local(&self, axle: usize) -> [f64; RAIL_PORTS] {
        let mut local = [0.0; RAIL_PORTS];
        local[W_SUM] = self.wheels.points[axle].local_compliance;
        for ((_, ports), points) in self.lines.lines.iter().zip(&self.points) {
            ports.iter().zip(points[axle].local).for_each(|(port, c)| local[*port] = c);
        }
        local
    }

    /// Y_s and Y_r of all cars from the factors of the track; `moving`: the rails' ports have rates.
    pub fn fill(&mut self, cars: &[CarStep], track: &TrackFactors, lines: &[LineFactors], moving: bool) {
        let reaches = |i: usize, j: usize| {
            let points = &self.wheels.points;
            let plane = track.compliance.reaches(&points[i], &points[j]);
            plane || lines.iter().zip(&self.points).any(|(line, points)| line.reaches(&points[i], &points[j]))
        };
        let mut ports = std::mem::take(&mut self.ports);
        let axles = self.wheels.points.len();
        for (c, car) in ports.iter_mut().enumerate() {
            car.set_car(&cars[self.of_kind[c]].compliance);
            car.neighbours.clear();
            for i in 0..AXLES {
                let axle = AXLES * c + i;
                for j in 0..AXLES {
                    let block = self.between(track, lines, axle, AXLES * c + j);
                    let local = self.local(axle);
                    car.add_rails([i, j], &block, (i == j).then_some(&local), moving);
                }
                let before = (0..AXLES * c).rev().take_while(|other| reaches(axle, *other));
                let after = (AXLES * (c + 1)..axles).take_while(|other| reaches(axle, *other));
                for other in before.chain(after) {
                    car.neighbours
                        .push(Neighbour { axles: [i, other], block: self.between(track, lines, axle, other) });
                }
            }
        }
        self.ports = ports;
    }

    /// Places and compliances for a step that ends at `t`.
    pub(super) fn place(&mut self, matrices: &SpaceStep, t: f64) -> Result<(), String> {
        let key = (t.to_bits(), matrices.newmark.h.to_bits());
        if self.geometry_for == Some(key) {
            return Ok(());
        }
        self.locate(t)?;
        self.fill(&matrices.cars, &matrices.track, &matrices.lines, true);
        self.geometry_for = Some(key);
        Ok(())
    }
}
