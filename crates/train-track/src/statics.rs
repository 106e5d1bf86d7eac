//! Static equilibrium of train and track for given deck displacements.
//!
//! With the static rail compliance Y = N K_t⁻¹ Nᵀ + diag c_loc and s = B q − N u_deck − r, the contact forces are a function
//! F(s) (module `contact`), and the cars' equilibrium
//!
//! ```text
//! K_c q + Bᵀ F(B q − N u_deck − r) = w
//! ```
//!
//! is solved by Newton with the tangent K_c + Bᵀ T B, T = D (I + Y D)⁻¹: the stationary point of a convex energy. K_c alone
//! is singular, wheels are held by the contacts only. Axles far apart have nothing to do with each other: Y, T and the
//! tangent are kept as far as their entries can be seen, so that the cost grows with the number of cars.

use std::ops::Range;

use ttb_contract::finite::larger;
use ttb_dynamics::newmark::Motion;

use crate::coupled::TrainTrackSystem;
use crate::decaying::{Decaying, NEGLIGIBLE};
use crate::law::Law;
use crate::state::State;
use crate::track::Track;

/// Newton iterations at most.
const ITERATIONS: usize = 40;
/// Out-of-balance force allowed, relative to an axle load.
const BALANCE: f64 = 1e-10;

/// Static equilibrium at time `t` for the deck displacements in `deck` = [d…, ḋ…] (velocities are ignored): rest, written
/// to `state`.
///
/// # Errors
/// A wheel off the rail, a number that is not finite, or no equilibrium within the iterations.
pub fn equilibrium(system: &mut TrainTrackSystem, t: f64, deck: &[f64], state: &mut State) -> Result<(), String> {
    system.locate(t)?;
    let rail = rail_without_wheels(system, deck);
    static_compliance(system);
    let axles = system.wheels.points.len();
    let under = |i: usize| system.track().deflection(&system.wheels.points[i], &rail) + system.wheels.roughness[i];
    let offset: Vec<f64> = (0..axles).map(under).collect();
    if let Some(axle) = offset.iter().position(|under| !under.is_finite()) {
        return Err(format!("the rail under wheel {} is at {} m at t = {t} s", axle + 1, offset[axle]));
    }
    let (weight, load) = (system.fleet.weight(), system.fleet.greatest_load());
    let wheels: Vec<Option<usize>> = (0..axles).map(|axle| system.fleet.wheel(axle)).collect();

    // First point of expansion: every axle under its static load.
    let mut delta: Vec<f64> = system.contacts.laws().iter().map(Law::static_approach).collect();
    let mut forces: Vec<f64> = delta.iter().zip(system.contacts.laws()).map(|(d, law)| law.force(*d).0).collect();
    let mut s: Vec<f64> = (0..axles)
        .map(|i| delta[i] + (0..axles).map(|j| system.compliance[i * axles + j] * forces[j]).sum::<f64>())
        .collect();
    let mut q: Option<Vec<f64>> = None;
    for _ in 0..ITERATIONS {
        // r = w − K q − Bᵀ F, and the tangent; the first time q is unknown and K q is left to the solution.
        let tangent = ContactTangent::new(system, &delta);
        let mut residual = weight.clone();
        wheels
            .iter()
            .zip(&forces)
            .filter_map(|(wheel, force)| Some(((*wheel)?, force)))
            .for_each(|(i, f)| residual[i] -= f);
        match &q {
            None => tangent.each(|i, j, t| {
                if let (Some(row), Some(_)) = (wheels[i], wheels[j]) {
                    residual[row] += t * (s[j] + offset[j]);
                }
            }),
            Some(q) => {
                system.fleet.subtract_stiffness(q, &mut residual);
                let unbalanced = residual.iter().fold(0.0, |most, force| larger(most, force.abs()));
                if unbalanced <= BALANCE * load {
                    write(system, rail, deck, q, &delta, &forces, state);
                    return Ok(());
                }
            }
        }
        let factor = matrix(system, &tangent).factorise();
        let factor = factor.ok_or("the train has no static equilibrium: a car stands on fewer than two axles")?;
        factor.solve(&mut residual);
        let next: Vec<f64> = match q {
            None => residual,
            Some(q) => q.iter().zip(&residual).map(|(q, change)| q + change).collect(),
        };
        s = (0..axles).map(|i| wheels[i].map_or(0.0, |wheel| next[wheel]) - offset[i]).collect();
        let compliance = std::mem::take(&mut system.compliance);
        let contact = system.contacts.solve(&compliance, &s, &mut delta, &mut forces);
        system.compliance = compliance;
        contact.map_err(|error| format!("{error} in static equilibrium"))?;
        q = Some(next);
    }
    Err(format!("static equilibrium of the train was not found in {ITERATIONS} iterations"))
}

