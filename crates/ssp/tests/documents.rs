//! What is written is read again; what is wrong in a document is found, all of it, each with its place.

use ttb_ssp::{
    Annotation, BaseUnit, Binding, Component, Connection, Connector, Content, Experiment, Kind, Parameter,
    ParameterSet, Source, Structure, System, Transformation, Type, Unit, Value, Values, pack, read, write,
};

fn structure() -> Structure {
    let end = |element: &str, connector: &str| (Some(element.to_string()), connector.to_string());
    let real = |name: &str, kind, unit: &str| Connector {
        name: name.into(),
        kind,
        kind_of_value: Some(Type::Real(Some(unit.into()))),
        place: String::new(),
    };
    let component = |name: &str, source: &str, connectors| Component {
        name: name.into(),
        source: Source::inside(source),
        connectors,
        ..Component::default()
    };
    let connection = |start, end, factor, offset| Connection {
        start,
        end,
        transformation: Transformation::linear(factor, offset),
        suppress_unit_conversion: factor != 1.0,
        place: String::new(),
    };
    let powers = [1, 1, -2, 0, 0, 0, 0, 0];
    let parameter =
        |name: &str, value| Parameter { name: name.into(), value, file: "a.ssd".into(), place: String::new() };
    let parameters =
        vec![parameter("EI", Value::Real(1e11 / 3.0, None)), parameter("kind", Value::Item("a<b".into(), None))];
    let values = Values::Inline(ParameterSet { name: "p".into(), parameters });
    let binding = Binding { values, ..Binding::default() };
    let bound = |component: Component| Component { bindings: vec![binding.clone()], ..component };
    Structure {
        name: "a < b & \"c\"".into(),
        description: Some("Brücke".into()),
        tool: Some("ttb".into()),
        system: System {
            name: "S".into(),
            components: vec![
                component("train", "resources/Zug 1.fmu", vec![real("f[1]", Kind::Output, "kN")]),
                bound(component("bridge", "resources/b.fmu", vec![real("F_1", Kind::Input, "kN")])),
            ],
            connections: vec![
                connection(end("train", "f[1]"), end("bridge", "F_1"), -1e3, 0.1 + 0.2),
                connection(end("bridge", "u"), end("train", "u"), 1.0, 0.0),
            ],
            ..System::default()
        },
        enumerations: Vec::new(),
        units: vec![Unit { name: "kN".into(), base: BaseUnit { powers, factor: 1e3, offset: 0.0 } }],
        experiment: Experiment {
            start: Some(0.0),
            stop: Some(1.1),
            annotations: vec![Annotation {
                kind: "org.example".into(),
                prefix: "e".into(),
                namespace: "urn:example".into(),
                elements: vec!["A".into(), "B".into()],
                attributes: vec![("step".into(), "0.001".into())],
                place: String::new(),
            }],
        },
    }
}

/// Without what only a document that was read has, or only one that is written.
fn plain(mut structure: Structure) -> Structure {
    let components = &mut structure.system.components;
    components.iter_mut().for_each(|component| (component.place, component.source.raw) = (String::new(), None));
    components.iter_mut().flat_map(|c| &mut c.connectors).for_each(|connector| connector.place.clear());
    for binding in components.iter_mut().flat_map(|c| &mut c.bindings) {
        binding.place.clear();
        if let Values::Inline(set) = &mut binding.values {
            set.parameters.iter_mut().for_each(|parameter| parameter.place.clear());
        }
    }
    structure.system.place.clear();
    structure.system.connections.iter_mut().for_each(|connection| connection.place.clear());
    for annotation in &mut structure.experiment.annotations {
        annotation.place.clear();
        annotation.namespace.clear();
    }
    structure
}

#[test]
fn what_is_written_is_read_again() {
    let text = write(&structure(), None).unwrap();
    let again = read(text.as_bytes(), "a.ssd").unwrap_or_else(|report| panic!("{report}\n{text}"));
    assert_eq!(
        again.system.connections[1].place,
        "/SystemStructureDescription/System[@name='S']/Connections/Connection[2]"
    );
    assert_eq!(plain(again), plain(structure()));
}

#[test]
fn the_same_structure_gives_the_same_bytes() {
    let folder = tempfile::tempdir().unwrap();
    let fmu = folder.path().join("b.fmu");
    std::fs::write(&fmu, "an FMU").unwrap();
    let paths = ["a.ssp", "b.ssp"].map(|name| folder.path().join(name));
    for path in &paths {
        let entries = [("resources/b.fmu", Content::File(&fmu)), ("extra/org.ttb/a.json", Content::Text("{}"))];
        pack(&structure(), &entries, None, std::fs::File::create(path).unwrap()).unwrap();
    }
    assert_eq!(std::fs::read(&paths[0]).unwrap(), std::fs::read(&paths[1]).unwrap());
    let text = |date| ttb_ssp::write(&structure(), date).unwrap();
    assert!(!text(None).contains("generationDateAndTime"));
    assert!(text(Some("2026-01-31T12:00:00Z")).contains("generationDateAndTime=\"2026-01-31T12:00:00Z\""));
    let nowhere = folder.path().join("no.fmu");
    let missing =
        pack(&structure(), &[("resources/b.fmu", Content::File(&nowhere))], None, std::io::Cursor::new(Vec::new()));
    assert!(missing.unwrap_err().to_string().contains("no.fmu cannot be read"));
}

