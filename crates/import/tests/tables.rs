//! Degrees of freedom, supports and points; a whole model from its files.

use std::collections::HashMap;

use ttb_import::{Dof, Files, Imported, Input};

/// A cantilever of two bars along x: nodes 2 and 3 move along x and z, node 3 weighs 5 kg.
fn good() -> HashMap<&'static str, String> {
    HashMap::from([
        ("K.sti", "1 1 200\n1 3 -100\n3 3 100\n2 2 20\n2 4 -10\n4 4 10\n".to_owned()),
        ("M.sti", "1 1 2\n2 2 2\n3 3 5\n4 4 5\n".to_owned()),
        ("dofs.csv", "row,node,direction,x,y,z\n1,2,x,1,0,0\n2,2,z,1,0,0\n3,3,x,2,0,0\n4,3,z,2,0,0\n".to_owned()),
        ("supports.csv", "x,node,direction,weight\n1.5,2,z,0.5\n1.5,3,z,0.5\n1,2,z,\n".to_owned()),
        ("points.csv", "name,node,direction,weight\n\"tip, down\",3,z,-1\nmid,2,z,1\n".to_owned()),
    ])
}

fn files() -> Files {
    Files {
        stiffness: "K.sti".into(),
        mass: "M.sti".into(),
        dofs: Some("dofs.csv".into()),
        supports: "supports.csv".into(),
        points: Some("points.csv".into()),
        ..Files::default()
    }
}

fn read(files: &Files, texts: &HashMap<&str, String>) -> Result<Imported, String> {
    let open = |name: &str| Input::bytes(name, texts.get(name).map_or(&[][..], |text| text.as_bytes()));
    files.read_from(open).map_err(|problems| problems.to_string())
}

#[test]
fn a_model_is_read_and_inspected() {
    let model = read(&files(), &good()).unwrap();
    assert_eq!(model.supports, [(1.0, vec![(1, 1.0)]), (1.5, vec![(1, 0.5), (3, 0.5)])]);
    assert_eq!(model.points, [("tip, down".to_owned(), vec![(3, -1.0)]), ("mid".to_owned(), vec![(1, 1.0)])]);
    let dofs = model.dofs.as_ref().unwrap();
    assert_eq!((dofs.nodes.as_slice(), dofs.node_of.as_slice()), (&[2, 3][..], &[0, 0, 1, 1][..]));
    assert_eq!(dofs.coordinates, Some(vec![[1.0, 0.0, 0.0], [2.0, 0.0, 0.0]]));

    let facts = model.inspect();
    assert_eq!((facts.n, facts.entries.as_slice()), (4, &[6, 4][..]));
    assert_eq!((facts.stiffness, facts.masses), ((200.0, 10.0), (5.0, 2.0)));
    assert!(facts.massless.is_empty() && facts.lone.is_empty() && facts.held.is_empty());
    // Along x and z 7 kg each; about y through the origin 2·1² + 5·2².
    let inertias: Vec<(usize, f64)> = facts.motions.iter().map(|m| (m.direction, m.inertia)).collect();
    assert_eq!(inertias, [(0, 7.0), (2, 7.0), (4, 22.0)]);
    // The first bar is held at its left end.
    assert_eq!((facts.motions[0].held, facts.motions[0].first_held), (1, Some(0)));
    assert_eq!(model.unmatched(&[1.0, 1.2]), (vec![1.2], vec![1.5]));
    assert_eq!(model.support(1.5), Some(&[(1, 0.5), (3, 0.5)][..]));
}

#[test]
fn a_free_model_is_held_nowhere() {
    let mut texts = good();
    // Two bars between three free nodes at x = 1, 2, 4; a stiff bending chain needs no more than its rigid motions.
    texts.insert("K.sti", "1 1 4\n1 2 -6\n1 3 2\n2 2 9\n2 3 -3\n3 3 1\n".into()); // b bᵀ with b = (2, −3, 1): b·1 = b·x = 0
    texts.insert("M.sti", "1 1 1\n2 2 1\n3 3 1\n".into());
    texts.insert("dofs.csv", "row,node,direction,x,y,z\n1,1,z,1,0,0\n2,2,z,2,0,0\n3,3,z,4,0,0\n".into());
    texts.insert("supports.csv", "x,row\n0.65,1\n1.3,2\n1.95,3\n".into());
    let model = read(&Files { points: None, ..files() }, &texts).unwrap();
    let facts = model.inspect();
    assert!(facts.motions.iter().all(|motion| motion.held == 0), "{facts:?}");
    assert_eq!(facts.motions.iter().find(|m| m.direction == 4).unwrap().inertia, 21.0);
}

