//! Small files of every format, by hand, against the matrix that they mean.

use ttb_import::{Dof, Format, Input, Matrix, SymmetricMatrix, read_matrix};

/// 4 −1 0; −1 5 −2.5; 0 −2.5 6.
fn expected() -> SymmetricMatrix {
    let (starts, rows) = (vec![0, 2, 4, 5], vec![0, 1, 1, 2, 2]);
    SymmetricMatrix { n: 3, starts, rows, values: vec![4.0, -1.0, 5.0, -2.5, 6.0] }
}

fn read(name: &str, text: &str) -> Matrix {
    read_matrix(&Input::bytes(name, text.as_bytes()), None, None, None).unwrap_or_else(|problems| panic!("{problems}"))
}

const LOWER: &str = "%%MatrixMarket matrix coordinate real symmetric\n% remark\n\n3 3 5\n\
    1 1 4\n2 1 -1e0\n2 2 5.0\n3 2 -2.5\n3 3 6\n";
const HARWELL: &str = "title\n     6     1     1     4     0\nRSA     3     3     5     0\n\
    (4I3)  (5I2)  (2E10.2)\n  1  3  5  6\n 1 2 2 3 3\n  4.00E+00 -1.00E+00\n  5.00D+00 -2.50+000\n  6.00E+00\n";

#[test]
fn matrix_market_is_read_from_either_triangle_or_in_full() {
    let lower = read("k.mtx", LOWER);
    assert_eq!(lower.facts.format, Format::MatrixMarket);
    assert_eq!((lower.facts.entries, lower.facts.asymmetry), (5, 0.0));
    let upper = "%%MatrixMarket MATRIX Coordinate Integer Symmetric\n3 3 6\n3 3 6\n2 3 -2\n1 2 -1\n1 3 0\n2 2 5\n1 1 4";
    let mut integers = expected();
    integers.values[3] = -2.0;
    assert_eq!(read("k.mtx", upper).matrix, integers);
    let full = "%%MatrixMarket matrix coordinate real general\n3 3 7\n\
        1 1 4\n2 1 -1\n1 2 -1\n2 2 5\n3 2 -2.5000000000001\n2 3 -2.5\n3 3 6\n";
    let full = read("k.mtx", full);
    assert!((full.matrix.values[3] + 2.500_000_000_000_05).abs() < 1e-15);
    let relative = 1e-13 / 30.0_f64.sqrt();
    assert!((full.facts.asymmetry / relative - 1.0).abs() < 1e-2);
    assert_eq!(lower.matrix, expected());
}

#[test]
fn what_scipy_writes_is_read() {
    // scipy.io.mmwrite of SciPy 1.17: symmetry="AUTO" with precision=17, and "general" with comment="K".
    let auto = "%%MatrixMarket matrix coordinate real symmetric\n%\n3 3 5\n1 1 4.0000000000000000e+00\n\
        2 1 -1.0000000000000000e+00\n2 2 5.0000000000000000e+00\n3 2 -2.5000000000000000e+00\n\
        3 3 6.0000000000000000e+00\n";
    let general = "%%MatrixMarket matrix coordinate real general\n%K\n3 3 7\n1 1 4\n2 1 -1\n1 2 -1\n2 2 5\n\
        3 2 -2.5\n2 3 -2.5\n3 3 6\n";
    assert_eq!(read("k.mtx", auto).matrix, expected());
    assert_eq!(read("k.mtx", general).matrix, expected());
}

#[test]
fn duplicates_are_summed_in_any_order() {
    let text = "3 3 2\n2 3 -2.5\n1 1 1\n3 3 4\n2 1 -1\n1 1 3\n2 2 5\n";
    assert_eq!(read("k.sti", text).matrix, expected());
}

#[test]
fn triplets_are_read_from_one_triangle_or_both() {
    let calculix = "1 1  4.0e+00\r\n1 2 -1.0e+00\r\n2 2  5.0e+00\r\n2 3 -2.5e+00\r\n3 3  6.0e+00\r\n";
    assert_eq!(read("k.sti", calculix).matrix, expected());
    let abaqus = "1, 1, 4.\n1,2,-1.\n2,1,-1.\n2,2,5.\n 3, 2, -2.5\n2,3,-2.5\n3,3,6.";
    let abaqus = read("k_STIF1.mtx", abaqus);
    assert_eq!((abaqus.matrix, abaqus.facts.format), (expected(), Format::Triplets));
}

