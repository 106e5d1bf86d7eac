//! Modes, and above them compliance between neighbouring supports: what a reduced model sees and is driven by where the
//! supports have so many forces that pseudo-modes would be too many.
//!
//! With Rayleigh damping the supports know the structure by one function of one variable:
//!
//! ```text
//! R (s²M + s(αM + βK) + K)⁻¹ Bᵀ = H(σ)/(1 + βs)      σ = (s² + αs)/(1 + βs),  H(σ) = R (K + σM)⁻¹ Bᵀ
//! ```
//!
//! At a real σ as great as (2πf)² the answer H(σ) to a force fades away within metres. From such values, and with poles λᵢ
//! above the modes, H follows everywhere:
//!
//! ```text
//! H(σ) ≈ Σᵢ Gᵢ/(λᵢ + σ)             Gᵢ = Σₐ Cₐᵢ H(σₐ),  C = [1/(λᵢ + σₐ)]⁻¹     right at every σₐ, and local
//! H(σ) ≈ Σⱼ φⱼ[1/(ωⱼ² + σ) − Σᵢ gⱼᵢ/(λᵢ + σ)]φⱼᵀ + Σᵢ Gᵢ/(λᵢ + σ)      gⱼᵢ = Σₐ Cₐᵢ/(ωⱼ² + σₐ)
//! ```
//!
//! The second line puts the modes ωⱼ right that are known: there it is exact for every σ. At σₐ its bracket is zero, so that
//! vectors that only resemble modes may be added, too. What lies above has the relative error
//! Πₐ(σ − σₐ)/(σₐ + λ) Πᵢ(λ − λᵢ)/(λᵢ + σ), λ = ω². Every term 1/(λ + σ) is a damped oscillator, so that the model is stable;
//! that it never gives energy away is not certain, as the Gᵢ may be indefinite. All terms are [`crate::reduced`]'s coordinates:
//!
//! ```text
//! ηⱼ, ξⱼᵢ driven by φⱼᵀf,  xᵢ by f itself        r = Σⱼ φⱼ(ηⱼ − Σᵢ gⱼᵢ ξⱼᵢ) + Σᵢ Gᵢ xᵢ
//! ```
//!
//! (Rational interpolation of a transfer function: Antoulas, Approximation of Large-Scale Dynamical Systems, 2005. Poles and
//! their places are our own choice.)

use serde::{Deserialize, Serialize};
use ttb_dynamics::dense::Dense;
use ttb_dynamics::near::Near;

/// φⱼ, gⱼᵢ and Gᵢ. Coordinates in order: η₁, ξ₁₁, ξ₁₂ … of every mode, then x₁ of all supports, x₂ ….
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Local {
    /// Row j: R φⱼ.
    shapes: Dense<f32>,
    /// Row j: gⱼᵢ of all poles.
    shares: Dense,
    /// Of every pole Gᵢᵀ: a row per force.
    near: Vec<Near<f32>>,
}

/// Numbers of S below this part of √(S_rr S_qq) are left out.
const NEGLIGIBLE: f64 = 1e-10;

impl Local {
    /// From φⱼ by rows over all that is seen, gⱼᵢ by rows over the poles, and of every pole Gᵢᵀ.
    pub fn new(shapes: Dense<f32>, shares: Dense, near: Vec<Near<f32>>) -> Self {
        Self { shapes, shares, near }
    }

    /// Number of modes.
    pub fn modes(&self) -> usize {
        self.shapes.rows()
    }

    /// Number of poles.
    pub fn poles(&self) -> usize {
        self.near.len()
    }

    /// Number of forces.
    pub fn forces(&self) -> usize {
        self.near.first().map_or(0, Near::rows)
    }

    /// Number of rows R.
    pub fn rows(&self) -> usize {
        self.shapes.columns()
    }

    /// The ω² of all coordinates, those of the modes and the poles λᵢ given, (rad/s)².
    pub fn omega2(&self, modes: &[f64], poles: &[f64]) -> Vec<f64> {
        let of_modes = modes.iter().flat_map(|w2| std::iter::once(w2).chain(poles)).copied();
        let of_forces = poles.iter().flat_map(|pole| std::iter::repeat_n(*pole, self.forces()));
        of_modes.chain(of_forces).collect()
    }