#[test]
fn labels_of_calculix_and_ansys_are_read() {
    let mut texts = good();
    texts.insert("k.dof", "2.1\n2.3\n3.1\n3.3\n".into());
    texts.insert("nodes.csv", "node,x,y,z\n1,0,0,0\n2,1,0,0\n3,2,0,0\n".into());
    let model =
        read(&Files { dofs: Some("k.dof".into()), nodes: Some("nodes.csv".into()), ..files() }, &texts).unwrap();
    assert_eq!(model.dofs, read(&files(), &good()).unwrap().dofs);
    let mapping = "  Matrix Eqn      Node    DOF\n   2   2   UZ\n   1   2   UX\n   3   3   UX\n   4   3   ROTY\n";
    texts.insert("k.mapping", mapping.into());
    texts.insert("supports.csv", "x,node,direction\n1,2,uz\n2,3,ry\n".into());
    let model = read(&Files { dofs: Some("k.mapping".into()), points: None, ..files() }, &texts).unwrap();
    assert_eq!(model.dofs.unwrap().dofs[3], Dof { node: 3, freedom: 4 });
}

#[test]
fn labels_in_the_matrix_serve_the_supports() {
    let mut texts = good();
    texts.insert("K.sti", "7,3,7,3,10\n7,3,9,3,-5\n9,3,9,3,10\n".into());
    texts.insert("M.sti", "9,3,9,3,2\n".into());
    texts.insert("supports.csv", "x;node;direction;weight\n1;9;z;-1\n".into());
    let model = read(&Files { dofs: None, points: None, ..files() }, &texts).unwrap();
    assert_eq!(model.supports, [(1.0, vec![(1, -1.0)])]);
    assert_eq!((model.m.n, model.inspect().massless), (2, vec![0]));
}

#[test]
fn a_broken_table_is_refused_with_line_rule_and_value() {
    let cases = [
        (
            "dofs.csv",
            "1,2,x,1,0,0",
            "1,2,w,1,0,0",
            "dofs.csv: line 2: direction must be one of x, y, z, rx, ry, rz: `w`",
        ),
        ("dofs.csv", "1,2,x,1,0,0", "0,2,x,1,0,0", "dofs.csv: line 2: row must be a whole number from 1: `0`"),
        (
            "dofs.csv",
            "1,2,x,1,0,0",
            "9,2,x,1,0,0",
            "dofs.csv: line 3: rows must be numbered from 1 without a gap: row 1 missing",
        ),
        (
            "dofs.csv",
            "2,2,z,1,0,0",
            "2,2,x,1,0,0",
            "dofs.csv: line 3: node and direction must belong to one row: node 2, x: rows 1 and 2",
        ),
        (
            "dofs.csv",
            "2,2,z,1,0,0",
            "2,2,z,1,0,1",
            "dofs.csv: line 3: a node must have the same coordinates in all its lines: node 2",
        ),
        ("dofs.csv", "2,2,z,1,0,0", "2,2,z,1,0", "dofs.csv: line 3: z must be a finite number: ``"),
        (
            "dofs.csv",
            "2,2,z,1,0,0",
            "2,2,z,1,0,0,5",
            "dofs.csv: line 3: a line must not have more fields than the header: 7 fields for 6 columns",
        ),
        (
            "dofs.csv",
            "4,3,z,2,0,0\n",
            "",
            "dofs.csv: there must be as many degrees of freedom as rows of the stiffness matrix: 3 instead of 4",
        ),
        (
            "dofs.csv",
            "row,node",
            "rov,node",
            "dofs.csv: line 1: columns must be among row, node, direction, x, y, z, each at most once: `rov`",
        ),
        (
            "dofs.csv",
            "direction,x,y,z",
            "direction,x,y",
            "dofs.csv: line 1: coordinates must have all three columns x, y, z",
        ),
        ("supports.csv", "1,2,z,", "nan,2,z,", "supports.csv: line 4: x must be a finite number: `nan`"),
        (
            "supports.csv",
            "1,2,z,",
            "1,2,y,",
            "supports.csv: line 4: node and direction must be among the free rows: node 2, y",
        ),
        ("supports.csv", "1,2,z,", "1,2,z,inf", "supports.csv: line 4: weight must be a finite number: `inf`"),
        (
            "supports.csv",
            "x,node",
            "y,node",
            "supports.csv: line 1: columns must be among x, row, node, direction, weight",
        ),
        (
            "supports.csv",
            "node,direction",
            "row,direction",
            "supports.csv: line 1: there must be a column row, or node and direction",
        ),
        ("points.csv", "mid,", ",", "points.csv: line 3: name must be a name: ``"),
        (
            "K.sti",
            "1 1 200",
            "1 1 -200",
            "K.sti: the diagonal of the stiffness matrix must be positive: row 1 (node 2, x): -2e2",
        ),
        (
            "K.sti",
            "4 4 10",
            "4 4 0",
            "K.sti: the diagonal of the stiffness matrix must be positive: row 4 (node 3, z): 0e0",
        ),
        (
            "M.sti",
            "1 1 2",
            "1 1 -2",
            "M.sti: the diagonal of the mass matrix must not be negative: row 1 (node 2, x): -2e0",
        ),
    ];
    for (file, from, to, expected) in cases {
        let mut texts = good();
        assert!(texts[file].contains(from), "{file} {from}");
        texts.insert(file, texts[file].replacen(from, to, 1));
        let said = read(&files(), &texts).unwrap_err();
        assert!(said.contains(expected), "{said}\n{expected}");
    }
    let mut texts = good();
    texts.insert("supports.csv", "x,row\n1,5\n".into());
    assert_eq!(read(&files(), &texts).unwrap_err(), "supports.csv: line 2: row must lie between 1 and 4: 5");
    texts.insert("supports.csv", "x,row\n".into());
    assert_eq!(
        read(&files(), &texts).unwrap_err(),
        "supports.csv: there must be at least one support: no line of data"
    );
    let said = read(&Files { dofs: None, ..files() }, &good()).unwrap_err();
    assert!(said.contains("supports.csv: line 1: rows named by node and direction need the file `dofs`"), "{said}");
}

