//! Valid files of every kind, mutated at random: whatever comes out, no panic, no hang, no memory beyond the file's.
//!
//! `TTB_FUZZ=1000000 cargo test --release -p ttb-import --test fuzz` for more than the short round.

use ttb_import::{Files, Format, Input, read_matrix};

const MATRICES: [(&str, &str); 9] = [
    (
        "a.mtx",
        "%%MatrixMarket matrix coordinate real symmetric\n% c\n3 3 5\n1 1 4\n2 1 -1e0\n2 2 5.0\n3 2 -2.5\n3 3 6\n",
    ),
    ("b.mtx", "%%MatrixMarket matrix coordinate integer general\n2 2 4\n1 1 4\n2 1 -1\n1 2 -1\n2 2 5\n"),
    ("c.sti", "1 1  4.0e+00\r\n1 2 -1.0e+00\r\n2 2  5.0e+00\r\n2 3 -2.5e+00\r\n3 3  6.0e+00\r\n"),
    ("d.txt", "** c\n2,2, 2,2, 4.\n2,6, 2,2, -1.\n2,6, 2,6, 5.\n2,6, 30,1, -2.5\n30,1, 30,1, 6.\n"),
    (
        "e.matrix",
        "t\n     6     1     1     4     0\nRSA     3     3     5     0\n(4I3)  (5I2)  (2E10.2)\n  1  3  5  6\n\
         \x201 2 2 3 3\n  4.00E+00 -1.00E+00\n  5.00D+00 -2.50+000\n  6.00E+00\n",
    ),
    (
        "f.matrix",
        "t\n 6 1 1 4 1\nRUA 3 3 7 0\n(4I3) (7I2) (1P,2D10.2) (E9.2)\nF   1   0\n  1  3  6  8\n 1 2 1 2 3 2 3\n\
         \x20 4.00D+00 -1.00D+00\n -1.00D+00  5.00D+00\n -2.50D+00 -2.50D+00\n  6.00D+00\n 1.00E+00\n",
    ),
    ("g.mtx", "%%MatrixMarket matrix array real general\n3 3\n4\n-1e0\n0\n-1\n5\n-2.5\n0\n-2.5\n6\n"),
    (
        "h.pch",
        "$ t\nDMIG    KAAX           0       6       2       0\nDMIG*   KAAX                           1               5\n\
         *                              1               5 4.0D+00\n*                              2               3-1.0D+00\n\
         DMIG*   KAAX                           2               3\n*                              2               3 5.0D+00\n",
    ),
    (
        "i.hb",
        "t\n 5 1 1 3\nRUA 3 3 7 0\n(4I9) (7I9) (3E25.16)\n 1 3 6 8\n 1 2 1 2 3 2 3\n 4.0 -1.0 -1.0\n 5. -2.5 -2.5\n 6.\n",
    ),
];

const TABLES: [(&str, &str); 6] = [
    ("dofs.csv", "row,node,direction,x,y,z\n1,2,x,1,0,0\n2,2,z,1,0,0\n3,3,x,2,0,0\n"),
    ("k.dof", "2.1\n2.3\n3.1\n"),
    ("k.mapping", "  Matrix Eqn   Node   DOF\n   1   2   UX\n   2   2   UZ\n   3   3   UX\n"),
    ("supports.csv", "x,node,direction,weight\n1.5,2,z,0.5\n1.5,3,x,0.5\n1,2,z,\n"),
    ("points.csv", "name,node,direction,weight\n\"tip, down\",3,x,-1\nmid,2,z,1\n"),
    ("nodes.csv", "node,x,y,z\n2,1,0,0\n3,2,0,0\n"),
];

struct Random(u64);

impl Random {
    fn below(&mut self, bound: usize) -> usize {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 % bound.max(1) as u64) as usize
    }
}

/// What files are broken with, besides single bytes.
const WORDS: [&[u8]; 30] = [
    b"\n",
    b"\r",
    b" ",
    b",",
    b"-",
    b"0",
    b"1",
    b"9",
    b"-1",
    b"1e308",
    b"1e999",
    b"nan",
    b"inf",
    b"1e-400",
    b"4294967295",
    b"4294967296",
    b"2147483648",
    b"18446744073709551615",
    b"99999999999999999999",
    b"1000000000000",
    b"\0",
    b"\xff\xfe",
    b"%",
    b"(",
    b")",
    b"\"",
    b"0.0",
    b"e",
    b".",
    b"(9999I100)",
];

