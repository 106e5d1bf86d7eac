//! docs/verification.md is made of what the tests have kept in docs/verification; with `TTB_BLESS=1` it is written anew.

use std::fmt::Write;
use std::process::Command;

use ttb_record::{BLESS, Table, blessing, folder};
use ttb_tests::{examples, ttb};

/// Headings, and the records below them by title.
const SECTIONS: [(&str, &[&str]); 7] = [
    ("Train", &["cars on a rigid rail, Hz", "static axle loads, kN"]),
    (
        "Track",
        &[
            "rail on a Winkler foundation, deflection in m",
            "rail soft in shear on a Winkler foundation, deflection in m",
            "running wheel on a Winkler foundation, over the standing one",
        ],
    ),
    (
        "Bridges of beams and frames",
        &[
            "bridges of the examples",
            "spans of 20 m side by side, Hz",
            "continuous beam of two spans, Hz",
            "span that is soft in shear, Hz",
            "Timoshenko frame member, Hz",
            "frame member as cantilever in any direction",
            "bar along its axis, Hz",
            "beam with a hinge under unit force",
            "two bars under unit force, m",
            "static line of a force on a span",
        ],
    ),
    (
        "Finite elements in space",
        &[
            "Euler–Bernoulli beam, simply supported",
            "Timoshenko beam, simply supported",
            "bar and shaft, fixed–free",
            "inclined cantilever",
            "Timoshenko cantilever, tip deflection",
            "cable: Ernst's modulus against the elastic catenary",
            "straight cantilever, 6 × 1",
            "straight cantilever, unit torque",
            "curved beam",
            "twisted beam",
            "rectangular plate",
            "simply supported plate 1 × 1.5, 16 × 16",
            "square cantilever plate, 16 × 16",
            "thick simply supported plate, t/a = 0.1, 16 × 16",
            "clamped square plate, uniform load",
            "Scordelis–Lo roof",
            "pinched cylinder with end diaphragms",
            "hemisphere with 18° hole",
            "Cook's membrane",
        ],
    ),
    (
        "Moving loads",
        &[
            "moving force over a simple beam, amplification",
            "moving force over a beam of 25 m",
            "trains of forces over a beam",
            "sprung mass over a beam of 25 m",
        ],
    ),
    (
        "Train, track and bridge",
        &[
            "R1, smooth, 0.05 ms",
            "R1, irregular, 0.05 ms",
            "R1, irregular, 1 ms",
            "R1, linear contact, 0.05 ms",
            "methods of the paper: where the loosely coupled one stops converging, ms",
        ],
    ),
    (
        "Train and track in space",
        &[
            "cars in space with held wheelsets, Hz",
            "a wheelset on springs begins to hunt, m/s",
            "growth of a wheelset's hunting in steps of 1 ms, 1/s",
            "cars begin to hunt on rigid rails",
            "free wheelset on a cone",
            "order of the steps of a car in space",
            "rail's head under 10 kN across, mm",
            "girder under forces across and about the track",
            "R1 in space, irregular, 1 ms",
        ],
    ),
];

const HEAD: &str = "\
# Verification

This page has every closed form and published case that the tests compute, with expected and computed values and the
error. The numbers come from the records of the tests in `verification/`. A test fails if its values differ from its
record, and `report.rs` fails if this page differs from the records. The page is made by

    TTB_BLESS=1 cargo test --release --workspace && TTB_BLESS=1 cargo test --release -p ttb-tests --test report

Results that have no table here, such as conservation, orders of convergence and bit for bit equality, are named in
[theory.md](theory.md), section 15.

| | |
|---|---|
| program | ttb |
";

const FOOT: &str = "
## Accuracy and step

The program is compared with itself at a fine step, over the whole of every history, all outputs of a kind together. A
slope of two in the picture is the second order of Newmark's method.

    ttb accuracy examples/r1.json --steps 4e-3,2e-3,1e-3,5e-4,2e-4 --reference 5e-5