#[test]
fn problems_of_all_files_are_told_together() {
    let mut texts = good();
    texts.insert("K.sti", "1 1 x\n".into());
    texts.insert("M.sti", "1 1 y\n".into());
    texts.insert("dofs.csv", "row,node,direction\n1,1,q\n".into());
    texts.insert("supports.csv", "x,row\nz,1\n".into());
    let said = read(&files(), &texts).unwrap_err();
    for file in ["K.sti: line 1", "M.sti: line 1", "dofs.csv: line 2", "supports.csv: line 2"] {
        assert!(said.contains(file), "{said}");
    }
    // Its nodes cannot be known while dofs.csv is bad: that is no problem of its own.
    assert!(!said.contains("points.csv"), "{said}");
}

#[test]
fn one_bad_line_of_a_matrix_of_labels_is_the_only_problem_told() {
    let mut texts = good();
    texts.insert("K.sti", "7,3,7,3,10\n7,9,9,3,-5\n9,3,9,3,10\n".into());
    texts.insert("M.sti", "9,3,9,3,2\n".into());
    texts.insert("supports.csv", "x;node;direction;weight\n1;9;z;-1\n".into());
    let said = read(&Files { dofs: None, points: None, ..files() }, &texts).unwrap_err();
    assert!(said.starts_with("K.sti: line 2: nodes must be numbered") && !said.contains("supports.csv"), "{said}");
}

#[test]
fn weights_that_do_not_add_up_are_refused_with_the_slip() {
    let cases = [
        (
            "x,row,weight\n1,2,1\n2,4,1\n1,2,1\n2,4,1\n",
            "2 at all supports, first at x = 1 m: are its lines in the table more than once?",
        ),
        (
            "x,row,weight\n1,2,0.5\n2,4,0.5\n",
            "0.5 at all supports, first at x = 1 m: is a line with the other half missing?",
        ),
        ("x,row,weight\n1,2,-1\n2,2,-1\n3,2,1\n", "1 at 1 of 3 supports, first at x = 3 m: has it the wrong sign?"),
        ("x,row,weight\n1,2,-1\n2,2,-1\n3,2,1\n4,4,-0.7\n", "1 at x = 3 m, others elsewhere; 2 of 4 supports are so"),
    ];
    for (supports, expected) in cases {
        let mut texts = good();
        texts.insert("supports.csv", supports.into());
        for dofs in [None, Some("dofs.csv".to_owned())] {
            let unknown = dofs.is_none();
            let said = read(&Files { points: None, dofs, ..files() }, &texts).unwrap_err();
            let rule = "supports.csv: the weights of a support must add up to 1 (-1 if the axis points up), to 0 only over a \
                        bearing: ";
            assert!(said.starts_with(rule) && said.contains(expected), "{said}");
            assert_eq!(said.contains("no file `dofs`"), unknown, "{said}");
        }
    }
}

