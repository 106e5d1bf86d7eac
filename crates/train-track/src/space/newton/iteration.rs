//! Newton's method for the ports of one car.

use ttb_contract::finite::larger;

use super::super::axle::PORTS;
use super::super::car::{AXLES, dot};
use super::{CORRECTION, CarPorts, FLOOR, GAIN, ITERATIONS, LEAST, Of};

impl CarPorts {
    /// f − F(s, ṡ) and the elements' new inner states; the largest |f − F|, which is NaN if one is.
    fn measure(&mut self, of: &Of) -> f64 {
        let [s, v] = &self.motion;
        for axle in 0..AXLES {
            let at = axle * PORTS..(axle + 1) * PORTS;
            let (place, f) = (&self.places[axle], &mut self.answered[at.clone()]);
            self.lever.forces(&self.contact, &s[at.clone()], &v[at], place, f);
        }
        let [before, after] = &mut self.inner;
        for (k, element) in self.elements.iter().enumerate() {
            let port = AXLES * PORTS + k;
            let answer = element.answer(s[port], v[port], before[k], of.gamma, of.h);
            self.answered[port] = answer.force;
            after[k] = answer.inner;
        }
        let mut norm = 0.0;
        for (port, ((r, f), answer)) in self.residual.iter_mut().zip(&self.f).zip(&self.answered).enumerate() {
            *r = f - answer;
            norm = larger(norm, r.abs() / Self::arm(port));
        }
        norm
    }

    /// J for the motion in `s` and `v` and its LU.
    fn renew(&mut self, of: &Of) -> bool {
        let n = self.n;
        self.lu.rows.fill(0.0);
        for axle in 0..AXLES {
            let at = axle * PORTS;
            let [s, v] = self.motion.each_ref().map(|x| &x[at..at + PORTS]);
            let [by_s, by_v] = self.lever.gradients(&self.contact, s, v, &self.places[axle]);
            for i in 0..PORTS {
                let row = &mut self.lu.rows[(at + i) * n..(at + i + 1) * n];
                for k in 0..PORTS {
                    let (p, r) = (-by_s[i][k], -of.a1 * by_v[i][k]);
                    let range = (at + k) * n..(at + k + 1) * n;
                    if of.rails_move {
                        // Y_s = Y_r + diag c_loc: one pass for both.
                        let both = p + r;
                        if both != 0.0 {
                            row.iter_mut().zip(&self.rate[range]).for_each(|(j, y)| *j += both * y);
                        }
                        row[at + k] += p * self.local[at + k];
                        continue;
                    }
                    if p != 0.0 {
                        row.iter_mut().zip(&self.position[range.clone()]).for_each(|(j, y)| *j += p * y);
                    }
                    if r != 0.0 {
                        row.iter_mut().zip(&self.rate[range]).for_each(|(j, y)| *j += r * y);
                    }
                }
                row[at + i] += 1.0;
            }
        }
        for (k, element) in self.elements.iter().enumerate() {
            let port = AXLES * PORTS + k;
            let answer = element.answer(self.motion[0][port], self.motion[1][port], self.inner[0][k], of.gamma, of.h);
            let [p, r] = answer.slopes;
            for j in 0..n {
                self.lu.rows[port * n + j] = -p * self.position[port * n + j] - of.a1 * r * self.rate[port * n + j];
            }
            self.lu.rows[port * n + port] += 1.0;
        }
        self.lu.factorise()
    }

    /// Remembers f, s and ṡ as those that the step begins with.
    pub fn begin(&mut self) {
        self.begun[0].copy_from_slice(&self.f);
        self.begun[1].copy_from_slice(&self.motion[0]);
        self.begun[2].copy_from_slice(&self.motion[1]);
    }

    /// Where Newton's method finds no way from the old forces in one stride: s_free and ṡ_free are led in stages from those
    /// that the old forces and motions would have, to their own.
    ///
    /// # Errors
    /// As [`CarPorts::solve`].
    pub(super) fn solve_in_stages(&mut self, of: &Of, stages: usize) -> Result<f64, bool> {
        let n = self.n;
        self.target[0].copy_from_slice(&self.free[0]);
        self.target[1].copy_from_slice(&self.free[1]);
        self.f.copy_from_slice(&self.begun[0]);
        // follow() gives s = s_free + Y f: what that s has more than the old one is taken off of s_free.
        self.follow(of);
        for k in 0..2 {
            for i in 0..n {
                self.start[k][i] = self.target[k][i] + self.begun[k + 1][i] - self.motion[k][i];
            }
        }
        let mut solved = Ok(0.0);
        for stage in 1..=stages {
            let part = stage as f64 / stages as f64;
            for k in 0..2 {
                for i in 0..n {
                    let (from, to) = (self.start[k][i], self.target[k][i]);
                    self.free[k][i] = if stage == stages { to } else { from + part * (to - from) };
                }
            }
            self.follow(of);
            self.renewed = true;
            solved = if self.renew(of) { self.solve(of, CORRECTION) } else { Err(false) };
            if solved.is_err() {
                break;
            }
        }
        self.free[0].copy_from_slice(&self.target[0]);
        self.free[1].copy_from_slice(&self.target[1]);
        solved
    }