/// Between one and three changes.
fn mutate(text: &[u8], random: &mut Random) -> Vec<u8> {
    let mut text = text.to_vec();
    for _ in 0..=random.below(3) {
        let at = random.below(text.len() + 1);
        let to = (at + random.below(12)).min(text.len());
        match random.below(8) {
            0 => text.truncate(at),
            1 => drop(text.drain(at..to)),
            2 => text[at..to].iter_mut().for_each(|byte| *byte = random.below(256) as u8),
            3 => drop(text.splice(at..at, WORDS[random.below(WORDS.len())].iter().copied())),
            4 => drop(text.splice(at..to, WORDS[random.below(WORDS.len())].iter().copied())),
            5 => {
                let piece = text[at..to].to_vec();
                let times = 1 + random.below(50);
                text.splice(at..at, piece.repeat(times));
            }
            6 => {
                // A number becomes another.
                let digits: Vec<usize> = (0..text.len()).filter(|&i| text[i].is_ascii_digit()).collect();
                if let Some(&i) = digits.get(random.below(digits.len())) {
                    text[i] = b'0' + random.below(10) as u8;
                }
            }
            _ => {
                // Lines change places.
                let mut lines: Vec<&[u8]> = text.split_inclusive(|byte| *byte == b'\n').collect();
                let (a, b) = (random.below(lines.len()), random.below(lines.len()));
                if !lines.is_empty() {
                    lines.swap(a, b);
                }
                text = lines.concat();
            }
        }
    }
    text
}

/// Peak memory of this process, bytes; zero where it is not known.
fn peak() -> u64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:")).unwrap_or_default();
    line.trim().trim_end_matches(" kB").parse::<u64>().unwrap_or(0) * 1024
}

#[test]
fn no_mutation_breaks_a_reader() {
    let rounds: usize = std::env::var("TTB_FUZZ").ok().and_then(|text| text.parse().ok()).unwrap_or(30_000);
    let mut random = Random(std::env::var("TTB_FUZZ_SEED").ok().and_then(|s| s.parse().ok()).unwrap_or(88_172_645_463));
    let formats = [Format::MatrixMarket, Format::Triplets, Format::Labels, Format::HarwellBoeing, Format::Dmig];
    let (mut read, mut refused) = (0, 0);
    for _ in 0..rounds {
        let (name, text) = MATRICES[random.below(MATRICES.len())];
        let bytes = mutate(text.as_bytes(), &mut random);
        let format = if random.below(4) == 0 { Some(formats[random.below(formats.len())]) } else { None };
        let size = if random.below(4) == 0 { Some(3) } else { None };
        match read_matrix(&Input::bytes(name, bytes), format, size, None) {
            Ok(done) => {
                let matrix = done.matrix;
                assert_eq!(matrix.starts.len(), matrix.n + 1);
                assert_eq!(*matrix.starts.last().unwrap(), matrix.rows.len());
                assert!(matrix.values.iter().all(|value| value.is_finite()));
                for j in 0..matrix.n {
                    let rows: Vec<usize> = matrix.column(j).map(|(i, _)| i).collect();
                    assert!(rows.is_sorted_by(|a, b| a < b) && rows.iter().all(|i| (j..matrix.n).contains(i)));
                }
                read += 1;
            }
            Err(problems) => {
                assert!(!problems.0.is_empty() && problems.0.len() <= 21);
                refused += 1;
            }
        }
    }
    let (mut good, mut bad) = (0, 0);
    for _ in 0..rounds / 2 {
        // All six tables at hand, one or two of them broken; rows by one of the three kinds.
        let broken = [random.below(6), random.below(6)];
        let mut tables: Vec<Vec<u8>> = TABLES.iter().map(|(_, text)| text.as_bytes().to_vec()).collect();
        for table in broken {
            tables[table] = mutate(&tables[table], &mut random);
        }
        let own_nodes = random.below(2) == 0;
        let dofs = if own_nodes { TABLES[1 + random.below(2)].0 } else { TABLES[0].0 };
        let files = Files {
            stiffness: "c.sti".into(),
            mass: "c.sti".into(),
            dofs: Some(dofs.into()),
            nodes: own_nodes.then(|| "nodes.csv".into()),
            supports: "supports.csv".into(),
            points: Some("points.csv".into()),
            ..Files::default()
        };
        let open = |name: &str| match TABLES.iter().position(|(table, _)| *table == name) {
            Some(i) => Input::bytes(name, tables[i].as_slice()),
            None => Input::bytes(name, MATRICES[2].1.as_bytes()),
        };
        match files.read_from(open) {
            Ok(model) => {
                let inspection = model.inspect();
                assert!(inspection.n == 3 && model.supports.iter().flat_map(|(_, row)| row).all(|(row, _)| *row < 3));
                good += 1;
            }
            Err(problems) => {
                assert!(!problems.to_string().is_empty());
                bad += 1;
            }
        }
    }
    println!(
        "matrices: {read} read, {refused} refused; models: {good} read, {bad} refused; peak {} MB",
        peak() / 1_000_000
    );
    assert!(peak() < 300_000_000, "peak memory {} bytes", peak());
    assert!(read > 0 && good > 0);
}