#[test]
fn weights_of_bearings_lever_arms_and_decks_at_an_angle_are_right() {
    let mut texts = good();
    texts.insert("dofs.csv", "row,node,direction\n1,2,y\n2,2,z\n3,2,rx\n4,3,z\n".into());
    // At the bearing 0; beside the axis with a lever arm; at 0.3 rad to z; of four digits.
    let supports = "x,row,weight\n1,2,0\n2,2,1\n2,3,1.5\n3,1,0.29552\n3,2,0.955336\n4,2,0.3333\n4,4,0.6666\n";
    texts.insert("supports.csv", supports.into());
    let model = read(&Files { points: None, ..files() }, &texts).unwrap_or_else(|said| panic!("{said}"));
    assert_eq!(model.supports.len(), 4);
}

#[test]
fn stations_that_differ_by_rounding_are_one_support() {
    let mut texts = good();
    texts.insert(
        "supports.csv",
        "x,row,weight\n0.65,2,0.5\n0.6500000000000001,4,0.5\n1.3,2,0.5\n1.2999995,4,0.5\n".into(),
    );
    let model = read(&Files { points: None, ..files() }, &texts).unwrap();
    assert_eq!(model.supports, [(0.65, vec![(1, 0.5), (3, 0.5)]), (1.2999995, vec![(1, 0.5), (3, 0.5)])]);
}

#[test]
fn rows_without_any_entry_are_held() {
    let mut texts = good();
    // Row 2 of four: once not there at all, once with zeros.
    for k in ["1 1 200\n1 3 -100\n3 3 100\n4 4 10\n", "1 1 200\n1 3 -100\n3 3 100\n4 4 10\n2 2 0\n2 4 0\n"] {
        texts.insert("K.sti", k.into());
        texts.insert("M.sti", "1 1 2\n3 3 5\n4 4 5\n".into());
        let model = read(&files(), &texts).unwrap_or_else(|said| panic!("{said}"));
        assert_eq!((model.held.as_slice(), model.k.diagonal()[1], model.m.diagonal()[1]), (&[1][..], 200.0, 0.0));
        assert_eq!(model.supports, [(1.0, vec![(1, 0.0)]), (1.5, vec![(1, 0.0), (3, 0.5)])]);
        let facts = model.inspect();
        assert_eq!((facts.held.as_slice(), facts.massless.is_empty(), facts.lone.len()), (&[1][..], true, 1));
    }
    // A mass without stiffness is free, not held.
    texts.insert("M.sti", "1 1 2\n2 2 2\n3 3 5\n4 4 5\n".into());
    let said = read(&files(), &texts).unwrap_err();
    assert!(
        said.contains("K.sti: the diagonal of the stiffness matrix must be positive: row 2 (node 2, z): 0e0"),
        "{said}"
    );
}