    /// J at the forces and motions that the step begins with.
    ///
    /// # Errors
    /// A matrix without factor: `false`.
    pub fn prepare(&mut self, of: &Of) -> bool {
        self.renewed = false;
        self.renew(of)
    }

    /// Whether J was renewed since [`CarPorts::prepare`].
    pub fn renewed(&self) -> bool {
        self.renewed
    }

    /// s and ṡ from f and what neighbours do.
    pub(super) fn follow(&mut self, of: &Of) {
        let n = self.n;
        for i in 0..n {
            let moved = dot(&self.rate[i * n..(i + 1) * n], &self.f);
            let (position, met) = if of.rails_move {
                (moved + self.local[i] * self.f[i], self.met[i])
            } else {
                // All that neighbours do comes through the rails.
                (dot(&self.position[i * n..(i + 1) * n], &self.f), 0.0)
            };
            self.motion[0][i] = self.free[0][i] + position + self.met[i];
            self.motion[1][i] = self.free[1][i] + of.a1 * (moved + met);
        }
    }

    /// Moves f, s and ṡ by a part of the correction.
    fn go(&mut self, factor: f64) {
        let [df, ds, dv] = &self.change;
        let [s, v] = &mut self.motion;
        for (x, change) in [(&mut self.f, df), (s, ds), (v, dv)] {
            x.iter_mut().zip(change).for_each(|(x, c)| *x += factor * c);
        }
    }

    /// The correction of f, s and ṡ; how far it moves the ports, m.
    fn correct(&mut self, of: &Of) -> f64 {
        let n = self.n;
        let [df, ds, dv] = &mut self.change;
        df.iter_mut().zip(&self.residual).for_each(|(c, r)| *c = -r);
        self.lu.solve(df);
        self.secants.improve(df);
        let mut correction = 0.0;
        for i in 0..n {
            let moved = dot(&self.rate[i * n..(i + 1) * n], df);
            ds[i] =
                if of.rails_move { moved + self.local[i] * df[i] } else { dot(&self.position[i * n..(i + 1) * n], df) };
            dv[i] = of.a1 * moved;
            correction = larger(correction, ds[i].abs() * Self::arm(i));
        }
        correction
    }

    /// Newton's method from the forces in `f`, s and ṡ until a correction is no larger than `enough`, m; how large its first
    /// one was, m.
    ///
    /// # Errors
    /// It does not end; `true` where a number is not finite.
    pub(super) fn solve(&mut self, of: &Of, enough: f64) -> Result<f64, bool> {
        let mut norm = self.measure(of);
        let (mut first, mut last, mut fresh) = (None, f64::INFINITY, false);
        self.secants.forget();
        for _ in 0..ITERATIONS {
            let correction = self.correct(of);
            if !(norm.is_finite() && correction.is_finite()) {
                return Err(true);
            }
            first.get_or_insert(correction);
            if correction <= enough || (fresh && correction <= FLOOR && correction >= 0.5 * last) {
                self.go(1.0);
                return Ok(first.unwrap_or(0.0));
            }
            last = correction;
            // Line search: the full step, unless the residual grows.
            let (mut factor, before) = (1.0, norm);
            loop {
                self.go(factor);
                norm = self.measure(of);
                if norm < before {
                    break;
                }
                self.go(-factor);
                factor *= 0.5;
                // An old J may point uphill; a new one does so in rounding only.
                if factor < if fresh { LEAST } else { 0.1 } {
                    break;
                }
            }
            let gained = norm < before;
            if factor == 1.0 && gained {
                self.secants.remember(&self.change[0]);
            } else {
                self.secants.forget();
            }
            if !gained {
                norm = self.measure(of);
                if fresh {
                    // Nothing leads down from here: a small step across the kink of a contact that opens or closes.
                    self.go(LEAST);
                    norm = self.measure(of);
                }
            }
            fresh = norm > GAIN * before;
            if fresh {
                self.renewed = true;
                self.secants.forget();
                if !self.renew(of) {
                    return Err(false);
                }
            }
        }
        Err(false)
    }
}