#[test]
fn labels_order_themselves_by_node_and_freedom() {
    let text =
        "** a remark\n*MATRIX INPUT\n30,1, 30,1, 6.\n2,6, 30,1, -2.5\n2,2, 2,2, 4.\n2,6, 2,6, 5.\n2,6, 2,2, -1.\n";
    let labels = read("k.mtx", text);
    assert_eq!(labels.matrix, expected());
    let dofs = [(2, 1), (2, 5), (30, 0)].map(|(node, freedom)| Dof { node, freedom });
    assert_eq!(labels.labels.as_deref(), Some(&dofs[..]));
    // In the order of another file.
    let mut other = dofs;
    other.reverse();
    let read = read_matrix(&Input::bytes("k", text.as_bytes()), None, Some(3), Some(&other)).unwrap();
    assert_eq!(read.matrix.diagonal(), [6.0, 5.0, 4.0]);
}

#[test]
fn internal_nodes_come_last() {
    let read = read("k.mtx", "-1,1, -1,1, 6\n5,2, -1,1, -2.5\n5,1, 5,1, 4\n5,2, 5,2, 5\n5,1, 5,2, -1\n");
    assert_eq!(read.matrix, expected());
    assert_eq!(read.labels.unwrap()[2].to_string(), "internal node 1, x");
}

#[test]
fn harwell_boeing_is_read_by_its_format_cards() {
    let symmetric = read("file.matrix", HARWELL);
    assert_eq!(symmetric.facts.format, Format::HarwellBoeing);
    assert_eq!(symmetric.matrix, expected());
    let full = "title\n     6     1     1     4     1\nRUA     3     3     7     0\n\
        (4I3)  (7I2)  (1P,2D10.2)  (E9.2)\nF   1   0\n  1  3  6  8\n 1 2 1 2 3 2 3\n\
        \x20 4.00D+00 -1.00D+00\n -1.00D+00  5.00D+00\n -2.50D+00 -2.50D+00\n  6.00D+00\n 1.00E+00\n";
    assert_eq!(read("file.matrix", full).matrix, expected());
}

#[test]
fn a_product_uses_both_triangles() {
    let product = read("k.mtx", LOWER).matrix.product(&[1.0, 2.0, -1.0]);
    assert_eq!(product, [2.0, 11.5, -11.0]);
}

#[test]
fn a_random_matrix_survives_every_format() {
    let n = 57_u32;
    let mut state = 1_u64;
    let mut random = move || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as f64 / f64::from(1_u32 << 31)
    };
    let (mut starts, mut rows, mut values) = (vec![0], Vec::new(), Vec::new());
    for j in 0..n {
        for i in j..n {
            if i == j || random() < 0.2 {
                rows.push(i);
                values.push((random() - 0.3) * 10_f64.powf(40.0 * random() - 20.0));
            }
        }
        starts.push(rows.len());
    }
    let matrix = SymmetricMatrix { n: n as usize, starts, rows, values };
    let all: Vec<_> = (0..matrix.n).flat_map(|j| matrix.column(j).map(move |(i, value)| (i, j, value))).collect();
    let write = |line: fn((usize, usize, f64)) -> String| all.iter().copied().map(line).collect::<Vec<_>>();

    let lower = write(|(i, j, v)| format!("{} {} {v:e}\n", i + 1, j + 1)).concat();
    let header = format!("%%MatrixMarket matrix coordinate real symmetric\n{n} {n} {}\n", matrix.entries());
    assert_eq!(read("k.mtx", &(header + &lower)).matrix, matrix);
    let mut full = write(|(i, j, v)| {
        let upper = if i == j { String::new() } else { format!("{} {} {v:e}\n", j + 1, i + 1) };
        format!("{} {} {v:e}\n{upper}", i + 1, j + 1)
    });
    full.reverse();
    assert_eq!(read("k.sti", &full.concat()).matrix, matrix);
    let labels = write(|(i, j, v)| format!("{},{},{},{},{v:.17e}\n", j / 3 + 1, j % 3 + 1, i / 3 + 1, i % 3 + 1));
    assert_eq!(read("k.txt", &labels.concat()).matrix, matrix);

    let pointers: String = matrix.starts.iter().map(|start| format!("{:14}\n", start + 1)).collect();
    let rows: String = matrix.rows.iter().map(|row| format!("{:14}\n", row + 1)).collect();
    let values: String = matrix.values.iter().map(|value| format!("{value:28.17e}\n")).collect();
    let e = matrix.entries();
    let head = format!("t\n{} {} {e} {e} 0\nRSA {n} {n} {e} 0\n(1I14) (1I14) (1E28.17)\n", n + 1 + 2 * e as u32, n + 1);
    assert_eq!(read("k.matrix", &(head + &pointers + &rows + &values)).matrix, matrix);
}