#[test]
fn every_table_is_read_in_every_dialect() {
    let mut texts = good();
    let model = read(&files(), &texts).unwrap();
    let all = ["dofs.csv", "supports.csv", "points.csv"];
    let comma = |text: &str| text.replace("1.5", "1,5").replace("0.5", "0,5").replace(".0", ",0");
    type Change = Box<dyn Fn(&str) -> String>;
    let changes: Vec<(&str, Change)> = vec![
        ("semicolons", Box::new(|t| t.replace(',', ";"))),
        ("tabs", Box::new(|t| t.replace(',', "\t"))),
        ("German Excel", Box::new(move |t| format!("\u{feff}{}", comma(&t.replace(',', ";")).replace('\n', "\r\n")))),
        ("sep=", Box::new(|t| format!("sep=;\n{}", t.replace(',', ";")))),
        ("trailing separators", Box::new(|t| t.replace('\n', ",,\n"))),
        ("capitals, units", Box::new(|t| t.replacen("x,", "X [m],", 1).replacen("weight", "Weight", 1))),
        ("remarks, empty lines", Box::new(|t| format!("# a, b; c\n\n{}\n  # d\n", t.replace('\n', "\n\n")))),
        ("old Mac", Box::new(|t| t.replace('\n', "\r"))),
        ("quoted", Box::new(|t| t.replace("1.5,", "\"1.5\",").replace("node,", "\"node\","))),
    ];
    for (name, change) in changes {
        for file in all {
            // A quoted name has a comma inside.
            texts.insert(file, change(&good()[file].replace("tip, down", "tip")));
        }
        if name == "trailing separators" {
            texts.insert("dofs.csv", good()["dofs.csv"].replace(",0\n", ",0,,\n"));
            texts.insert("supports.csv", good()["supports.csv"].replace("0.5\n", "0.5,\n"));
            texts.insert("points.csv", good()["points.csv"].replace("tip, down", "tip"));
        }
        let other = read(&files(), &texts).unwrap_or_else(|said| panic!("{name}: {said}"));
        assert_eq!((&other.supports, &other.dofs), (&model.supports, &model.dofs), "{name}");
    }
}

#[test]
fn what_could_be_read_in_two_ways_is_refused() {
    let cases = [
        (
            "x;row;weight\n0,5;2;1\n1.5;4;1\n",
            "line 3: points and commas before decimals must not be mixed: `1.5`, and another in line 2",
        ),
        (
            "x,row,weight\n0,5,2,1\n",
            "line 2: a line must not have more fields than the header: 4 fields for 3 columns; with commas before decimals, fields must be apart by semicolons",
        ),
        ("x;row;weight\n1.234,5;2;1\n", "line 2: x must be a finite number: `1.234,5`"),
        ("\u{0}x;row\n1;2\n", "a table must be a text file of UTF-8: it has bytes of value 0"),
        ("PK\u{3}\u{4}", "a table must be a text file of UTF-8: it is a workbook"),
    ];
    for (text, expected) in cases {
        let mut texts = good();
        texts.insert("supports.csv", text.into());
        let said = read(&Files { points: None, ..files() }, &texts).unwrap_err();
        assert!(said.contains(expected), "{said}");
    }
    let utf16 = Input::bytes("p.csv", vec![0xff, 0xfe, b'x', 0, b',', 0]);
    assert!(ttb_import::profile(&utf16).unwrap_err().to_string().contains("UTF-16: save it as UTF-8"));
}

#[test]
fn a_profile_is_read_with_gaps_and_refused_unsorted() {
    let read = |text: &str| ttb_import::profile(&Input::bytes("p.csv", text.as_bytes())).map_err(|p| p.to_string());
    for text in [
        "X;R\n0,0;0\n0,5;1,5e-3\n1,0;0\n",
        "# laser\nr [m],other,x [m]\n0,a,0\n1.5D-3,\"b, c\",0.5\n0,,1\n",
        "x r\n0 0\n  0.5   1.5e-3\n1 0 \n",
    ] {
        let found = read(text).unwrap_or_else(|said| panic!("{said}"));
        assert_eq!((found.x, found.r, found.remarks), (vec![0.0, 0.5, 1.0], vec![0.0, 1.5e-3, 0.0], vec![]), "{text}");
    }
    for (text, expected) in [
        ("x,r\n0,0\n2,0\n1,0\n", "p.csv: line 4: x must increase: 1 m after 2 m: sort the lines"),
        (
            "x,r\n3,0\n2,0\n1,0\n",
            "p.csv: line 3: x must increase: 2 m after 3 m (and 1 more lines): it falls throughout; sort the lines",
        ),
        ("x,r\n0,0\n1,0\n1,0\n", "line 4: x must increase: 1 m after 1 m: twice the same place"),
        (
            "x [km],r [mm]\n0,0\n",
            "line 1: the measured profile must have columns x and r: columns x [km], r [mm]; both in m",
        ),
        ("x,r\n0,0\n", "p.csv: the measured profile must have at least 2 lines: 1"),
        ("x,r\n0,nan\n1,0\n", "p.csv: line 2: r must be a finite number: `nan`"),
        ("x,x,r\n0,0,0\n", "line 1: columns must be different, each at most once: `x`"),
    ] {
        assert!(read(text).unwrap_err().contains(expected), "{:?}", read(text));
    }
}
