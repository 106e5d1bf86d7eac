//! `ttb compare` on R1: the table's rows agree as the paper says, and better; the files are what they should be.

use std::path::Path;
use std::process::{Command, Output};

use serde_json::Value;
use ttb_tests::{examples, ttb};

fn compare(out: &Path, arguments: &[&str]) -> Output {
    let mut command = Command::new(ttb());
    command.arg("compare").arg(examples().join("r1.json")).arg("-o").arg(out).arg("--quiet").args(arguments);
    command.output().expect("ttb runs")
}

fn table(out: &Path) -> Value {
    let text = std::fs::read_to_string(out.join("compare.json")).expect("compare.json");
    serde_json::from_str(&text).expect("JSON")
}

fn rows(table: &Value) -> &Vec<Value> {
    table["rows"].as_array().expect("rows")
}

fn four(row: &Value, key: &str) -> Vec<f64> {
    row[key]
        .as_array()
        .unwrap_or_else(|| panic!("{key} of {row}"))
        .iter()
        .map(|x| x.as_f64().expect("number"))
        .collect()
}

#[test]
fn every_method_at_its_own_step_agrees_within_two_percent_and_at_equal_step_to_the_tolerance() {
    let out = tempfile::tempdir().expect("temporary folder");
    let done = compare(out.path(), &[]);
    assert!(done.status.success(), "{}", String::from_utf8_lossy(&done.stderr));
    println!("{}", String::from_utf8_lossy(&done.stdout));
    let table = table(out.path());
    let methods: Vec<&str> = rows(&table).iter().map(|row| row["method"].as_str().expect("text")).collect();
    let first = ["SCM, as in the paper", "SCM, constant matrices", "LCM", "LCM, relaxed", "HSA"];
    assert_eq!(methods[..5], first);
    for row in rows(&table) {
        assert_eq!(row["complete"], true, "{row}");
        let off = four(row, "peak_differences");
        assert!(off.iter().all(|d| d.abs() < 0.02), "{row}");
    }
    // Tolerance 1e-6 on the forces of wheels or supports; accelerations of rail and deck show it most.
    for row in &rows(&table)[1..5] {
        if row["step_s"] == 1e-3 {
            let off = four(row, "equal_step_differences");
            assert!(off.iter().all(|d| *d < 3e-5), "{row}");
        }
    }
    assert_eq!(rows(&table)[0]["mean_factorisations"], 1.0);
    let csv = std::fs::read_to_string(out.path().join("compare.csv")).expect("compare.csv");
    assert_eq!(csv.lines().count(), 1 + rows(&table).len());
    for figure in ["7-displacement", "8-deck-acceleration", "9-car-acceleration", "10-contact-force"] {
        let stem = out.path().join(format!("figure-{figure}"));
        let svg = std::fs::read_to_string(stem.with_extension("svg")).expect("SVG");
        assert!(svg.trim_end().ends_with("</svg>") && svg.contains("HSA, 1 ms"));
        let png = std::fs::read(stem.with_extension("png")).expect("PNG");
        assert!(png.starts_with(b"\x89PNG\r\n\x1a\n") && png.ends_with(b"IEND\xaeB`\x82") && png.len() > 20_000);
    }
}

#[test]
fn a_row_that_costs_too_much_is_extrapolated_and_one_that_diverges_says_so() {
    let out = tempfile::tempdir().expect("temporary folder");
    let asked = ["--methods", "schur,lcm", "--steps", "1e-3", "--reference", "none", "--budget", "schur=0.01,5"];
    let done = compare(out.path(), &asked);
    assert!(done.status.success(), "{}", String::from_utf8_lossy(&done.stderr));
    let text = String::from_utf8_lossy(&done.stdout).into_owned();
    assert!(text.contains("* SCM, constant matrices: extrapolated from"), "{text}");
    assert!(
        text.contains("LCM at 1.0000 ms: stopped: the step to t = 0.001 s: the iteration on the wheels' forces"),
        "{text}"
    );
    let table = table(out.path());
    let row = &rows(&table)[0];
    assert_eq!((&row["complete"], &row["steps"]), (&Value::Bool(false), &Value::from(1100)));
    let (taken, total) = (row["steps_taken"].as_f64(), row["total_cpu_s"].as_f64());
    let each = row["cpu_per_step_s"].as_f64().expect("number");
    assert!(taken.is_some_and(|n| n < 1100.0) && total.is_some_and(|t| (t / each - 1100.0).abs() < 1e-6), "{row}");
    assert!(row.get("peak_differences").is_none());
}

#[test]
fn bad_questions_are_answered_with_exit_code_2() {
    let out = tempfile::tempdir().expect("temporary folder");
    for (arguments, said) in [
        (["--point", "nowhere"], "the bridge has no monitored point nowhere; it has: mid"),
        (["--car", "2"], "--car is 2; the train has 1 to 1"),
        (["--wheel", "0"], "--wheel is 0; the train has 1 to 4"),
        (["--steps", "0"], "a positive number of seconds is wanted"),
        (["--budget", "0"], "a positive number of seconds is wanted"),
        (["--budget", "magic=1"], "invalid variant: magic"),
        (["--methods", "magic"], "possible values: scm, schur, lcm, lcm-relaxed, hsa"),
    ] {
        let done = compare(out.path(), &arguments);
        let text = String::from_utf8_lossy(&done.stderr).into_owned();
        assert_eq!(done.status.code(), Some(2), "{arguments:?}: {text}");
        assert!(text.contains(said), "{arguments:?}: {text}");
    }
}