#[test]
fn empty_containers_are_nothing() {
    let good = write(&structure(), None).unwrap();
    let expected = plain(read(good.as_bytes(), "a.ssd").unwrap());
    let empty = [
        ("<ssd:Connectors>", "<ssd:ParameterBindings/><ssd:Connectors>"),
        ("<ssd:Elements>", "<ssd:Connectors/><ssd:ParameterBindings></ssd:ParameterBindings><ssd:Elements>"),
        ("</ssd:System>", "<ssd:SignalDictionaries/><ssd:Annotations/></ssd:System>"),
        ("<ssd:Units>", "<ssd:Enumerations/><ssd:Units>"),
    ];
    for (what, with) in empty {
        let text = good.replacen(what, with, 1);
        assert!(text != good, "{what}");
        assert_eq!(
            plain(read(text.as_bytes(), "a.ssd").unwrap_or_else(|report| panic!("{report}"))),
            expected,
            "{with}"
        );
    }
    let without_unit = read(good.replace("unit=\"kN\"", "unit=\"\"").as_bytes(), "a.ssd").unwrap();
    assert_eq!(without_unit.system.components[0].connectors[0].kind_of_value, Some(Type::Real(None)));
}

/// What is replaced in a good document, by what, and what is said of it.
const BROKEN: [(&str, &str, &str); 21] = [
    ("<?xml", "<xml", "/xml: an attribute cannot be read"),
    ("</ssd:SystemStructureDescription>", "", "ends before its last element is closed"),
    ("</ssd:System>", "</ssd:Sytem>", "is not well-formed near byte"),
    ("version=\"1.0\" name", "version=\"3.0\" name", "is for SSP \"3.0\""),
    ("<ssd:System ", "<ssd:Systems ", "is not well-formed"),
    (
        "<ssd:SystemStr",
        "<!DOCTYPE a [<!ENTITY b \"bb\"><!ENTITY c \"&b;&b;\">]><ssd:SystemStr",
        "document type declaration",
    ),
    ("name=\"S\"", "name=\"&boom;\"", "/System: the attribute name cannot be read"),
    ("name=\"S\"", "name=\"S\" name=\"T\"", "/System[@name='S']: an attribute cannot be read"),
    ("name=\"train\"", "name=\"bridge\"", "another element of this name"),
    ("resources/b.fmu", "%zz.fmu", "/Component[@name='bridge']: the attribute source is \"%zz.fmu\": a percent sign"),
    ("resources/b.fmu", "http://a/b.fmu", "nothing is fetched from elsewhere"),
    ("source=\"resources/b.fmu\"", "", "the attribute source is missing"),
    ("x-fmu-sharedlibrary", "table", "its type is \"application/table\"; only FMUs"),
    ("implementation=\"CoSimulation\"", "implementation=\"ModelExchange\"", "only co-simulation is supported"),
    ("ssv:Real value=\"", "ssv:Real value=\"x", "/Parameter[@name='EI']/Real: the attribute value is no number"),
    ("<ssd:Elements>", "<ssd:Elements><ssd:Robot name=\"r\"/>", "/Robot[@name='r']: an element Robot is not known"),
    (
        "<ssv:Parameter name=\"kind\">",
        "<ssv:Parameter name=\"EI\">",
        "another parameter of this name with another value",
    ),
    ("kind=\"input\"", "kind=\"inward\"", "a connector needs a name and a kind"),
    ("startConnector=\"u\"", "", "/Connections/Connection[2]: has no attribute startConnector"),
    ("factor=\"-1000.0\"", "factor=\"NaN\"", "Connection[1]/LinearTransformation: the attribute factor is no number"),
    ("stopTime=\"1.1\"", "stopTime=\"soon\"", "/DefaultExperiment: the attribute stopTime is no number"),
];

#[test]
fn every_broken_document_is_refused_with_its_place() {
    let good = write(&structure(), None).unwrap();
    for (what, by, said) in BROKEN {
        assert!(good.contains(what), "{what}");
        let report = read(good.replacen(what, by, 1).as_bytes(), "a.ssd").unwrap_err().to_string();
        assert!(report.contains(said) && report.starts_with("a.ssd: "), "{what} → {by}: {report}");
    }
    assert!(read(&[0xFF, 0xFE, b'<', 0], "a.ssd").unwrap_err().to_string().contains("UTF-8"));
    assert!(read(b"<a/>", "a.ssd").unwrap_err().to_string().contains("has the root element a,"));
    assert!(read(b"", "a.ssd").is_err());
}

#[test]
fn all_problems_come_at_once() {
    let mut text = write(&structure(), None).unwrap();
    for (what, by, _) in BROKEN.iter().skip(17) {
        text = text.replacen(what, by, 1);
    }
    let report = read(text.as_bytes(), "a.ssd").unwrap_err();
    assert_eq!(report.problems().len(), 4, "{report}");
}

#[test]
fn hostile_documents_end_soon() {
    let deep = format!("{}{}", "<a>".repeat(500), "</a>".repeat(500));
    assert!(read(deep.as_bytes(), "a.ssd").unwrap_err().to_string().contains("deep"));
    let wide = format!("<a>{}</a>", "<b/>".repeat(600_000));
    assert!(read(wide.as_bytes(), "a.ssd").unwrap_err().to_string().contains("elements"));
}
