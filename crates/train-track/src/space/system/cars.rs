//! Cars before and after their ports are solved: q_free with wind and curve, and q₁.

use ttb_dynamics::newmark::{Motion, Newmark};

use super::super::axle::PORTS;
use super::super::car::{AXLES, Car, DOFS, FIRST_WHEELSET, OF_BODY, WHEELSET_PORTS};
use super::{SpaceStep, SpaceSystem};

impl SpaceSystem {
    /// q_free of all cars for a step that ends at `t`.
    pub fn free_cars(&mut self, matrices: &SpaceStep, old: &Motion, t: f64) {
        for (c, kind) in self.of_kind.iter().enumerate() {
            let range = c * DOFS..(c + 1) * DOFS;
            let car = &self.kinds[*kind];
            let extra = self.extra(c, car, t);
            let motion = [&old.u[range.clone()], &old.v[range.clone()], &old.a[range.clone()]];
            matrices.cars[*kind].free(car, &matrices.newmark, motion, &extra, &mut self.cars_free[range]);
        }
    }

    /// Forces of wind and curve on a car at time `t`.
    fn extra(&self, c: usize, car: &Car, t: f64) -> [f64; DOFS] {
        let mut extra = [0.0; DOFS];
        if self.loads.wind.is_none() && self.loads.curve.is_empty() {
            return extra;
        }
        let v = self.wheels.running.speed(t.max(0.0));
        let middle = self.wheels.position(AXLES * c, t) - car.centres[3][0];
        if let Some(wind) = &self.loads.wind {
            let [x, height] = car.centres[0];
            let [fy, fz, mx] = wind.forces(t, middle + x, v, height);
            (extra[0], extra[1], extra[2]) = (fy, fz, mx);
        }
        for (b, [x, _]) in car.centres.iter().enumerate() {
            let [curvature, cant] = self.loads.curve_at(middle + x);
            extra[OF_BODY * b] += car.mass[OF_BODY * b] * (ttb_scenario::GRAVITY * cant - v * v * curvature);
            if b >= 3 {
                extra[OF_BODY * b + 2] -= car.spin_inertia * v / car.radius * v * curvature;
            }
        }
        extra
    }

    /// s_free and ṡ_free of the wheelsets' and links' ports.
    pub fn free_car_ports(&mut self, newmark: &Newmark, old: &Motion) {
        for (c, ports) in self.ports.iter_mut().enumerate() {
            let car = &self.kinds[self.of_kind[c]];
            let at = c * DOFS;
            let past = |i: usize| newmark.damping(old.u[at + i], old.v[at + i], old.a[at + i]);
            for k in 0..car.ports() {
                let (port, s, gone) = match k.checked_sub(WHEELSET_PORTS) {
                    None => {
                        let dof = FIRST_WHEELSET + k;
                        (k / OF_BODY * PORTS + k % OF_BODY, self.cars_free[at + dof], past(dof))
                    }
                    Some(element) => {
                        let row = &car.elements[element].0;
                        let of = |x: &dyn Fn(usize) -> f64| (0..DOFS).map(|i| row[i] * x(i)).sum::<f64>();
                        (AXLES * PORTS + element, of(&|i| self.cars_free[at + i]), of(&past))
                    }
                };
                ports.free[0][port] = s;
                ports.free[1][port] = newmark.a[1] * s - gone;
            }
        }
    }

    /// q₁ of all cars with velocities and accelerations.
    pub fn finish_cars(&self, matrices: &SpaceStep, old: &Motion, new: &mut Motion) {
        for (c, ports) in self.ports.iter().enumerate() {
            let range = c * DOFS..(c + 1) * DOFS;
            let force = |k: usize| match k.checked_sub(WHEELSET_PORTS) {
                None => ports.f[k / OF_BODY * PORTS + k % OF_BODY],
                Some(element) => ports.f[AXLES * PORTS + element],
            };
            matrices.cars[self.of_kind[c]].press(&self.cars_free[range.clone()], force, &mut new.u[range]);
        }
        matrices.newmark.finish_all(old, new);
    }
}
