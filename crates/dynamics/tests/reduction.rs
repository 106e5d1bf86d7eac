//! Reduced models against what they reduce.

use ttb_dynamics::reduction::{Answers, Basis, Shifted, reduce};
use ttb_sparse::Layout;
use ttb_sparse::blocks::solve;
use ttb_sparse::excited::Excited;
use ttb_sparse::modes::lowest;
use ttb_sparse::{Assembly, Pencil};

/// A strip of springs on soft ground, two degrees of freedom a node.
fn strip(long: usize) -> Pencil {
    let mut assembly = Assembly::new(2 * 3 * long);
    for x in 0..long {
        for y in 0..3 {
            let node = 3 * x + y;
            let ground = 1e-3 * (1.0 + 0.1 * y as f64);
            let dofs: Vec<Option<u32>> = (0..2).map(|d| Some((2 * node + d) as u32)).collect();
            assembly.add(&dofs, &[[ground, 0.0], [0.0, 1.3 * ground]], &[[1.0, 0.0], [0.0, 0.7]]);
            for (other, k) in [((x + 1 < long), 1.0), ((y < 2), 0.6)]
                .iter()
                .zip([3, 1])
                .filter(|(a, _)| a.0)
                .map(|(a, d)| (node + d, a.1))
            {
                for d in 0..2 {
                    let dofs = [Some((2 * node + d) as u32), Some((2 * other + d) as u32)];
                    assembly.add(&dofs, &[[k, -k], [-k, k]], &[[0.2, 0.1], [0.1, 0.2]]);
                }
            }
        }
    }
    let n = 6 * long as u32;
    assembly.finish_with(&Layout { node_of: (0..n).map(|i| i / 2).collect(), ..Layout::default() }).unwrap()
}

/// Loads in the first direction at every fourth node of the middle line, and one row that only sees.
fn rows(long: usize) -> Vec<Vec<(u32, f64)>> {
    let mut rows: Vec<Vec<(u32, f64)>> =
        (0..long / 4).map(|i| vec![(6 * 4 * i as u32 + 2, 0.8), (6 * 4 * i as u32, 0.2)]).collect();
    rows.push(vec![(6 * long as u32 - 2, 1.0)]);
    rows
}

const C: [f64; 2] = [1.1, 0.4];

fn basis(long: usize, highest: f64) -> (Pencil, Basis) {
    let pencil = strip(long);
    let (stiffness, step) = (pencil.factor(1.0, 0.0, 0.0).unwrap(), pencil.factor(C[0], C[1], 0.0).unwrap());
    let rows = rows(long);
    let mut excited = Excited::new(&pencil, &stiffness, &rows[..long / 4]);
    let ritz = excited.modes(highest, 2000).modes;
    let mut answers = Answers::default();
    answers.add(&pencil, Shifted { factor: &stiffness, stiffness: 1.0, mass: 0.0 }, &rows, long / 4);
    answers.add(&pencil, Shifted { factor: &step, stiffness: C[0], mass: C[1] }, &rows, long / 4);
    let basis = reduce(&answers, &excited, &ritz, &rows, 0.0);
    (pencil, basis)
}

/// Greatest difference of R (c_K K + c_M M)⁻¹ Bᵀ, relative to its greatest entry.
fn compliance_error(long: usize, pencil: &Pencil, basis: &Basis, [c_k, c_m]: [f64; 2]) -> f64 {
    let (rows, n) = (rows(long), pencil.ndof());
    let mut z = vec![0.0; n * (long / 4)];
    for (column, row) in z.chunks_exact_mut(n).zip(&rows) {
        row.iter().for_each(|(dof, w)| column[*dof as usize] += w);
    }
    solve(&pencil.factor(c_k, c_m, 0.0).unwrap(), &mut z);
    let (mut worst, mut largest) = (0.0_f64, 0.0_f64);
    for (j, z) in z.chunks_exact(n).enumerate() {
        for (i, row) in rows.iter().enumerate() {
            let exact: f64 = row.iter().map(|(dof, w)| w * z[*dof as usize]).sum();
            let terms = basis.omega2.iter().enumerate().map(|(k, w2)| (basis.shapes.row(k), w2));
            let reduced: f64 = terms.map(|(shape, w2)| shape[i] * shape[j] / (c_k * w2 + c_m)).sum();
            worst = worst.max((exact - reduced).abs());
            largest = largest.max(exact.abs());
        }
    }
    worst / largest
}

#[test]
fn static_loads_and_single_steps_are_answered_exactly() {
    for long in [60, 600] {
        let (pencil, basis) = basis(long, 0.12);
        assert!(basis.modes > 3 && basis.omega2.len() < pencil.ndof());
        let errors = [[1.0, 0.0], C, [1.0, 0.05]].map(|c| compliance_error(long, &pencil, &basis, c));
        assert!(errors[0] < 1e-9 && errors[1] < 1e-9, "{errors:?}");
        // In between it is the better the more modes there are.
        let (_, better) = self::basis(long, 0.5);
        let better = compliance_error(long, &pencil, &better, [1.0, 0.05]);
        assert!(errors[2] < 5e-3 && better < 0.5 * errors[2], "{errors:?} {better}");
    }
}

#[test]
fn the_modes_are_those_of_the_model_that_the_loads_excite() {
    let long = 60;
    let (pencil, basis) = basis(long, 0.3);
    let all = lowest(&pencil, &pencil.factor(1.0, 0.0, 0.0).unwrap(), 80).unwrap();
    // The loads act in the first direction alone: modes of the second are not among them.
    let excited = all
        .omega2
        .iter()
        .zip(&all.shapes)
        .filter(|(w2, shape)| **w2 <= 0.09 && shape.iter().step_by(2).any(|u| u.abs() > 1e-6));
    let excited: Vec<f64> = excited.map(|(w2, _)| *w2).collect();
    assert_eq!(excited.len(), basis.modes);
    for (a, b) in excited.iter().zip(&basis.omega2) {
        assert!((a / b - 1.0).abs() < 1e-9, "{a} {b}");
    }
}