";

const SIGNATURE: &str = "
![Error over step](verification/accuracy.svg)

## Signature

| | |
|---|---|
| version, commit | |
| tests run on (machine, date), result | |
| checked by | |
";

fn record(title: &str) -> Table {
    let text = |table: &Table| table.title == title;
    let found = records().into_iter().find(text);
    found.unwrap_or_else(|| panic!("there is no record of “{title}”; {BLESS}"))
}

fn records() -> Vec<Table> {
    let files = std::fs::read_dir(folder()).expect("docs/verification").map(|entry| entry.expect("an entry").path());
    let json = files.filter(|path| path.extension().is_some_and(|e| e == "json"));
    json.map(|path| serde_json::from_str(&std::fs::read_to_string(path).expect("a record")).expect("a table")).collect()
}

/// The numbers of a text.
fn numbers(text: &str) -> Vec<f64> {
    let words = text.split(|c: char| !(c.is_ascii_digit() || c == '.')).filter(|word| !word.is_empty());
    words.filter_map(|word| word.parse().ok()).collect()
}

/// Runs the study, and compares it with the one in docs.
fn accuracy() -> String {
    let out = tempfile::tempdir().expect("temporary folder");
    let mut command = Command::new(ttb());
    command.arg("accuracy").arg(examples().join("r1.json")).arg("-o").arg(out.path()).arg("--quiet");
    let output =
        command.args(["--steps", "4e-3,2e-3,1e-3,5e-4,2e-4", "--reference", "5e-5"]).output().expect("ttb runs");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let read = |folder: &std::path::Path| std::fs::read_to_string(folder.join("accuracy.md"));
    let now = read(out.path()).expect("accuracy.md");
    if blessing() {
        for file in ["accuracy.md", "accuracy.svg"] {
            std::fs::copy(out.path().join(file), folder().join(file)).expect("docs/verification");
        }
        return now;
    }
    let kept = read(&folder()).unwrap_or_else(|e| panic!("docs/verification/accuracy.md: {e}; {BLESS}"));
    let (a, b) = (numbers(&now), numbers(&kept));
    assert_eq!(a.len(), b.len(), "docs/verification/accuracy.md is stale; {BLESS}");
    for (now, kept) in a.iter().zip(&b) {
        // Two digits are kept.
        assert!((now - kept).abs() <= 0.1 * now.max(*kept) + 1e-3, "accuracy: {now}, kept {kept}; {BLESS}");
    }
    kept
}

#[test]
fn the_report_says_what_the_tests_compute() {
    let mut report = HEAD.replace("| program | ttb |", &format!("| program | ttb {} |", env!("CARGO_PKG_VERSION")));
    let tables: usize = SECTIONS.iter().map(|(_, titles)| titles.len()).sum();
    let named: Vec<&str> = SECTIONS.iter().flat_map(|(_, titles)| titles.iter().copied()).collect();
    let records = records();
    let stray = records.iter().find(|table| !named.contains(&table.title.as_str())).map(|table| &table.title);
    assert_eq!(stray, None, "a table without place in the report: add it to SECTIONS");
    let rows: usize = named.iter().map(|title| record(title).rows.len()).sum();
    let _ = writeln!(report, "| comparisons | {rows} in {tables} tables |");
    for (heading, titles) in SECTIONS {
        let _ = write!(report, "\n## {heading}\n");
        for title in titles {
            let table = record(title);
            let _ = write!(report, "{table}\n`{}`\n", table.command);
        }
    }
    report = report + FOOT + &accuracy() + SIGNATURE;
    let path = folder().join("../verification.md");
    if blessing() {
        std::fs::write(&path, &report).expect("docs/verification.md");
    }
    let kept = std::fs::read_to_string(&path).unwrap_or_else(|e| panic!("{}: {e}; {BLESS}", path.display()));
    assert!(kept == report, "docs/verification.md is stale; {BLESS}");
}
