//! Large bridges: what building, a step of all degrees of freedom and a reduced model cost, against the memory's bandwidth.
//!
//!     cargo bench -p ttb-bridge --bench large -- SCENARIO.json … [reduce HERTZ]
//!     cargo bench -p ttb-bridge --bench large -- scaling [reduce HERTZ]
//!
//! `scaling` makes its own bridges: the cable-stayed one with 12,000, 120,000 and 1,200,000 degrees of freedom, and
//! viaducts of 120,000 with 300 and 3,000 supports. The table at the end is that of docs/guide/large-bridges.md.

mod measure;
mod meter;

use std::path::{Path, PathBuf};

use measure::Row;
use ttb_generate::{CableStayed, Viaduct, cable_stayed, cable_stayed_scenario, text, viaduct, viaduct_scenario};

/// Supports from which on a reduced model would need too many vectors.
const REDUCIBLE: usize = 1000;

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).filter(|a| a != "--bench").collect();
    let (cases, reduce) = match arguments.iter().position(|a| a == "reduce") {
        Some(at) => (&arguments[..at], arguments.get(at + 1).and_then(|hertz| hertz.parse().ok())),
        None => (&arguments[..], None),
    };
    let folder = tempfile::tempdir().expect("a folder");
    let scenarios: Vec<PathBuf> = match cases {
        [] => return println!("usage: … --bench large -- scaling | SCENARIO.json … [reduce HERTZ]"),
        [case] if case == "scaling" => generated(folder.path()),
        several => several.iter().map(PathBuf::from).collect(),
    };
    let rows: Vec<Row> = scenarios.iter().map(|scenario| measure::measure(scenario, reduce, REDUCIBLE)).collect();
    println!("\n{}", Row::HEAD);
    rows.iter().for_each(|row| println!("{row}"));
}

/// Writes the models of the scaling table.
fn generated(folder: &Path) -> Vec<PathBuf> {
    let write = |name: String, model: String, scenario: String| {
        let folder = folder.join(name);
        std::fs::create_dir_all(&folder).expect("a folder");
        std::fs::write(folder.join("bridge.json"), model).expect("a file");
        std::fs::write(folder.join("scenario.json"), scenario).expect("a file");
        folder.join("scenario.json")
    };
    let stayed = [12_000, 120_000, 1_200_000].map(|dofs| {
        let model = cable_stayed(&CableStayed { dofs, ..CableStayed::default() }).expect("a bridge");
        write(format!("cable-stayed {dofs}"), text(&model), cable_stayed_scenario(&model, "bridge.json", None))
    });
    // Supports lie 0.545 m apart.
    let viaducts = [5, 51].map(|spans| {
        let model = viaduct(&Viaduct { spans, ..Viaduct::default() }).expect("a viaduct");
        write(format!("viaduct {spans}"), text(&model), viaduct_scenario(&model, spans, "bridge.json"))
    });
    stayed.into_iter().chain(viaducts).collect()
}
