//! Broken matrix files and what is said of them.

use ttb_import::{Format, Input, read_matrix};

fn refusal(name: &str, bytes: &[u8], format: Option<Format>) -> String {
    match read_matrix(&Input::bytes(name, bytes), format, None, None) {
        Ok(read) => panic!("{:?} was read as {:?}", String::from_utf8_lossy(bytes), read.matrix),
        Err(problems) => problems.to_string(),
    }
}

const MM: &str = "%%MatrixMarket matrix coordinate real symmetric\n";

#[test]
fn broken_files_are_refused_with_line_rule_and_value() {
    let mm = |rest: &str| format!("{MM}{rest}");
    let cases = [
        (String::new(), "f: the file must hold a matrix: it holds no line of data"),
        (
            "1 2\n3 4\n".into(),
            "f: line 1: the format must be Matrix Market, Harwell-Boeing, DMIG, or lines of 3 or 5 numbers: 2 fields; a line of \
             sizes belongs into Matrix Market, below its first line",
        ),
        // Matrix Market
        (
            "%%MatrixMarket matrix sparse real general\n1 1\n1\n".into(),
            "line 1: the matrix must be in coordinate or array format: `sparse`",
        ),
        (
            "%%MatrixMarket vector coordinate real general\n".into(),
            "line 1: the first line must begin with %%MatrixMarket matrix",
        ),
        (
            "%%MatrixMarket matrix coordinate complex general\n".into(),
            "line 1: the matrix must be real or integer: `complex`",
        ),
        (
            "%%MatrixMarket matrix coordinate pattern symmetric\n".into(),
            "the matrix must be real or integer: `pattern`",
        ),
        (
            "%%MatrixMarket matrix coordinate real skew-symmetric\n".into(),
            "must be symmetric or general: `skew-symmetric`",
        ),
        (mm(""), "line 2: a line with rows, columns and entries must follow: the file ends here"),
        (mm("2 2\n1 1 1\n"), "line 2: the line after the comments must hold rows, columns and entries: `2 2`"),
        (mm("2 3 1\n1 1 1\n"), "line 2: the matrix must be square: 2 rows, 3 columns"),
        (mm("2 2 3\n1 1 1\n2 2 1\n"), "line 4: the header announces 3 entries: the file ends after 2"),
        (mm("2 2 2\n1 1 1\n2 2 1\n2 1 1\n"), "line 5: the header announces 2 entries: more lines follow"),
        (mm("2 2 2\n1 1 1\n3 2 1\n"), "line 4: row and column must lie between 1 and 2: 3, 2"),
        (
            mm("2 2 2\n1 1 1\n0 2 1\n"),
            "line 4: row and column must lie between 1 and 2: 0, 2; rows and columns count from 1",
        ),
        (mm("2 2 2\n1 1 1\n-1 2 1\n"), "line 4: a line must hold row, column and value: `-1 2 1`"),
        (mm("2 2 2\n1 1 1\n2 2\n"), "line 4: a line must hold row, column and value: `2 2`"),
        (mm("2 2 2\n1 1 1\n2 2 1 1\n"), "line 4: a line must hold row, column and value: `2 2 1 1`"),
        (mm("2 2 2\n1 1 1\n2 2 nan\n"), "line 4: values must be finite numbers: `nan`"),
        (mm("2 2 2\n1 1 1\n2 2 inf\n"), "line 4: values must be finite numbers: `inf`"),
        (mm("2 2 2\n1 1 1\n2 2 1e999\n"), "line 4: values must be finite numbers: `1e999`"),
        (mm("2 2 2\n1 1 1\n2 2 3,5\n"), "line 4: a line must hold row, column and value: `2 2 3,5`"),
        (
            mm("2 2 2\n1 1 1e308\n2 2 1\n").replace("2 2 2\n", "2 2 3\n1 1 1.7e308\n"),
            "entries at one place must have a finite sum: (1, 1)",
        ),
        (
            mm("2 2 4\n1 1 1\n2 2 1\n2 1 1\n1 2 1\n"),
            "a symmetric file must hold one triangle, not both: (2, 1) and (1, 2)",
        ),
        (
            mm("1000000000000 1000000000000 1\n1 1 1\n"),
            "line 2: the header must announce what the file can hold: 1000000000000 rows",
        ),
        (
            mm("2 2 1000000000000\n1 1 1\n"),
            "line 2: the header must announce what the file can hold: 1000000000000 entries",
        ),
        (
            mm("99999999999999999999999 99999999999999999999999 1\n1 1 1\n"),
            "the header must announce what the file can hold",
        ),
        (mm("9 9 1\n1 1 1\n"), "every row must have a diagonal entry: 9 rows, 1 entries"),
        (mm("0 0 0\n"), "the header must announce what the file can hold: 0 rows"),
        (mm("2 2 2\n1 1 1\n\0\u{1}\u{2}\n"), "line 4: a line must hold row, column and value: `\\x00\\x01\\x02`"),
        // general
        (
            "%%MatrixMarket matrix coordinate real general\n2 2 4\n1 1 4\n2 1 1\n1 2 1.1\n2 2 4\n".into(),
            "the matrix must be symmetric: a(2, 1) = 1e0, a(1, 2) = 1.1e0",
        ),
        (
            "%%MatrixMarket matrix coordinate real general\n2 2 3\n1 1 4\n2 1 1\n2 2 4\n".into(),
            "the matrix must be symmetric: a(2, 1) = 1e0, a(1, 2) = 0e0; only one triangle is given: the header must say symmetric",
        ),
        // triplets
        (
            "1 1 4\n1 2 1\n2 1 1\n2 2 3\n3 2 1\n3 3 1\n".into(),
            "the matrix must be symmetric: a(3, 2) = 1e0, a(2, 3) = 0e0",
        ),
        ("1 1 4\n4000000000 1 1\n".into(), "line 2: row and column must lie between 1 and 5: 4000000000, 1"),
        // labels
        (
            "1,1,1,7,2.0\n".into(),
            "line 1: nodes must be numbered from 1 (internal ones from -1) to 2147483648, freedoms from 1 to 6: `1,1,1,7,2.0`",
        ),
        ("0,1,1,1,2.0\n".into(), "line 1: nodes must be numbered from 1"),
        (
            "1,1,1,1,2.0\n--3,1,1,1,2\n".into(),
            "line 2: a line must hold node, freedom, node, freedom and value: `--3,1,1,1,2`",
        ),
        ("1,1,1,1,x\n".into(), "line 1: values must be finite numbers: `x`"),
    ];
    for (text, expected) in cases {
        let said = refusal("f", text.as_bytes(), None);
        assert!(said.contains(expected), "{text}\n{said}\n{expected}");
    }
}