/// K_c + Bᵀ T B.
fn matrix(system: &TrainTrackSystem, tangent: &ContactTangent) -> Decaying {
    let fleet = &system.fleet;
    let both = |i: usize, j: usize| fleet.wheel(i).zip(fleet.wheel(j));
    let mut reach = fleet.largest_order().saturating_sub(1);
    tangent.each(|i, j, _| reach = both(i, j).map_or(reach, |(a, b)| reach.max(a.abs_diff(b))));
    let mut matrix = Decaying::zeros(fleet.order(), reach);
    fleet.each_stiffness(|i, j, k| matrix.add(i, j, k));
    tangent.each(|i, j, t| {
        if let Some((row, column)) = both(i, j).filter(|(row, column)| row >= column) {
            matrix.add(row, column, t);
        }
    });
    matrix
}

/// K_t⁻¹ k d.
pub(crate) fn rail_without_wheels(system: &TrainTrackSystem, deck: &[f64]) -> Vec<f64> {
    let mut displacements = deck.to_vec();
    displacements[deck.len() / 2..].fill(0.0);
    let (mut forces, mut u) = (vec![0.0; deck.len() / 2], vec![0.0; system.track().order()]);
    system.track().deck_forces(&displacements, &mut forces);
    system.track().add_deck_forces(&forces, &mut u);
    system.prepared.statics.solve(&mut u);
    u
}

/// u_deck + K_t⁻¹ Nᵀ F.
pub(crate) fn rail_under_wheels(system: &TrainTrackSystem, mut rail: Vec<f64>, forces: &[f64]) -> Vec<f64> {
    let mut pressed = vec![0.0; rail.len()];
    let points = system.wheels.points.iter();
    points.zip(forces).for_each(|(point, force)| system.track().add_force(point, *force, &mut pressed));
    system.prepared.statics.solve(&mut pressed);
    rail.iter_mut().zip(&pressed).for_each(|(u, p)| *u += p);
    rail
}

/// Y of the rail alone at the present wheel positions, by one static solve an axle, over as much of the rail as feels it.
pub(crate) fn static_compliance(system: &mut TrainTrackSystem) {
    let (prepared, points) = (&system.prepared, &system.wheels.points);
    let (track, n) = (&prepared.track, points.len());
    let (mut column, mut reach) = (vec![0.0; track.order()], FIRST_REACH);
    system.compliance.fill(0.0);
    system.coupled_from.fill(0);
    for j in 0..n {
        let nodes = loop {
            let nodes = points[j].element.saturating_sub(reach)..(points[j].element + 2 + reach).min(track.nodes());
            let dofs = dofs_of(track, &nodes);
            track.add_force(&points[j], 1.0, &mut column);
            prepared.statics.solve_range(&mut column, dofs.start, dofs.end);
            if has_decayed(track, &column, &nodes) {
                break nodes;
            }
            column[dofs].fill(0.0);
            reach *= 2;
        };
        for (i, point) in points.iter().enumerate() {
            if nodes.contains(&point.element) && nodes.contains(&(point.element + 1)) {
                system.compliance[i * n + j] = track.deflection(point, &column);
            }
        }
        column[dofs_of(track, &nodes)].fill(0.0);
        system.compliance[j * n + j] += points[j].local_compliance;
    }
}