    /// Whether all parts fit together and to so many coordinates: true of all but damaged files.
    pub fn is_whole(&self, coordinates: usize) -> bool {
        let (modes, poles, rows, forces) = (self.modes(), self.poles(), self.rows(), self.forces());
        let fit = self.shapes.is_whole(modes) && self.shares.is_whole(modes) && self.shares.columns() == poles;
        let near = self.near.iter().all(|near| near.is_whole(forces, rows));
        fit && near && forces <= rows && coordinates == modes * (poles + 1) + poles * forces
    }

    /// ηⱼ − Σᵢ gⱼᵢ ξⱼᵢ of a mode's own coordinates.
    fn amplitude(&self, j: usize, own: &[f64]) -> f64 {
        own[0] - self.shares.row(j).iter().zip(&own[1..]).map(|(g, xi)| g * xi).sum::<f64>()
    }

    /// What is seen of the coordinates u in row i.
    pub fn dot(&self, i: usize, u: &[f64]) -> f64 {
        let (of_modes, of_forces) = u.split_at(self.modes() * (self.poles() + 1));
        let modes = of_modes.chunks_exact(self.poles() + 1).enumerate();
        let modes = modes.map(|(j, own)| f64::from(self.shapes.row(j)[i]) * self.amplitude(j, own));
        let near = self.near.iter().zip(of_forces.chunks_exact(self.forces().max(1)));
        let forces = near.map(|(near, x)| {
            let seen =
                |(q, x): (usize, &f64)| near.row(q).filter(|(row, _)| *row == i).map(|(_, g)| g * x).sum::<f64>();
            x.iter().enumerate().map(seen).sum::<f64>()
        });
        modes.sum::<f64>() + forces.sum::<f64>()
    }

    /// As [`Dense::fold`], over all coordinates: p is what drives a coordinate under the forces x.
    pub fn fold<const N: usize>(
        &self,
        x: &[f64],
        mut weights: impl FnMut(usize, f64) -> [f64; N],
        mut y: [&mut [f64]; N],
    ) {
        let each = self.poles() + 1;
        let of_mode = |j: usize, p: f64| {
            let mut w = weights(j * each, p);
            for (i, share) in self.shares.row(j).iter().enumerate() {
                let taken = weights(j * each + 1 + i, p);
                (0..N).for_each(|n| w[n] -= share * taken[n]);
            }
            w
        };
        self.shapes.fold(x, of_mode, y.each_mut().map(|y| &mut **y));
        for (i, near) in self.near.iter().enumerate() {
            let first = self.modes() * each + i * self.forces();
            let of_force = |q: usize, _: f64| weights(first + q, x.get(q).copied().unwrap_or(0.0));
            near.fold(&[], of_force, y.each_mut().map(|y| &mut **y));
        }
    }

    /// R diag(w) times what drives the coordinates: S, of w that are the same for all coordinates of one pole.
    pub fn compliance(&self, w: &[f64]) -> Near {
        let (forces, rows) = (self.forces(), self.rows());
        let (of_modes, of_forces) = w.split_at(self.modes() * (self.poles() + 1));
        let of_modes = of_modes.chunks_exact(self.poles() + 1).enumerate().map(|(j, own)| self.amplitude(j, own));
        let mut all = self.shapes.weighted_gram(&of_modes.collect::<Vec<_>>(), forces);
        for (near, w) in self.near.iter().zip(of_forces.chunks_exact(forces.max(1))) {
            for (q, w) in w.iter().enumerate() {
                near.row(q).for_each(|(row, g)| all.row_mut(row)[q] += w * g);
            }
        }
        let scale: Vec<f64> = (0..forces).map(|q| all.row(q)[q].abs().sqrt()).collect();
        let mut compliance = Near::new(forces);
        for r in 0..rows {
            let row = all.row(r);
            // Of a monitored point, which has no force of its own, the greatest number takes the place of √S_rr.
            let own = scale
                .get(r)
                .copied()
                .unwrap_or_else(|| row.iter().zip(&scale).map(|(s, scale)| s.abs() / scale).fold(0.0, f64::max));
            compliance.push(row, |q| row[q].abs() > NEGLIGIBLE * own * scale[q]);
        }
        compliance
    }
}