#[test]
fn broken_harwell_boeing_files_are_refused() {
    let good = "t\n 6 1 1 4 0\nRSA 3 3 5 0\n(4I3) (5I2) (2E10.2)\n  1  3  5  6\n 1 2 2 3 3\n\
        \x20 4.00E+00 -1.00E+00\n  5.00E+00 -2.50E+00\n  6.00E+00\n";
    let cases = [
        ("RSA", "CSA", "line 3: the matrix must be real, symmetric or unsymmetric, assembled: RSA or RUA: `CSA`"),
        ("RSA", "RSE", "RSA or RUA: `RSE`"),
        ("RSA 3 3 5", "RSA 3 4 5", "line 3: the matrix must be square: 3 rows, 4 columns"),
        ("RSA 3 3 5", "RSA 3 3 500000000", "line 3: the header must announce what the file can hold"),
        ("RSA 3 3 5", "RSA 900000000 900000000 5", "line 3: the header must announce what the file can hold"),
        ("RSA 3 3 5", "RSA x 3 5", "line 3: the third line must hold type, rows, columns and entries"),
        (" 6 1 1 4 0", " 6 1 x 4 0", "line 2: the second line must hold numbers of lines"),
        (" 6 1 1 4 0", " 6 1 2 4 0", "line 2: values must begin after line 7: the last row number is on line 6"),
        ("(5I2)", "(5A2)", "line 4: the fourth line must hold formats"),
        ("(2E10.2)", "(2I10)", "line 4: the fourth line must hold formats"),
        ("  1  3  5  6", "  1  5  3  6", "line 5: pointers must not fall and run from 1 to 6: `3`"),
        ("  1  3  5  6", "  1  3  5  5", "line 5: the last pointer must be 6: 5"),
        ("  1  3  5  6", "  2  3  5  6", "line 5: pointers must not fall and run from 1 to 6: `2`"),
        (" 1 2 2 3 3", " 1 2 2 4 3", "line 6: row and column must lie between 1 and 3: 4"),
        (" 1 2 2 3 3", " 1 2 2 x 3", "line 6: row numbers must be whole numbers: `x`"),
        ("-2.50E+00\n", "-2.50Q+00\n", "line 8: values must be finite numbers: `-2.50Q+00`"),
        ("  6.00E+00\n", "", "line 9: values must follow: the file ends here"),
        (" 1 2 2 3 3\n", "", "line 6: row numbers must be whole numbers"),
    ];
    for (from, to, expected) in cases {
        assert!(good.contains(from), "{from}");
        let said = refusal("f", good.replacen(from, to, 1).as_bytes(), Some(Format::HarwellBoeing));
        assert!(said.contains(expected), "{to}\n{said}");
    }
}

