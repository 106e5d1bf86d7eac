//! The factor by panels: against products with the matrix, and its partial sweeps against whole ones.

use ttb_sparse::Layout;
use ttb_sparse::sweeps::{LANES, Which};
use ttb_sparse::{Assembly, Pencil};

const LONG: usize = 90;
const WIDE: usize = 13;

/// A lattice of springs on weak ground with three degrees of freedom a node, and a part of it that hangs alone.
fn lattice(last: Vec<u32>, with_places: bool) -> Pencil {
    let nodes = LONG * WIDE;
    let mut assembly = Assembly::new(3 * nodes);
    let place = |a: usize| [(a / WIDE) as f64, (a % WIDE) as f64, 0.0];
    for a in 0..nodes {
        for b in [a + 1, a + WIDE, a + WIDE + 1] {
            let neighbours = b < nodes && place(b)[1] - place(a)[1] < 1.5 && place(b)[1] >= place(a)[1];
            if !neighbours || place(a)[0] == 69.0 && place(b)[0] == 70.0 {
                continue;
            }
            let dofs: Vec<Option<u32>> =
                [a, b].iter().flat_map(|&n| (0..3).map(move |d| Some(3 * n as u32 + d))).collect();
            let k: Vec<[f64; 6]> = (0..6)
                .map(|i| {
                    std::array::from_fn(|j| {
                        if i == j {
                            3.0
                        } else if (i < 3) == (j < 3) {
                            0.4
                        } else {
                            -0.9
                        }
                    })
                })
                .collect();
            let m: Vec<[f64; 6]> = (0..6).map(|i| std::array::from_fn(|j| if i == j { 1.0 } else { 0.1 })).collect();
            assembly.add(&dofs, &k, &m);
        }
    }
    let place = if with_places { (0..nodes).map(place).collect() } else { Vec::new() };
    let layout = Layout { node_of: (0..3 * nodes as u32).map(|i| i / 3).collect(), place, last, order: Vec::new() };
    assembly.finish_with(&layout).unwrap()
}

fn numbers(n: usize) -> Vec<f64> {
    (0..n).map(|i| ((i * 37) % 101) as f64 / 50.0 - 1.0).collect()
}

#[test]
fn a_solve_undoes_a_product_whatever_the_order() {
    for (last, places) in [(vec![], true), (vec![], false), ((0..90).map(|i| 3 * (13 * i + 6)).collect(), true)] {
        let pencil = lattice(last.clone(), places);
        let x = numbers(pencil.ndof());
        let mut y = vec![0.0; x.len()];
        pencil.add_stiffness(&x, &mut y);
        pencil.add_mass(&x, &mut y);
        let factor = pencil.factor(1.0, 1.0, 0.0).unwrap();
        assert!(factor.panels().is_some());
        factor.solve_in_place(&mut y, &mut vec![0.0; x.len()]);
        let error = x.iter().zip(&y).map(|(x, y)| (x - y).abs()).fold(0.0, f64::max);
        assert!(error < 1e-11, "{error}");
        let order = pencil.order().unwrap();
        let mut seen = vec![false; order.len()];
        order.iter().for_each(|&dof| assert!(!std::mem::replace(&mut seen[dof as usize], true)));
    }
}

#[test]
fn sweeps_over_the_reach_are_those_over_everything() {
    let dofs: Vec<u32> = (0..90).map(|i| 3 * (13 * i + 6)).collect();
    for last in [vec![], dofs.clone()] {
        let pencil = lattice(last, true);
        let factor = pencil.factor(1.0, 0.0, 0.0).unwrap();
        let (pattern, values) = factor.panels().unwrap();
        let reach = pattern.reach(dofs.iter().copied());
        assert!(reach.len() < pattern.panels());
        let (mut whole, mut buffer) = (vec![0.0; pencil.ndof()], Vec::new());
        dofs.iter().for_each(|&dof| whole[pattern.position[dof as usize] as usize] = 1.0 + f64::from(dof));
        let mut part = whole.clone();
        pattern.forward(values, &mut whole, &mut buffer, Which::All);
        pattern.forward(values, &mut part, &mut buffer, Which::Some(&reach));
        assert_eq!(whole, part);
        pattern.backward(values, &mut whole, &mut buffer, Which::All);
        pattern.backward(values, &mut part, &mut buffer, Which::Some(&reach));
        for &dof in &dofs {
            let at = pattern.position[dof as usize] as usize;
            assert_eq!(whole[at], part[at]);
        }
    }
}

#[test]
fn right_hand_sides_in_lockstep_give_what_they_give_alone() {
    let pencil = lattice(vec![], true);
    let factor = pencil.factor(1.0, 2.0, 0.0).unwrap();
    let (pattern, values) = factor.panels().unwrap();
    let n = pencil.ndof();
    let one = |lane: usize| -> Vec<f64> { numbers(n + lane)[lane..].to_vec() };
    let mut many: Vec<f64> =
        (0..n).flat_map(|i| (0..LANES).map(move |lane| (i, lane))).map(|(i, lane)| one(lane)[i]).collect();
    let mut buffer = Vec::new();
    pattern.forward_many(values, &mut many, &mut buffer, Which::All);
    pattern.backward_many(values, &mut many, &mut buffer, Which::All);
    for lane in 0..LANES {
        let mut y = one(lane);
        pattern.forward(values, &mut y, &mut buffer, Which::All);
        pattern.backward(values, &mut y, &mut buffer, Which::All);
        let error = y.iter().enumerate().map(|(i, y)| (y - many[i * LANES + lane]).abs()).fold(0.0, f64::max);
        assert!(error < 1e-12, "{error}");
    }
}

#[test]
fn modes_of_a_large_model_are_modes_and_none_is_missing() {
    let pencil = lattice(vec![], true);
    let factor = pencil.factor(1.0, 0.0, 0.0).unwrap();
    // `lowest` itself compares with the count of negative pivots.
    let modes = ttb_sparse::modes::lowest(&pencil, &factor, 5).unwrap();
    for (w2, shape) in modes.omega2.iter().zip(&modes.shapes) {
        let (mut residual, mut mass) = (vec![0.0; shape.len()], vec![0.0; shape.len()]);
        pencil.add_stiffness(shape, &mut residual);
        pencil.add_mass(shape, &mut mass);
        let size = residual.iter().fold(0.0_f64, |m, r| m.max(r.abs()));
        let error = residual.iter().zip(&mass).map(|(r, m)| (r - w2 * m).abs()).fold(0.0, f64::max);
        assert!(error < 1e-8 * size, "{error} of {size}");
    }
    assert_eq!(pencil.count_below(modes.omega2[0] * 0.999), Some(0));
}
