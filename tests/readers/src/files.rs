//! Readers of single files: matrices, tables, descriptions, system structures, maps.

use std::path::Path;

use ttb::connect::map::Map;
use ttb_fmi2::import::read_description;
use ttb_import::{Files, Format, Input, SymmetricMatrix, read_matrix};

use crate::models::checked;
use crate::parts;

/// Degrees of freedom up to which a model that was read is used.
const USED: usize = 200;

/// A matrix of any format: the first byte says in which, the rest is the file.
pub fn matrices(bytes: &[u8]) {
    let Some((how, text)) = bytes.split_first() else { return };
    let formats = [Format::MatrixMarket, Format::Triplets, Format::Labels, Format::HarwellBoeing];
    let (format, size) = (formats.get(usize::from(how % 8)).copied(), (how & 8 != 0).then_some(3));
    let name = ["k", "k.mtx", "k.sti", "k.txt"][usize::from(how >> 4) % 4];
    if let Ok(read) = read_matrix(&Input::bytes(name, text), format, size, None) {
        sound(&read.matrix);
    }
}

/// Columns in order, rows below the diagonal in order, numbers finite.
fn sound(matrix: &SymmetricMatrix) {
    assert_eq!(matrix.starts.len(), matrix.n + 1, "one start a column and one more");
    assert_eq!(matrix.starts.last(), Some(&matrix.rows.len()), "the last start is the number of entries");
    assert!(matrix.values.iter().all(|value| value.is_finite()), "a number that is not finite");
    for j in 0..matrix.n {
        let rows: Vec<usize> = matrix.column(j).map(|(row, _)| row).collect();
        assert!(rows.is_sorted_by(|a, b| a < b), "rows of column {j} are not in order");
        assert!(rows.iter().all(|row| (j..matrix.n).contains(row)), "a row of column {j} does not exist");
    }
}

/// An imported model, its files separated by a line: stiffness, mass, supports, then maybe degrees of freedom, points,
/// damping, nodes. What can be read becomes a bridge.
pub fn tables(bytes: &[u8]) {
    let parts = parts(bytes);
    if parts.len() < 3 {
        return;
    }
    let names = ["k.sti", "m.mas", "supports.csv", "dofs.csv", "points.csv", "c.sti", "nodes.csv"];
    let part = |at: usize| parts.get(at).filter(|part| !part.is_empty()).map(|_| names[at].to_string());
    let files = Files {
        stiffness: names[0].into(),
        mass: names[1].into(),
        supports: names[2].into(),
        dofs: part(3),
        points: part(4),
        damping: part(5),
        nodes: part(6),
        format: None,
    };
    let open = |name: &str| {
        let at = names.iter().position(|known| *known == name).unwrap_or_default();
        Input::bytes(name, parts[at])
    };
    let Ok(imported) = files.read_from(open) else { return };
    [Some(&imported.k), Some(&imported.m), imported.c.as_ref()].into_iter().flatten().for_each(sound);
    let rows = imported.supports.iter().map(|(_, row)| row).chain(imported.points.iter().map(|(_, row)| row));
    assert!(
        rows.flatten().all(|(row, weight)| (*row as usize) < imported.k.n && weight.is_finite()),
        "a row that is not there"
    );
    if imported.k.n <= USED {
        let _ = imported.inspect();
        let stations: Vec<f64> = imported.supports.iter().map(|(x, _)| *x).take(20).collect();
        let _ = ttb_bridge::imported::from(imported, &stations);
    }
}

/// A measured profile, as a file that a scenario names.
pub fn measured(bytes: &[u8]) {
    const SCENARIO: &str = r#"{"train":{"cars":["ice3-trailer"],"front_wheel":24.0,"speed":{"m_s":70}},
        "track":{"type":"slab","bays":50},"irregularity":{"type":"measured","file":"measured.csv"},
        "bridge":{"at":6.0,"structure":{"type":"beams","spans":[{"length":6,"bending_stiffness":4e9,"mass":9000,"elements":4}]},
        "damping":{"type":"none"}},"time":{"step":1e-3,"end":0.01}}"#;
    let Ok(folder) = tempfile::tempdir() else { return };
    if std::fs::write(folder.path().join("measured.csv"), bytes).is_ok()
        && let Some(checked) = checked(SCENARIO, folder.path())
    {
        let _ = ttb_train_track::TrainTrack::new(checked.train_track);
    }
}

/// SystemStructure.ssd; what was read can be written, and what was written is read as the same.
pub fn ssp(bytes: &[u8]) {
    let Ok(structure) = ttb_ssp::read(bytes, "SystemStructure.ssd") else { return };
    let Ok(text) = ttb_ssp::write(&structure, None) else { return };
    let again = ttb_ssp::read(text.as_bytes(), "SystemStructure.ssd");
    assert!(
        again.is_ok(),
        "what was written is refused: {}\n{text}",
        again.err().map_or_else(String::new, |e| e.to_string())
    );
}

/// modelDescription.xml.
pub fn description(bytes: &[u8]) {
    if let Ok(description) = read_description(bytes) {
        let _ = description.ambiguity();
        let _ = description.variable("x");
    }
}

/// A map of a foreign bridge.
pub fn map(bytes: &[u8]) {
    let Ok(folder) = tempfile::tempdir() else { return };
    let file = folder.path().join("map.json");
    if std::fs::write(&file, bytes).is_ok()
        && let Ok(map) = Map::load(&file)
    {
        for series in [Some(&map.force), Some(&map.displacement), map.velocity.as_ref()].into_iter().flatten() {
            let _ = (series.at(1), series.at(1_000_000));
        }
    }
}

/// Where scenarios of the targets look for files: nowhere.
pub(crate) const NOWHERE: &str = "/nowhere/at/all";

/// Whether a text names files that may be endless or somebody's.
pub(crate) fn names_files(text: &str) -> bool {
    Path::new(text).is_absolute() || ["/dev", "/proc", "/sys", "..", "\\u"].iter().any(|part| text.contains(part))
}
