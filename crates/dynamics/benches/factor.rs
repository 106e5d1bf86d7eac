//! Sparse factor of a strip of shell-like elements against the memory's bandwidth.
//!
//!     cargo bench -p ttb-dynamics --bench factor [-- LENGTH WIDTH]
use faer::sparse::{SparseColMatRef, SymbolicSparseColMat};
use std::time::Instant;
use ttb_dynamics::order::{Graph, nested_dissection, postordered};
use ttb_dynamics::supernodal::Pattern;
use ttb_dynamics::sweeps::Which;

fn main() {
    let numbers: Vec<usize> = std::env::args().skip(1).filter_map(|a| a.parse().ok()).collect();
    let (length, width) = (numbers.first().copied().unwrap_or(565), numbers.get(1).copied().unwrap_or(36));
    let nodes = length * width;
    let n = 6 * nodes;
    let t = Instant::now();
    // column structure: neighbours (dx,dy) in -1..=1
    let (mut starts, mut rows, mut values) = (vec![0u32], vec![], vec![]);
    for i in 0..length {
        for j in 0..width {
            for d in 0..6 {
                let me = 6 * (i * width + j) + d;
                let mut column = vec![];
                for di in -1i64..=1 {
                    for dj in -1i64..=1 {
                        let (a, b) = (i as i64 + di, j as i64 + dj);
                        if a < 0 || b < 0 || a >= length as i64 || b >= width as i64 {
                            continue;
                        }
                        for e in 0..6 {
                            let other = 6 * (a as usize * width + b as usize) + e;
                            if other >= me {
                                column.push(other as u32)
                            }
                        }
                    }
                }
                column.sort();
                for r in column {
                    rows.push(r);
                    values.push(if r as usize == me { 60.0 } else { -1.0 })
                }
                starts.push(rows.len() as u32);
            }
        }
    }
    let node_of: Vec<u32> = (0..n as u32).map(|i| i / 6).collect();
    let place: Vec<[f64; 3]> = (0..nodes).map(|a| [(a / width) as f64, (a % width) as f64, 0.0]).collect();
    println!("n {n} entries {} build {:?}", rows.len(), t.elapsed());
    let t = Instant::now();
    let graph = Graph::new(&starts, &rows, &node_of);
    println!("graph {:?}", t.elapsed());
    {
        // AMD on node graph
        let (mut gs, mut gr) = (vec![0u32], vec![]);
        for a in 0..nodes as u32 {
            gr.push(a);
            let mut v: Vec<u32> = (0..9)
                .filter_map(|k| {
                    let (di, dj) = (k as i64 / 3 - 1, k as i64 % 3 - 1);
                    let (i, j) = ((a as usize / width) as i64 + di, (a as usize % width) as i64 + dj);
                    (i >= 0 && j >= 0 && i < length as i64 && j < width as i64)
                        .then(|| (i as usize * width + j as usize) as u32)
                })
                .filter(|b| *b > a)
                .collect();
            v.sort();
            gr.extend(v);
            gs.push(gr.len() as u32);
        }
        let g = SymbolicSparseColMat::new_checked(nodes, nodes, gs, None, gr);
        let c = faer::sparse::linalg::cholesky::factorize_symbolic_cholesky(
            g.as_ref(),
            faer::Side::Lower,
            faer::sparse::linalg::cholesky::SymmetricOrdering::Amd,
            Default::default(),
        )
        .unwrap();
        let order: Vec<u32> = c.perm().unwrap().arrays().0.to_vec();
        let order: Vec<u32> = order.iter().flat_map(|a| (0..6).map(move |d| 6 * a + d)).collect();
        let order = postordered(&starts, &rows, &order);
        let pattern = SymbolicSparseColMat::new_checked(n, n, starts.clone(), None, rows.clone());
        let p = Pattern::new(pattern.as_ref(), order).unwrap();
        println!("node AMD: {:.2} M entries, {} panels", p.all_entries() as f64 / 1e6, p.panels());
    }
    for (name, place, last) in [("geometric", &place, false), ("geometric, middle last", &place, true)] {
        let t = Instant::now();
        let order = nested_dissection(&graph, place);
        println!("{name}: dissection {:?}", t.elapsed());
        let is_last = |dof: u32| last && (dof / 6) as usize % width == width / 2 && dof % 6 == 2;
        let t = Instant::now();
        let all = || order.iter().flat_map(|a| (0..6).map(move |d| 6 * a + d));
        let order: Vec<u32> = all().filter(|d| !is_last(*d)).chain(all().filter(|d| is_last(*d))).collect();
        let order = postordered(&starts, &rows, &order);
        println!("postorder {:?}", t.elapsed());
        let t = Instant::now();
        let pattern = SymbolicSparseColMat::new_checked(n, n, starts.clone(), None, rows.clone());
        let p = Pattern::new(pattern.as_ref(), order).unwrap();
        if std::env::var("SHORT").is_ok() {
            println!("{:.2} M entries {} panels", p.all_entries() as f64 / 1e6, p.panels());
            continue;
        }
        println!("symbolic {:?}: {:.2} M entries, {} panels", t.elapsed(), p.all_entries() as f64 / 1e6, p.panels());
        let a = SparseColMatRef::new(pattern.as_ref(), &values);
        let t = Instant::now();
        let f = p.factorise(a, 1e-13).unwrap();
        println!("numeric {:?}", t.elapsed());
        let reach = p.reach((0..n as u32).filter(|d| (d / 6) as usize % width == width / 2 && d % 6 == 2));
        println!("reach of the middle: {} panels, {:.2} M entries", reach.len(), p.entries(&reach) as f64 / 1e6);
        let mut buffer = vec![];
        let mut y = vec![1.0; n];
        let (mut bf, mut bb) = (f64::MAX, f64::MAX);
        for _ in 0..20 {
            let t = Instant::now();
            p.forward(&f, &mut y, &mut buffer, Which::All);
            bf = bf.min(t.elapsed().as_secs_f64());
            let t = Instant::now();
            p.backward(&f, &mut y, &mut buffer, Which::All);
            bb = bb.min(t.elapsed().as_secs_f64());
        }
        println!("forward {:.2} ms backward {:.2} ms", bf * 1e3, bb * 1e3);
        let big: Vec<f64> = vec![1.0; p.all_entries()];
        let mut best = f64::MAX;
        let mut total = 0.0;
        for _ in 0..10 {
            let t = Instant::now();
            total += big
                .chunks_exact(16)
                .fold([0.0; 16], |mut s, c| {
                    (0..16).for_each(|k| s[k] += c[k]);
                    s
                })
                .iter()
                .sum::<f64>();
            best = best.min(t.elapsed().as_secs_f64());
        }
        println!("stream once {:.2} ms ({:.1} GB/s) {total}", best * 1e3, p.all_entries() as f64 * 8e-9 / best);
    }
}
