//! Matrices from files that were written with few digits: by how much results are off, against what is said.

use std::fmt::Write;
use std::path::Path;

use ttb_bridge::Prepared;
use ttb_bridge::inspect::{Report, inspect};
use ttb_scenario::spec::{BridgeSpec, StructureSpec};
use ttb_scenario::types::{Damping, Newmark};

const ELEMENTS: usize = 50;
const LENGTH: f64 = 32.5;
const STIFFNESS: f64 = 4.39668e11;
const MASS: f64 = 29720.0;

/// K and M of a simply supported beam, lower triangles as triplets: rows 2i of deflections and 2i + 1 of rotations, those of
/// both bearings held, without any entry.
fn write(folder: &Path, digits: usize) -> BridgeSpec {
    let l = LENGTH / ELEMENTS as f64;
    let k = [[12.0, 6.0 * l, -12.0, 6.0 * l], [6.0 * l, 4.0 * l * l, -6.0 * l, 2.0 * l * l]];
    let k = [k[0], k[1], [-12.0, -6.0 * l, 12.0, -6.0 * l], [6.0 * l, 2.0 * l * l, -6.0 * l, 4.0 * l * l]];
    let m = [[156.0, 22.0 * l, 54.0, -13.0 * l], [22.0 * l, 4.0 * l * l, 13.0 * l, -3.0 * l * l]];
    let m = [m[0], m[1], [54.0, 13.0 * l, 156.0, -22.0 * l], [-13.0 * l, -3.0 * l * l, -22.0 * l, 4.0 * l * l]];
    let n = 2 * (ELEMENTS + 1);
    for (name, element, factor) in [("K", k, STIFFNESS / l.powi(3)), ("M", m, MASS * l / 420.0)] {
        let mut all = vec![vec![0.0; n]; n];
        for e in 0..ELEMENTS {
            for (i, j) in (0..4).flat_map(|i| (0..4).map(move |j| (i, j))) {
                all[2 * e + i][2 * e + j] += factor * element[i][j];
            }
        }
        let held = |i: usize| i == 0 || i == n - 2;
        let mut text = String::new();
        for (i, j) in (0..n).flat_map(|i| (0..=i).map(move |j| (i, j))) {
            if all[i][j] != 0.0 && !held(i) && !held(j) {
                writeln!(text, "{} {} {:.*e}", i + 1, j + 1, digits - 1, all[i][j]).unwrap();
            }
        }
        std::fs::write(folder.join(name), text).unwrap();
    }
    let mut supports = "x;row\n".to_owned();
    for i in 0..=ELEMENTS {
        writeln!(supports, "{};{}", (l * i as f64).to_string().replace('.', ","), 2 * i + 1).unwrap();
    }
    std::fs::write(folder.join("S.csv"), supports).unwrap();
    let files = ttb_import::Files {
        stiffness: "K".into(),
        mass: "M".into(),
        supports: "S.csv".into(),
        ..ttb_import::Files::default()
    };
    BridgeSpec {
        structure: StructureSpec::Matrices { files, folder: folder.to_owned(), length: LENGTH },
        damping: Damping::None,
        modes: None,
        reduction: None,
        supports: (1..ELEMENTS).map(|i| l * i as f64).collect(),
        points: Vec::new(),
        step: 1e-3,
        end: 1.0,
        newmark: Newmark::default(),
        space: false,
        ground: None,
        ground_points: Vec::new(),
    }
}

fn looked_at(digits: usize) -> (Report, Vec<String>) {
    let folder = tempfile::tempdir().unwrap();
    let spec = write(folder.path(), digits);
    let report = inspect(&spec).unwrap_or_else(|error| panic!("{digits} digits: {error}"));
    (report, Prepared::new(&spec).unwrap().remarks().to_vec())
}

/// n₀ = π/2 √(EI/m)/L², the held rows of both bearings without any part in it.
#[test]
fn the_size_of_the_error_by_few_digits_is_told() {
    let exact = std::f64::consts::FRAC_PI_2 * (STIFFNESS / MASS).sqrt() / LENGTH.powi(2);
    let off = |report: &Report| (report.frequencies.as_ref().unwrap()[0] / exact - 1.0).abs();
    let (full, remarks) = looked_at(17);
    assert!(off(&full) < 1e-6 && full.digits.is_none() && remarks.is_empty(), "{remarks:?}");
    for digits in [7, 8, 9, 10, 11] {
        let (report, remarks) = looked_at(digits);
        let told = report.digits.unwrap();
        assert_eq!(told.digits as usize, digits);
        // Twice the standard deviation of what half a unit of the last digit does, halved for the frequency.
        assert!((0.2..5.0).contains(&(told.error * 10_f64.powi(digits as i32) / 5.16e6)), "{told:?}");
        assert!(off(&report) < 0.5 * told.error + 1e-6, "{digits} digits: {} and {told:?}", off(&report));
        assert_eq!(remarks.len(), usize::from(digits < 10), "{remarks:?}");
        let text = report.to_string();
        assert_eq!(
            text.contains("with 9 digits, and the last of them moves displacements by about"),
            digits == 9,
            "{text}"
        );
    }
}

#[test]
fn held_rows_are_counted_and_the_mass_without_directions_is_unknown() {
    let (report, _) = looked_at(17);
    assert_eq!((report.mass, report.files.as_ref().unwrap().held.as_slice()), (None, &[0, 100][..]));
    let text = report.to_string();
    assert!(text.contains("mass                 unknown: no file `dofs` says which rows are translations"), "{text}");
    assert!(text.contains("rows that are held   2, without any entry, the first of them 1"), "{text}");
}
