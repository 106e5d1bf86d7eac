use faer::dyn_stack::*; use faer::sparse::*; use faer::sparse::linalg::cholesky::*; use faer::*;
use ttb_dynamics::{beam::Beam, sparse::Assembly};
use std::time::Instant;
fn main() {
    let n = 50usize; let l = 0.65;
    let beam = Beam { bending_stiffness: 3.45e10*12.744, mass: 29720.0, shear_stiffness: None, rotary_inertia: 0.0 };
    let (k, m) = (beam.stiffness(l), beam.mass_matrix(l));
    let mut asm = Assembly::new(2*n+2); let mut tr = vec![];
    for e in 0..n { let d: Vec<Option<u32>> = (0..4).map(|i| Some((2*e+i) as u32)).collect(); asm.add(&d, &k, &m);
      for i in 0..4 { for j in 0..=i { tr.push(sparse::Triplet::new((2*e+i) as u32,(2*e+j) as u32, k[i][j]+4e6*m[i][j])); } } }
    let own = asm.finish().unwrap().factor(1.0, 4e6).unwrap();
    let a = SparseColMat::<u32,f64>::try_new_from_triplets(2*n+2,2*n+2,&tr).unwrap();
    let sym = factorize_symbolic_cholesky(a.symbolic(), Side::Lower, SymmetricOrdering::Amd, CholeskySymbolicParams::default()).unwrap();
    let mut v = vec![0.0; sym.len_val()];
    let mut mem = MemBuffer::new(sym.factorize_numeric_llt_scratch::<f64>(Par::Seq, Default::default()));
    sym.factorize_numeric_llt(&mut v, a.as_ref(), Side::Lower, Default::default(), Par::Seq, MemStack::new(&mut mem), Default::default()).unwrap();
    let mut x = vec![1.0; 2*n+2]; let mut s = x.clone();
    let mut mem = MemBuffer::new(sym.solve_in_place_scratch::<f64>(1, Par::Seq));
    for _ in 0..3 {
    let t = Instant::now();
    for _ in 0..100000 { own.solve_in_place(&mut x, &mut s); x[3] += 1.0; }
    println!("own {:?}", t.elapsed()/100000);
    let t = Instant::now();
    for _ in 0..100000 { LltRef::new(&sym, &v).solve_in_place_with_conj(Conj::No, MatMut::from_column_major_slice_mut(&mut x, 2*n+2, 1), Par::Seq, MemStack::new(&mut mem)); x[3] += 1.0; }
    println!("faer {:?}", t.elapsed()/100000);
    }
}