#[test]
fn many_problems_are_told_at_once_and_not_too_many() {
    let two = refusal("f", format!("{MM}2 2 3\n1 1 x\n5 5 1\n2 2 1\n").as_bytes(), None);
    assert_eq!(two.lines().count(), 2, "{two}");
    let text: String = std::iter::repeat_n("9999999 1 1\n", 1000).collect();
    let said = refusal("f", text.as_bytes(), None);
    assert_eq!(said.lines().count(), 21);
    assert!(said.ends_with("f: more problems may follow, reading stopped after: line 20"), "{said}");
}

#[test]
fn garbage_is_refused_whatever_the_format() {
    let mut state = 7_u32;
    let garbage = std::iter::repeat_with(|| {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (state >> 24) as u8
    });
    let garbage: Vec<u8> = garbage.take(300_000).collect();
    let formats = [Format::MatrixMarket, Format::Triplets, Format::Labels, Format::HarwellBoeing, Format::Dmig];
    for format in formats.into_iter().map(Some).chain([None]) {
        refusal("f", &garbage, format);
        refusal("f", &vec![b'1'; 300_000], format);
        refusal("f", &vec![0; 300_000], format);
        refusal("f", b"", format);
        refusal("f", b"\n\n\n\n\n\n", format);
    }
}

#[test]
fn what_is_no_file_is_refused() {
    for path in [".", "/nowhere/at/all.mtx", "/dev/zero"] {
        let said = read_matrix(&Input::path(path.as_ref()), None, None, None).unwrap_err().to_string();
        assert!(said.starts_with(&format!("{path}: the file cannot be read: ")), "{said}");
    }
}

#[test]
fn another_size_than_the_stiffness_matrix_is_refused() {
    let read = |text: &str| {
        read_matrix(&Input::bytes("m", text.as_bytes()), None, Some(3), None).map_err(|problems| problems.to_string())
    };
    let said = read(&format!("{MM}2 2 1\n1 1 1\n")).unwrap_err();
    assert!(said.contains("line 2: the matrices must have as many rows as the stiffness matrix: 2 instead of 3 rows"));
    let said = read("1 1 1\n4 4 1\n").unwrap_err();
    assert!(said.contains("line 2: row and column must lie between 1 and 3: 4, 4"), "{said}");
    assert_eq!(read("1 1 1\n").unwrap().matrix.n, 3);
}