#[test]
fn arrays_of_matrix_market_are_read() {
    // scipy.io.mmwrite of a NumPy array, general and symmetric.
    let general =
        "%%MatrixMarket matrix array real general\n%\n3 3\n4.0000000000000000e+00\n-1\n0\n-1\n5\n-2.5\n0\n-2.5\n6\n";
    let symmetric = "%%MatrixMarket matrix array real symmetric\n3 3\n4\n-1\n0\n5\n-2.5\n6\n";
    for text in [general, symmetric, &general.replace('\n', "\r\n"), &format!("\u{feff}{general}")] {
        assert_eq!(read("k.mtx", text).matrix, expected());
    }
}

#[test]
fn harwell_boeing_with_other_widths_than_announced_is_read_by_its_blanks() {
    // scipy.io.hb_write of SciPy 1.17 announces (3E25.16) and writes 24 characters a field.
    let text = "Default title                                                           KEY     \n\
        \x20            5             1             1             3\n\
        RUA                        3             3             7             0\n\
        (4I3)           (7I2)           (3E25.16)           \n  1  3  6  8\n 1 2 1 2 3 2 3\n\
        \x20 4.0000000000000000E+00 -1.0000000000000000E+00 -1.0000000000000000E+00\n\
        \x20 5.0000000000000000E+00 -2.5000000000000000E+00 -2.5000000000000000E+00\n\
        \x20 6.0000000000000000E+00\n";
    assert_eq!(read("k.hb", text).matrix, expected());
}

#[test]
fn dmig_is_read_from_a_punch_with_several_matrices() {
    // As EXTSEOUT(STIFFNESS,MASS,DMIGPCH) punches it: the value touches the component.
    let column =
        |name: &str, rows: &str| format!("DMIG*   {name}                                   1               5\n{rows}");
    let k = "DMIG    KAAX           0       6       2       0                       0\n".to_owned()
        + &column(
            "KAAX",
            "*                                      1               5 4.000000000D+00\n\
                           *                                      2               3-1.000000000D+00\n",
        )
        + &column(
            "KAAX",
            "*                                      2               3 5.000000000D+00\n\
                           *                                      2               5-2.500000000D+00\n",
        )
        .replace("               1               5\n", "               2               3\n")
        + &column("KAAX", "*                                      2               5 6.000000000D+00\n")
            .replace("               1               5\n", "               2               5\n");
    let m = "DMIG    MAAX           0       6       2       0                       0\n".to_owned()
        + &column("MAAX", "*                                      1               5 7.000000000D+00\n");
    let text = format!("$TITLE = BRIDGE\nGRID           1       0     0.0     0.0     0.0\n{k}{m}");
    let labels = [(1, 4), (2, 2), (2, 4)].map(|(node, freedom)| Dof { node, freedom });
    let read = |letter, size, labels: Option<&[Dof]>| {
        read_matrix(&Input::bytes("a.pch", text.as_bytes()).of(letter), None, size, labels).unwrap()
    };
    let stiffness = read('K', None, None);
    assert_eq!((stiffness.facts.format, stiffness.labels.as_deref()), (Format::Dmig, Some(&labels[..])));
    assert_eq!(stiffness.matrix, expected());
    assert_eq!(read('M', Some(3), Some(&labels)).matrix.diagonal(), [7.0, 0.0, 0.0]);
}

#[test]
fn what_octave_and_matlab_save_as_text_is_read() {
    // Octave: save -text K.txt K of a sparse matrix. Matlab: [i j v] saved with -ascii.
    let octave = "# Created by Octave 8.4.0, Mon Jan 01 00:00:00 2024 UTC <u@h>\n# name: K\n# type: sparse matrix\n\
        # nnz: 7\n# rows: 3\n# columns: 3\n1 1 4\n2 1 -1\n1 2 -1\n2 2 5\n3 2 -2.5\n2 3 -2.5\n3 3 6\n\n\n";
    let matlab = "   1.0000000e+00   1.0000000e+00   4.0000000e+00\r\n   2.0000000e+00   1.0000000e+00  -1.0000000e+00\r\n\
        \x20  2.0000000e+00   2.0000000e+00   5.0000000e+00\r\n   3.0000000e+00   2.0000000e+00  -2.5000000e+00\r\n\
        \x20  3.0000000e+00   3.0000000e+00   6.0000000e+00\r\n";
    assert_eq!(read("K.txt", octave).matrix, expected());
    assert_eq!(read("K.txt", matlab).matrix, expected());
}
