//! The constant equations of track and bridge for one step size, base springs included, as one sparse factor.
//!
//! ```text
//! K̂ u₁ = p + Nᵀ F,     K̂ = K + a₀M + a₁C,     C = C₀ + αM_b + βK_b       b: the bridge's part
//! q = a₁u + a₄u̇ + a₅ü,   g = β q_b/c_K,   c_K = 1 + a₁β,   c_M = a₀ + a₁α
//! u₁ = g + K̂⁻¹ (p′ + Nᵀ F)
//! p′ = M (a₀u + a₂u̇ + a₃ü + α′ q_b) + C₀ (q − a₁ g) − Σ k̂ v vᵀ g,   α′ = α − c_M β/c_K
//! ```
//!
//! v is the row of a base spring between track and deck, k̂ = k + a₁c: K_b is never multiplied with (as in
//! `ttb_bridge::full`).

use ttb_bridge::law::Law;
use ttb_dynamics::newmark::{Motion, Newmark};
use ttb_sparse::Assembly;

use crate::error::ReferenceError;
use crate::sweeps::Sweeps;
use crate::whole::{Whole, dot};

/// K + a₀M + a₁C of track and bridge, in the stiffness part of an assembly.
pub fn equations(whole: &Whole, a0: f64, a1: f64) -> Assembly {
    let (n, Law { alpha, beta, .. }) = (whole.track.order() as u32, &whole.bridge.law);
    let mut assembly = Assembly::new(whole.order());
    let band = whole.track.effective(a0, a1);
    for i in 0..n as usize {
        for j in i.saturating_sub(band.half_bandwidth())..=i {
            if i == j || band.get(i, j) != 0.0 {
                assembly.add_entry(i as u32, j as u32, band.get(i, j), 0.0);
            }
        }
    }
    // Room for the contacts: where elements meet, deflection and rotation of a node cancel in K and M.
    for element in 0..whole.track.nodes() - 1 {
        let dofs = whole.track.element_dofs(element).map(|dof| dof as u32);
        for i in dofs {
            dofs.iter().filter(|j| **j <= i).for_each(|j| assembly.add_entry(i, *j, 0.0, 0.0));
        }
    }
    let raw = whole.bridge.pencil.raw();
    for (column, ends) in raw.starts.windows(2).enumerate() {
        for at in ends[0] as usize..ends[1] as usize {
            let value = (1.0 + a1 * beta) * raw.k[at] + (a0 + a1 * alpha) * raw.m[at];
            assembly.add_entry(n + raw.rows[at], n + column as u32, value, 0.0);
        }
    }
    raw.damping.iter().for_each(|&(i, j, c)| assembly.add_entry(n + i, n + j, a1 * c, 0.0));
    let stiffness = whole.base.stiffness + a1 * whole.base.damping;
    for ((_, base), row) in whole.track.bridge_bases().zip(&whole.bridge.supports) {
        for &(i, a) in row {
            assembly.add_entry(n + i, base as u32, -stiffness * a, 0.0);
            row.iter().filter(|(j, _)| *j <= i).for_each(|&(j, b)| {
                assembly.add_entry(n + i, n + j, stiffness * a * b, 0.0);
            });
        }
    }
    assembly
}

/// p′ and g of a step.
pub struct History {
    /// p′ of track and bridge.
    pub load: Vec<f64>,
    /// g, of the bridge.
    pub known: Vec<f64>,
    work: Vec<f64>,
    track_work: Vec<f64>,
}

impl History {
    /// Buffers for a case.
    pub fn new(whole: &Whole) -> Self {
        let zeros = |n: usize| vec![0.0; n];
        let ndof = whole.bridge.pencil.ndof();
        let (load, track_work) = (zeros(whole.order()), zeros(whole.track.order()));
        Self { load, known: zeros(ndof), work: zeros(ndof), track_work }
    }

    /// From the motions a step begins with.
    pub fn begin(&mut self, whole: &Whole, newmark: &Newmark, track: &Motion, bridge: &Motion) {
        let Self { load, known, work, track_work } = self;
        let [rate, dashpots, share] = whole.bridge.law.history(newmark);
        let (p_t, p_b) = load.split_at_mut(whole.track.order());
        whole.track.history(newmark, track, p_t, track_work);
        let motion = bridge.u.iter().zip(&bridge.v).zip(&bridge.a);
        for (((q, w), p), ((u, v), a)) in known.iter_mut().zip(work.iter_mut()).zip(p_b.iter_mut()).zip(motion) {
            *q = newmark.damping(*u, *v, *a);
            *w = newmark.inertia(*u, *v, *a) + rate * *q;
            *p = 0.0;
        }
        let pencil = &whole.bridge.pencil;
        pencil.add_mass(work, p_b);
        if pencil.has_dashpots() {
            work.iter_mut().zip(&*known).for_each(|(w, q)| *w = dashpots * q);
            pencil.add_damping(work, p_b);
        }
        let damping = whole.base.damping;
        let stiffness = share * (whole.base.stiffness + newmark.a[1] * damping);
        for ((_, base), row) in whole.track.bridge_bases().zip(&whole.bridge.supports) {
            let deck = dot(row, known);
            // Of the dashpot's force the track has counted its own part already, as if it stood on the ground.
            let damper = newmark.damping(track.u[base], track.v[base], track.a[base]) - deck;
            p_t[base] += (stiffness - damping) * deck;
            for &(dof, weight) in row {
                p_b[dof as usize] -= weight * (damping * damper + stiffness * deck);
            }
        }
        known.iter_mut().for_each(|q| *q *= share);
    }
}

/// K̂ of track and bridge, factorised, to be looked at along the rail.
///
/// # Errors
/// K̂ is not positive definite.
pub fn factorised(whole: &Whole, newmark: &Newmark) -> Result<Sweeps, ReferenceError> {
    let case = |e: ttb_sparse::FactorError| ReferenceError::Case(e.to_string());
    let pencil = equations(whole, newmark.a[0], newmark.a[1]).finish_with(&whole.layout).map_err(case)?;
    let factor = pencil.factor(1.0, 0.0, 0.0).map_err(case)?;
    Ok(Sweeps::new(factor, whole.rail()))
}