#[test]
fn a_first_line_that_is_not_understood_is_never_read_as_data() {
    let cases = [
        (
            "%MatrixMarket matrix coordinate real symmetric\n2 2 3\n1 1 4\n2 1 -1\n2 2 5\n",
            "line 1: a header must be understood, not passed over as a remark: `%MatrixMarket matrix coordinate real symmetric`: the first line of a Matrix Market file begins with %%MatrixMarket",
        ),
        (
            "# from Octave\n%%MatrixMarket matrix coordinate real symmetric\n2 2 3\n1 1 4\n2 1 -1\n2 2 5\n",
            "line 2: a header must be understood",
        ),
        (
            "2 2 3\n1 1 4\n2 1 -1\n2 2 5\n",
            "line 1: a line of sizes must not stand above lines of row, column and value: remove it, or write the header of a Matrix Market file: 2 2 3, and 3 lines of data follow",
        ),
        // The count is that of both triangles.
        ("2 2 4\n1 1 4\n2 1 -1\n2 2 5\n", "line 1: a line of sizes"),
        ("% a remark\n\n3 3 4\n1 1 4\n2 1 -1\n2 2 5\n1 1 1\n", "line 3: a line of sizes"),
        ("2 3\n1 1 4\n2 1 -1\n2 2 5\n", "line 1: the format must be"),
        ("3\n1 1 4\n2 1 -1\n2 2 5\n", "line 1: the format must be"),
        ("row col value\n1 1 4\n", "line 1: a line must hold row, column and value: `row col value`"),
        (
            "# Created by Octave\n# name: K\n# type: matrix\n# rows: 3\n# columns: 3\n 4 -1 0\n -1 5 -2\n 0 -2 6\n",
            "line 3: a header must be understood",
        ),
        (
            "4 -1 0 0 0 0\n-1 4 0 0 0 0\n",
            "line 1: the format must be Matrix Market, Harwell-Boeing, DMIG, or lines of 3 or 5 numbers: 6 fields; a matrix in full is written by scipy.io.mmwrite",
        ),
        (
            "     100     100       6       2KAA     1P,3E23.16\n       1       1       3\n",
            "this is no matrix that can be read here: OUTPUT4 of Nastran",
        ),
    ];
    for (text, expected) in cases {
        let said = refusal("f", text.as_bytes(), None);
        assert!(
            said.contains(expected) || expected.starts_with("this") && said.contains("OUTPUT4 of Nastran"),
            "{text}\n{said}"
        );
    }
    for format in [Format::Triplets, Format::Labels] {
        refusal("f", cases[0].0.as_bytes(), Some(format));
    }
}

#[test]
fn broken_arrays_are_refused() {
    let array = |rest: &str| format!("%%MatrixMarket matrix array real {rest}");
    for (text, expected) in [
        (array("general\n2 3\n1\n2\n"), "line 2: the matrix must be square: 2 rows, 3 columns"),
        (array("general\n2 2 4\n1\n2\n"), "line 2: the line after the comments must hold rows and columns: `2 2 4`"),
        (
            array("general\n2 2\n4\n-1\n-1\n"),
            "line 5: the header announces 2 columns: the file ends in column 2, at row 2",
        ),
        (array("symmetric\n2 2\n4\n-1\n5\n6\n"), "line 6: the header announces 2 columns: more values follow"),
        (array("general\n2 2\n4\n-1\nx\n5\n"), "line 5: values must be finite numbers: `x`"),
        (array("general\n2 2\n4\n-1\n-2\n5\n"), "the matrix must be symmetric: a(2, 1) = -1e0, a(1, 2) = -2e0"),
        (array("general\n4000000000 4000000000\n1\n"), "line 2: the header must announce what the file can hold"),
        (array("general\n100000 100000\n1\n"), "line 2: the header must announce what the file can hold"),
    ] {
        let said = refusal("f", text.as_bytes(), None);
        assert!(said.contains(expected), "{text}\n{said}");
    }
}

#[test]
fn broken_dmig_is_refused() {
    let good = "DMIG    KAAX           0       6       2       0                       0\n\
        DMIG*   KAAX                                   1               5\n\
        *                                      1               5 4.000000000D+00\n";
    for (from, to, expected) in [
        (
            "       6       2",
            "       2       2",
            "line 1: a DMIG matrix must be symmetric or square (form 6 or 1) and real (type 1 or 2)",
        ),
        ("       6       2", "       6       4", "line 1: a DMIG matrix must be symmetric or square"),
        (
            "DMIG*   KAAX                                   1               5",
            "DMIG    KAAX           1       5               1       5     4.0",
            "line 2: entries of DMIG must have wide fields (DMIG*)",
        ),
        ("4.000000000D+00", "x", "line 3: values must be finite numbers: `x`"),
        (
            "               5 4.0",
            "               7 4.0",
            "line 3: a line of DMIG* must hold grid point, component 1 to 6 and value",
        ),
        ("KAAX", "MAAX", "the file must hold a DMIG matrix whose name begins with K: MAAX"),
    ] {
        let text = good.replace(from, to);
        let input = Input::bytes("f", text.as_bytes()).of('K');
        let said = read_matrix(&input, None, None, None).unwrap_err().to_string();
        assert!(said.contains(expected), "{text}\n{said}");
    }
}