/// Rail nodes on either side that are tried first; 80 m of usual track.
const FIRST_REACH: usize = 256;

/// The degrees of freedom of some nodes of the rail and of what stands below them.
fn dofs_of(track: &Track, nodes: &Range<usize>) -> Range<usize> {
    let dof = |node: usize| if node < track.nodes() { track.node_dof(node) } else { track.order() };
    dof(nodes.start)..dof(nodes.end)
}

/// Whether nothing is left of a deflection in the outer eighths of a window, unless the rail ends there.
fn has_decayed(track: &Track, column: &[f64], nodes: &Range<usize>) -> bool {
    let eighth = nodes.len() / 8;
    let largest = column[dofs_of(track, nodes)].iter().fold(0.0, |most, u| larger(most, u.abs()));
    let quiet = |part: Range<usize>| column[dofs_of(track, &part)].iter().all(|u| u.abs() <= NEGLIGIBLE * largest);
    (nodes.start == 0 || quiet(nodes.start..nodes.start + eighth))
        && (nodes.end == track.nodes() || quiet(nodes.end - eighth..nodes.end))
}

/// T = S (I + S Y S)⁻¹ S, S = diag F′(δ)^{1/2}, by columns: the first row of each and its entries.
struct ContactTangent(Vec<(usize, Vec<f64>)>);

impl ContactTangent {
    fn new(system: &TrainTrackSystem, delta: &[f64]) -> Self {
        let (n, y) = (delta.len(), &system.compliance);
        let root: Vec<f64> = delta.iter().zip(system.contacts.laws()).map(|(d, law)| law.force(*d).1.sqrt()).collect();
        let last = |j: usize| (j..n).rev().find(|i| y[i * n + j] != 0.0).unwrap_or(j);
        let reach = (0..n).map(|j| last(j) - j).max().unwrap_or(0);
        let mut symmetric = Decaying::zeros(n, reach);
        for j in 0..n {
            (j..n.min(j + reach + 1)).for_each(|i| symmetric.add(i, j, root[i] * y[i * n + j] * root[j]));
            symmetric.add(j, j, 1.0);
        }
        // I plus a positive semidefinite matrix always has a Cholesky factor; without one the state is not finite and the
        // caller's next Cholesky reports it.
        let Some(factor) = symmetric.factorise() else { return Self(vec![(0, vec![f64::NAN; n]); n]) };
        let mut column = vec![0.0; n];
        let columns = (0..n).map(|j| {
            let rows = factor.inverse(j, &mut column);
            let entries = rows.clone().map(|i| root[i] * column[i] * root[j]).collect();
            let first = rows.start;
            column[rows].fill(0.0);
            (first, entries)
        });
        Self(columns.collect())
    }

    /// Every entry: row, column, value, column by column.
    fn each(&self, mut visit: impl FnMut(usize, usize, f64)) {
        for (j, (first, entries)) in self.0.iter().enumerate() {
            entries.iter().enumerate().for_each(|(k, t)| visit(first + k, j, *t));
        }
    }
}

/// The state of rest under the found forces.
fn write(
    system: &TrainTrackSystem,
    rail: Vec<f64>,
    deck: &[f64],
    q: &[f64],
    delta: &[f64],
    forces: &[f64],
    state: &mut State,
) {
    state.cars = Motion { u: q.to_vec(), ..Motion::rest(q.len()) };
    state.track = Motion { u: rail_under_wheels(system, rail, forces), ..Motion::rest(system.track().order()) };
    state.delta.copy_from_slice(delta);
    state.forces.copy_from_slice(forces);
    state.deck.copy_from_slice(deck);
    state.deck[deck.len() / 2..].fill(0.0);
    let State { track, deck, supports, .. } = state;
    system.track().support_forces(track, deck, supports);
}
