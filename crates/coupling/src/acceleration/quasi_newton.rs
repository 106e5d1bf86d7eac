//! Interface quasi-Newton with an inverse Jacobian from a least-squares model (Degroote, Bathe and Vierendeels, Comput.
//! Struct. 87, 2009; filter: Haelterman et al., Comput. Struct. 171, 2016).
//!
//! Columns: changes of λ and of r between successive trials, newest first, those of a few earlier steps too:
//!
//! ```text
//! ΔΛ = [λ_k − λ_{k−1}, …],  V = [r_k − r_{k−1}, …]
//! c = argmin |V c + r|,     λ ← λ + ΔΛ c + ω (r + V c)
//! ```
//!
//! What V knows is solved for, the rest is relaxed by Aitken's ω. V = Q R by Gram and Schmidt; a column that is within
//! a tenth of the span of newer ones is forgotten: it tells nothing new, or it is noise.

use std::collections::VecDeque;

use crate::acceleration::relaxation::relaxation;
use crate::acceleration::verbs::Acceleration;
use crate::algebra::{dot, norm};

/// Least part of a column that newer ones must not know. Loose: with columns of earlier steps a tight filter goes wrong.
const FILTER: f64 = 0.1;
/// Columns at most.
const COLUMNS: usize = 30;

/// One change of λ and what it did to r.
#[derive(Debug)]
struct Column {
    change: Vec<f64>,
    effect: Vec<f64>,
    /// Steps ago.
    age: usize,
}

/// IQN-ILS.
#[derive(Debug)]
pub struct QuasiNewton {
    reuse: usize,
    columns: VecDeque<Column>,
    spare: Vec<Column>,
    /// Q and, by columns, R.
    q: Vec<Vec<f64>>,
    r: Vec<Vec<f64>>,
    c: Vec<f64>,
    rest: Vec<f64>,
    lambda: Vec<f64>,
    residual: Vec<f64>,
    /// Trials of this step so far.
    trials: usize,
    omega: f64,
}

impl QuasiNewton {
    /// For `n` forces; columns are kept over `reuse` steps.
    pub fn new(n: usize, reuse: usize) -> Self {
        let most = COLUMNS.min(n);
        let zeros = |_| vec![0.0; n];
        Self {
            reuse,
            columns: VecDeque::with_capacity(most + 1),
            spare: (0..=most).map(|_| Column { change: vec![0.0; n], effect: vec![0.0; n], age: 0 }).collect(),
            q: (0..most).map(zeros).collect(),
            r: (0..most).map(|_| vec![0.0; most]).collect(),
            c: vec![0.0; most],
            rest: vec![0.0; n],
            lambda: vec![0.0; n],
            residual: vec![0.0; n],
            trials: 0,
            omega: 1.0,
        }
    }

    /// Forgets all columns.
    pub fn forget(&mut self) {
        self.spare.extend(self.columns.drain(..));
        self.trials = 0;
    }

    /// Sets ω of the next update.
    pub fn relax(&mut self, omega: f64) {
        self.omega = omega.clamp(0.05, 1.0);
    }

    /// The change since the last trial becomes the newest column.
    fn learn(&mut self, lambda: &[f64], residual: &[f64]) {
        if self.trials > 0 {
            let Some(mut column) = self.spare.pop().or_else(|| self.columns.pop_back()) else { return };
            difference(&mut column.change, lambda, &self.lambda);
            difference(&mut column.effect, residual, &self.residual);
            column.age = 0;
            self.columns.push_front(column);
            if self.columns.len() > self.q.len() {
                self.spare.extend(self.columns.pop_back());
            }
        }
        self.lambda.copy_from_slice(lambda);
        self.residual.copy_from_slice(residual);
        self.trials += 1;
    }

    /// V = Q R; forgets columns that newer ones know.
    fn factor(&mut self) {
        let mut k = 0;
        while k < self.columns.len() {
            let (known, rest) = self.q.split_at_mut(k);
            let (q, r) = (&mut rest[0], &mut self.r[k]);
            q.copy_from_slice(&self.columns[k].effect);
            let whole = norm(q);
            for (r, known) in r.iter_mut().zip(known) {
                *r = dot(known, q);
                q.iter_mut().zip(known.iter()).for_each(|(q, k)| *q -= *r * k);
            }
            let part = norm(q);
            if part > FILTER * whole {
                q.iter_mut().for_each(|q| *q /= part);
                r[k] = part;
                k += 1;
            } else {
                self.spare.extend(self.columns.remove(k));
            }
        }
    }
}

impl Acceleration for QuasiNewton {
    fn begin_step(&mut self) {
        self.trials = 0;
        self.columns.iter_mut().for_each(|c| c.age += 1);
        while self.columns.back().is_some_and(|c| c.age > self.reuse) {
            self.spare.extend(self.columns.pop_back());
        }
    }

    fn update(&mut self, lambda: &mut [f64], residual: &[f64]) {
        if self.trials == 1 {
            self.omega = relaxation(self.omega, &self.residual, residual);
        }
        self.learn(lambda, residual);
        self.factor();
        self.rest.copy_from_slice(residual);
        let m = self.columns.len();
        for k in 0..m {
            self.c[k] = -dot(&self.q[k], &self.rest);
            let c = self.c[k];
            self.rest.iter_mut().zip(&self.q[k]).for_each(|(rest, q)| *rest += c * q);
        }
        for k in (0..m).rev() {
            self.c[k] /= self.r[k][k];
            for i in 0..k {
                self.c[i] -= self.r[k][i] * self.c[k];
            }
        }
        lambda.iter_mut().zip(&self.rest).for_each(|(l, rest)| *l += self.omega * rest);
        for (column, c) in self.columns.iter().zip(&self.c) {
            lambda.iter_mut().zip(&column.change).for_each(|(l, d)| *l += c * d);
        }
    }

    fn end_step(&mut self, lambda: &[f64], residual: &[f64]) {
        self.learn(lambda, residual);
    }
}

fn difference(to: &mut [f64], a: &[f64], b: &[f64]) {
    to.iter_mut().zip(a).zip(b).for_each(|((to, a), b)| *to = a - b);
}
